"""Batches of compiled runs: the rows of single runs, on any number of threads."""

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("numba")

import rockref
from rockref.effects.catalogue import EFFECTS
from rockref.engines.compiled import batch, engine
from rockref.engines.compiled import columns as col
from rockref.engines.compiled.batch import from_problems, run_batch, run_reduced
from tests.property.engines.problems import similar_problem
from tests.refusal import refused

MODEL = rockref.Model.table_3_1()


@pytest.fixture(scope="module")
def problems():
    drag, support = EFFECTS["quadratic_drag"](c=0.5), EFFECTS["compliant_support"](frequency=80.0)
    changes = [{}, {"effects": (drag,)}, {"K_N": 5e7, "effects": (support,)}, {"theta_0": 0.1}]
    return [MODEL.replace(**change).problem(0.04) for change in changes]


def test_rows_are_those_of_single_runs(problems):
    """Runs with and without effects may stand in one batch; pose, forces and memories are recorded."""
    states, forces, memories = run_batch(from_problems(problems), full=True)
    for i, problem in enumerate(problems):
        r = engine.simulate(problem)
        np.testing.assert_array_equal(states[i, :, col.W_ : col.W_ + 3], r.W)
        np.testing.assert_array_equal(states[i, :, col.TIME], r.t)
        np.testing.assert_array_equal(forces[i], r.F)
        np.testing.assert_array_equal(memories[i, :, :, col.ANCHORED] != 0, r.anchored)


@pytest.mark.parametrize("workers", [1, 2, 3, 7])
def test_any_number_of_threads(problems, workers):
    batch = from_problems(problems)
    np.testing.assert_array_equal(run_batch(batch, workers=workers), run_batch(batch, workers=1))


def test_a_batch_can_be_run_twice(problems):
    """The run does not write into the batch that it is given."""
    batch = from_problems(problems)
    before = batch.memory.copy(), batch.state.copy()
    np.testing.assert_array_equal(run_batch(batch), run_batch(batch))
    np.testing.assert_array_equal(batch.memory, before[0])
    np.testing.assert_array_equal(batch.state, before[1])


def test_each_run_may_have_its_own_rows(problems):
    batch = from_problems(problems)
    own = np.arange(1, 5)[:, None] * np.array([[10, 500]])
    states = run_batch(replace(batch, wanted=own))
    for i, steps in enumerate(own):
        alone = run_batch(replace(from_problems(problems[i : i + 1]), wanted=steps))
        np.testing.assert_array_equal(states[i], alone[0])


def test_from_a_negative_step_number_on_nothing_is_recorded(problems):
    """Rows that nobody wants stay as they are; those before them are the same bits."""
    batch = from_problems(problems)
    own = np.array([[0, 10, 500], [0, 10, -1], [0, -1, -1], [7, -1, -1]])
    states = run_batch(replace(batch, wanted=own), out=np.full((4, 3, col.STATE), 4.0))
    np.testing.assert_array_equal(states[own < 0], 4.0)
    every = run_batch(replace(batch, wanted=np.array([0, 7, 10, 500])))
    for b, row in zip(*np.nonzero(own >= 0), strict=True):
        np.testing.assert_array_equal(states[b, row], every[b, [0, 7, 10, 500].index(own[b, row])])
    # Of fresh memory nothing shows through.
    fresh, forces, memories = run_batch(replace(batch, wanted=own), full=True)
    for rows in (fresh, forces, memories):
        asked = np.broadcast_to((own >= 0).reshape(own.shape + (1,) * (rows.ndim - 2)), rows.shape)
        assert np.array_equal(np.isnan(rows), ~asked)
    assert np.array_equal(fresh[own >= 0], states[own >= 0])


def test_a_lost_run_has_no_numbers_in_the_rows_that_are_wanted():
    bad = similar_problem(4, 4)
    bad = bad.replace(start=replace(bad.start, W=np.array([np.inf, 0, 0])))
    batch = replace(from_problems([bad]), wanted=np.array([0, 5, 9, -1]))
    states = run_batch(batch, out=np.full((1, 4, col.STATE), 4.0))[0, :, col.W_]
    assert np.isnan(states[1:3]).all() and states[3] == 4.0


def test_a_summary_of_runs_is_that_of_all_their_rows(problems, monkeypatch):
    """In pieces of a few runs, none of which holds more than its own rows."""
    whole, seen = from_problems(problems * 5), []
    monkeypatch.setattr(batch, "ROWS_A_PIECE", 1)
    monkeypatch.setattr(batch, "PIECES", 1)

    def largest(states):
        seen.append(len(states))
        return np.abs(states[:, :, col.W_ : col.W_ + 3]).max(axis=1)

    found = run_reduced(whole, largest, workers=1)
    assert sum(seen) == 20 and max(seen) < 20
    np.testing.assert_array_equal(found, largest(run_batch(whole)))


def test_a_run_that_loses_its_numbers_spoils_no_other():
    good, bad = similar_problem(3, 4), similar_problem(4, 4)
    bad = bad.replace(start=replace(bad.start, W=np.array([np.inf, 0, 0])))
    states = run_batch(from_problems([bad, good]), workers=1)
    assert np.isnan(states[0, 1:, col.W_]).all()
    np.testing.assert_array_equal(states[1, :, col.W_ : col.W_ + 3], engine.simulate(good).W)


def test_restart_from_a_recorded_row_with_forces(problems):
    """A row of a full record, with forces and memories, continues the run bit for bit."""
    batch = from_problems(problems)
    states, forces, memories = run_batch(batch, full=True)
    wanted = batch.wanted[40:] - batch.wanted[40]
    rest = replace(batch, state=states[:, 40], memory=memories[:, 40], forces=forces[:, 40], wanted=wanted)
    np.testing.assert_array_equal(run_batch(rest), states[:, 40:])


def test_problems_that_do_not_fit_together_are_refused(problems):
    error = refused(from_problems, [problems[0], problems[1].replace(step=5e-6)])
    assert error.code == "E-STACK" and error.where == "step"
    error = refused(from_problems, [problems[0], rockref.Model.four_points().problem(0.04)])
    assert error.where == "points"


@pytest.mark.parametrize("key", ["body", "props", "memory", "effects", "state", "forces"])
def test_arrays_of_a_wrong_shape_are_refused(problems, key):
    batch = from_problems(problems)
    error = refused(run_batch, replace(batch, **{key: getattr(batch, key)[..., :-1]}))
    assert error.code == "E-SHAPE" and key in error.where
