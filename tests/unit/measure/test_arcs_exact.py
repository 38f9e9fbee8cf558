"""Apexes on straight lines, whose roots are known, with other motion beside them."""

import numpy as np
import pytest

from rockref.measure.arcs import arcs
from rockref.measure.impacts import Impacts

T = 2.0 + np.arange(1000) / 1000.0
ROOT = 2.5003


def struck(*times):
    nothing = np.zeros(len(times))
    return Impacts(np.array(times, float), nothing, nothing, nothing, nothing.astype(int))


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


def test_a_dip_is_no_line_and_stays_where_the_rate_changes_its_sign():
    """The root of the line through it is more than 40 ms away."""
    w = np.where(np.abs(T - ROOT) < 0.01, -0.2, 1.0)
    assert abs(apex(w, 2.1, 2.9) - ROOT) < 0.016


def test_a_root_that_is_80_ms_away_is_not_that_of_this_apex():
    """A line to zero 80 ms later, after the next impact, and a dip of 12 ms through zero."""
    w = np.where(np.abs(T - ROOT) < 0.006, -0.01, ROOT + 0.08 - T)
    assert abs(apex(w, 2.1, ROOT + 0.07) - ROOT) < 0.012


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
