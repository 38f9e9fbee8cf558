"""Run-to-run variability: the envelope of repeated runs, their spread, and the horizon up to which they agree."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from rockref.measure.records.release import Run
from rockref.measure.signals.impacts import checked_signal, main_impacts
from rockref.measure.signals.noise import noise_floor
from rockref.measure.signals.running import half_width, running_rms, sample_step
from rockref.model.errors import InputError

# decided: a difference that stays above three noise widths for 50 ms is no noise and no single impact.
HORIZON_SIGMAS, HORIZON_WINDOW = 3.0, 0.05
# decided: runs are alike while their spread is below half of their motion; that of unrelated runs is as large as it.
ALIKE_SHARE, ALIKE_WINDOW = 0.5, 0.1
# decided: motion below five noise widths says nothing about likeness.
ALIKE_SIGMAS = 5.0


@dataclass(frozen=True, eq=False)
class Repeatability:
    """What R repeated runs have in common, on a time axis that is zero at the first main impact of each.

    Attributes
    ----------
    t : (G,) time after the first main impact, s
    mean, lower, upper : (G, 3) mean, smallest and largest rate of the runs, rad/s
    spread : (G, 3) standard deviation between runs, noise included, rad/s
    smooth_spread : (G, 3) the same as an RMS over 50 ms, with the noise taken out, rad/s
    noise : (3,) noise of one run, rad/s: RMS over the runs
    impacts : (R, K) times of the main impacts that all runs have, s after the first
    horizon : (3,) time from which the spread exceeds three noise widths, s; infinite if it never does
    alike_until : (3,) time from which the spread exceeds half of the motion, s; infinite if it never does
    """

    t: np.ndarray
    mean: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    spread: np.ndarray
    smooth_spread: np.ndarray
    noise: np.ndarray
    impacts: np.ndarray
    horizon: np.ndarray
    alike_until: np.ndarray


def repeat_groups(runs: Iterable[Run]) -> list[tuple[Run, ...]]:
    """Return the groups of two or more loaded runs with the same release tilt and the same turn of the block."""
    groups: dict[tuple[float | None, float], list[Run]] = {}
    for run in runs:
        if run.loaded and run.crv is not None:
            groups.setdefault((run.release_tilt, run.block_turned), []).append(run)
    return [tuple(group) for group in groups.values() if len(group) > 1]


def repeatability(signals: Sequence[tuple[np.ndarray, np.ndarray]]) -> Repeatability:
    """Return what repeated runs, each given as (t (N,) s, crv (N, 3) rad/s), have in common.

    Runs may have other rates and lengths; they are compared where all of them are, at the coarsest of their rates.
    Raises InputError E-SIGNAL, E-REPEATS if there are fewer than two or one has no main impact.
    """
    if len(signals) < 2:
        raise InputError("E-REPEATS", "argument signals", f"{len(signals)} runs", "Give two or more repeated runs.")
    pairs = [checked_signal(t, crv) for t, crv in signals]
    impacts = [main_impacts(t, crv).times for t, crv in pairs]
    missing = [k for k, times in enumerate(impacts) if not len(times)]
    if missing:
        cure = "Leave it out."
        raise InputError("E-REPEATS", f"argument signals[{missing[0]}]", "the run has no main impact", cure)
    grid, stack = _aligned(pairs, [float(times[0]) for times in impacts])
    noise = np.sqrt(np.mean([noise_floor(t, crv).sigma ** 2 for t, crv in pairs], axis=0))
    spread = stack.std(axis=0, ddof=1)
    smooth = _without_noise(running_rms(spread, half_width(grid, HORIZON_WINDOW)), noise)
    wide = half_width(grid, ALIKE_WINDOW)
    motion = np.sqrt(np.mean([running_rms(x, wide) ** 2 for x in stack], axis=0))
    differs = _without_noise(running_rms(spread, wide), noise) > ALIKE_SHARE * motion
    common = min(len(times) for times in impacts)
    return Repeatability(
        t=grid,
        mean=stack.mean(axis=0),
        lower=stack.min(axis=0),
        upper=stack.max(axis=0),
        spread=spread,
        smooth_spread=smooth,
        noise=noise,
        impacts=np.array([times[:common] - times[0] for times in impacts]),
        horizon=_first_times(grid, smooth > HORIZON_SIGMAS * noise),
        alike_until=_first_times(grid, differs & (motion > ALIKE_SIGMAS * noise)),
    )


def _aligned(pairs: list[tuple[np.ndarray, np.ndarray]], zeros: list[float]) -> tuple[np.ndarray, np.ndarray]:
    """Return the common time axis (G,) s, zero at `zeros` of each run, and the rates there, (R, G, 3) rad/s."""
    from scipy.interpolate import CubicSpline

    start = max(float(t[0]) - zero for (t, _), zero in zip(pairs, zeros, strict=True))
    end = min(float(t[-1]) - zero for (t, _), zero in zip(pairs, zeros, strict=True))
    step = max(sample_step(t) for t, _ in pairs)
    # Whole steps from zero, so that groups of runs share their instants; rounded inwards.
    grid = np.arange(np.ceil(start / step - 1e-9), np.floor(end / step + 1e-9) + 1.0) * step
    inside = [np.clip(grid + zero, t[0], t[-1]) for (t, _), zero in zip(pairs, zeros, strict=True)]
    return grid, np.stack([CubicSpline(t, crv)(at) for (t, crv), at in zip(pairs, inside, strict=True)])


def _without_noise(spread: np.ndarray, noise: np.ndarray) -> np.ndarray:
    return np.sqrt(np.maximum(spread**2 - noise**2, 0.0))


def _first_times(t: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """Return the time of the first True of each column of mask (G, 3), (3,) s; infinite where there is none."""
    return np.where(mask.any(axis=0), t[np.argmax(mask, axis=0)], np.inf)
