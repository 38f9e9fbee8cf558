"""Arcs: apexes in time and angle, against the closed form."""

import numpy as np
import pytest

from rockref.measure.arcs import arcs, turned_angle
from rockref.measure.experiment import load_experiment
from rockref.measure.impacts import Impacts, main_impacts


def exact(motion, count):
    """The impacts of the closed form, so that arcs are tested and not the search for impacts."""
    return Impacts(
        motion.times[:count],
        motion.sign * (-1) ** np.arange(count),
        motion.before[:count],
        (motion.before - motion.after)[:count],
        np.zeros(count, dtype=np.int64),
    )


@pytest.mark.parametrize("sign", [1, -1])
def test_apexes_of_the_closed_form(rocking, sign):
    motion = rocking(sign=sign)
    t = np.arange(0.0, 3.0, 0.001)
    found = arcs(t, motion.crv(t), exact(motion, 4))
    assert len(found) == 5
    assert found.complete.tolist() == [False, True, True, True, False]
    assert found.starts[1:].tolist() == found.ends[:-1].tolist() == motion.times[:4].tolist()
    assert (found.starts[0], found.ends[-1]) == (t[0], t[-1])
    # The trapezoidal rule over a drop of 0.02 rad/s inside a sample of 1 ms: 1e-5 rad at most.
    assert np.allclose(found.rise[1:], motion.apexes[1:5], rtol=0.0, atol=2e-5)
    assert np.allclose(found.fall[:4], motion.apexes[:4], rtol=0.0, atol=2e-5)
    assert np.isnan(found.rise[0]) and np.isnan(found.fall[-1])
    assert np.allclose(found.apex_angles, motion.apexes[:5], rtol=0.0, atol=2e-5)
    middles = 0.5 * (motion.times[:3] + motion.times[1:4])
    # A line through 80 ms of a sinh has its root where the sinh has it, by symmetry.
    assert np.allclose(found.apex_times[1:4], middles, rtol=0.0, atol=1e-4)
    assert found.apex_times[0] == t[0]


def test_a_record_cut_before_the_apex_has_none(rocking):
    motion = rocking()
    t = np.arange(0.0, motion.times[1] + 0.1, 0.001)
    found = arcs(t, motion.crv(t), exact(motion, 2))
    assert np.isnan(found.apex_times[-1]) and np.isnan(found.rise[-1]) and np.isnan(found.apex_angles[-1])


def test_a_record_without_impacts_is_one_arc(rocking):
    motion = rocking()
    t = np.arange(0.0, 0.4, 0.001)
    found = arcs(t, motion.crv(t), main_impacts(t, motion.crv(t)))
    assert len(found) == 1
    assert not found.complete.any()
    assert np.isnan(found.apex_angles[0])


def test_integral_of_a_straight_line_is_exact():
    t = np.cumsum(np.random.default_rng(3).uniform(0.5, 1.5, 50))
    assert np.allclose(turned_angle(t, 2.0 * t), t**2 - t[0] ** 2, rtol=1e-13)


@pytest.mark.parametrize("number", [1, 4, 6, 8])
def test_shipped_runs_fall_from_their_stated_tilt(shipped, number):
    experiment = load_experiment(shipped / f"mystery-{number:02d}", uses=("fit",))
    for run in experiment.fit_runs():
        found = arcs(run.t, run.crv, main_impacts(run.t, run.crv))
        # The stated uncertainty of the tilt, twice, and 0.4 mrad of the posture at the impact.
        assert abs(abs(found.fall[0]) - run.release_tilt) < 2 * experiment.tilt_uncertainty + 4e-4
        assert np.sign(found.fall[0]) == (-1 if run.block_turned == 0.0 else 1)
        # Up and down again: what is not closed is clatter about the instants of impact.
        closed = np.abs(found.rise - found.fall)[found.complete]
        assert closed.max() < 0.03 * run.release_tilt
