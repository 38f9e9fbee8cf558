"""Numbers that were cut on their way out: the format is told, and no rule; a wrong rule keeps its name."""

import numpy as np
import pytest

from rockref.conformance.backends import json_lines
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.faults.mistakes import BY_ID
from rockref.conformance.judge.causes.digits import digits_of
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import verdict


class Cut:
    """The contact law of a backend with every number written in a format."""

    language, precision, name = "Python", "float64", "cut"

    def __init__(self, backend, written):
        self.backend = backend
        self.write = np.vectorize(lambda x: float(written % x), otypes=[float])

    def simulate(self, problem):
        return {k: self.write(getattr(self.backend.simulate(problem), k)) for k in ("t", "W", "x", "Lambda")}

    def contact_law(self, **q):
        out = dict(self.backend.contact_law(**q))
        return {k: v if np.asarray(v).dtype == bool else self.write(v) for k, v in out.items() if k != "trace"}


@pytest.mark.parametrize(
    ("written", "words"), [("%.10g", "more than 10 significant digits"), ("%.7f", "more than 7 decimals")]
)
def test_a_format_is_told_and_no_rule(written, words):
    v = verdict(judge(Cut(NumpyEngine(), written), ["L1"]))
    assert v.status == "FAIL" and v.rule is None and words in v.slip and "%.17g" in v.slip


@pytest.mark.parametrize("written", ["%.15g", "%.17g"])
def test_what_many_languages_print_by_default_passes(written):
    assert verdict(judge(Cut(NumpyEngine(), written), ["L1"])).passed


def test_a_wrong_rule_that_is_written_in_few_digits_keeps_its_name():
    v = verdict(judge(Cut(BY_ID["Z01"].backend(), "%.10g"), ["L1"]))
    assert v.rule == "N1" and "significant digits" not in v.slip


class SingleRows(NumpyEngine):
    """Computed in doubles, the rows of a run handed out in single precision."""

    def simulate(self, problem):
        rows = vars(super().simulate(problem))
        return {k: np.asarray(rows[k], np.float32) for k in ("W", "x", "Lambda", "F")}


def test_rows_in_single_precision_are_told_and_no_rule():
    v = verdict(judge(SingleRows(), ["L1", "L5s"]))
    assert v.status == "FAIL" and v.rule is None and "single precision" in v.slip and "float32" in v.slip


def test_who_computes_in_single_precision_is_told_of_the_profile():
    v = verdict(judge(NumpyEngine(np.float32), ["L1"]))
    assert v.status == "FAIL" and "single precision" in v.slip
    assert "single precision" not in verdict(judge(BY_ID["Z01"].backend(), ["L1"])).slip


def test_digits_and_decimals_are_those_of_the_shortest_decimal():
    assert digits_of(0.1) == (1, 1) and digits_of(-1250.0) == (3, 0) and digits_of(1.25e-7) == (3, 9)
    assert digits_of(1 / 3) == (16, 16)


def test_null_in_the_place_of_a_number_is_an_answer_that_is_none():
    out = json_lines.readable({"F_N": None, "F_T": [None, 1.0], "sliding": False, "trace": None}, "contact_law")
    assert np.isnan(out["F_N"]) and out["trace"] is None

    class Nulls(NumpyEngine):
        def contact_law(self, **q):
            return json_lines.readable({"F_N": None, "F_T": [None, 0.0]}, "contact_law")

    v = verdict(judge(Nulls(), ["L1"]))
    notes = {c.note for c in v.findings.failures}
    assert v.status == "FAIL" and notes == {"not a finite number", "holds null, which is no number (is it a NaN?)"}
