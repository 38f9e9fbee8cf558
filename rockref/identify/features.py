"""What the cost looks at: the main impacts, and between the first two the envelopes and spectra of two crv.

The same as `rockref.measure` gives, with a spectrum made for ten thousand runs: at the frequencies of
`rockref.measure.signals.spectra` a zero-padded fast transform has its lines, and costs a hundredth of the sums.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockref.measure.signals.envelopes import envelopes
from rockref.measure.signals.impacts import main_impacts
from rockref.measure.signals.running import sample_step
from rockref.measure.signals.spectra import FREQUENCIES, amplitude_spectrum

#: Distance of the lines of the padded transform [Hz]: every second one is a line of `FREQUENCIES`.
LINE = 0.625


@dataclass(frozen=True, eq=False)
class Features:
    """impacts (M,) [s]; and, where M > 1, between the first two, about Y and Z: upper, lower (2, P) [rad/s] envelopes,
    spectrum (2, F) [rad/s]."""

    impacts: np.ndarray
    upper: np.ndarray | None = None
    lower: np.ndarray | None = None
    spectrum: np.ndarray | None = None

    @property
    def duration(self) -> float:
        """Return time between the first two main impacts [s]."""
        return float(self.impacts[1] - self.impacts[0])


def features(t: np.ndarray, crv: np.ndarray) -> Features:
    """Return the features of a run t (N,) [s], crv (N, 3) [rad/s]. Raises InputError (E-SIGNAL)."""
    times = main_impacts(t, crv).times
    if len(times) < 2 or times[1] - times[0] < 0.05:
        return Features(times)
    outline = envelopes(t, crv, times[0], times[1])
    return Features(times, outline.upper, outline.lower, spectrum(t, crv, times[0], times[1]))


def spectrum(t: np.ndarray, crv: np.ndarray, start: float, end: float) -> np.ndarray:
    """Return amplitudes (2, F) [rad/s] about Y and Z between `start` and `end` [s], as `amplitude_spectrum` gives
    them."""
    step = sample_step(t)
    size = round(1 / (LINE * step))
    first, last = np.searchsorted(t, (start, end))
    if abs(size * LINE * step - 1) > 1e-9 or last - first > size:
        return amplitude_spectrum(t, crv, start, end).amplitudes[1:]
    x = crv[first:last, 1:]
    k = np.arange(len(x)) - (len(x) - 1) / 2
    slope = (k[:, None] * x).sum(axis=0) / (k * k).sum()
    x = x - x.mean(axis=0) - k[:, None] * slope
    window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(len(x)) / (len(x) - 1))
    lines = np.fft.rfft(x * window[:, None], size, axis=0)
    return 2 * np.abs(lines[np.rint(FREQUENCIES / LINE).astype(int)].T) / window.sum()
