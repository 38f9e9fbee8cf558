"""The band and where it is left."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover.compare.band import active_points, band, departures, running_error
from rockref.measure.signals.repeatability import Repeatability

T = np.arange(2000) / 1000.0


def repeats(spread):
    """Repeats whose spread, noise taken out, is the same everywhere."""
    full = np.full((1000, 3), spread)
    nothing = np.zeros((1000, 3))
    t = np.arange(1000) / 1000.0 - 0.5
    edge = np.full(3, np.inf)
    return Repeatability(t, nothing, nothing, nothing, full, full, np.zeros(3), np.zeros((2, 1)), edge, edge)


def test_without_repeats_the_band_is_three_noise_widths():
    noise = np.array([0.1, 0.2, 0.3])
    assert band(T, 0.5, noise, None) == pytest.approx(np.tile(3.0 * noise, (len(T), 1)))


def test_spread_widens_the_band_by_the_difference_of_two_runs():
    limits = band(T, 0.5, np.full(3, 0.1), repeats(0.2))
    # sqrt(0.1^2 + 2 * 0.2^2) = 0.3
    assert limits == pytest.approx(np.full((len(T), 3), 0.9))


def test_without_an_impact_the_spread_has_no_place():
    limits = band(T, np.inf, np.full(3, 0.1), repeats(0.2))
    assert limits == pytest.approx(np.full((len(T), 3), 0.3))


def test_running_error_is_a_quadratic_mean_over_50_ms():
    difference = np.zeros((len(T), 3))
    difference[1000, 0] = 1.0
    error = running_error(T, difference)
    # 25 samples on each side and the middle one.
    assert error[:, 0].max() == pytest.approx(1.0 / np.sqrt(51.0))
    assert np.count_nonzero(error[:, 0] > 1e-6) == 51


def test_what_was_not_simulated_is_no_error():
    difference = np.full((len(T), 3), np.nan)
    assert not running_error(T, difference).any()


def test_first_sample_outside_axis_by_axis():
    error = np.zeros((len(T), 3))
    error[700:, 1] = 2.0
    error[900:, 2] = 2.0
    assert departures(error, np.ones_like(error)) == [None, 700, 900]


@pytest.mark.parametrize(
    "time, touching", [(0.5, (("a", 1.0), ("c", 0.5))), (0.0, (("a", 1.0), ("c", 0.5))), (5.0, ()), (1.0005, ())]
)
def test_points_that_touch_about_an_instant_are_told_longest_first(time, touching):
    """Beyond the end of the simulation nothing is known of them."""
    t = np.arange(1001) * 1e-3
    anchored = np.stack([np.ones(1001), np.zeros(1001), np.arange(1001) % 2], axis=-1)
    response = SimpleNamespace(t=t, anchored=anchored, problem=SimpleNamespace(points=SimpleNamespace(names="abc")))
    found = active_points(response, time, 0.02 if time != 1.0005 else 0.0)
    assert [name for name, _ in found] == [name for name, _ in touching]
    assert [share for _, share in found] == pytest.approx([share for _, share in touching], abs=0.05)
