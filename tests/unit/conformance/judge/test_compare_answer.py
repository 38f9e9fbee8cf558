"""The first row of a run is the start; a run knows nothing of the one before; a block may have any number of feet."""

import numpy as np

from rockref.conformance import vectors
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.faults.mistakes import BY_ID
from rockref.conformance.faults.run import BlackBox
from rockref.conformance.judge.compare_answer import ELSEWHERE, OTHERWISE, first_row_elsewhere
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import suspects, verdict


def of_number(number):
    return next(v for v in vectors.layer("L5s") if int(v.id[-4:]) == number)


def test_a_first_row_that_is_not_the_start_speaks_of_the_run_before_anything_else():
    v = verdict(judge(BlackBox(BY_ID["Z139"].backend()), ["L5s"]))
    assert (v.rule, v.check.name, v.check.note) == ("S2", "x@0", ELSEWHERE)
    rates = verdict(judge(BlackBox(BY_ID["Z35"].backend()), ["L5s"]))
    assert suspects(rates) == ["S2", "M1"], "rates in other axes may be those of the channel"


def test_a_start_may_lose_what_is_too_small_to_be_physical():
    vector = of_number(36)
    rows = {k: np.stack([vector.inputs[k]] * 2) for k in ("x", "Lambda", "W")}
    for size, failures in ((1e-13, 0), (1e-11, 1)):
        moved = rows | {"x": rows["x"] + size}
        assert len(first_row_elsewhere(vector, moved, "float64")) == failures
    assert first_row_elsewhere(vector, rows | {"x": rows["x"].astype(np.float32)}, "float32") == []


class Remembering(NumpyEngine):
    """The law, whose feet slide at a start if they did at the end of the run before."""

    left = np.zeros(8, bool)

    def simulate(self, problem):
        if problem.points.n == 8:
            start = problem.start
            object.__setattr__(start, "sliding", start.sliding | self.left)
        response = super().simulate(problem)
        self.left = response.final_state.sliding if problem.points.n == 8 else self.left
        return response


def test_who_remembers_the_run_before_is_found_by_runs_one_after_another():
    numbers = [int(v.id[-4:]) for v in vectors.layer("L5s")]
    assert numbers == sorted(numbers), "they are asked in this order"
    v = verdict(judge(Remembering(), ["L5s"]))
    assert "L5s-T6-0162" in {c.vector for c in v.findings.failures}
    assert (v.rule, v.check.note) == ("S2", OTHERWISE)


def test_a_block_may_stand_on_more_feet_and_on_fewer():
    assert {len(v.inputs["P"]) for v in vectors.layer("L5s")} == {3, 8, 12}
    v = verdict(judge(BlackBox(BY_ID["Z136"].backend()), ["L5s"]))
    assert v.rule == "N1" and v.check.vector == "L5s-N1-0157"


class Changed:
    """The law's runs, changed: `change` gets problem and rows, and may alter these."""

    precision = "float64"

    def __init__(self, change):
        self.change, self.law = change, NumpyEngine()

    def simulate(self, problem):
        rows = {k: np.array(getattr(self.law.simulate(problem), k)) for k in ("t", "W", "x", "Lambda", "F", "anchored")}
        self.change(problem, rows)
        return rows


def test_rows_after_the_forces_are_looked_at_where_nothing_else_is_wrong():
    vector = next(v for v in vectors.layer("L5s") if v.expect.get("x@2") is not None and v.expect["x@2"].instead_of)
    asked = vectors.problem_of(vector.inputs)

    def elsewhere(problem, rows):
        if np.array_equal(problem.start.x, asked.start.x) and len(rows["x"]) == 3:
            rows["x"][2] += 1e-6

    shown = judge(Changed(elsewhere), ["L5s"]).failures
    assert ("x@2", vector.id) in {(c.name, c.vector) for c in shown}
    assert judge(Changed(lambda problem, rows: None), ["L5s"]).failures == []


def test_what_a_run_leaves_behind_speaks_of_the_run():
    left = [0.0]

    def remembers(problem, rows):
        rows["W"][1:] += left[0]
        left[0] = 1e-3 * (1.0 + abs(rows["W"][-1, 2]))

    v = verdict(judge(Changed(remembers), ["L5s"]))
    assert (v.rule, v.check.note) == ("S2", OTHERWISE)
    for id_, rule in (("Z30", "I2"), ("Z101", "I3")):
        wrong = verdict(judge(BlackBox(BY_ID[id_].backend()), ["L5s"]))
        assert wrong.rule == rule, "the same answer every time, a number or none"
