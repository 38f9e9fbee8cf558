"""Amplitude spectra: a sine reads its amplitude, whatever the sampling."""

import numpy as np
import pytest

from rockref.measure.signals.spectra import FREQUENCIES, amplitude_spectrum
from tests.refusal import refusal


@pytest.mark.parametrize("rate", [500.0, 1000.0, 2000.0, 1234.5])
@pytest.mark.parametrize("phase", [0.0, 1.0])
def test_sines_read_their_amplitudes(rate, phase):
    t = np.arange(0.0, 1.0, 1.0 / rate)
    crv = np.stack(
        [a * np.sin(2.0 * np.pi * f * t + phase) for a, f in ((1.0, 20.0), (0.3, 45.0), (2.0, 100.0))], axis=-1
    )
    found = amplitude_spectrum(t, crv, 0.0, 1.0)
    for axis, (a, f) in enumerate(((1.0, 20.0), (0.3, 45.0), (2.0, 100.0))):
        peak, height = found.peak(axis)
        assert peak == f
        # The side lobes of the line's mirror image and of the straight line taken out.
        assert height == pytest.approx(a, rel=5e-3)
        far = np.abs(found.frequencies - f) > 10.0
        assert found.amplitudes[axis, far].max() < 0.01 * a


def test_drift_and_offset_do_not_show():
    t = np.arange(1000) / 1000.0
    crv = np.stack((5.0 + 3.0 * t, -2.0 * t, np.ones_like(t)), axis=-1)
    assert amplitude_spectrum(t, crv, 0.0, 1.0).amplitudes.max() < 1e-12


def test_only_the_stretch_is_looked_at():
    t = np.arange(3000) / 1000.0
    tone = np.where((t >= 1.0) & (t < 2.0), np.sin(2.0 * np.pi * 30.0 * t), 100.0 * np.sin(2.0 * np.pi * 60.0 * t))
    found = amplitude_spectrum(t, np.stack((tone, tone, tone), axis=-1), 1.0, 2.0)
    assert found.peak(2) == (30.0, pytest.approx(1.0, rel=5e-3))


def test_against_the_fast_fourier_transform():
    """At the frequencies of the transform, and without the line taken out, the sums are its own."""
    rng = np.random.default_rng(2)
    n = 800
    t = np.arange(n) / 1000.0
    x = rng.standard_normal((n, 3))
    basis, _ = np.linalg.qr(np.stack((np.ones(n), t), axis=-1))
    x = x - basis @ (basis.T @ x)
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * np.arange(n) / (n - 1))
    expected = 2.0 * np.abs(np.fft.rfft(x * window[:, None], axis=0)) / window.sum()
    frequencies = np.fft.rfftfreq(n, 1e-3)
    found = amplitude_spectrum(t, x, 0.0, 1.0, frequencies)
    assert np.allclose(found.amplitudes, expected.T, rtol=0.0, atol=1e-12)


def test_long_records_are_summed_in_pieces():
    t = np.arange(10000) / 1000.0
    tone = np.sin(2.0 * np.pi * 25.0 * t)
    found = amplitude_spectrum(t, np.stack((tone, tone, tone), axis=-1), 0.0, 10.0)
    assert found.amplitudes.shape == (3, len(FREQUENCIES))
    assert found.peak(0) == (25.0, pytest.approx(1.0, rel=1e-3))


def test_eight_samples_are_enough_and_frequencies_any_sequence():
    t = np.arange(1000) / 1000.0
    found = amplitude_spectrum(t, np.zeros((1000, 3)), 0.492, 0.5, [5, 10])
    assert found.frequencies.dtype == np.float64 and found.amplitudes.shape == (3, 2)


def test_what_is_said_of_seven_samples():
    t = np.arange(1000) / 1000.0
    said = ("E-STRETCH", "arguments start, end", "7 samples between 0.493 and 0.5 s", "Give a stretch of the run.")
    assert refusal(amplitude_spectrum, t, np.zeros((1000, 3)), 0.493, 0.5) == said


def test_the_time_of_day_does_not_matter():
    t = np.arange(1000) / 1024.0
    crv = np.random.default_rng(3).standard_normal((1000, 3))
    here, there = amplitude_spectrum(t, crv, 0.25, 0.75), amplitude_spectrum(7.0 + t, crv, 7.25, 7.75)
    assert np.allclose(here.amplitudes, there.amplitudes, rtol=1e-9, atol=1e-15)
