"""The moment that is missing in free arcs, and what the misfit goes by: the release, the clock, or neither."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from rockref.discover.listening.listener import Listener
from rockref.measure.signals.impacts import Impacts

#: Fewest samples on one side of upright, in one direction, that make a slope, and most (decided: its error falls as
#: n^(-3/2); the first swing, on one side and inwards only, would outweigh all others if it were one piece).
LEAST_SAMPLES, MOST_SAMPLES = 12, 120
#: Parities of a moment: even or odd in the direction of the swing (velocity) and in the side on which the block leans.
PARITIES = {
    "even": lambda side, out: np.ones_like(side),
    "odd_in_velocity": lambda side, out: side * out,
    "odd_in_side": lambda side, out: side,
    "odd_in_both": lambda side, out: out,
}
#: Functions of the distance from the apex in each parity: Legendre's polynomials of degree 0, 1, 2 on (0, 1).
SHAPES = (np.ones_like, lambda u: 2 * u - 1, lambda u: 6 * u * u - 6 * u + 1)
#: Slopes stand out of their noise by so many standard deviations, and so large a share of them has one parity, or none
#: is named (decided: of the public experiments that with drag has 1.0 of the right one, the next 0.21; that with an
#: eccentricity 0.65 and 0.20; a loose part at most 0.42 of any, a shaking base 0.02).
STANDS_OUT, HAS_PARITY = 5.0, 0.5
#: Misfits of two runs that were released alike which are so much alike are locked to the release (decided).
REPEATS = 0.5
#: Releases that count as alike [rad]; decided: wires scatter by 0.02 degrees.
ALIKE = 2e-3
#: Innovations count no further than this many noise widths.
CLIPPED = 10.0
#: Where a tone is looked for, in steps that three seconds resolve [Hz]; and the coherence over the windows of a run
#: from which on it is one (decided: without a tone public experiments have 0.25 to 0.30, with a base that shakes 0.42;
#: so has a loose part that swings, but that repeats).
TONES, TONE = (5.0, 100.0, 0.1), 0.38
#: Length of the pieces of a record whose phases are compared [s] (decided: a tenth of what is used, half a second at
#: the slowest tone).
PIECE = 0.3


class Slopes(NamedTuple):
    """Slopes of the misfit over pieces of free arcs: what is missing there is a moment over the inertia.

    side, out : the side on which the block leans, and whether it swings away from upright or back; +1 or -1
    distance : of the piece from the apex of its arc, 0 to 1
    slope : in standard deviations of its own noise
    weight : one over that deviation [s]
    """

    side: np.ndarray
    out: np.ndarray
    distance: np.ndarray
    slope: np.ndarray
    weight: np.ndarray


def slopes(listener: Listener, impacts: Sequence[Impacts], near: np.ndarray, r: np.ndarray) -> Slopes:
    """Return slopes of the innovations of one axis (R, N), piece by piece; near (R, N): what belongs to an impact."""
    rate, found = listener.gyro.sample_rate, []
    for b in range(len(r)):
        at, signs = impacts[b].times, impacts[b].signs
        n = len(listener.t[b])
        t, counts = listener.t[b], ~near[b, :n]
        if not len(at):
            continue
        before = np.searchsorted(at, t)
        # The release is the apex of an arc of which the first half was never swung; the last arc has no end.
        side = np.r_[-signs[0], signs][before]
        starts, ends = np.r_[-at[0], at][before], np.r_[at, np.inf][before]
        distance = np.abs(2 * (t - starts) / (ends - starts) - 1)
        way = np.sign(listener.measured[b, :n, 0])
        ok = counts & np.isfinite(ends) & (way != 0)
        label = np.where(ok, 2 * side + way, 0)
        edges = np.flatnonzero(np.diff(label)) + 1
        edges = np.unique(np.r_[edges, np.arange(0, len(label), MOST_SAMPLES), len(label)])
        for first, end in itertools.pairwise(edges):
            if not label[first] or end - first < LEAST_SAMPLES:
                continue
            x = (np.arange(end - first) - (end - first - 1) / 2) / rate
            length = float(np.sqrt(x @ x))
            own = float(x @ np.clip(r[b, first:end], -CLIPPED, CLIPPED)) / length
            found.append((side[first], side[first] * way[first], distance[first:end].mean(), own, length))
    return Slopes(*np.array(found, float).reshape(-1, 5).T)


def parity(found: Slopes) -> dict[str, Any]:
    """Return what share of the slopes each parity explains alone, and which one they have, if any.

    A moment that brakes is odd in the velocity; one that rights the block, as its weight does, odd in the side; one
    that always pulls to the same side even. The shares do not add up to one: there are few arcs.
    """
    n = len(found.slope)
    power = float(found.slope @ found.slope) - n
    if n < 4 * len(SHAPES) or power < STANDS_OUT * np.sqrt(2 * n):
        return {"parity": None, "parity_shares": dict.fromkeys(PARITIES)}
    shapes = np.stack([f(found.distance) for f in SHAPES], axis=1) * found.weight[:, None]
    shares = {}
    for name, sign in PARITIES.items():
        columns = shapes * sign(found.side, found.out)[:, None]
        explained = columns @ np.linalg.lstsq(columns, found.slope, rcond=None)[0]
        shares[name] = float(np.clip((explained @ explained - len(SHAPES)) / power, 0.0, 1.0))
    best = max(shares, key=shares.__getitem__)
    return {"parity": best if shares[best] >= HAS_PARITY else None, "parity_shares": shares}


def repeats(listener: Listener, r: np.ndarray) -> float | None:
    """Return how alike the misfits (R, N) of runs that were released alike are at the same time after it, 0 to 1.

    Noise is taken off their power. None where no two were released alike, or the misfit does not stand out of it.
    """
    counts = listener.valid[:, : r.shape[1]].sum(axis=1)
    lines = np.clip(r, -CLIPPED, CLIPPED)
    power = (lines**2).sum(axis=1) - counts
    found = []
    for i, first in enumerate(listener.runs):
        for j in range(i + 1, len(listener.runs)):
            other = listener.runs[j]
            same = abs((first.release_tilt or 0.0) - (other.release_tilt or 0.0)) < ALIKE
            same &= bool(first.block_turned) == bool(other.block_turned)
            if same and min(power[k] / np.sqrt(2 * counts[k]) for k in (i, j)) > STANDS_OUT:
                found.append(lines[i] @ lines[j] / np.sqrt(power[i] * power[j]))
    return float(np.clip(np.mean(found), 0.0, 1.0)) if found else None


def coherence(listener: Listener, r: np.ndarray) -> float:
    """Return how well one tone keeps its phase through the runs (R, N), 0 to 1, at the frequency where it does best.

    A tone that goes on by the clock does; what starts anew with every impact does not. Each record is cut into pieces,
    and the sum of their transforms is compared with the sum of their sizes.
    """
    tones = np.arange(*TONES)
    found = np.zeros(len(tones))
    for i, t in enumerate(listener.t):
        y = np.clip(r[i, : len(t)], -CLIPPED, CLIPPED)
        pieces = np.array_split(np.arange(len(t)), max(2, int(t[-1] / PIECE)))
        parts = np.array([np.exp(-2j * np.pi * np.outer(tones, t[k])) @ (y[k] - y[k].mean()) for k in pieces])
        size = np.sqrt(len(pieces) * np.sum(np.abs(parts) ** 2, axis=0))
        found += np.abs(parts.sum(axis=0)) / np.maximum(size, 1e-300) / len(listener.t)
    return float(found.max())


def locked_to(alike: float | None, coherent: float) -> str | None:
    """Return what the misfit goes by: None where it does not stand out, or no two runs were released alike."""
    if alike is None:
        return None
    return "release" if alike >= REPEATS else "clock" if coherent >= TONE else "neither"
