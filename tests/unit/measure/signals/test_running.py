"""Running means against their slow twins."""

import numpy as np
import pytest

from rockref.measure.signals.running import half_width, running_mean, running_rms, sample_step


@pytest.mark.parametrize("half", [1, 2, 7, 50])
def test_running_mean_is_the_mean_of_what_is_there(half):
    x = np.random.default_rng(1).standard_normal((30, 2))
    slow = np.array([x[max(i - half, 0) : i + half + 1].mean(axis=0) for i in range(len(x))])
    assert np.allclose(running_mean(x, half), slow, rtol=0.0, atol=1e-14)
    square = np.array([np.sqrt((x[max(i - half, 0) : i + half + 1] ** 2).mean(axis=0)) for i in range(len(x))])
    assert np.allclose(running_rms(x, half), square, rtol=0.0, atol=1e-14)


def test_rms_of_nothing_is_zero():
    x = np.concatenate((np.ones(50), np.zeros(50)))
    assert running_rms(x, 3)[-1] == 0.0


@pytest.mark.parametrize(("window", "half"), [(0.002, 1), (0.009, 5), (0.1, 50), (1e-9, 1)])
def test_half_width_in_samples(window, half):
    t = np.arange(2000) / 1000.0
    assert half_width(t, window) == half
    assert sample_step(t) == pytest.approx(1e-3, rel=1e-12)


def test_the_interval_is_a_mean_wherever_time_begins():
    assert sample_step(np.array([5.0, 5.125, 5.5])) == 0.25


@pytest.mark.parametrize(("window", "half"), [(0.0049, 2), (0.0051, 3)])
def test_half_a_window_is_rounded_to_the_nearest_sample(window, half):
    assert half_width(7.0 + np.arange(2000) / 1000.0, window) == half


def test_sums_are_taken_in_double_precision():
    x = np.full(100_000, 0.1, np.float32)
    # In single precision the last of so many sums is wrong in its fourth digit.
    assert np.allclose(running_mean(x, 3), float(x[0]), rtol=1e-9)
