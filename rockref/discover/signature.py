"""What the misfit of the baseline looks like: axis, stretch, parity, frequency, and what it is locked to."""

from __future__ import annotations

import itertools
from typing import Any, NamedTuple

import numpy as np

from rockref.discover.compare.stretches import AXES
from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.windows.series import Series
from rockref.measure.impacts import Impacts, main_impacts

#: A misfit of the first swings, in the median over the runs, that is so many times that of the windows after them
#: belongs to the release (decided).
RELEASE = 1.5
#: What belongs to an impact [s before, after]; decided: a contact lasts 1.5 ms, the feet clatter for some 20 ms.
IMPACT = (0.005, 0.025)
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
#: Where a tone is looked for, in steps that three seconds resolve [Hz]; and the coherence over the windows of a run
#: from which on it is one (decided: without a tone public experiments have 0.25 to 0.30, with a base that shakes 0.42;
#: so has a loose part that swings, but that repeats).
TONES, TONE = (5.0, 100.0, 0.1), 0.38


def signature(fit: Fit, point: Point, final: Fit, best: Point) -> dict[str, Any]:
    """Shares of the residual power by axis and by stretch, parity, frequency and lock, and the axes after the best fit.

    Parities are those of the moment about the main axis that is missing in free arcs, see `parity`.
    """
    r = fit.residual(point.z, point.corrections)
    s = fit.series
    axis_excess = excess(r, s.valid)
    rest = excess(final.residual(best.z, best.corrections), final.series.valid)
    axis = int(np.argmax(axis_excess))
    impacts = [main_impacts(run.t, run.crv) for run in s.runs]
    mean = 2 * point.loss / s.count
    # What belongs to the release shows in every run; a blow at any time may fall into the first swing of half of them.
    at_release, after = float(np.quantile(mean[s.first], 0.5, method="lower")), float(mean[~s.first].mean())
    alike, coherent = repeats(s, r[..., axis]), coherence(s, r[..., axis])
    return {
        "axis": AXES[axis],
        "axis_shares": by_name(AXES, axis_excess),
        "remaining_axis_shares": by_name(AXES, rest),
        "phase": "release" if at_release > RELEASE * max(after, 1.0) else "impacts",
        "loss_at_release": at_release,
        "loss_after": after,
        "stretch_shares": by_name(("free_arc", "impact"), by_stretch(s, impacts, r)),
        "frequency_hz": frequency(s, r),
        **parity(slopes(s, impacts, r[..., 0])),
        "repeats": alike,
        "coherence": coherent,
        "locked_to": locked_to(alike, coherent),
    }


def locked_to(alike: float | None, coherent: float) -> str | None:
    """What the misfit goes by: None where it does not stand out, or no two runs were released alike."""
    if alike is None:
        return None
    return "release" if alike >= REPEATS else "clock" if coherent >= TONE else "neither"


def by_name(names: tuple[str, ...], power: np.ndarray) -> dict[str, float]:
    """Shares of a power."""
    return {name: float(p / max(power.sum(), 1e-9)) for name, p in zip(names, power, strict=True)}


def excess(r: np.ndarray, valid: np.ndarray) -> np.ndarray:
    """(3,) power of residuals in noise sigmas above that of noise alone."""
    return np.maximum(np.sum(r**2, axis=(0, 1)) - valid.sum(), 0.0)


def frequency(s: Series, r: np.ndarray) -> float:
    """The strongest frequency of the first swings [Hz]."""
    r1 = r[s.first]
    power = np.sum(np.abs(np.fft.rfft(r1 - r1.mean(axis=1, keepdims=True), axis=1)) ** 2, axis=(0, 2))
    return float(np.fft.rfftfreq(r1.shape[1], 1 / s.rate)[1 + int(np.argmax(power[1:]))])


def times(s: Series) -> np.ndarray:
    """(B, M) of every sample of every window from the release [s]."""
    return (s.start[:, None] + np.arange(s.valid.shape[1])) / s.rate


def near_impacts(s: Series, impacts: list[Impacts]) -> np.ndarray:
    """(B, M) bool: which samples belong to a main impact."""
    t, near = times(s), np.zeros(s.valid.shape, bool)
    for b, run in enumerate(s.run_of):
        for at in impacts[run].times:
            near[b] |= (t[b] > at - IMPACT[0]) & (t[b] < at + IMPACT[1])
    return near


def by_stretch(s: Series, impacts: list[Impacts], r: np.ndarray) -> np.ndarray:
    """(2,) power above the noise in free arcs and at main impacts."""
    near = near_impacts(s, impacts)
    power = np.sum(r**2, axis=-1)
    return np.array([max(power[m].sum() - 3 * m.sum(), 0.0) for m in (s.valid & ~near, s.valid & near)])


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


def slopes(s: Series, impacts: list[Impacts], r: np.ndarray) -> Slopes:
    """Slopes of one axis's residual (B, M) in noise sigmas, piece by piece."""
    t, counts, found = times(s), s.valid & ~near_impacts(s, impacts), []
    for b, run in enumerate(s.run_of):
        at, signs = impacts[run].times, impacts[run].signs
        if not len(at):
            continue
        before = np.searchsorted(at, t[b])
        # The release is the apex of an arc of which the first half was never swung; the last arc has no end.
        side = np.r_[-signs[0], signs][before]
        begins, ends = np.r_[-at[0], at][before], np.r_[at, np.inf][before]
        distance = np.abs(2 * (t[b] - begins) / (ends - begins) - 1)
        way = np.sign(s.measured[b, :, 0])
        ok = counts[b] & np.isfinite(ends) & (way != 0)
        label = np.where(ok, 2 * side + way, 0)
        edges = np.flatnonzero(np.diff(label)) + 1
        edges = np.unique(np.r_[edges, np.arange(0, len(label), MOST_SAMPLES), len(label)])
        for first, end in itertools.pairwise(edges):
            if not label[first] or end - first < LEAST_SAMPLES:
                continue
            x = (np.arange(end - first) - (end - first - 1) / 2) / s.rate
            length = float(np.sqrt(x @ x))
            own = float(x @ r[b, first:end]) / length
            found.append((side[first], side[first] * way[first], distance[first:end].mean(), own, length))
    return Slopes(*np.array(found, float).reshape(-1, 5).T)


def parity(found: Slopes) -> dict[str, Any]:
    """What share of the slopes each parity explains alone, and which one they have, if any.

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


def repeats(s: Series, r: np.ndarray) -> float | None:
    """How much the misfits (B, M) of runs that were released alike are alike at the same time after it, 0 to 1.

    Noise is taken off their power. None where no two were released alike, or the misfit does not stand out of it.
    """
    whole = []
    for run in range(len(s.runs)):
        line = np.zeros(int(np.max(s.start + s.length)))
        for b in np.flatnonzero(s.run_of == run):
            line[s.start[b] : s.start[b] + s.length[b]] = r[b, : s.length[b]]
        whole.append(line)
    counts = [int(s.valid[s.run_of == run].sum()) for run in range(len(s.runs))]
    power = [float(line @ line) - n for line, n in zip(whole, counts, strict=True)]
    found = []
    for i, first in enumerate(s.runs):
        for j in range(i + 1, len(s.runs)):
            other = s.runs[j]
            same = abs(first.release_tilt - other.release_tilt) < ALIKE
            same &= bool(first.block_turned) == bool(other.block_turned)
            if same and min(power[k] / np.sqrt(2 * counts[k]) for k in (i, j)) > STANDS_OUT:
                found.append(whole[i] @ whole[j] / np.sqrt(power[i] * power[j]))
    return float(np.clip(np.mean(found), 0.0, 1.0)) if found else None


def coherence(s: Series, r: np.ndarray) -> float:
    """How well one tone keeps its phase through the windows of a run, 0 to 1, at the frequency where it does best.

    A tone that goes on by the clock does; what begins anew with every impact does not. Lines are taken off the windows
    first: their starts are corrected, which does the same to a slow tone. The first swing, one long window, is left
    out.
    """
    tones = np.arange(*TONES)
    t, share = times(s), np.zeros(len(tones))
    for run in range(len(s.runs)):
        parts = []
        for b in np.flatnonzero((s.run_of == run) & ~s.first & (s.valid.sum(axis=1) > LEAST_SAMPLES)):
            own, y = t[b, s.valid[b]], r[b, s.valid[b]]
            y = y - np.polyval(np.polyfit(own - own.mean(), y, 1), own - own.mean())
            parts.append(np.exp(-2j * np.pi * np.outer(tones, own)) @ y)
        if not parts:
            continue
        size = np.sqrt(len(parts) * np.sum(np.abs(parts) ** 2, axis=0))
        share += np.abs(np.sum(parts, axis=0)) / np.maximum(size, 1e-300) / len(s.runs)
    return float(share.max())
