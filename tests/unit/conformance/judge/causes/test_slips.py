"""Common slips are told in words, with what shows them; other mistakes are not taken for one."""

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.faults.mistakes import BY_ID
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import as_json, verdict
from rockref.conformance.reports import terminal
from rockref.conformance.reports.page import page as page_of
from rockref.model.rotation import from_quaternion, quaternion

PIECES = ("L0", "L1", "L2", "L3", "L7")


class Slipping(NumpyEngine):
    """The law with one result of one piece changed."""

    def __init__(self, piece, name, change):
        super().__init__()
        right = getattr(self, piece)
        setattr(self, piece, lambda **q: (out := dict(right(**q))) | {name: change(np.asarray(out[name]), q)})


SLIPS = {
    "degrees for radians": ("integrate", "Theta", lambda a, q: np.degrees(a)),
    "radians for degrees": ("channel", "crv_deg_s", lambda a, q: np.radians(a)),
    "the other sign": ("kinematics", "xi_rate", lambda a, q: -a),
    "mm for m": ("kinematics", "r", lambda a, q: 1e3 * a),
    "X and Y exchanged": ("assemble", "moment", lambda a, q: a[[1, 0, 2]]),
    "Z with the other sign": ("channel", "crv_deg_s", lambda a, q: a * [1, 1, -1]),
    "the transpose": ("release", "Lambda", lambda a, q: a.T),
    "wxyz, xyzw": ("release", "Lambda", lambda a, q: from_quaternion(np.roll(quaternion(a), 1))),
    "plate axes for body axes": ("assemble", "T", lambda a, q: q["Lambda"] @ a),
    "body axes for plate axes": ("assemble", "moment", lambda a, q: q["Lambda"].T @ a),
    "a row late": ("channel", "crv_deg_s", lambda a, q: np.concatenate([a[:1], a[:-1]])),
}


@pytest.mark.parametrize("words", SLIPS)
def test_a_slip_is_told_before_the_rule(words):
    piece, name, change = SLIPS[words]
    v = verdict(judge(Slipping(piece, name, change), PIECES))
    assert words in v.slip and f"{name} of {piece}" in v.slip, v.slip
    lines = terminal.text(v).splitlines()
    at = [i for i, line in enumerate(lines) if "COMMON SLIP" in line]
    assert at and at[0] < next(i for i, line in enumerate(lines) if "FIRST DIVERGENCE" in line)
    assert as_json(v)["slip"] == v.slip


def test_the_evidence_is_the_ratio():
    v = verdict(judge(Slipping("integrate", "Theta", lambda a, q: np.degrees(a)), ["L3"]))
    assert "got/expected = 57.2958: degrees for radians" in v.slip
    assert f"<strong>Common slip:</strong> {v.slip}</p>" in page_of(v)


def test_rows_of_a_run_that_are_a_row_late_are_told():
    v = verdict(judge(BY_ID["Z84"].backend(), ["L5s"]))
    assert not v.passed and "the row before" in v.slip


@pytest.mark.parametrize("id_", ["Z02", "Z12", "Z36", "Z59"])
def test_other_mistakes_are_not_taken_for_a_slip(id_):
    v = verdict(judge(BY_ID[id_].backend(), PIECES))
    assert not v.passed and v.slip == ""


def test_a_start_evaluated_anew_is_told():
    v = verdict(judge(BY_ID["Z122"].backend(), ["L5s"]))
    assert not v.passed and "that of a start evaluated anew" in v.says
    assert any(x.inputs.get("a") is not None for x in vectors.layer("L5s"))
