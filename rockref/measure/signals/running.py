"""Running mean and RMS over a stretch of time."""

from __future__ import annotations

import numpy as np


def sample_step(t: np.ndarray) -> float:
    """Return the mean interval between samples, s, of times `t` (N,) s with N > 1."""
    return float(t[-1] - t[0]) / (len(t) - 1)


def half_width(t: np.ndarray, window: float) -> int:
    """Return how many samples on each side make a window of `window` seconds, at least one."""
    return max(1, int(0.5 * window / sample_step(t) + 0.5))


def running_mean(x: np.ndarray, half: int) -> np.ndarray:
    """Return the mean of x (N, ...) over `half` samples on each side; at the ends over those that there are."""
    n = len(x)
    total = np.concatenate((np.zeros((1, *x.shape[1:])), np.cumsum(x, axis=0, dtype=np.float64)))
    first = np.maximum(np.arange(n) - half, 0)
    last = np.minimum(np.arange(n) + half + 1, n)
    count = (last - first).reshape(-1, *(1,) * (x.ndim - 1))
    return (total[last] - total[first]) / count


def running_rms(x: np.ndarray, half: int) -> np.ndarray:
    """Return the RMS of x (N, ...) over `half` samples on each side, of the unit of x."""
    # Cancellation in the sums may leave a tiny negative number where x is zero.
    return np.sqrt(np.maximum(running_mean(np.square(x), half), 0.0))
