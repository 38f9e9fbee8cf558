"""The three phases of the response: three-dimensional and repeatable, erratic, quasi-two-dimensional."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rockref.measure.signals.activity import Leakage, arc_shares, leakage, onset
from rockref.measure.signals.impacts import Impacts, checked_signal, main_impacts
from rockref.measure.signals.noise import noise_floor

PLANAR, REPEATABLE, ERRATIC, QUASI_2D = "planar", "repeatable 3-D", "erratic 3-D", "quasi-2-D"
# decided: arcs that one would call planar have an out-of-plane rate of 0.01 to 0.055 of the main one, the others of
# 0.07 and more, over the shipped experiments.
PLANAR_SHARE = 0.06
# decided: one quiet arc may be a lull; two in a row, up to the end of the record, are the last phase.
LEAST_ARCS = 2
# decided: a piece of an arc that is shorter says nothing about it.
SHORTEST = 0.1


@dataclass(frozen=True, eq=False)
class Phases:
    """The phases of a run.

    Attributes: ``onset`` s, begin of the motion out of the plane (NaN if none is seen); ``repeatable_until`` s;
    ``repeatable_from_runs``, whether that instant was measured with repeated runs, or is the second main impact, up to
    which the source saw all runs agree; ``quasi_2d_from`` s, begin of the last planar arcs (infinite if there are
    none); ``shares`` (M + 1,), out-of-plane over main rate in each arc; ``intervals``, (name, start s, end s) in order.
    """

    onset: float
    repeatable_until: float
    repeatable_from_runs: bool
    quasi_2d_from: float
    shares: np.ndarray
    intervals: tuple[tuple[str, float, float], ...]


def phases(
    t: np.ndarray,
    crv: np.ndarray,
    *,
    agree_until: float | None = None,
    impacts: Impacts | None = None,
    leak: Leakage | None = None,
) -> Phases:
    """Return the phases of a run with times t (N,) s and body rates crv (N, 3) rad/s.

    `agree_until`, s in the time of this run, comes from repeated runs where there are some (first main impact plus the
    ``alike_until`` of :class:`Repeatability`). Raises InputError E-SIGNAL.
    """
    t, crv = checked_signal(t, crv)
    impacts = main_impacts(t, crv) if impacts is None else impacts
    leak = leakage(t, crv, impacts) if leak is None else leak
    shares = arc_shares(t, crv, leak, impacts)
    begin = onset(t, crv, impacts, leak, noise_floor(t, crv))
    planar = _last_planar(t, shares, impacts)
    second = float(impacts.times[1]) if len(impacts) > 1 else float(t[-1])
    until = second if agree_until is None else min(float(agree_until), float(t[-1]))
    return Phases(
        onset=begin,
        repeatable_until=until,
        repeatable_from_runs=agree_until is not None,
        quasi_2d_from=planar,
        shares=shares,
        intervals=_intervals(float(t[0]), float(t[-1]), begin, until, planar),
    )


def _last_planar(t: np.ndarray, shares: np.ndarray, impacts: Impacts) -> float:
    """Return the start, s, of the planar arcs with which the run ends; infinite if there are fewer than two."""
    bounds = np.concatenate((t[:1], impacts.times, t[-1:]))
    counted = np.flatnonzero(np.diff(bounds) >= SHORTEST)
    start, count = math.inf, 0
    for arc in counted[::-1]:
        if not shares[arc] < PLANAR_SHARE:
            break
        start, count = float(bounds[arc]), count + 1
    return start if count >= LEAST_ARCS else math.inf


def _intervals(
    start: float, end: float, begin: float, until: float, planar: float
) -> tuple[tuple[str, float, float], ...]:
    """Return the named intervals that have a length, in order and without overlap."""
    last = min(planar, end)
    begin = min(begin if np.isfinite(begin) else until, last)
    until = min(max(until, begin), last)
    marks = ((PLANAR, start, begin), (REPEATABLE, begin, until), (ERRATIC, until, last), (QUASI_2D, last, end))
    return tuple(mark for mark in marks if mark[2] > mark[1])
