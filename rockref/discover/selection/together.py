"""An effect and the law, looked for together: pairs of a start and an effect compete.

Without the effect the law bends towards what is missing, and what fits best is not near the truth. So starts of the law
are each tried with every effect, and the best pairs are a population (`rockref.discover.fit.evolution`): what one pair
finds of the law, others take over. Many pairs over the first horizon that tells them apart, few over whole runs.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count

import numpy as np

from rockref.discover.fit.evolution import evolved
from rockref.discover.fit.few_runs import FewRuns
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.objective import WHITE
from rockref.discover.fit.stages import S1, S2, Stage
from rockref.discover.fit.starts import AGAIN, GlobalFit, finely, stages
from rockref.discover.selection.halving import MARGIN, SECOND, proposed, say, sized_at_release, within

#: Mean loss of the law alone from which a horizon tells effects apart: beside the stated law, where few pairs go on,
#: and in a population, where many do (decided: the second is what white noise hardly leaves).
TELLING, TELLING_MANY = 1.5, 1.2
#: Starts of the law that are tried with every effect, of those that went far without one, and of those that took one
#: step; and the effects that go on from each (decided: the first bend, the others lie all over the prior).
STARTS, WIDE = (6, 16), (12, 9)
#: Steps of a pair at S2 after the first three, as long as each takes off a fiftieth (decided: few stand in their valley
#: after three).
SETTLED = 5
#: Members of the population over each horizon, and how many of one effect, or in one valley, among them (decided on
#: simulated blocks of other feet: half as many again find no more).
MEMBERS = ((16, 3), (8, 2), (4, 1))
#: Part of the misfit of the law alone that an effect may leave and lead by far (decided: it is there, whatever the
#: feet).
LEADS = 0.1
#: Effects that each start is tried with (decided: nearly all; one step from far says little).
TRIED = 16
#: Rounds over the first horizon: pairs that go on, how many of one effect among them, the factor on the best loss up to
#: which they do, and their steps. The last ones stand in their valley before runs are followed farther (decided: a step
#: takes off three quarters at most).
ROUNDS = ((24, 2, 4.0, 1), (16, 2, 2.5, 1), (4, 1, 1.5, 3))
#: Over each longer horizon: effects that go on, the factor on the best loss up to which they do, steps, and how many of
#: them take as many again along the directions of the posterior (decided: what a step more would change is within the
#: factor).
FARTHER = ((12, 1.5, 3, 4), (5, 1.3, 3, 4))


def telling(losses: Sequence[float], least: float) -> int:
    """Return the first horizon over which the law alone leaves more than `least`, by its mean losses over each.

    Feet and releases explain a short stretch by themselves, whatever is missing.
    """
    return next((k for k, loss in enumerate(losses) if loss > least), len(losses) - 1)


def from_statement(
    fitter: Fitter, null: FittedModel, nominal: FittedModel, left: float
) -> tuple[list[FittedModel], FittedModel | None]:
    """Return the best effects beside the law as it is stated, and the one that leads by far, if one does.

    null : the baseline fitted from there
    left : mean loss above which the best over the first horizon is not the cause beside this law, and none goes on.
    """
    few = FewRuns(fitter.problem)
    part = Fitter(few.problem)
    alone = few.start(null)
    losses = [part.evaluate(alone, stage).loss for stage in stages(part)]
    k = telling(losses, TELLING)
    found = first_pairs(part, few.start(nominal), stages(part)[k])
    found = [on_all_runs(fitter, few, h, nominal) for h in found]
    best = found[0].copy()
    leader = best if leads(best, losses[k]) else None
    return followed(fitter, found, k) if best.loss <= left else [], leader


def leads(h: FittedModel, alone: float) -> bool:
    """Return whether an effect leads by far: it leaves next to nothing of what the law alone leaves, a mean loss."""
    return h.loss - WHITE <= LEADS * (alone - WHITE)


def from_anywhere(fitter: Fitter, found: GlobalFit) -> list[FittedModel]:
    """Return the best pairs of an effect and a law, fitted at S2, from starts of the law over the whole prior."""
    problem, few = fitter.problem, FewRuns(fitter.problem)
    part, rng = Fitter(few.problem), np.random.default_rng(problem.seed)
    k = telling([field[0].loss for field in found.fields], TELLING_MANY)
    field = []
    bent = [found.best, *(h for h in found.fields[k] if h is not found.best)]
    for starts, (most, effects) in ((bent, STARTS), (found.wide, WIDE)):
        field += pairs(part, [few.start(h) for h in starts[:most]], stages(part)[k], effects)
    for stage, (size, of_each) in zip(stages(part)[k:], MEMBERS[k:], strict=True):
        part.evaluate_all(field, stage)
        field = finely(part, field, stage)
        field = evolved(part, field, stage, size, rng, of_each)
        say(part, "together", field)
    return at_S2(fitter, [fitter.tempered(on_all_runs(fitter, few, h, found.best), S1, AGAIN) for h in field])


def on_all_runs(fitter: Fitter, few: FewRuns, h: FittedModel, base: FittedModel) -> FittedModel:
    """Return a pair of few runs with the numbers that a hypothesis without its effect has of the other runs."""
    whole = fitter.with_effect(base, h.effects[-1]).z
    return FittedModel(h.effects, few.put(h.effects, h.z, whole), objective=h.objective, loss=h.loss)


def followed(fitter: Fitter, field: list[FittedModel], horizon: int) -> list[FittedModel]:
    """Return pairs over a horizon that stay near the best over farther ones, fitted at S2."""
    for stage, (most, margin, steps, moved) in zip(stages(fitter)[horizon + 1 :], FARTHER[horizon:], strict=True):
        field = best_pairs(field, most, 1, margin)
        fitter.evaluate_all(field, stage)
        for h in field:
            fitter.tempered(h, stage, steps)
        field = best_pairs(field, most, 1, margin)
        for h in field[:moved]:
            fitter.polish(h, stage, steps)
        say(fitter, "farther", field)
    return at_S2(fitter, field)


def at_S2(fitter: Fitter, field: list[FittedModel]) -> list[FittedModel]:
    """Return the best pairs over whole runs, fitted at S2."""
    for h in field:
        h.start = h.z.copy()
    field = best_pairs(field, SECOND, 1, MARGIN)
    for h in field:
        fitter.settle(fitter.refine(h, S2, 3), S2, SETTLED)
    say(fitter, "S2", field)
    return within(field, SECOND)


def pairs(fitter: Fitter, starts: Sequence[FittedModel], stage: Stage, effects: int) -> list[FittedModel]:
    """Return each start with so many of the best effects, and with each error of the sensor."""
    field: list[FittedModel] = []
    for start in starts:
        field += proposed(fitter, start.copy(), stage, effects)
    field += with_sensors(fitter, starts)
    fitter.evaluate_all(field, stage)
    return field


def first_pairs(fitter: Fitter, start: FittedModel, stage: Stage) -> list[FittedModel]:
    """Return the pairs of a start and an effect by how they explain the runs over a horizon, best first."""
    field = pairs(fitter, [start], stage, TRIED)
    for most, of_each, margin, steps in ROUNDS:
        for h in best_pairs(field, most, of_each, margin):
            fitter.tempered(h, stage, steps)
    field = best_pairs(field, len(field), 1)
    say(fitter, "pairs", field[: FARTHER[0][0]])
    return field


def with_sensors(fitter: Fitter, starts: Sequence[FittedModel]) -> list[FittedModel]:
    """Return each start with each error of the sensor: the first swing, on which the feet hardly act, sizes it once."""
    found = []
    for h in sized_at_release(fitter, starts[0]):
        own = h.z[len(starts[0].z) :]
        found += [fitter.with_effect(start, h.effects[-1], own) for start in starts]
    return found


def best_pairs(field: Sequence[FittedModel], most: int, of_each: int, margin: float = np.inf) -> list[FittedModel]:
    """Return the pairs with the least loss within a margin of the best: so many, and so many of each effect at most."""
    taken: dict[frozenset[str], count] = {}
    ranked = sorted(field, key=lambda h: h.loss)
    near = [h for h in ranked if h.loss <= margin * ranked[0].loss]
    return [h for h in near if next(taken.setdefault(frozenset(h.effects), count())) < of_each][:most]
