"""Pulses and noise against the closed forms of their spectra."""

import math

import numpy as np
import pytest

from rockref.model.errors import InputError
from rockref.shake.pulses import envelope, kanai_tajimi, kanai_tajimi_density, one_sine, ricker, white_noise


def spectrum(base, f):
    t = base.dt * np.arange(len(base.a))
    return np.abs(base.dt * np.exp(-2j * np.pi * np.outer(f, t)) @ base.a[:, 0])


def test_one_sine_has_its_spectrum():
    f, period = np.array([0.3, 1.1, 3.7]), 0.5
    w, wp = 2 * np.pi * f, 2 * np.pi / period
    expected = 2 * 3.0 * wp * np.abs(np.sin(w * period / 2)) / np.abs(wp**2 - w**2)
    # The sum over samples is the integral to (pi f dt)^2/3 and better.
    assert spectrum(one_sine(3.0, period, 1e-3), f) == pytest.approx(expected, rel=1e-4)


def test_ricker_has_its_spectrum_and_no_velocity_left():
    base, f = ricker(2.0, 0.8, 0.01), np.array([0.4, 1.25, 3.0])
    expected = 2.0 * 2 / math.sqrt(math.pi) * f**2 * 0.8**3 * np.exp(-((0.8 * f) ** 2))
    # A smooth pulse that ends at 1e-15: sums over samples are integrals.
    assert spectrum(base, f) == pytest.approx(expected, rel=1e-9)
    assert abs(base.a[:, 0].sum() * base.dt) < 1e-12 and base.a[:, 0].max() == pytest.approx(2.0)


def mean_power(make, frequencies, seeds=60):
    """One-sided power density about frequencies, mean over seeds and over a band of 0.2 Hz."""
    total = np.zeros(len(frequencies))
    for seed in range(seeds):
        base = make(seed)
        n = len(base.a)
        power = 2 * base.dt / n * np.abs(np.fft.rfft(base.a[:, 0])) ** 2
        f = np.fft.rfftfreq(n, base.dt)
        total += [power[np.abs(f - at) < 0.1].mean() for at in frequencies]
    return total / seeds


def test_white_noise_has_its_density():
    found = mean_power(lambda seed: white_noise(seed, 0.03, 40.0, 0.01), [1.0, 10.0, 40.0])
    # 480 periodogram values each: a standard deviation of 5 %; three of them.
    assert found == pytest.approx(0.03, rel=0.15)


def test_kanai_tajimi_noise_has_its_density():
    at = np.array([0.5, 2.5, 4.0, 12.0])
    found = mean_power(lambda seed: kanai_tajimi(seed, 0.02, 40.0, 0.01, low_cut=0.3), at)
    expected = kanai_tajimi_density(at, 0.02, 2.5, 0.6, 0.3)
    # As above; the density hardly changes within a band.
    assert found == pytest.approx(expected, rel=0.15)
    # At the ground's frequency (1 + 4 d^2)/(4 d^2).
    assert kanai_tajimi_density([2.5], 1.0, 2.5, 0.6) == pytest.approx((1 + 1.44) / 1.44)
    assert kanai_tajimi_density([0.0], 1.0, 2.5, 0.6, 0.3) == 0.0


def test_a_seed_is_a_motion_and_the_envelope_shapes_it():
    window = envelope(2.0, 5.0, 0.4)
    assert window(np.array([0.0, 1.0, 2.0, 7.0, 9.5])) == pytest.approx([0.0, 0.25, 1.0, 1.0, math.exp(-1.0)])
    one, same = (kanai_tajimi(7, 0.02, 20.0, 0.01, window=window) for _ in range(2))
    assert one == same and one != kanai_tajimi(8, 0.02, 20.0, 0.01, window=window)
    assert one.a[0, 0] == 0.0 and not one.a[:, 1:].any()


@pytest.mark.parametrize("make", [lambda: one_sine(1.0, 0.5, 0.03), lambda: white_noise(1, -1.0, 1.0, 0.1)])
def test_broken_steps_and_negative_power_are_refused(make):
    with pytest.raises(InputError, match="E-RANGE"):
        make()
