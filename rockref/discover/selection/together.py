"""An effect and the law, looked for together: pairs of a start and an effect compete.

Without the effect the law bends towards what is missing, and what fits best is not near the truth. So starts of the law
that have gone some way are each tried with every effect; few steps for many pairs over the first horizon that tells
them apart, more for few over whole runs.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count

import numpy as np

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.objective import WHITE
from rockref.discover.fit.stages import S2, Stage
from rockref.discover.fit.starts import GlobalFit, stages
from rockref.discover.selection.halving import MARGIN, SECOND, proposed, say, sized_at_release, within

#: Mean loss of the law alone from which a horizon tells effects apart, and the starts that are tried there (decided).
TELLING, STARTS = 1.5, 6
#: Part of the misfit of the law alone that an effect may leave and lead by far (decided: it is there, whatever the
#: feet).
LEADS = 0.1
#: Effects that each start is tried with (decided: nearly all; one step from far says little).
TRIED = 16
#: Rounds over the first horizon: pairs that go on, how many of one effect among them, the factor on the best loss up to
#: which they do, and their steps. The last ones stand in their valley before runs are followed farther (decided: a step
#: takes off three quarters at most).
ROUNDS = ((16, 2, 4.0, 1), (16, 2, 2.5, 1), (4, 1, 1.5, 3))
#: Over each longer horizon: effects that go on, the factor on the best loss up to which they do, steps, and how many of
#: them take as many again along the directions of the posterior (decided: what a step more would change is within the
#: factor).
FARTHER = ((12, 1.5, 3, 4), (5, 1.3, 3, 4))


def telling(losses: Sequence[float]) -> int:
    """Return the first horizon over which effects are told apart, by the mean losses of the law alone over each.

    Feet and releases explain a short stretch by themselves, whatever is missing.
    """
    return next((k for k, loss in enumerate(losses) if loss > TELLING), len(losses) - 1)


def from_statement(
    fitter: Fitter, null: FittedModel, nominal: FittedModel, left: float
) -> tuple[list[FittedModel], FittedModel | None]:
    """Return the best effects beside the law as it is stated, and the one that leads by far, if one does.

    null : the baseline fitted from there
    left : mean loss above which the best over the first horizon is not the cause beside this law, and none goes on.
    """
    losses = [fitter.evaluate(null.copy(), stage).loss for stage in stages(fitter)]
    k = telling(losses)
    pairs = first_pairs(fitter, [nominal], stages(fitter)[k])
    best = pairs[0].copy()
    leads = best.loss - WHITE <= LEADS * (losses[k] - WHITE)
    return followed(fitter, pairs, k) if best.loss <= left else [], best if leads else None


def from_anywhere(fitter: Fitter, found: GlobalFit) -> list[FittedModel]:
    """Return the best pairs of an effect and a law, from the starts of the law over the whole prior that went far."""
    k = telling([field[0].loss for field in found.fields])
    starts = found.fields[k][: STARTS - 1]
    if k < len(found.fields) - 1:  # over whole runs it is the first of them
        starts = [*starts, found.best]
    return followed(fitter, first_pairs(fitter, starts, stages(fitter)[k]), k)


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
    for h in field:
        h.start = h.z.copy()
    field = best_pairs(field, SECOND, 1, MARGIN)
    for h in field:
        fitter.refine(h, S2, 3)
    say(fitter, "S2", field)
    return within(field, SECOND)


def first_pairs(fitter: Fitter, starts: Sequence[FittedModel], stage: Stage) -> list[FittedModel]:
    """Return the pairs of a start and an effect by how they explain the runs over a horizon, best first."""
    field: list[FittedModel] = []
    for start in starts:
        field += proposed(fitter, start.copy(), stage, TRIED)
    field += with_sensors(fitter, starts)
    fitter.evaluate_all(field, stage)
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
