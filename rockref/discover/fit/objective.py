"""How far innovations are from white noise: a robust loss, its mean, and its smoothing in time."""

from __future__ import annotations

import math

import numpy as np

#: Scale of the Cauchy loss in noise widths; decided: an innovation of five widths counts half as much as under a normal
#: law, so that an impact that falls out of step does not decide a fit.
CAUCHY = 5.0


def loss(r: np.ndarray) -> np.ndarray:
    """Return the robust loss of innovations r, in units of r^2: its mean is WHITE for white noise of size one."""
    return CAUCHY**2 * np.log1p((r / CAUCHY) ** 2)


def _white() -> float:
    """Return the expectation of the loss for a standard normal innovation, by Gauss-Hermite quadrature."""
    x, w = np.polynomial.hermite_e.hermegauss(80)
    return float(w @ loss(x) / math.sqrt(2 * math.pi))


#: Mean loss of white noise of size one.
WHITE = _white()


def weight(r: np.ndarray) -> np.ndarray:
    """Return by how much an innovation counts in a Gauss-Newton step."""
    return 1 / (1 + (r / CAUCHY) ** 2)


def objective(r: np.ndarray, z: np.ndarray) -> float:
    """Return the negative logarithm of the posterior, but for a constant [nat]; z in prior deviations."""
    return float(0.5 * loss(r).sum() + 0.5 * (z @ z))


def mean_loss(r: np.ndarray, count: int | None = None) -> float:
    """Return the mean loss of `count` innovations (default: all); what is padded with zeros adds nothing."""
    return float(loss(r).sum() / (r.size if count is None else count))


def smoothed(r: np.ndarray, samples: float) -> np.ndarray:
    """Return Gaussian means along the third axis from the end, white noise kept at size one, thinned by their width."""
    if samples < 0.5:
        return r
    width, reach = max(1, round(samples)), int(4 * samples + 0.5)
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / samples) ** 2)
    kernel /= math.sqrt(float(kernel @ kernel))
    ends = [(0, 0)] * r.ndim
    ends[-2] = (reach, reach)
    windows = np.lib.stride_tricks.sliding_window_view(np.pad(r, ends), len(kernel), axis=-2)
    return windows[..., ::width, :, :] @ kernel


def inflation_for(r: np.ndarray, count: int, level: float) -> float:
    """Return by what innovations must be divided for a mean loss of `level`; at least 1."""
    if mean_loss(r, count) <= level:
        return 1.0
    low, high = 1.0, 1e3
    for _ in range(30):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if mean_loss(r / middle, count) > level else (low, middle)
    return high
