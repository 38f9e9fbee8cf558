"""What the card says of a misfit, on residuals in place of fits."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover.signature import signature

RUNS, WINDOWS, SAMPLES = 4, 10, 60


def misfit(axis: int, loud: dict[int, float]):
    """Fit and point of windows of noise, of which some (by number) are so many times as loud on one axis."""
    r = np.random.default_rng(3).normal(size=(RUNS * WINDOWS, SAMPLES, 3))
    for window, times in loud.items():
        r[window, :, axis] *= times
    first = np.arange(RUNS * WINDOWS) % WINDOWS == 0
    count = np.full(len(r), 3 * SAMPLES)
    valid = np.ones((len(r), SAMPLES), bool)
    series = SimpleNamespace(first=first, count=count, valid=valid, rate=1000.0)
    fit = SimpleNamespace(series=series, residual=lambda z, c: r)
    point = SimpleNamespace(z=None, corrections=None, loss=0.5 * np.sum(r**2, axis=(1, 2)))
    return fit, point


def card(axis, loud):
    fit, point = misfit(axis, loud)
    return signature(fit, point, fit, point)


@pytest.mark.parametrize("axis, name", list(enumerate(("main", "transverse", "longitudinal"))))
def test_the_axis_is_that_of_the_largest_misfit(axis, name):
    found = card(axis, {0: 3.0, 13: 3.0})
    assert found["axis"] == name
    assert found["axis_shares"][name] > 0.9


def test_what_shows_in_every_first_swing_belongs_to_the_release():
    found = card(0, {k * WINDOWS: 3.0 for k in range(RUNS)})
    assert found["phase"] == "release"
    # One axis of three at 9 times its power; that of 60 samples of noise is known to sqrt(2/60) = 0.18.
    assert found["loss_at_release"] == pytest.approx(11 / 3, rel=0.3) and found["loss_after"] == pytest.approx(
        1, rel=0.1
    )


def test_a_blow_in_the_first_swing_of_one_run_does_not():
    found = card(2, {0: 6.0, 13: 6.0, 27: 6.0, 35: 6.0})
    assert found["phase"] == "impacts"
    assert found["loss_at_release"] < 1.5
