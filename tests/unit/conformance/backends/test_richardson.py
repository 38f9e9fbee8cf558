"""Other integrators: right ones pass, mistakes in them have names."""

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.load import load
from rockref.conformance.backends.richardson import extrapolated, refined
from rockref.conformance.faults.mistakes import BY_ID
from rockref.conformance.faults.run import BlackBox
from rockref.conformance.judge.compare_answer import no_answer
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import verdict
from rockref.conformance.reports import terminal


def test_extrapolation_leaves_nothing_of_first_and_second_order():
    h = 0.01
    rows = [{"t": [0, 1], "x": np.array([1.0, 2.0]) + k + 3 * k**2 + k**3, "W": None} for k in (h, h / 2, h / 4)]
    out = extrapolated(rows)
    assert np.allclose(out["x"], [1.0, 2.0], rtol=0, atol=h**3)
    assert not np.allclose(2 * rows[1]["x"] - rows[0]["x"], [1.0, 2.0], rtol=0, atol=h**2), "two rows do not do"
    assert "W" not in out and out["t"] == [0, 1]
    with pytest.raises(ValueError, match="smaller steps"):
        extrapolated([{"x": np.zeros(3)}, {"x": np.zeros(2)}, {"x": np.zeros(3)}])


def test_what_does_not_depend_on_the_step_stays_to_the_bit():
    same = {"x": np.array([0.1, 1e-17, 7.0])}
    assert np.array_equal(extrapolated([same, same, same])["x"], same["x"])


def test_a_part_of_the_step_is_the_same_run():
    problem = vectors.problem_of(vectors.layer("LS")[0].inputs)
    assert refined(problem, 4).step == problem.step / 4 and refined(problem, 4).duration == problem.duration


def test_short_runs_of_other_integrators_show_places_rates_and_poses():
    shown = {name for v in vectors.layer("LS") for name in v.expect}
    assert shown == {"x@1", "x_T@1", "Lambda@1", "W@1"}
    assert {v.rule for v in vectors.layer("LS")} >= {
        "A1",
        "A2",
        "A3",
        "I2",
        "I3",
        "K1",
        "N1",
        "T1",
        "T2",
        "T3",
        "T4",
        "T5",
        "T6",
    }


class Hidden(BlackBox):
    """Runs without their forces: more is looked at in the later rows."""

    def __init__(self, backend):
        super().__init__(backend)
        self.simulate = lambda problem: vars(backend.simulate(problem)) | {"F": None}


def test_a_run_that_cannot_be_made_is_a_failure_where_all_that_is_asked_stands_in_for_forces():
    vector = next(v for v in vectors.layer("LS") if all(e.instead_of for e in v.expect.values()))
    checks = no_answer(vector, "the step is too large")
    assert {c.name for c in checks} == set(vector.expect) and all(c.failed and not c.weighed for c in checks)
    some = next(v for v in vectors.layer("L5s") if {bool(e.instead_of) for e in v.expect.values()} == {True, False})
    assert {c.name for c in no_answer(some, "")} == {k for k, e in some.expect.items() if not e.instead_of}


def test_another_integrator_passes_by_runs_alone():
    v = verdict(judge(BlackBox(load("scheme")), ["L5s", "LS"], "scheme"))
    assert v.passed, terminal.text(v)
    shown = [c for c in v.findings.checks if c.layer == "LS"]
    hidden = judge(Hidden(load("scheme")), ["LS"], "scheme").checks
    assert 20 < len(shown) < len(hidden) and not any(c.failed for c in hidden)


@pytest.mark.parametrize("id_", ["Z71", "Z93", "Z27", "Z02", "Z53", "Z24", "Z64"])
def test_mistakes_in_another_integrator_are_named_by_runs_alone(id_):
    v = verdict(judge(BlackBox(BY_ID[id_].of_another_scheme()), ["L5s", "LS"], "scheme"))
    assert v.rule == BY_ID[id_].rule, terminal.text(v)


def test_in_the_profile_of_the_law_they_are_not_asked():
    assert judge(load("numpy"), ["LS"]).layers == ()
    assert judge(load("scheme"), ["L4", "L1"], "scheme").layers == ("L1",)
