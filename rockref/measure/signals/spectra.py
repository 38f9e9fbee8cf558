"""Amplitude spectra of the rates over a stretch, at the same frequencies whatever the sampling."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockref.measure.signals.impacts import checked_signal
from rockref.model.errors import InputError

# decided: the clatter between the first two impacts has 10 to 50 Hz, its harmonics fade into the noise by 150 Hz;
# an arc of 0.8 s resolves 2.5 Hz with a Hann window, and half of that draws its lines.
FREQUENCIES = np.arange(2.5, 150.0 + 1e-9, 1.25)
# decided: samples at a time, so that the table of phases stays below 8 MB.
_BLOCK = 4096


@dataclass(frozen=True, eq=False)
class Spectrum:
    """Amplitudes (3, F) rad/s of the rates about X, Y, Z at frequencies (F,) Hz: a sine of amplitude a reads a."""

    frequencies: np.ndarray
    amplitudes: np.ndarray

    def peak(self, axis: int) -> tuple[float, float]:
        """Return frequency Hz and amplitude rad/s of the largest line of axis 0, 1 or 2."""
        at = int(np.argmax(self.amplitudes[axis]))
        return float(self.frequencies[at]), float(self.amplitudes[axis, at])


def amplitude_spectrum(
    t: np.ndarray, crv: np.ndarray, start: float, end: float, frequencies: np.ndarray | None = None
) -> Spectrum:
    """Return the spectrum between `start` and `end` s of a run with times t (N,) s and rates crv (N, 3) rad/s.

    A straight line is taken out of each rate and a Hann window laid over the stretch. The Fourier sums are evaluated at
    `frequencies` (F,) Hz, at the true times, so that records of different rates and lengths share their abscissae.
    Raises InputError E-SIGNAL, E-STRETCH if less than eight samples lie between start and end.
    """
    t, crv = checked_signal(t, crv)
    frequencies = FREQUENCIES if frequencies is None else np.asarray(frequencies, dtype=np.float64)
    first, last = np.searchsorted(t, (start, end))
    if last - first < 8:
        what = f"{last - first} samples between {start:g} and {end:g} s"
        raise InputError("E-STRETCH", "arguments start, end", what, "Give a stretch of the run.")
    inside, x = t[first:last] - t[first], crv[first:last]
    basis, _ = np.linalg.qr(np.stack((np.ones_like(inside), inside - inside.mean()), axis=-1))
    x = x - basis @ (basis.T @ x)
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * inside / inside[-1])
    weighted = x * window[:, np.newaxis]
    total = np.zeros((len(frequencies), 3), dtype=np.complex128)
    for head in range(0, len(inside), _BLOCK):
        phases = np.exp(-2j * np.pi * np.outer(frequencies, inside[head : head + _BLOCK]))
        total += phases @ weighted[head : head + _BLOCK]
    return Spectrum(frequencies, 2.0 * np.abs(total.T) / window.sum())
