"""Phases: planar, repeatable, erratic, quasi-two-dimensional, in that order and without overlap."""

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from rockref.measure.phases import ERRATIC, PLANAR, QUASI_2D, REPEATABLE, phases


@pytest.fixture
def clattering(rocking, sensed):
    """A record that clatters from 15 ms before its first impact until `stop`."""
    motion = rocking()

    def make(stop):
        t, crv = sensed(motion)
        since = t - motion.times[0] + 0.015
        clatter = np.where((since > 0.0) & (t < stop), 0.05 * np.sin(2.0 * np.pi * 20.0 * since), 0.0)
        return motion, t, crv + np.stack((0 * t, clatter, clatter), axis=-1)

    return make


def test_phases_of_a_made_record(clattering):
    motion, t, crv = clattering(2.0)
    found = phases(t, crv)
    assert [name for name, *_ in found.intervals] == [PLANAR, REPEATABLE, ERRATIC, QUASI_2D]
    assert found.onset == pytest.approx(motion.times[0] - 0.015, abs=5e-3)
    assert found.repeatable_until == pytest.approx(motion.times[1], abs=3e-3)
    assert not found.repeatable_from_runs
    assert found.quasi_2d_from == pytest.approx(motion.times[2], abs=3e-3)
    assert len(found.shares) == 5


def test_repeated_runs_say_how_long_it_repeats(clattering):
    _, t, crv = clattering(2.0)
    found = phases(t, crv, agree_until=1.9)
    assert found.repeatable_from_runs and found.repeatable_until == 1.9
    assert found.intervals[1][2] == found.intervals[2][1] == 1.9
    assert phases(t, crv, agree_until=np.inf).repeatable_until == t[-1]
    assert [name for name, *_ in phases(t, crv, agree_until=np.inf).intervals] == [PLANAR, REPEATABLE, QUASI_2D]


def test_clatter_to_the_end_leaves_no_planar_phase(clattering):
    _, t, crv = clattering(9.0)
    found = phases(t, crv)
    assert found.quasi_2d_from == np.inf
    assert found.intervals[-1][0] == ERRATIC


def test_planar_record_is_planar_throughout(rocking, sensed):
    t, crv = sensed(rocking())
    found = phases(t, crv)
    assert found.intervals == ((QUASI_2D, t[0], t[-1]),)
    assert np.isnan(found.onset)


@pytest.mark.parametrize("number", range(1, 12))
def test_intervals_tile_every_shipped_run(shipped, number):
    experiment = load_experiment(shipped / f"mystery-{number:02d}", uses=("fit",))
    for run in experiment.fit_runs():
        marks = phases(run.t, run.crv).intervals
        assert (marks[0][1], marks[-1][2]) == (run.t[0], run.t[-1])
        assert all(a[2] == b[1] for a, b in zip(marks[:-1], marks[1:], strict=True))
        assert all(end > start for _, start, end in marks)


def test_uneven_feet_stop_the_clatter(shipped):
    """In mystery-07 the feet are so uneven that the block hardly leaves its plane; the control clatters for 3 s."""
    uneven = load_experiment(shipped / "mystery-07", uses=("fit",)).runs[0]
    control = load_experiment(shipped / "mystery-08", uses=("fit",)).runs[0]
    assert phases(uneven.t, uneven.crv).quasi_2d_from == 0.0
    assert phases(control.t, control.crv).quasi_2d_from > 3.0
