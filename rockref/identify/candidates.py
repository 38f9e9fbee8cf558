"""Chromosomes to records: many models run side by side and are seen through the target's gyroscope."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

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
from rockref.model.problem import Block, ContactPoints, Problem, State, stack
from rockref.model.release import release_postures
from rockref.model.simulate import output_steps, whole_part
from rockref.model.simulate import simulate as law

#: The source's step [s], and an output rate at which the gyroscope's low-pass is exact enough [Hz].
STEP = 1e-5
OUTPUT_RATE = 2000.0


def rates(problems: Sequence[Problem], workers: int | None = 1) -> np.ndarray:
    """Return crv (B, T, 3) [rad/s] of problems of one step, output rate and number of points.

    NaN from where a run lost its numbers, and beyond the end of runs that are shorter than others.
    """
    if has_numba():
        from rockref.engines.compiled import columns as col
        from rockref.engines.compiled.batch import batch_of, run_batch
        from rockref.engines.compiled.pack import with_memory

        wanted = {end: output_steps(p) for end, p in {p.duration: p for p in problems}.items()}
        rows = np.full((len(problems), max(map(len, wanted.values()))), -1)
        for row, p in zip(rows, problems, strict=True):
            row[: len(wanted[p.duration])] = wanted[p.duration]
        batch = batch_of([with_memory(p) for p in problems], rows)
        return run_batch(batch, workers=workers)[:, :, col.W_ : col.W_ + 3]
    alike: dict[float, list[int]] = {}
    for i, p in enumerate(problems):
        alike.setdefault(p.duration, []).append(i)
    runs = {i: W for own in alike.values() for i, W in zip(own, _by_the_law([problems[i] for i in own]), strict=True)}
    found = np.full((len(problems), max(map(len, runs.values())), 3), np.nan)
    for i, W in runs.items():
        found[i, : len(W)] = W
    return found


def _by_the_law(problems: Sequence[Problem]) -> np.ndarray:
    return law(stack(list(problems)), keep_going=True).W


class Releases(NamedTuple):
    """Models to be released as the run of a target was: at tilts [rad], each with what its release needs beside, and
    its body (None where that is refused); duration [s] of each run, long enough to be compared with the target."""

    target: Target
    models: Sequence[Model]
    tilts: Sequence[float]
    starts: Sequence[dict]
    bodies: Sequence[tuple[Block, ContactPoints] | None]
    duration: float

    def problems(self, step: float) -> dict[int, Problem]:
        """Return the runs by their index; none of a model that cannot be released."""
        known = {i: body for i, body in enumerate(self.bodies) if body is not None}
        rolls = [self.starts[i].get("out_of_plane", 0.0) for i in known]
        turned = [self.target.turned] * len(known)
        postures = _postures(list(known.values()), [self.tilts[i] for i in known], turned, rolls)
        return {
            i: self.models[i].problem(self.duration, step, OUTPUT_RATE, body=known[i], posture=posture)
            for i, posture in zip(known, postures, strict=True)
            if posture is not None
        }


def _postures(
    bodies: Sequence[tuple[Block, ContactPoints]],
    tilts: Sequence[float],
    turned: Sequence[bool],
    rolls: Sequence[float],
) -> list[State | None]:
    """Return the release posture of each body, None where that is refused: of halves, where one of a batch is."""
    if not bodies:
        return []
    try:
        return list(release_postures(bodies, tilts, turned, rolls))
    except InputError:
        if len(bodies) == 1:
            return [None]
    half = len(bodies) // 2
    first = _postures(bodies[:half], tilts[:half], turned[:half], rolls[:half])
    return first + _postures(bodies[half:], tilts[half:], turned[half:], rolls[half:])


def records(
    asked: Sequence[Releases], step: float = STEP, workers: int | None = 1
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return for each target times (N,) [s] and rates (B, N, 3) [rad/s] that its gyroscope would have recorded.

    All runs are one batch. A model that cannot be released (tilt beyond its tipping angle) or loses its numbers has
    NaN.
    """
    problems = [each.problems(step) for each in asked]
    whole = rates([p for own in problems for p in own.values()], workers) if any(problems) else np.zeros((0, 0, 3))
    edges = np.cumsum([0, *map(len, problems)])
    made = []
    for (target, models, *_, duration), own, first, last in zip(asked, problems, edges[:-1], edges[1:], strict=True):
        if not own:
            made.append((target.t, np.full((len(models), len(target.t), 3), np.nan)))
            continue
        found = whole[first:last, : _rows(duration)]
        lost = np.logical_not(np.all(np.isfinite(found[:, -1]), axis=-1))
        found = _continued(np.where(lost[:, np.newaxis, np.newaxis], 0.0, found), _rows(target.duration))
        times, seen = record(np.arange(found.shape[1]) / OUTPUT_RATE, found, target.gyro)
        seen[lost] = np.nan
        crv = np.full((len(models), *seen.shape[1:]), np.nan)
        crv[list(own)] = seen
        made.append((times, crv))
    return made


def _rows(duration: float) -> int:
    return whole_part(duration * OUTPUT_RATE) + 1


def _continued(W: np.ndarray, rows: int) -> np.ndarray:
    """Return rates (B, T, 3) of at least so many rows, shorter ones continued at their last rates.

    The step of the low-pass is a mean over all rows, which rounds otherwise for another number of them: so no bit of a
    record hangs on how far beyond it a run was simulated.
    """
    return np.pad(W, ((0, 0), (0, max(0, rows - W.shape[1])), (0, 0)), "edge")


def evaluate(
    space: Space, targets: Sequence[Target], chromosomes: np.ndarray
) -> list[tuple[float, list[Terms | None]]]:
    """Return cost, and terms for each target, of chromosomes (B, G) in [0, 1]; the cost is the mean over the targets.

    Each chromosome is computed by itself: the result does not depend on what else is in the batch.
    """
    sums: list[float] = [0.0] * len(chromosomes)
    kept: list[list[Terms | None]] = [[] for _ in chromosomes]
    for target, (t, crv) in zip(targets, releases(space, targets, [list(chromosomes)] * len(targets)), strict=True):
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
    space: Space,
    targets: Sequence[Target],
    chromosomes: Sequence[Sequence[np.ndarray]],
    step: float = STEP,
    workers: int | None = 1,
    durations: Sequence[float] | None = None,
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return `records` of the chromosomes (B, G) of each target, released as it was.

    The gene theta_0 says how far the stated tilt is off, the same for every target.  durations : (R,) [s] of the runs
    of each target; by default as long as the cost looks.
    """
    asked, tilt_gene = [], space.names.index("theta_0")
    bodies: dict[bytes, tuple[Block, ContactPoints] | None] = {}
    ends = [t.duration for t in targets] if durations is None else durations
    for target, own, end in zip(targets, chromosomes, ends, strict=True):
        models = [model_of(space, u) for u in own]
        tilts = [target.tilt + (m.parameters.theta_0 - space.model.parameters.theta_0) for m in models]
        keys = [np.delete(u, tilt_gene).tobytes() for u in own]
        for key, model in zip(keys, models, strict=True):
            if key not in bodies:
                bodies[key] = _body(model)
        starts = [start_of(space, u) for u in own]
        asked.append(Releases(target, models, tilts, starts, [bodies[key] for key in keys], end))
    return records(asked, step, workers)


def _body(model: Model) -> tuple[Block, ContactPoints] | None:
    """Return block and points of a model, which its release angle does not change; None where they are refused."""
    try:
        return model.body()
    except InputError:
        return None
