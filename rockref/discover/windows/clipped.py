"""Records of a gyroscope at its stops: at which rate, and what the block did meanwhile: its attitude must be known."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rockref.measure.experiment import Experiment, Run
from rockref.measure.running import sample_step
from rockref.measure.signal import growth_rate, side_of, tilts

#: Seconds at the top that make it flat (decided: a cusp has two or three samples, at 1 kHz).
FLAT = 12e-3
#: Seconds before and after a flat top that its missing part is continued from (decided: a twelfth of an arc), and the
#: least number of samples that will do (decided: three for each of the arc's two numbers).
BESIDE, LEAST = 0.04, 6
#: Resolutions below the limit that a sample at the stops may show (rounding leaves half of one).
ROUNDED = 0.6


def flat_tops(experiment: Experiment, runs: Sequence[Run]) -> float | None:
    """Rate [rad/s] at which the records of two runs (of the only one) and of half of them are clipped, or None."""
    assert experiment.gyro is not None
    limits, resolution = [], experiment.gyro.resolution
    for run in runs:
        assert run.crv is not None
        x = np.abs(run.crv)
        if np.sum(np.any(x > x.max() - ROUNDED * resolution, axis=1)) >= round(FLAT * experiment.gyro.sample_rate):
            limits.append(x.max())
    if len(limits) < max(min(2, len(runs)), len(runs) // 2, 1) or np.ptp(limits) > 2 * resolution:
        return None
    return float(np.median(limits))


def unclipped(experiment: Experiment, runs: Sequence[Run]) -> list[np.ndarray]:
    """The rates of runs with what was cut off put back, each (N, 3) [rad/s]; their own, where nothing was.

    About X a slender block on an edge follows w'' = p^2 w (`growth_rate`): the arc before a flat top is continued until
    the block is upright, which is the impact, the arc after it from there on. About the other axes the gap is bridged
    by a line.
    """
    limit = flat_tops(experiment, runs)
    return [run.crv if limit is None else _whole(experiment, run, limit) for run in runs]  # type: ignore[misc]


def _whole(experiment: Experiment, run: Run, limit: float) -> np.ndarray:
    assert run.crv is not None and run.t is not None and experiment.gyro is not None
    cut = np.abs(run.crv) > limit - ROUNDED * experiment.gyro.resolution
    w = run.crv.copy()
    for axis in (1, 2):
        if cut[:, axis].any():
            w[cut[:, axis], axis] = np.interp(run.t[cut[:, axis]], run.t[~cut[:, axis]], w[~cut[:, axis], axis])
    p, tilt = growth_rate(experiment.width, experiment.height), float(run.release_tilt or 0.0)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], cut[:, 0], [False]]).astype(int)))
    for first, last in edges.reshape(-1, 2):
        # Upright is where the turn that is left comes to nothing, on either side.
        left = abs(tilts(run.t, w[:, 0], tilt, side_of(run))[first - 1]) if first else 0.0
        w[first:last, 0] = _arcs(run.t, w[:, 0], cut[:, 0], first, last, p, left)
    return w


def _arcs(t, wx, cut, first: int, last: int, p: float, left: float) -> np.ndarray:
    """Rates about X between samples first and last; left : the turn that is left until upright at first [rad]."""
    inside = t[first:last]
    before = _arc(t, wx, cut, range(first - 1, -1, -1), p, inside)
    after = _arc(t, wx, cut, range(last, len(t)), p, inside)
    if before is None or after is None:
        return wx[first:last]
    passed = np.flatnonzero(np.cumsum(np.abs(before)) * sample_step(t) >= left)
    impact = passed[0] if len(passed) else len(inside) // 2
    return np.where(np.arange(len(inside)) <= impact, before, after)


def _arc(t, wx, cut, beside: range, p: float, inside: np.ndarray) -> np.ndarray | None:
    """An arc through the samples beside a gap, up to the next gap, continued into it; None if there are too few."""
    near = []
    for k in beside[: round(BESIDE / sample_step(t))]:
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
