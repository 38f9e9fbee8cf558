"""Arcs between main impacts: their apexes, in time and angle, by integrating the rate about the main axis."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rockref.measure.signals.impacts import Impacts, checked_signal
from rockref.measure.signals.running import half_width, running_mean

# decided: the clatter about the apex has periods up to 100 ms; a line through 80 ms averages it and is still straight.
APEX_WINDOW = 0.08


@dataclass(frozen=True, eq=False)
class Arcs:
    """The arcs of a run with M main impacts: M + 1 of them, arrays of shape (M + 1,).

    The first one falls from the release to the first impact, the last one is cut by the end of the record; those
    between are complete. Angles are turns about X from upright, with sign, in rad.

    Attributes: ``starts``, ``ends`` s; ``apex_times`` s (NaN if the apex is not in the record; the start of the record
    for the release); ``rise`` rad, integral of the rate from the start to the apex (NaN for the release); ``fall`` rad,
    minus the integral from the apex to the end (NaN for the last). In a complete arc both are the apex angle;
    they differ by drift, by a change of posture, and by out-of-plane motion.
    """

    starts: np.ndarray
    ends: np.ndarray
    apex_times: np.ndarray
    rise: np.ndarray
    fall: np.ndarray

    def __len__(self) -> int:
        return len(self.starts)

    @property
    def complete(self) -> np.ndarray:
        """Return which arcs lie between two impacts, (M + 1,) bool."""
        mask = np.ones(len(self.starts), dtype=bool)
        mask[0] = mask[-1] = False
        return mask

    @property
    def apex_angles(self) -> np.ndarray:
        """Return the apex angle of each arc, rad with sign: the mean of rise and fall, or the one that there is."""
        both = np.stack((self.rise, self.fall))
        known = np.isfinite(both)
        total = np.where(known, both, 0.0).sum(axis=0)
        return np.where(known.any(axis=0), total / np.maximum(known.sum(axis=0), 1), np.nan)


def arcs(t: np.ndarray, crv: np.ndarray, impacts: Impacts) -> Arcs:
    """Return the arcs of a run with times t (N,) s and body rates crv (N, 3) rad/s. Raises InputError E-SIGNAL."""
    t, crv = checked_signal(t, crv)
    angle = turned_angle(t, crv[:, 0])
    smooth = running_mean(crv[:, 0], half_width(t, 0.01))
    starts = np.concatenate((t[:1], impacts.times))
    ends = np.concatenate((impacts.times, t[-1:]))
    apex_times = np.array([_apex(t, crv[:, 0], smooth, a, b) for a, b in pairwise(ends)])
    apex_times = np.concatenate((t[:1], apex_times))
    at = np.interp(np.stack((starts, apex_times, ends)), t, angle)
    # Where there is no apex its time is NaN, and so is the angle there.
    rise, fall = at[1] - at[0], at[1] - at[2]
    rise[0], fall[-1] = np.nan, np.nan
    return Arcs(starts, ends, apex_times, rise, fall)


def turned_angle(t: np.ndarray, wx: np.ndarray) -> np.ndarray:
    """Return the integral of wx (N,) rad/s over t (N,) s from the first sample, (N,) rad, by the trapezoidal rule."""
    pieces = 0.5 * (wx[1:] + wx[:-1]) * np.diff(t)
    return np.concatenate(([0.0], np.cumsum(pieces)))


def _apex(t: np.ndarray, wx: np.ndarray, smooth: np.ndarray, start: float, end: float) -> float:
    """Return the time at which the rate changes sign between `start` and `end`, or NaN."""
    first, last = np.searchsorted(t, (start, end))
    inside = smooth[first:last]
    changes = np.flatnonzero(np.diff(np.signbit(inside)))
    if not len(changes):
        return math.nan
    apex = float(t[first + changes[len(changes) // 2]])
    # The second pass starts from a window that is centred.
    for _ in range(2):
        near = slice(*np.searchsorted(t, (max(apex - 0.5 * APEX_WINDOW, start), min(apex + 0.5 * APEX_WINDOW, end))))
        if near.stop - near.start < 4:
            break
        slope, level = np.polyfit(t[near] - apex, wx[near], 1)
        shift = -level / slope if slope != 0.0 else 0.0
        if not abs(shift) < 0.5 * APEX_WINDOW:
            break
        apex += float(shift)
    return apex
