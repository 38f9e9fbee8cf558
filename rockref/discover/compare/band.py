"""The band in which a model cannot be told from another run of the experiment, and where it leaves it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockref.discover.compare.stretches import AXES
from rockref.measure.signals.repeatability import HORIZON_SIGMAS, HORIZON_WINDOW, Repeatability
from rockref.measure.signals.running import half_width, running_rms
from rockref.model.response import Response

# decided: two contacts of 1.5 ms and the 2 ms of the gyroscope's filter; short enough to tell one impact from the next.
INSTANT = 0.005


@dataclass(frozen=True)
class Departure:
    """Where a model leaves the band of a run.

    Attributes: ``time`` s after the release, in the run's time; ``axis``, the one that leaves first; ``error`` and
    ``limit`` rad/s in the 50 ms in which it does; ``points``, names of the contact points that touched within 5 ms of
    it, with their share of these 10 ms, longest first; ``after_impact`` s since the last main impact of the run (None
    before the first).
    """

    time: float
    axis: str
    error: float
    limit: float
    points: tuple[tuple[str, float], ...]
    after_impact: float | None


def band(t: np.ndarray, first_impact: float, noise: np.ndarray, repeats: Repeatability | None) -> np.ndarray:
    """Return the limits (N, 3) rad/s for the RMS, over 50 ms, of model minus measured.

    Three times the difference that a perfect model would show: the noise of the run (3,) rad/s, and the difference
    between two repeated runs (root 2 of their spread, noise taken out). Where the repeats end, their last spread holds.
    """
    square = np.broadcast_to(noise**2, (len(t), 3)).copy()
    if repeats is not None and np.isfinite(first_impact):
        for axis in range(3):
            spread = np.interp(t - first_impact, repeats.t, repeats.smooth_spread[:, axis])
            square[:, axis] += 2.0 * spread**2
    return HORIZON_SIGMAS * np.sqrt(square)


def running_error(t: np.ndarray, difference: np.ndarray) -> np.ndarray:
    """Return the RMS over 50 ms of difference (N, 3) rad/s at t (N,) s; NaN counts as zero."""
    return running_rms(np.nan_to_num(difference), half_width(t, HORIZON_WINDOW))


def departures(error: np.ndarray, limits: np.ndarray) -> list[int | None]:
    """Return the first sample at which error exceeds limits, (N, 3) rad/s each, axis by axis; None if it never does."""
    outside = error > limits
    return [int(np.argmax(outside[:, k])) if outside[:, k].any() else None for k in range(3)]


def departure(
    t: np.ndarray, difference: np.ndarray, limits: np.ndarray, response: Response, shift: float, impacts: np.ndarray
) -> Departure | None:
    """Return where the model first leaves the band, or None.

    t (N,) s; difference, limits (N, 3) rad/s; impacts (M,) s of the run; `shift` s, by how much the model was
    moved from the first of them on.
    """
    error = running_error(t, difference)
    firsts = [(sample, axis) for axis, sample in enumerate(departures(error, limits)) if sample is not None]
    if not firsts:
        return None
    # Where two axes leave at once, the one that is further outside.
    sample, axis = min(firsts, key=lambda f: (f[0], -error[f[0], f[1]] / limits[f[0], f[1]]))
    time = _instant(t, difference[:, axis], limits[:, axis], sample)
    before = impacts[impacts <= time]
    return Departure(
        time=time,
        axis=AXES[axis],
        error=float(error[sample, axis]),
        limit=float(limits[sample, axis]),
        points=active_points(response, time - shift if len(before) else time, 2.0 * INSTANT),
        after_impact=time - float(before[-1]) if len(before) else None,
    )


def _instant(t: np.ndarray, difference: np.ndarray, limit: np.ndarray, sample: int) -> float:
    """Return the first time in the 50 ms about `sample` at which the mean over 5 ms is outside, or its own."""
    half = half_width(t, HORIZON_WINDOW)
    near = slice(max(sample - half, 0), sample + half + 1)
    sharp = running_rms(np.nan_to_num(difference[near]), half_width(t, INSTANT))
    outside = np.flatnonzero(sharp > limit[near])
    return float(t[near][outside[0]]) if len(outside) else float(t[sample])


def active_points(response: Response, time: float, window: float) -> tuple[tuple[str, float], ...]:
    """Return the contact points that touch within `window` s about `time` s, with their share of it, longest first."""
    first, last = np.searchsorted(response.t, (time - 0.5 * window, time + 0.5 * window))
    last = max(int(last), int(first) + 1)
    if first >= len(response.t):
        return ()
    shares = response.anchored[first:last].mean(axis=0)
    order = np.argsort(-shares, kind="stable")
    return tuple((response.problem.points.names[k], float(shares[k])) for k in order if shares[k] > 0.0)
