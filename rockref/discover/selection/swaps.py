"""One effect of a model in another's place, ranked by one linearisation at the model's best fit.

Where several effects explain the runs nearly as well, a step from the model without either tells little: its law has
not moved yet. About the best fit all of them are near, and a quadratic that takes one out and the other in tells which
is worth a fit.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from rockref.discover.fit.fitter import FittedModel, Fitter, stepped
from rockref.discover.fit.stages import F
from rockref.discover.selection.finalists import added_effects, converged, follow, lowest
from rockref.discover.selection.halving import say
from rockref.discover.selection.score_test import ScoreTest, best_of_each, predicted_gain, predicted_step, score_test

#: Exchanges that are followed, by the quadratic; decided: it overrates what the law cannot do at once, and on a block
#: of other feet put the right one third among those that were not known.
MOST = 4


def swapped(fitter: Fitter, field: list[FittedModel]) -> list[FittedModel]:
    """Return finalists with those in which an effect of the best stands in another's place, compared anew where one of
    them is better."""
    best = lowest(fitter, field)
    found = swaps(fitter, best, {frozenset(h.effects) for h in field})
    follow(fitter, found, [*field, *found])
    if not found:
        return field
    say(fitter, f"in the place of an effect of {best.name}", found)
    every = best_of_each([*field, *found])
    return converged(fitter, every) if lowest(fitter, every) is not best else every


def swaps(fitter: Fitter, best: FittedModel, known: Collection[frozenset[str]]) -> list[FittedModel]:
    """Return models with one effect of the best exchanged for another that are not known yet, those first that come
    nearest by the quadratic about it, as far as one step leads."""
    own = added_effects(fitter, best)
    if not own:
        return []
    best = fitter.evaluate(best.copy(), F)
    test = score_test(fitter, best, F)
    found = [
        exchanged(fitter, best, test, out, into)
        for out in own
        for into in test.places
        if (frozenset(best.effects) - {out}) | {into} not in known
    ]
    ranked = sorted(range(len(found)), key=lambda k: found[k][0])
    return [found[k][1] for k in ranked[:MOST]]


def exchanged(fitter: Fitter, best: FittedModel, test: ScoreTest, out: str, into: str) -> tuple[float, FittedModel]:
    """Return by how much the objective would rise, were it quadratic, and the model with one effect for another."""
    parameters = fitter.parameters(best)
    gone = np.array([k for k, p in enumerate(parameters) if p.effect == out])
    kept = np.setdiff1d(np.arange(test.own), gone)
    rows = np.r_[kept, test.places[into]]
    away = -best.z[gone]
    g = test.g[rows] + test.H[np.ix_(rows, gone)] @ away
    H = test.H[np.ix_(rows, rows)]
    without = test.g[gone] @ away + 0.5 * away @ test.H[np.ix_(gone, gone)] @ away
    h = fitter.with_effect(fitter.without(best, out), into)
    h.z = stepped(h.z, predicted_step(H, g), fitter.parameters(h))
    h.H = H
    return float(without) - predicted_gain(H, g), h
