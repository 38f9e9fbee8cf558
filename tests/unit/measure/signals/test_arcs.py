"""Arcs: apexes in time and angle, against the closed form.

Then apexes on straight lines, whose roots are known, with other motion beside them.
"""

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from rockref.measure.signals.arcs import arcs, turned_angle
from rockref.measure.signals.impacts import Impacts, main_impacts
from tests.unit.measure.struck import struck


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


T = 2.0 + np.arange(1000) / 1000.0
ROOT = 2.5003


def apex(w, *bounds, t=T):
    """The apex between two impacts."""
    return arcs(t, np.stack([w, 0 * w, 0 * w], axis=-1), struck(*bounds)).apex_times[1]


def test_the_root_of_a_line_is_found_between_the_samples_and_rise_and_fall_are_its_integrals():
    w = 3.0 * (ROOT - T)
    found = arcs(T, np.stack([w, 0 * w, 0 * w], axis=-1), struck(2.1, 2.8))
    assert found.apex_times[:2] == pytest.approx([2.0, ROOT], abs=1e-12)
    # The integral is drawn straight between the samples: 3 h^2/8.
    assert found.rise[1] == pytest.approx(1.5 * (ROOT - 2.1) ** 2, abs=4e-7)
    assert found.fall[1] == pytest.approx(1.5 * (2.8 - ROOT) ** 2, abs=4e-7)
    assert found.fall[0] == pytest.approx(-1.5 * ((ROOT - 2.0) ** 2 - (ROOT - 2.1) ** 2), abs=4e-7)
    assert found.apex_angles[1] == pytest.approx(0.5 * (found.rise[1] + found.fall[1]), rel=1e-12)


def test_only_40_ms_on_either_side_are_looked_at():
    for reach, exact in ((0.0415, True), (0.0385, False)):
        w = np.where(np.abs(T - ROOT) < reach, ROOT - T, np.where(T < ROOT, 5.0, -1.0))
        assert (abs(apex(w, 2.1, 2.9) - ROOT) < 1e-9) == exact


@pytest.mark.parametrize("bounds", [(2.4805, 2.9), (2.1, 2.5205), (2.4805, 2.5205)])
def test_nothing_beyond_the_impacts_is_looked_at(bounds):
    w = np.where(bounds[0] > T, 5.0, np.where(bounds[1] < T, -1.0, ROOT - T))
    assert apex(w, *bounds) == pytest.approx(ROOT, abs=1e-9)


def test_of_several_changes_of_sign_the_middle_one_is_taken():
    """A line with two excursions through zero, 0.1 s before its root and after it, each of 20 ms."""
    w = ROOT - T
    w[(np.abs(T - 2.4) < 0.01) | (np.abs(T - 2.6) < 0.01)] *= -1.0
    assert apex(w, 2.1, 2.9) == pytest.approx(ROOT, abs=1e-9)


@pytest.mark.parametrize(("first", "exact"), [(20.2, True), (28.5, False)])
def test_fewer_than_four_samples_make_no_line(first, exact):
    """At 50 Hz an impact a sample and a half after the apex leaves four; another one as near before it leaves three.

    Then the apex is known to a sample.
    """
    step, root = 0.0195, 30.5 * 0.0195
    t = np.arange(60) * step
    found = apex(root - t, first * step, 31.5 * step, t=t)
    assert (abs(found - root) < 1e-9) == exact and abs(found - root) <= step


@pytest.mark.parametrize(
    ("w", "next_impact", "width"),
    [
        # The root of the line through a dip is more than 40 ms away.
        (np.where(np.abs(T - ROOT) < 0.01, -0.2, 1.0), 2.9, 0.016),
        # A line to zero 80 ms later, after the next impact, and a dip of 12 ms through zero.
        (np.where(np.abs(T - ROOT) < 0.006, -0.01, ROOT + 0.08 - T), ROOT + 0.07, 0.012),
    ],
)
def test_where_the_root_of_the_line_is_far_the_apex_stays_where_the_rate_changes_its_sign(w, next_impact, width):
    assert abs(apex(w, 2.1, next_impact) - ROOT) < width


def test_one_impact_leaves_the_angle_of_the_release():
    found = arcs(T, np.stack([np.ones(1000)] * 3, axis=-1), struck(2.25))
    assert found.fall[0] == pytest.approx(-0.25, rel=1e-9) and np.isnan(found.fall[1])
    assert found.apex_angles[0] == pytest.approx(-0.25, rel=1e-9)


def test_a_rate_of_one_sign_has_no_apex_and_no_angle():
    found = arcs(T, np.stack([np.ones(1000)] * 3, axis=-1), struck(2.1, 2.8))
    assert np.isnan(found.apex_times[1:]).all() and np.isnan(found.rise).all() and np.isnan(found.fall[1:]).all()


def test_without_an_impact_the_arc_has_no_angle():
    found = arcs(T, np.stack([ROOT - T] * 3, axis=-1), struck())
    assert (found.starts.tolist(), found.ends.tolist()) == ([T[0]], [T[-1]])
    assert np.isnan(found.rise).all() and np.isnan(found.fall).all()
