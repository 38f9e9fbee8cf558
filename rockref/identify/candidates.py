"""Chromosomes to records: many models run side by side and are seen through the target's gyroscope."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rockref.api import Model
from rockref.engines import has_numba
from rockref.identify.cost import Terms, cost_terms, total
from rockref.identify.features import Features, features
from rockref.identify.four_points import start_of
from rockref.identify.genes import Space
from rockref.identify.models import model_of
from rockref.identify.target import Target
from rockref.measure.gyroscope import record
from rockref.model.errors import InputError
from rockref.model.problem import Problem, stack
from rockref.model.simulate import simulate as law

#: The source's step [s], and an output rate at which the gyroscope's low-pass is exact enough [Hz].
STEP = 1e-5
OUTPUT_RATE = 2000.0


def rates(problems: Sequence[Problem], workers: int | None = 1) -> np.ndarray:
    """Return crv (B, T, 3) [rad/s] of problems of one structure; NaN from where a run lost its numbers."""
    if has_numba():
        from rockref.engines.compiled import columns as col
        from rockref.engines.compiled.batch import from_problems, run_batch

        return run_batch(from_problems(problems), workers=workers)[:, :, col.W_ : col.W_ + 3]
    return law(stack(list(problems)), keep_going=True).W


def problem_for(model: Model, target: Target, tilt: float, step: float = STEP, start: dict | None = None) -> Problem:
    """Return the release of `model` at `tilt` [rad] as the target's was, long enough to be compared with it."""
    return model.problem(target.duration, step, OUTPUT_RATE, turned=target.turned, theta_0=tilt, **(start or {}))


def records(
    models: Sequence[Model], target: Target, tilts: Sequence[float], step: float = STEP, workers: int | None = 1,
    starts: Sequence[dict] | None = None,
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """Return times (N,) [s] and rates (B, N, 3) [rad/s] that the target's gyroscope would have recorded of each model.

    A model that cannot be released (tilt beyond its tipping angle) or loses its numbers has NaN.
    """
    starts = [{}] * len(models) if starts is None else starts
    problems: dict[int, Problem] = {}
    for i, (model, tilt, start) in enumerate(zip(models, tilts, starts, strict=True)):
        try:
            problems[i] = problem_for(model, target, tilt, step, start)
        except InputError:
            continue
    crv = None
    if problems:
        found = rates(list(problems.values()), workers)
        t = np.arange(found.shape[1]) / OUTPUT_RATE
        at, seen = record(t, np.nan_to_num(found), target.gyro)
        seen[~np.isfinite(found[:, -1]).all(axis=-1)] = np.nan
        crv = np.full((len(models), *seen.shape[1:]), np.nan)
        crv[list(problems)] = seen
        return at, crv
    return target.t, np.full((len(models), len(target.t), 3), np.nan)


def evaluate(
    space: Space, targets: Sequence[Target], chromosomes: np.ndarray
) -> list[tuple[float, list[Terms | None]]]:
    """Return cost, and terms for each target, of chromosomes (B, G) in [0, 1]; the cost is the mean over the targets.

    Each chromosome is computed by itself: the result does not depend on what else is in the batch.
    """
    sums: list[float] = [0.0] * len(chromosomes)
    kept: list[list[Terms | None]] = [[] for _ in chromosomes]
    for target in targets:
        t, crv = releases(space, target, list(chromosomes))
        for i in range(len(chromosomes)):
            found = features(t, crv[i]) if np.isfinite(crv[i]).all() else Features(np.zeros(0))
            terms = cost_terms(found, target.features)
            sums[i] += total(terms, len(found.impacts))
            kept[i].append(terms)
    return [(s / len(targets), terms) for s, terms in zip(sums, kept, strict=True)]


def feature_costs(space: Space, targets: Sequence[Target], chromosomes: np.ndarray) -> list[float]:
    """Return the cost alone, for the search: (B,) of chromosomes (B, G)."""
    return [cost for cost, _ in evaluate(space, targets, np.asarray(chromosomes))]


def releases(
    space: Space, target: Target, chromosomes: Sequence[np.ndarray], step: float = STEP, workers: int | None = 1
) -> tuple[np.ndarray, np.ndarray]:
    """Return `records` of chromosomes (B, G), released as the target was.

    The gene theta_0 says how far the stated tilt is off, the same for every target.
    """
    models = [model_of(space, u) for u in chromosomes]
    tilts = [target.tilt + (m.parameters.theta_0 - space.model.parameters.theta_0) for m in models]
    return records(models, target, tilts, step, workers, [start_of(space, u) for u in chromosomes])
