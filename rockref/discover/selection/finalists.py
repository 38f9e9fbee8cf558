"""Fits at the longest memory, followed side by side until the best stand at the bottom of their valleys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.stages import F
from rockref.discover.selection.halving import WORTH
from rockref.discover.selection.score_test import best_of_each

#: Steps that a fit may take (decided: fits end by gaining nothing long before that).
CONVERGED = 8
#: Finalists, and the factor on the best objective up to which one is (decided: what is further above has no
#: probability).
FINALISTS, CLOSE = 4, 1.02
#: Times that they are compared from the law of the best (decided: twice, should the best change).
EXCHANGES = 2


def added_effects(fitter: Fitter, h: FittedModel) -> list[str]:
    """Return the effects of a model beyond those that the user's model carries."""
    return [e for e in h.effects if e not in fitter.problem.carried]


def penalised(fitter: Fitter, h: FittedModel) -> float:
    """Return the objective and what its effects have to gain [nat]: those beside the first more."""
    added = len(added_effects(fitter, h))
    return h.objective + WORTH * added + fitter.problem.companion * max(added - 1, 0)


def lowest(fitter: Fitter, field: Sequence[FittedModel]) -> FittedModel:
    """Return the best of a field, less what its effects have to gain."""
    return min(field, key=lambda h: penalised(fitter, h))


def follow(fitter: Fitter, field: Sequence[FittedModel], beam: Sequence[FittedModel], most: int = CONVERGED) -> None:
    """Let fits take steps as long as they gain; one stops that at the pace of the field does not come near the best of
    a beam.

    The pace is what the step of any of them gained: a fit gains least just before it turns into its valley. Near is
    what an effect has to gain: what stays farther away has no say in the evidence.
    """
    going = list(field)
    if going:
        fitter.evaluate_all(going, F)
    for left in range(most - 1, -1, -1):
        before = [h.objective for h in going]
        moving = [h for h in going if fitter.polished(h, F)]
        pace = max((b - h.objective for b, h in zip(before, going, strict=True)), default=0.0)
        near = penalised(fitter, lowest(fitter, beam)) + WORTH + left * pace
        going = [h for h in moving if penalised(fitter, h) <= near]
    for h in field:
        fitter.problem.say(f"followed {h.name} {h.objective:.0f} ({h.loss:.2f})")
        fitter.problem.refined(h, F)


def converged(fitter: Fitter, beam: list[FittedModel]) -> list[FittedModel]:
    """Return a beam, best first: the finalists, and the best without some of its effects, fitted until no step gains,
    and again from the law and the releases of the best of them.

    A fit that stops early, or in a local minimum, lies hundreds of nats too high; a common start compares effects.
    """
    limit = CLOSE * min(h.objective for h in beam)
    close = sorted((h for h in beam if h.objective <= limit), key=lambda h: penalised(fitter, h))
    finalists = close[:FINALISTS] + [h for h in close[FINALISTS:] if set(h.effects) < set(close[0].effects)]
    follow(fitter, finalists, beam)
    for _ in range(EXCHANGES):
        best = lowest(fitter, beam)
        others = [beside(fitter, best, h) for h in finalists if not holds(h, best)]
        beam += others
        follow(fitter, others, beam)
        if set(lowest(fitter, beam).effects) == set(best.effects):
            break
    return sorted(best_of_each(beam), key=lambda h: h.objective)


def remember(known: dict[frozenset[str], FittedModel], field: Sequence[FittedModel]) -> None:
    """Keep the best fit at F of each set of effects."""
    for h in field:
        there = known.get(frozenset(h.effects))
        if there is None or h.objective < there.objective:
            known[frozenset(h.effects)] = h


def holds(h: FittedModel, best: FittedModel) -> bool:
    """Return whether h has all effects of the best, and is as low: from the same law it ends where it is."""
    return set(best.effects) <= set(h.effects) and h.objective <= best.objective


def beside(fitter: Fitter, best: FittedModel, h: FittedModel) -> FittedModel:
    """Return a hypothesis with the law, the releases and the shared effects of another one."""
    known = {p.name: z for p, z in zip(fitter.parameters(best), best.z, strict=True)}
    z = [known.get(p.name, own) for p, own in zip(fitter.parameters(h), h.z, strict=True)]
    return replace(h, z=np.array(z))
