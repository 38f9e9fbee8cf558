"""Records that are cut flat: at which rate, and what the block did meanwhile, so that its attitude is not lost."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from rockref.measure.experiment import Experiment, Run
from rockref.model.problem import GRAVITY

#: Samples at the top that make it flat (decided: a cusp has two or three, at 1 kHz).
FLAT = 12
#: Seconds before and after a flat top that its missing part is continued from (decided: a twelfth of an arc), and the
#: least number of samples that will do.
BESIDE, LEAST = 0.04, 6


def flat_tops(experiment: Experiment, runs: Iterable[Run]) -> float | None:
    """Rate [rad/s] at which the records are clipped on both sides or in two runs, or None."""
    assert experiment.gyro is not None
    limits, resolution, count = [], experiment.gyro.resolution, 0
    for run in runs:
        assert run.crv is not None
        x = np.abs(run.crv)
        top, count = x.max(), count + 1
        if np.sum(np.any(x > top - 0.6 * resolution, axis=1)) >= FLAT:
            limits.append(top)
    if len(limits) < max(2, count // 2) or np.ptp(limits) > 2 * resolution:
        return None
    return float(np.median(limits))


def unclipped(experiment: Experiment, run: Run, limit: float | None) -> np.ndarray:
    """The rates of a run with what was cut off at `limit` put back, (N, 3) [rad/s]; its own, where nothing was.

    About X a slender block on an edge follows w'' = p^2 w, p^2 = 3 g / (4 R) (Housner 1963,
    doi:10.1785/BSSA0530020403): the arc before a flat top is continued until the block is upright, which is the impact,
    the arc after it from there on. About the other axes the gap is bridged by a line.
    """
    assert run.crv is not None and run.t is not None and run.release_tilt is not None and experiment.gyro is not None
    if limit is None:
        return run.crv
    cut = np.abs(run.crv) > limit - 0.6 * experiment.gyro.resolution
    w = run.crv.copy()
    for axis in (1, 2):
        if cut[:, axis].any():
            w[cut[:, axis], axis] = np.interp(run.t[cut[:, axis]], run.t[~cut[:, axis]], w[~cut[:, axis], axis])
    p = math.sqrt(0.75 * GRAVITY / (0.5 * math.hypot(experiment.width, experiment.height)))
    side = -1.0 if abs(run.block_turned) > 0.5 * math.pi else 1.0
    step = float(run.t[1] - run.t[0])
    gaps = np.flatnonzero(np.diff(np.concatenate([[False], cut[:, 0], [False]]).astype(int))).reshape(-1, 2)
    for first, last in gaps:
        tilt = run.release_tilt - side * float(np.sum(w[:first, 0])) * step
        w[first:last, 0] = _arcs(run.t, w[:, 0], cut[:, 0], first, last, p, side * tilt, step)
    return w


def _arcs(t, wx, cut, first: int, last: int, p: float, tilt: float, step: float) -> np.ndarray:
    """Rates about X between samples first and last; tilt: the turn that is left until upright at first [rad]."""
    inside = t[first:last]
    before = _arc(t, wx, cut, range(first - 1, -1, -1), p, inside)
    after = _arc(t, wx, cut, range(last, len(t)), p, inside)
    if before is None or after is None:
        return wx[first:last]
    left = tilt - np.cumsum(before) * step
    passed = np.flatnonzero(left * np.sign(before) <= 0)
    impact = passed[0] if len(passed) else len(inside) // 2
    return np.where(np.arange(len(inside)) <= impact, before, after)


def _arc(t, wx, cut, beside: range, p: float, inside: np.ndarray) -> np.ndarray | None:
    """An arc through the samples beside a gap, up to the next gap, continued into it; None if there are too few."""
    near = []
    for k in beside[: round(BESIDE / (t[1] - t[0]))]:
        if cut[k]:
            break
        near.append(k)
    if len(near) < LEAST:
        return None
    origin = t[near[0]]
    found = np.linalg.lstsq(_shapes(p * (t[near] - origin)), wx[near], rcond=None)[0]
    return _shapes(p * (inside - origin)) @ found


def _shapes(s: np.ndarray) -> np.ndarray:
    return np.stack([np.cosh(s), np.sinh(s)], axis=-1)
