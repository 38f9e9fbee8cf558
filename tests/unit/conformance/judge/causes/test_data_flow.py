"""What comes after the first wrong quantity of a run follows from it."""

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.call import ask
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge.causes.data_flow import law_extrapolated, with_consequences_marked
from rockref.conformance.judge.causes.slips import exponential
from rockref.conformance.judge.compare_answer import Check, compare
from rockref.conformance.judge.verdict import AFTER_STEPPING, stand_ins


def marks(id_, **changes):
    """By name of each failure whether it follows, where entries of the law's answer to a short run are changed."""
    vector = next(v for v in vectors.layer("L5s") if v.id == id_)
    out = {k: np.array(a) for k, a in ask(NumpyEngine(), vector).items() if k in ("x", "Lambda", "W", "F", "anchored")}
    for key, at in changes.items():
        out[key][at] += 10.0 if key == "F" else 1e-3
    checks = with_consequences_marked(compare(vector, out), [(vector, out)])
    return {c.name: c.follows for c in checks if c.failed}


@pytest.mark.parametrize(
    ("changes", "follows"),
    [
        ({"F": (1, 7, 0)}, False),
        ({"F": (1, 7, 0), "x": (1, 0)}, True),
        ({"F": (1, 7, 0), "W": (0, 2)}, True),
        ({"F": (1, 7, 0), "x": (2, 0)}, False),
    ],
)
def test_friction_after_a_wrong_pose_follows_from_it(changes, follows):
    assert marks("L5s-S1-0131", **changes)["F_T@1"] is follows


def test_friction_after_wrong_friction_is_looked_at_for_itself():
    """The anchors of a foot keep what its friction was: the first wrong friction is no other cause."""
    assert marks("L5s-T4-0070", F=(slice(1, None), 7, 0))["F_T@2"] is False
    assert marks("L5s-T4-0070", F=([1, 2], [7, 7], [2, 0]))["F_T@2"] is True, "its normal force is one"


def test_rates_after_wrong_forces_follow_from_them():
    assert marks("L5s-I5-0040", W=(1, 0)) == {"W@1": False}
    assert marks("L5s-I5-0040", W=(1, 0), F=(1, 0, 0)) == {"W@1": True}


def test_a_second_step_stands_for_its_forces_behind_what_shows_the_step():
    assert stand_ins()["L5s-N2-0166", "x@2"] == AFTER_STEPPING
    assert ("L5s-S1-0033", "x@2") not in stand_ins()


def test_what_steps_of_another_integrator_show_follows_from_wrong_forces_of_the_start():
    step = Check("LS-A1-0030", "LS", "A1", "x@1", "outside")
    force = Check("L5s-T5-0045", "L5s", "T5", "F_T@0", "outside")
    answers = [(v, {}) for name in ("LS", "L5s") for v in vectors.layer(name) if v.id in (step.vector, force.vector)]
    assert not any(c.follows for c in with_consequences_marked([step], answers))
    assert [c.follows for c in with_consequences_marked([step, force], answers)] == [True, False]


@pytest.mark.parametrize(("share", "follows"), [(0.9, True), (1.5, False)])
def test_an_attitude_of_another_integrator_follows_from_its_rates_as_far_as_they_explain_it(share, follows):
    """The turn is off by a share of the time of the row times what the rates are off by."""
    vector = next(v for v in vectors.layer("LS") if v.id == "LS-I3-0125")
    right, apart = law_extrapolated(vector.id), np.array([0.0, 1e-3, 0.0])
    out = {k: np.array(right[k]) for k in ("x", "Lambda", "W")}
    out["W"][1] += apart
    out["Lambda"][1] = out["Lambda"][1] @ exponential(share * apart / vector.inputs["output_rate"])
    (check,) = [c for c in with_consequences_marked(compare(vector, out, "scheme"), [(vector, out)]) if c.failed]
    assert check.name == "Lambda@1" and check.follows is follows
