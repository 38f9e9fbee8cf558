"""What is odd in a recorded motion, but can be worked with: clipping, offset, drift, dropouts, sampling, a step."""

from __future__ import annotations

import math

import numpy as np

from rockref.measure.records.notice import Notice
from rockref.shake.records.channel import STANDARD_GRAVITY

AXIS = ("x", "y", "z")
# decided: three equal values beside a larger step on both sides are a limit or a dropout; the top of a smooth wave in a
# coarse resolution is left by one step of it.
FLAT, CORNER = 3, 3.0
# decided: a value that stands still for ten samples in the midst of motion is a dropout.
STUCK = 10
# decided: 0.002 g tilts the plate by a tenth of a degree; a hundredth of the peak is no rounding.
OFFSET, OFFSET_SHARE = 0.002 * STANDARD_GRAVITY, 0.01
# decided: a table that comes to rest ends with a tenth of its largest velocity at most.
DRIFT = 0.1
# decided: straight lines between samples may miss a tenth of the motion.
COARSE = 0.1
# decided: a hundredth of the peak is a step that a block does not feel.
STEP = 0.01


def remarks(a: np.ndarray, dt: float, where: str) -> list[Notice]:
    """Return remarks on a motion: acceleration (n, 3) [m/s2], interval [s]; axes that are zero throughout are quiet."""
    found: list[Notice] = []
    for axis in range(3):
        if a[:, axis].any():
            place = f"{where}, a{AXIS[axis]}"
            found += _flat(a[:, axis], dt, place)
            found += _offset(a[:, axis], place)
            found += _drift(a[:, axis], dt, place)
            found += _coarse(a[:, axis], dt, place)
            found += _ends(a[:, axis], place)
    return found


def plateaus(a: np.ndarray, least: int) -> list[tuple[int, int]]:
    """Return first sample and length of stretches of one value, entered and left by more than a corner's step.

    The scale of a step is the smallest difference between neighbours that is not zero.
    """
    steps = np.abs(np.diff(a))
    if not steps.any():
        return []
    corner = CORNER * steps[steps > 0.0].min()
    edges = np.flatnonzero(np.concatenate([[True], steps > 0.0, [True]]))
    return [
        (int(i), int(j - i))
        for i, j in zip(edges[:-1], edges[1:], strict=True)
        if j - i >= least and i > 0 and j < len(a) and steps[i - 1] > corner and steps[j - 1] > corner
    ]


def _flat(a: np.ndarray, dt: float, where: str) -> list[Notice]:
    found = []
    extremes = (a.max(), a.min())
    clipped = [(i, n) for i, n in plateaus(a, FLAT) if a[i] in extremes]
    if clipped:
        i, n = max(clipped, key=lambda place: place[1])
        what = f"{n} equal extremes in a row at {i * dt:.4g} s ({a[i]:.4g} m/s2), {len(clipped)} such stretches"
        found.append(Notice("W-RECORD-CLIPPED", where, what, "The sensor or the table was at its limit: use another."))
    stuck = [(i, n) for i, n in plateaus(a, STUCK) if a[i] not in extremes]
    if stuck:
        i, n = max(stuck, key=lambda place: place[1])
        what = f"one value for {n} samples from {i * dt:.4g} s on, in the midst of motion"
        found.append(Notice("W-RECORD-STUCK", where, what, "The channel dropped out there: repair it or use another."))
    return found


def _offset(a: np.ndarray, where: str) -> list[Notice]:
    mean = float(a.mean())
    if abs(mean) <= max(OFFSET, OFFSET_SHARE * float(np.abs(a).max())):
        return []
    tilt = math.degrees(math.atan(abs(mean) / STANDARD_GRAVITY))
    what = f"the mean is {mean:.3g} m/s2, as if the plate were tilted by {tilt:.2g} degrees"
    return [Notice("W-RECORD-OFFSET", where, what, "Subtract the mean of the quiet beginning, if there is one.")]


def _drift(a: np.ndarray, dt: float, where: str) -> list[Notice]:
    # The integral of the straight lines between samples.
    v = np.concatenate([[0.0], np.cumsum(0.5 * dt * (a[1:] + a[:-1]))])
    if abs(v[-1]) <= DRIFT * np.abs(v).max():
        return []
    what = f"the integrated velocity ends at {v[-1]:.3g} m/s, of {np.abs(v).max():.3g} m/s at most"
    return [Notice("W-RECORD-DRIFT", where, what, "The baseline is not corrected, or the record is cut.")]


def _coarse(a: np.ndarray, dt: float, where: str) -> list[Notice]:
    # A straight line misses a curve by its second difference over eight, at most.
    missed = float(np.sqrt(np.mean(np.diff(a, 2) ** 2)) / 8.0) if len(a) > 2 else 0.0
    size = float(np.sqrt(np.mean(a**2)))
    if missed <= COARSE * size:
        return []
    what = f"straight lines between samples of {dt:g} s miss some {100 * missed / size:.0f} % of the motion"
    return [Notice("W-RECORD-COARSE", where, what, "Use a record with a shorter interval.")]


def _ends(a: np.ndarray, where: str) -> list[Notice]:
    peak = float(np.abs(a).max())
    if abs(a[0]) <= STEP * peak:
        return []
    what = f"the first sample is {a[0]:.3g} m/s2, of {peak:.3g} m/s2 at most: the block feels a step"
    return [Notice("W-RECORD-STEP", where, what, "Taper the beginning, or give what came before.")]
