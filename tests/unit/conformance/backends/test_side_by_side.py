"""Runs side by side are the runs by themselves, to the bit."""

from dataclasses import replace

import numpy as np

from rockref.conformance import vectors
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.backends.side_by_side import grouped, simulate, with_inert_points


def short(name, steps, every):
    p = vectors.trajectory(name).problem
    return replace(p, duration=steps * p.step, output_rate=1 / (every * p.step))


def test_runs_of_other_lengths_rows_and_points_are_put_together_and_taken_apart():
    problems = [short("table_3_1", 60, 4), short("four_points", 40, 5), short("one_foot_missing", 32, 2)]
    assert grouped(problems) == [[0, 1, 2]]
    engine = NumpyEngine()
    for problem, found in zip(problems, simulate(engine, problems), strict=True):
        alone = engine.simulate(problem)
        for key in ("t", "W", "x", "Lambda", "F", "anchored"):
            assert np.array_equal(np.asarray(found[key]), getattr(alone, key)), key


def test_what_has_another_step_or_rows_between_steps_or_is_much_shorter_stays_apart():
    problems = [short("table_3_1", 60, 4), short("step_2e-5", 60, 4), short("table_3_1", 60, 2.6), short("drop", 20, 4)]
    assert sorted(map(sorted, grouped(problems))) == [[0], [1], [2], [3]]


def test_inert_points_never_touch():
    p = with_inert_points(short("four_points", 10, 1), 6)
    assert p.points.n == 6 and p.points.names[-1] == "inert 1"
    assert not NumpyEngine().simulate(p).anchored[:, 4:].any()
