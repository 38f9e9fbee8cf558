"""Where the fit of a hypothesis starts: at the block's nominal numbers, or anywhere that the priors allow.

A block whose feet nobody knows may lie in another valley than the source's. Quasi-random draws over the whole prior are
followed at a short memory over the first swings. Many of them descend, the best breed, and are followed farther and
farther.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rockref.discover.fit.evolution import best, evolved, survivors
from rockref.discover.fit.few_runs import FewRuns
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.stages import S1, F, Stage
from rockref.discover.fit.steps import fine_enough
from rockref.discover.hypotheses.law import is_height
from rockref.discover.listening.listener import record_of
from rockref.measure.signals.impacts import main_impacts

#: Draws over the whole prior; decided on simulated blocks of other feet, as the numbers below.
DRAWS = 512
#: Horizons in times of the first main impact; the last is the whole record.
HORIZONS: tuple[float | None, ...] = (2.2, 3.7, None)
#: Rounds over the first horizon: how many of the best go on, and their Gauss-Newton steps. A descent from anywhere ends
#: in the right valley in one case of ten, and its first loss does not tell which.
ROUNDS = ((32, 1), (16, 1), (8, 2))
#: Members of the population over each horizon.
MEMBERS = (8, 6, 4)
#: The best of a population, for which steps are to be fine enough.
LOOKED = 4
#: Steps of the best with all runs.
AGAIN = 4
#: Share of each prior within which draws lie.
INSIDE = (0.02, 0.98)
#: Least factor that the heights of a block's feet have in common. Feet are made alike: where all are high, the block
#: rocks on its inner points, and no small step tells that lower ones would do.
ALIKE = 0.1
#: Part of the first swing over which releases and the sensor are sized: before the first impact nothing is chaotic.
FIRST_SWING = 0.85
#: Steps that size the releases: tempered ones, and more at the true noise.
RELEASED = (4, 2)


def first_impact(fitter: Fitter) -> float:
    """Return the time of the first main impact [s], the latest of the runs."""
    found = [main_impacts(*record_of(run)).times for run in fitter.problem.runs]
    return max((float(times[0]) for times in found if len(times)), default=0.5 * fitter.problem.time_scale)


def first_swing(fitter: Fitter) -> Stage:
    """Return the stage of longest memory up to shortly before the first main impact."""
    return F.upto(FIRST_SWING * first_impact(fitter))


def released(fitter: Fitter, h: FittedModel) -> FittedModel:
    """Return a hypothesis with the releases that the first swing shows. Wrong ones hide the true law."""
    stage = first_swing(fitter)
    sized = fitter.tempered(h.copy(), stage, RELEASED[0])
    fitter.refine(sized, stage, RELEASED[1])
    z = [at if p.run is not None and not p.effect else own
         for p, at, own in zip(fitter.parameters(h), sized.z, h.z, strict=True)]  # fmt: skip
    return FittedModel(h.effects, np.array(z))


def draws(fitter: Fitter, effects: Sequence[str], z: np.ndarray, count: int) -> list[FittedModel]:
    """Return starts over the whole prior of the law, and of effects that are feet: `count` quasi-random ones, and z.

    z : numbers of the releases and of other effects, which all starts share.
    """
    from scipy.special import ndtri
    from scipy.stats import qmc

    parameters = fitter.problem.parameters(effects)
    feet = [k for k, p in enumerate(parameters) if p.run is None and (not p.effect or p.drawn)]
    heights = np.array([is_height(parameters[k]) for k in feet])
    shares = qmc.Sobol(len(feet) + 1, seed=fitter.problem.seed).random(count)
    alike = ALIKE ** shares[:, -1:]
    shares = np.clip(np.where(heights, alike, 1.0) * shares[:, :-1], *INSIDE)
    found = [FittedModel(tuple(effects), z.copy())]
    for row in shares:
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
    """A fit from starts over the whole prior: fits that differ over each horizon on the way, best first.

    wide : the best starts after a step, from which these descend
    """

    fields: list[list[FittedModel]]
    wide: list[FittedModel]

    @property
    def best(self) -> FittedModel:
        """Return the best over whole records; it alone was fitted to all runs."""
        return self.fields[-1][0]

    def valleys(self, most: int, margin: float) -> list[FittedModel]:
        """Return the next best in other valleys over whole records, within a margin of the best loss."""
        first, *others = self.fields[-1]
        return [h for h in others if h.loss <= margin * first.loss][:most]


def finely(fitter: Fitter, field: list[FittedModel], stage: Stage) -> list[FittedModel]:
    """Return a field, evaluated at a stage with steps that are fine enough for its best."""
    if not fine_enough(fitter, best(field, LOOKED), [stage]):
        fitter.evaluate_all(field, stage)
    return field


def global_fit(fitter: Fitter, effects: Sequence[str], z: np.ndarray) -> GlobalFit:
    """Fit a hypothesis at the shortest memory from starts over the whole prior, farther and farther, on few runs.

    z : numbers of releases and effects from which all start
    """
    few = FewRuns(fitter.problem)
    found = populations(Fitter(few.problem), effects, few.taken(effects, z))
    for h in (h for field in [*found.fields, found.wide] for h in field):
        h.z, h.r, h.objective = few.put(effects, h.z, z), None, np.inf
    fitter.tempered(found.best, S1, AGAIN)
    found.best.start = found.best.z.copy()
    return found


def populations(fitter: Fitter, effects: Sequence[str], z: np.ndarray) -> GlobalFit:
    """Return fits from starts over the whole prior that differ, over each horizon, best first."""
    rng = np.random.default_rng(fitter.problem.seed)
    found, field = GlobalFit([], []), draws(fitter, effects, z, DRAWS)
    first = stages(fitter)[0]
    fitter.evaluate_all(field, first)
    for most, steps in ROUNDS:
        field = finely(fitter, best(field, most), first)
        for h in field:
            fitter.tempered(h, first, steps)
        found.wide = found.wide or [h.copy() for h in best(field, most)]
    for stage, members in zip(stages(fitter), MEMBERS, strict=True):
        fitter.evaluate_all(field, stage)
        field = finely(fitter, field, stage)
        before = [h.copy() for h in field]
        field = evolved(fitter, field, stage, members, rng)
        there = [*field, *before]
        found.fields.append([h.copy() for h in survivors(fitter, there, len(there))])
        fitter.problem.say(f"starts over the whole prior: mean loss {field[0].loss:.2f}")
    return found
