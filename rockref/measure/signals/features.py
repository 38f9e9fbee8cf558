"""The printed features of the response between the first two main impacts: the saw-tooth, its flanks, its curvature.

The source describes the transverse rate as a saw-tooth that "varies linearly between positive and negative values"
under a "quasi-constant, slightly convex envelope"; the longitudinal one as "a curve composed of two segments" under a
"highly concave envelope"; and a slight saw-tooth on the main rate, with peaks concomitant with theirs.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rockref.measure.signals.envelopes import LEAST_TOOTH
from rockref.measure.signals.running import half_width, running_mean
from rockref.model.errors import InputError

# decided: a flank of fewer samples has no shape.
LEAST_SAMPLES = 12
# decided: the turn at a tooth's tip takes a contact of a few milliseconds; a tenth of the flank on either side.
TIP = 0.1


@dataclass(frozen=True, eq=False)
class Flanks:
    """The flanks of a saw-tooth: K stretches from a maximum to the next minimum or back.

    Attributes: ``bounds`` (K, 2) indices of the samples; ``straightness`` (K,), share of the variance that one straight
    line explains; ``bend`` (K,), share of what it leaves that two joined lines explain in its place.
    """

    bounds: np.ndarray
    straightness: np.ndarray
    bend: np.ndarray


def extremes(x: np.ndarray, least: float = LEAST_TOOTH) -> np.ndarray:
    """Return the indices of the maxima and minima of x (N,), in turn, that stand out by `least` of its whole range."""
    from scipy.signal import find_peaks

    prominence = max(least * float(np.ptp(x)), 1e-300)
    tops, bottoms = find_peaks(x, prominence=prominence)[0], find_peaks(-x, prominence=prominence)[0]
    return np.sort(np.concatenate((tops, bottoms)))


def flanks(x: np.ndarray) -> Flanks:
    """Return the flanks of a signal x (N,) at equal time steps. Raises InputError E-STRETCH if there are none."""
    x = np.asarray(x)
    tips = extremes(x)
    bounds = np.array([(a, b) for a, b in pairwise(tips) if b - a >= LEAST_SAMPLES])
    if not len(bounds):
        raise InputError("E-STRETCH", "argument x", "has no saw-tooth", "Give a stretch with out-of-plane motion.")
    shapes = [_shape(x[a : b + 1]) for a, b in bounds]
    straightness, bend = np.array(shapes).T
    return Flanks(bounds, straightness, bend)


def _shape(y: np.ndarray) -> tuple[float, float]:
    """Return straightness and bend of one flank y (n,), its tips left out."""
    tip = int(TIP * len(y))
    y = y[tip : len(y) - tip]
    s = np.linspace(-1.0, 1.0, len(y))
    line = _unexplained(y, [np.ones_like(s), s])
    joints = s[2:-2:2]
    two_lines = min(_unexplained(y, [np.ones_like(s), s, np.maximum(s - joint, 0.0)]) for joint in joints)
    whole = float(np.sum((y - y.mean()) ** 2))
    return 1.0 - line / whole, 1.0 - two_lines / line if line > 0.0 else 0.0


def _unexplained(y: np.ndarray, terms: list[np.ndarray]) -> float:
    """Sum of squares that a linear combination of the terms leaves of y."""
    A = np.stack(terms, axis=-1)
    rest = y - A @ np.linalg.lstsq(A, y, rcond=None)[0]
    return float(rest @ rest)


def curvature(x: np.ndarray) -> float:
    """Return how much a parabola through the heights of the teeth of x (N,) bows, as a share of their mean.

    The heights are the absolute values at the extremes; the first and the last two, which belong to the impacts, are
    left out. Height of the parabola in the middle over the chord of its ends: negative is convex (sagging), positive
    concave. Raises InputError E-STRETCH for fewer than eight teeth.
    """
    tips = extremes(np.asarray(x))[2:-2]
    if len(tips) < 4:
        raise InputError("E-STRETCH", "argument x", "has fewer than eight extremes", "Give a whole arc.")
    heights, place = np.abs(np.asarray(x)[tips]), np.interp(tips, (tips[0], tips[-1]), (-1.0, 1.0))
    return float(-np.polyfit(place, heights, 2)[0] / heights.mean())


def ripple(t: np.ndarray, x: np.ndarray, window: float = 0.075) -> np.ndarray:
    """Return x (N,) at t (N,) s without its running mean over `window` s: the saw-tooth on the main rate, (N,)."""
    return np.asarray(x) - running_mean(np.asarray(x), half_width(t, window))


def rhythm(t: np.ndarray, x: np.ndarray) -> float:
    """Return the dominant period [s] of x (N,) at equal time steps t (N,) s: the highest line of its spectrum."""
    x = np.asarray(x) - np.mean(x)
    size = 8 * len(x)  # decided: eight times finer lines than the stretch is long, so that two periods can be compared
    spectrum = np.abs(np.fft.rfft(x * np.hanning(len(x)), size))
    return float(size * (t[1] - t[0]) / np.argmax(spectrum))
