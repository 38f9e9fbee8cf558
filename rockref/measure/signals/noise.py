"""The noise floor of a record, from the stretches in which nothing happens."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockref.measure.signals.impacts import checked_signal
from rockref.measure.signals.running import sample_step
from rockref.model.errors import InputError

# decided: in 40 ms of free rocking a cubic follows the rate to 1e-4 deg/s, and 40 samples give the noise to 12 %.
WINDOW = 0.04
_DEGREE_OF_FIT = 3
# decided: of fewer windows none can be called the calm one.
LEAST_WINDOWS = 4
# decided: the calmest tenth is free of impacts in every run seen; windows up to half as strong again differ by chance.
CALM_SHARE, CALM_MARGIN = 10.0, 1.5
# decided: so many equal samples at an end of what a channel shows, of a fifth of its largest number at least, are a top
# that was cut, which holds no noise.
LEAST_FLAT, LARGE = 5, 0.2


@dataclass(frozen=True, eq=False)
class NoiseFloor:
    """The noise of each axis (main, transverse, longitudinal).

    Attributes: ``sigma`` (3,) rad/s, standard deviation of a sample about smooth motion; ``calm`` (3,) s, total
    length of the stretches it comes from; ``whiteness`` (3,), correlation of neighbouring residuals there (0 for white
    noise, towards 1 for slow disturbances); ``resolution`` (3,) rad/s, the smallest step between values, 0 if none.
    """

    sigma: np.ndarray
    calm: np.ndarray
    whiteness: np.ndarray
    resolution: np.ndarray


def noise_floor(t: np.ndarray, crv: np.ndarray, *, window: float = WINDOW) -> NoiseFloor:
    """Return the noise floor of a run with times t (N,) s and body rates crv (N, 3) rad/s.

    Half-overlapping windows of `window` s are fitted with a cubic; the residuals of the calm ones are the noise. Those
    that reach into a top that was cut are left out. A block that is smaller than that of Table 3.1 needs shorter ones.
    Raises InputError E-SIGNAL if the run is shorter than four windows or the shapes are wrong.
    """
    t, crv = checked_signal(t, crv)
    size = window_samples(sample_step(t), window)
    if len(t) < LEAST_WINDOWS * size:
        what = f"{len(t)} samples, less than four windows of {size}"
        raise InputError("E-SIGNAL", "arguments t, crv", what, "Give a longer run.")
    residuals = _window_residuals(crv, size)
    rms = np.sqrt((residuals**2).sum(axis=1) / (size - _DEGREE_OF_FIT - 1))
    told = _told(crv, size)
    calm = np.stack([_calm(rms[:, axis], told[:, axis]) for axis in range(3)], axis=1)
    sigma = np.array([np.median(rms[calm[:, axis], axis]) for axis in range(3)])
    whiteness = np.array([_neighbours(residuals[calm[:, axis], :, axis]) for axis in range(3)])
    length = calm.sum(axis=0) * (size // 2) * sample_step(t)
    return NoiseFloor(sigma, length, whiteness, smallest_step(crv))


def window_samples(step: float, window: float = WINDOW) -> int:
    """Return how many samples, `step` s apart, a window has: those of `window` s, and enough for a cubic."""
    return max(2 * (_DEGREE_OF_FIT + 1), round(window / step))


def _window_residuals(crv: np.ndarray, size: int) -> np.ndarray:
    """Return (windows, size, 3): what a cubic leaves in each half-overlapping window."""
    starts = np.arange(0, len(crv) - size + 1, size // 2)
    windows = crv[starts[:, np.newaxis] + np.arange(size)]
    basis, _ = np.linalg.qr(np.vander(np.linspace(-1.0, 1.0, size), _DEGREE_OF_FIT + 1))
    return windows - np.einsum("sk,uk,wua->wsa", basis, basis, windows, optimize=True)


def _told(crv: np.ndarray, size: int) -> np.ndarray:
    """Return (windows, 3): which windows hold no top that was cut; all of an axis where too few would be left."""
    cut = np.zeros(crv.shape, bool)
    for axis in range(3):
        x = crv[:, axis]
        large = LARGE * np.abs(x).max()
        for end in (x.max(), x.min()):
            if abs(end) > large:
                cut[:, axis] |= _stretches(x == end, LEAST_FLAT)
    told = ~cut[np.arange(0, len(crv) - size + 1, size // 2)[:, np.newaxis] + np.arange(size)].any(axis=1)
    return told | (told.sum(axis=0) < LEAST_WINDOWS)


def _stretches(marked: np.ndarray, least: int) -> np.ndarray:
    """Return (N,) which of the marked samples stand in stretches of `least` of them at least."""
    number = np.cumsum(np.diff(marked, prepend=False))  # of the stretch of alike samples that each stands in
    kept: np.ndarray = marked & (np.bincount(number)[number] >= least)
    return kept


def _calm(rms: np.ndarray, told: np.ndarray) -> np.ndarray:
    """Return (windows,) which of those that tell are calm, by what a cubic leaves in each (windows,) rad/s."""
    calm: np.ndarray = told & (rms <= CALM_MARGIN * np.percentile(rms[told], CALM_SHARE))
    return calm


def _neighbours(residuals: np.ndarray) -> float:
    power = float(np.mean(residuals**2))
    return float(np.mean(residuals[:, 1:] * residuals[:, :-1])) / power if power > 0.0 else 0.0


def smallest_step(crv: np.ndarray) -> np.ndarray:
    """Return (3,) rad/s: the step of which all differences in crv (N, 3) are multiples; 0 where there is none."""
    steps = np.zeros(3)
    for axis in range(3):
        levels = np.unique(crv[:, axis])
        jumps = np.diff(levels)
        # Two texts of one level may differ by rounding in their conversion to rad/s.
        jumps = jumps[jumps > 1e-9 * max(np.abs(levels).max(), 1e-300)]
        if not len(jumps):
            continue
        least = float(jumps.min())
        off = np.abs(jumps / least - np.rint(jumps / least))
        # decided: a thousandth of a step is rounding; a signal without steps has jumps of every size.
        steps[axis] = least if off.max() < 1e-3 and len(levels) < len(crv) else 0.0
    return steps
