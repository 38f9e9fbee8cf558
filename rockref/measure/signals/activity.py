"""Motion out of the plane of rocking: how much of it there is, and when it begins."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rockref.measure.signals.impacts import Impacts, checked_signal
from rockref.measure.signals.noise import NoiseFloor
from rockref.measure.signals.running import half_width, running_mean, running_rms

# decided: the out-of-plane motion begins some 20 ms before the first impact; 60 ms before it there is none yet.
BEFORE_IMPACT = 0.06
# decided: the first tooth of the saw reaches its top some 5 ms after the impact; the second one begins 10 ms later.
FIRST_EXCURSION = 0.01
# decided: two to ten periods of clatter.
ACTIVITY_WINDOW = 0.1
# decided: what stands out of the noise, of the disturbance before, and of the largest excursion that follows.
ONSET_SIGMAS, ONSET_REST, ONSET_SHARE = 4.0, 5.0, 0.03


@dataclass(frozen=True, eq=False)
class Leakage:
    """How much of the main rate shows on the other axes while the block rocks in its plane.

    Attributes: ``slopes`` (2,), rates about Y and Z per rate about X (of a misaligned gyroscope: small angles, rad);
    ``offsets`` (2,) rad/s; ``errors`` (2,), standard errors of the slopes for white residuals.
    """

    slopes: np.ndarray
    offsets: np.ndarray
    errors: np.ndarray


def leakage(t: np.ndarray, crv: np.ndarray, impacts: Impacts) -> Leakage:
    """Return the leakage in the first swing of a run with times t (N,) s and body rates crv (N, 3) rad/s.

    Without an impact, or with too short a swing, all is zero. Raises InputError E-SIGNAL.
    """
    t, crv = checked_signal(t, crv)
    count = int(np.searchsorted(t, impacts.times[0] - BEFORE_IMPACT)) if len(impacts) else 0
    if count < 16 or not np.ptp(crv[:count, 0]) > 0.0:
        return Leakage(np.zeros(2), np.zeros(2), np.zeros(2))
    basis = np.stack((crv[:count, 0], np.ones(count)), axis=-1)
    solution, *_ = np.linalg.lstsq(basis, crv[:count, 1:], rcond=None)
    rest = crv[:count, 1:] - basis @ solution
    spread = np.sqrt((rest**2).sum(axis=0) / (count - 2))
    errors = spread / np.sqrt(((basis[:, 0] - basis[:, 0].mean()) ** 2).sum())
    return Leakage(solution[0], solution[1], errors)


def out_of_plane(crv: np.ndarray, leak: Leakage) -> np.ndarray:
    """Return the rates about Y and Z, (N, 2) rad/s, of crv (N, 3) rad/s without what leaks from the main axis."""
    return crv[:, 1:] - crv[:, :1] * leak.slopes - leak.offsets


def activity(t: np.ndarray, crv: np.ndarray, leak: Leakage, window: float = ACTIVITY_WINDOW) -> np.ndarray:
    """Return the RMS, over `window` s, of the rate out of the plane: (N,) rad/s for crv (N, 3) rad/s."""
    rates = out_of_plane(crv, leak)
    return np.sqrt((running_rms(rates, half_width(t, window)) ** 2).sum(axis=1))


def arc_shares(t: np.ndarray, crv: np.ndarray, leak: Leakage, impacts: Impacts) -> np.ndarray:
    """Return, for each arc, out-of-plane over main rate (RMS): (M + 1,) for M impacts.

    Arcs are cut at the impacts; the first begins with the record (times t (N,) s, rates crv (N, 3) rad/s), the last
    ends with it. NaN for an arc without samples.
    """
    bounds = [0, *np.searchsorted(t, impacts.times), len(t)]
    square = (out_of_plane(crv, leak) ** 2).sum(axis=1)
    shares = np.full(len(bounds) - 1, np.nan)
    for k, (first, last) in enumerate(pairwise(bounds)):
        main = float((crv[first:last, 0] ** 2).sum()) if last > first else 0.0
        if main > 0.0:
            shares[k] = np.sqrt(float(square[first:last].sum()) / main)
    return shares


def onset(
    t: np.ndarray, crv: np.ndarray, impacts: Impacts, leak: Leakage, noise: NoiseFloor, *, level: float | None = None
) -> float:
    """Return when motion about the transverse axis begins, s: before the first main impact, in the source by 0.02 s.

    It is the instant from which the rate about Y keeps above the noise and the disturbance before, up to its largest
    value until just after the impact: above `level` rad/s if it is given, so that records of unlike noise compare. NaN
    without an impact or without such motion. Shapes as in :func:`activity`.
    """
    if not len(impacts):
        return math.nan
    first = float(impacts.times[0])
    wy = running_mean(out_of_plane(crv, leak)[:, 0], half_width(t, 0.003))
    calm = t < first - BEFORE_IMPACT
    near = np.flatnonzero((t >= first - BEFORE_IMPACT) & (t <= first + FIRST_EXCURSION))
    if not calm.any() or not len(near):
        return math.nan
    rest = float(np.sqrt(np.mean(wy[calm] ** 2)))
    size = np.abs(wy[near])
    top = int(np.argmax(size))
    if level is None:
        level = max(ONSET_SIGMAS * float(noise.sigma[1]), ONSET_REST * rest, ONSET_SHARE * float(size[top]))
    if size[top] <= level:
        return math.nan
    quiet = np.flatnonzero(size[: top + 1] <= level)
    return float(t[near[quiet[-1] + 1]]) if len(quiet) else float(t[near[0]])
