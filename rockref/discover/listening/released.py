"""Models at the releases of measured runs, many at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields

import numpy as np

from rockref.api import Model
from rockref.engines.compiled import pack
from rockref.measure.records.release import Run
from rockref.model.errors import InputError
from rockref.model.problem import Problem, State
from rockref.model.release import release_postures, sideways_tipping_angle, tipping_angle

#: Share of the tilt and of the roll at which a block tips over, at which it is held (decided: it stands there for long,
#: and no record shows that).
UPRIGHT = 0.999
#: What the body of a model is made of: all but the notes.
MADE_OF = tuple(f.name for f in fields(Model) if f.name not in ("uncertainty", "origin"))


def released(models: Sequence[Model], runs: Sequence[Run]) -> list[Problem]:
    """Return the problems of models, each at the release of its run: stated tilt and roll with the offsets that the
    model's origin notes."""
    bodies = bodies_of(models)
    tilts = np.array([tilt_of(model, run) for model, run in zip(models, runs, strict=True)])
    rolls = np.array([float(model.origin.get("roll_offset", 0.0)) for model in models])
    turned = np.array([bool(run.block_turned) for run in runs])
    found: list[Problem] = []
    for model, body, posture in zip(models, bodies, postures(bodies, tilts, turned, rolls), strict=True):
        found.append(pack.with_memory(model.problem(duration=1.0, body=body, posture=posture)))
    return found


def tilt_of(model: Model, run: Run) -> float:
    """Return the tilt [rad] from which a run is released."""
    return float(run.release_tilt or 0.0) + float(model.origin.get("tilt_offset", 0.0))


def bodies_of(models: Sequence[Model]) -> list[tuple]:
    """Return block and points of each model; models that are made of the same share them."""
    made: dict[tuple[int, ...], tuple] = {}
    keys = [tuple(id(getattr(model, name)) for name in MADE_OF) for model in models]
    for key, model in zip(keys, models, strict=True):
        if key not in made:
            made[key] = model.body()
    return [made[key] for key in keys]


def postures(bodies: Sequence[tuple], tilts: np.ndarray, turned: np.ndarray, rolls: np.ndarray) -> list[State]:
    """Return the release postures (`release_postures`) of bodies that may differ in their number of points.

    A fit may try what would tip over: such a body is held just before.
    """
    numbers = np.array([points.n for _, points in bodies])
    found: dict[int, State] = {}
    for n in np.unique(numbers):
        rows = np.flatnonzero(numbers == n).tolist()
        of_rows = [bodies[b] for b in rows]
        try:
            made = release_postures(of_rows, tilts[rows], turned[rows], rolls[rows])
        except InputError:
            held, level = held_up(of_rows, tilts[rows], turned[rows], rolls[rows])
            made = release_postures(of_rows, held, turned[rows], level)
        found.update(zip(rows, made, strict=True))
    return [found[b] for b in range(len(bodies))]


def held_up(
    bodies: Sequence[tuple], tilts: np.ndarray, turned: np.ndarray, rolls: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return tilts and rolls (B,) [rad] of bodies, held short of those at which each tips over."""
    sides = np.where(turned, -1, 1)
    limits = UPRIGHT * np.array([tipping_angle(b, p, side) for (b, p), side in zip(bodies, sides, strict=True)])
    sideways = UPRIGHT * np.array([sideways_tipping_angle(points) for _, points in bodies])
    return np.clip(tilts, (1 - UPRIGHT) * limits, limits), np.clip(rolls, -sideways, sideways)
