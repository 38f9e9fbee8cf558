"""Upper and lower envelopes of the transverse and longitudinal rates between two main impacts."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rockref.measure.signals.impacts import checked_signal
from rockref.measure.signals.running import half_width, running_mean, sample_step
from rockref.model.errors import InputError

# decided: fine enough for the shape of an arc with twenty saw-teeth; the same for model and data of any rate.
POINTS = 64
# decided: as at the main impacts, three samples at 1 kHz.
FINE_WINDOW = 0.002
# decided: a tooth stands out by this share of the largest excursion, or by four noise widths; smaller ones are ripples.
LEAST_TOOTH = 0.05
# decided: the slowest clatter seen has a period of 0.093 s; where no tooth stands out for longer, the clatter has died,
# and the envelope follows the largest values of stretches of half that length.
SLOWEST_PERIOD = 0.1
AXES = (1, 2)


@dataclass(frozen=True, eq=False)
class Envelope:
    """Envelopes of one arc at P equidistant instants.

    Attributes: ``t`` (P,) s; ``upper``, ``lower`` (2, P) rad/s, of the rates about Y and Z; ``teeth`` (2,), number of
    maxima of each; ``periods`` (2,) s, median interval between maxima (NaN if there are fewer than two).
    """

    t: np.ndarray
    upper: np.ndarray
    lower: np.ndarray
    teeth: np.ndarray
    periods: np.ndarray


def envelopes(
    t: np.ndarray, crv: np.ndarray, start: float, end: float, *, noise: float = 0.0, points: int = POINTS
) -> Envelope:
    """Return the envelopes between `start` and `end` s of a run with times t (N,) s and rates crv (N, 3) rad/s.

    The upper one joins the tops of the teeth by straight lines, the lower one the bottoms, both from the signal at the
    start of the arc to that at its end; where there is no tooth for 0.1 s they follow the signal. `noise` rad/s is the
    standard deviation of a sample.
    Raises InputError E-SIGNAL, E-STRETCH if less than eight samples lie between start and end.
    """
    t, crv = checked_signal(t, crv)
    first, last = np.searchsorted(t, (start, end))
    if last - first < 8:
        what = f"{last - first} samples between {start:g} and {end:g} s"
        raise InputError("E-STRETCH", "arguments start, end", what, "Give a stretch of the run.")
    inside, half = t[first:last], half_width(t, FINE_WINDOW)
    grid = np.linspace(inside[0], inside[-1], points)
    upper, lower = np.empty((2, points)), np.empty((2, points))
    teeth, periods = np.zeros(2, dtype=np.int64), np.full(2, np.nan)
    for row, axis in enumerate(AXES):
        x = running_mean(crv[first:last, axis], half)
        least = max(LEAST_TOOTH * float(np.ptp(x)), 4.0 * noise)
        tops = _tops(x, least)
        upper[row] = _joined(inside, x, tops, grid)
        lower[row] = -_joined(inside, -x, _tops(-x, least), grid)
        teeth[row] = len(tops)
        if len(tops) > 1:
            periods[row] = float(np.median(np.diff(tops))) * sample_step(t)
    return Envelope(grid, upper, lower, teeth, periods)


def _tops(x: np.ndarray, least: float) -> np.ndarray:
    """Return the indices of the maxima of x (N,) that stand out by at least `least` on both sides."""
    from scipy.signal import find_peaks

    return find_peaks(x, prominence=max(least, 1e-300))[0]


def _joined(t: np.ndarray, x: np.ndarray, knots: np.ndarray, grid: np.ndarray) -> np.ndarray:
    knots = np.concatenate(([0], knots, [len(x) - 1]))
    knots = np.concatenate([*(_between(t, x, a, b) for a, b in pairwise(knots)), knots[-1:]])
    return np.interp(grid, t[knots], x[knots])


def _between(t: np.ndarray, x: np.ndarray, start: int, end: int) -> np.ndarray:
    """Return `start` and, if the stretch to `end` is long, the largest values of its pieces."""
    if t[end] - t[start] <= SLOWEST_PERIOD:
        return np.array([start])
    # The first and the last half period belong to the teeth on either side.
    half = int(0.5 * SLOWEST_PERIOD / (t[1] - t[0]))
    bounds = np.arange(start + half // 2, end - half // 2, half)
    places = [a + int(np.argmax(x[a:b])) for a, b in pairwise(bounds)]
    return np.array([start, *places])


@dataclass(frozen=True)
class EnvelopeShape:
    """The shape of one envelope, taken as half the distance between its upper and its lower line.

    Attributes: ``mean`` and ``largest`` rad/s; ``start`` and ``end``, levels in the first and last tenth as shares of
    the largest; ``bow``, how much the middle third lies above the straight line through the first and last third, as a
    share of the mean: positive bulges in the middle (and vanishes at the ends), near zero is quasi-constant;
    ``variation``, standard deviation over mean between the first and the last tenth.
    """

    mean: float
    largest: float
    start: float
    end: float
    bow: float
    variation: float


def envelope_shape(upper: np.ndarray, lower: np.ndarray) -> EnvelopeShape:
    """Return the shape of the envelope with the lines upper and lower (P,) rad/s, P of at least 10."""
    half = 0.5 * (np.asarray(upper) - np.asarray(lower))
    tenth, third = max(1, len(half) // 10), len(half) // 3
    mean, largest = float(half.mean()), float(half.max())
    if largest <= 0.0:
        return EnvelopeShape(mean, largest, 0.0, 0.0, 0.0, 0.0)
    thirds = [float(part.mean()) for part in (half[:third], half[third : len(half) - third], half[len(half) - third :])]
    inner = half[tenth : len(half) - tenth]
    return EnvelopeShape(
        mean=mean,
        largest=largest,
        start=float(half[:tenth].mean()) / largest,
        end=float(half[-tenth:].mean()) / largest,
        bow=(thirds[1] - 0.5 * (thirds[0] + thirds[2])) / mean,
        variation=float(inner.std() / inner.mean()) if inner.mean() > 0.0 else 0.0,
    )
