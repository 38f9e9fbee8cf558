"""Where the fit of a hypothesis starts: at the block's nominal numbers, or anywhere that the priors allow.

A block whose feet nobody knows may lie in another valley than the source's. Quasi-random draws over the whole prior are
followed at a short memory over the first swings; the best are refined there, moved along the known ridges, and followed
farther and farther.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.stages import S1, Stage
from rockref.discover.listening.listener import record_of
from rockref.measure.signals.impacts import main_impacts

#: Draws, and how many of the best go on at each horizon; decided on simulated blocks of other feet.
DRAWS, SURVIVORS = 1024, (6, 3, 2)
#: Horizons in times of the first main impact; the last is the whole record.
HORIZONS: tuple[float | None, ...] = (2.2, 3.7, None)
#: Gauss-Newton steps at each horizon.
STEPS = (3, 3, 4)
#: Moves along a ridge in prior deviations.
KICKS = (-1.4, -0.7, -0.35, 0.35, 0.7, 1.4)
#: Prior deviations beyond which no number is moved.
OUTSIDE = 2.5
#: Mean losses between which a fit is moved along ridges (decided: below it is right; above it lacks more than a ridge
#: could mend).
WHITE_ENOUGH, FAR_OFF = 1.0, 5.0
#: Share of each prior within which draws lie.
INSIDE = (0.02, 0.98)
#: Ridges of the null: numbers of the law that trade with each other, and the signs with which they do. Feet on one
#: edge, a diagonal or alone; the inner points' distance with the mean height, by the angle at which these take over.
RIDGES: tuple[dict[str, float], ...] = (
    {"delta_diag": 1, "delta_long_1": 1, "delta_long_2": 1, "delta_long_3": 1, "delta_long_4": 1},
    {"delta_diag": 1, "delta_long_1": -1, "delta_long_2": -1, "delta_long_3": -1, "delta_long_4": -1},
    {"delta_diag": 1},
    {"delta_long_1": 1, "delta_long_2": 1, "delta_long_3": 1, "delta_long_4": 1},
    {"delta_long_1": 1, "delta_long_2": 1}, {"delta_long_3": 1, "delta_long_4": 1},
    {"delta_long_1": 1, "delta_long_4": 1}, {"delta_long_2": 1, "delta_long_3": 1},
    {"delta_long_1": 1, "delta_long_3": 1}, {"delta_long_2": 1, "delta_long_4": 1},
    {"delta_long_1": 1}, {"delta_long_2": 1}, {"delta_long_3": 1}, {"delta_long_4": 1},
    {"mu_int": 1, "mu_ext": 1}, {"mu_int": 1, "mu_ext": -1}, {"mu_int": 1}, {"mu_ext": 1},
    {"K_N": 1}, {"K_T": 1}, {"K_N": 1, "K_T": -1},
    {"beta_int": 1, "beta_ext": 1}, {"beta_int": 1, "beta_ext": -1},
)  # fmt: skip


def first_impact(fitter: Fitter) -> float:
    """Return the time of the first main impact [s], the latest of the runs."""
    found = [main_impacts(*record_of(run)).times for run in fitter.problem.runs]
    return max((float(times[0]) for times in found if len(times)), default=0.5 * fitter.problem.time_scale)


def draws(fitter: Fitter, effects: Sequence[str], z: np.ndarray, count: int) -> list[FittedModel]:
    """Return starts over the whole prior of the law, and of effects that are feet: `count` quasi-random ones, and z.

    z : numbers of the releases and of other effects, which all starts share.
    """
    from scipy.special import ndtri
    from scipy.stats import qmc

    parameters = fitter.problem.parameters(effects)
    feet = [k for k, p in enumerate(parameters) if p.run is None and (not p.effect or p.drawn)]
    shares = qmc.Sobol(len(feet), seed=fitter.problem.seed).random(count)
    found = [FittedModel(tuple(effects), z.copy())]
    for row in np.clip(shares, *INSIDE):
        start = z.copy()
        for k, share in zip(feet, row, strict=True):
            between = parameters[k].drawn
            start[k] = ndtri(share) if between is None else parameters[k].z_of(np.interp(share, (0, 1), between))
        found.append(FittedModel(tuple(effects), start))
    return found


def stages(fitter: Fitter) -> list[Stage]:
    """Return the stages of shortest memory that follow runs farther and farther."""
    unit = first_impact(fitter)
    return [S1.upto(None if factor is None else factor * unit) for factor in HORIZONS]


@dataclass
class GlobalFit:
    """A fit from starts over the whole prior: the best, and the fits over each horizon on the way, best first."""

    best: FittedModel
    fields: list[list[FittedModel]]


def global_fit(fitter: Fitter, effects: Sequence[str], z: np.ndarray, count: int = DRAWS) -> GlobalFit:
    """Fit a hypothesis at the shortest memory from starts over the whole prior, farther and farther.

    z : numbers of releases and effects from which all start
    """
    field, fields = draws(fitter, effects, z, count), []
    for stage, most, keep in zip(stages(fitter), STEPS, SURVIVORS, strict=True):
        fitter.evaluate_all(field, stage)
        field = sorted(field, key=lambda h: h.loss)[:keep]
        for h in field:
            fitter.tempered(h, stage, most)
        tried = sorted(field, key=lambda h: h.loss)
        field = [h.copy() for h in tried[: max(1, keep // 2)]]
        for h in field:
            if WHITE_ENOUGH < h.loss < FAR_OFF:
                kicked(fitter, h, stage, most)
        field.sort(key=lambda h: h.loss)
        fields.append([*(h.copy() for h in field), *tried[len(field) :]])
        fitter.problem.say(f"starts over the whole prior: mean loss {field[0].loss:.2f}")
    best = field[0]
    best.start = best.z.copy()
    return GlobalFit(best, fields)


def kicked(fitter: Fitter, h: FittedModel, stage: Stage, most: int, rounds: int = 3) -> FittedModel:
    """Move a fit along the ridges of the law, and each number of its effects, as long as a move, refined, is lower."""
    parameters = fitter.parameters(h)
    index = {p.name: k for k, p in enumerate(parameters)}
    own: list[dict[str, float]] = [{p.name: p.reach} for p in parameters if p.effect and p.run is None]
    for _ in range(rounds):
        moved = []
        for ridge in (*RIDGES, *own):
            if not ridge.keys() <= index.keys():
                continue
            for size in KICKS:
                z = h.z.copy()
                for name, sign in ridge.items():
                    k = index[name]
                    far = OUTSIDE * parameters[k].reach
                    z[k] = np.clip(z[k] + size * sign, max(-far, parameters[k].least), min(far, parameters[k].most))
                moved.append(FittedModel(h.effects, z))
        fitter.evaluate_all(moved, stage)
        best = min(moved, key=lambda k: k.loss)
        fitter.tempered(best, stage, most)
        if best.loss > 0.99 * h.loss:
            break
        h.z, h.r, h.objective, h.loss = best.z, best.r, best.objective, best.loss
    return h
