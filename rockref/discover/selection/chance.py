"""What an effect gains by chance: in records that the model without it makes.

Where impacts amplify the noise of the record that a run follows, no model leaves white innovations, and one more effect
finds something to gain that is not its own. By how much is found by simulation: the optimism of a likelihood, after
M. Ishiguro, Y. Sakamoto, G. Kitagawa (1997), Bootstrapping log likelihood and EIC, an extension of AIC, Ann. Inst.
Statist. Math. 49:411-434, doi:10.1023/A:1003158526504.
"""

from __future__ import annotations

from collections.abc import Sequence

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.floor import RECORDS, in_own_record
from rockref.discover.fit.stages import S3, F
from rockref.discover.selection.finalists import CONVERGED
from rockref.discover.selection.score_test import proposals, score_test

#: Share of the objective up to which a gain may be one by chance, and is asked for (decided: five times what chance
#: gained on a tall, stiff block of little damping).
ASKED = 0.05
#: Steps at S3, as in the search.
STEPS = 3
#: Records that are asked at most, and what chance gains in the first ones [nat] from which more are; decided: an effect
#: that is not there gains more than in seven records once in eight, and by numbers alone, in white noise, 1 to 8 nats.
MOST, CALM = 7, 10.0


def gained_by_chance(fitter: Fitter, fits: Sequence[FittedModel], best: FittedModel) -> float:
    """Return what the weakest effect of a set gains by chance [nat], the most in several records; 0 where its gain is
    too large for that, or the set without it is not among the fits.

    The most, since gains by chance have a long tail: on one stiff block -2, 31, 115, 124, 208 and 479 nats. No more
    records are asked once chance has gained as much as the effect.
    """
    less = weaker(fits, best, fitter.problem.carried)
    if less is None or not 0.0 < less.objective - best.objective <= ASKED * less.objective:
        return 0.0
    (effect,) = set(best.effects) - set(less.effects)
    largest = 0.0
    for seed in range(MOST):
        if largest >= less.objective - best.objective or (seed >= RECORDS and largest < CALM):
            break
        largest = max(largest, gain_in_own_record(fitter, less, effect, seed))
    return largest


def weaker(fits: Sequence[FittedModel], best: FittedModel, carried: Sequence[str]) -> FittedModel | None:
    """Return the best of the fits without one effect of a set, None where there is none."""
    sets = [frozenset(best.effects) - {e} for e in best.effects if e not in carried]
    return min((h for h in fits if frozenset(h.effects) in sets), key=lambda h: h.objective, default=None)


def gain_in_own_record(fitter: Fitter, h: FittedModel, effect: str, seed: int) -> float:
    """Return what an effect gains over a model in a record of the model, both fitted as in a search [nat].

    The model is fitted from the law beside the effect, too: a fit that stopped early would count as a gain.
    """
    own, start = in_own_record(fitter, h, F, seed)
    again = own.refine(start.copy(), S3, STEPS)
    field = [start, again]
    own.evaluate_all(field, F)
    alone = own.polish(min(field, key=lambda k: k.objective), F, CONVERGED)
    at = own.evaluate(alone.copy(), S3)
    more = proposals(own, at, S3, 1, score_test(own, at, S3, [effect]))
    for k in more:
        own.refine(k, S3, STEPS)
    with_it = own.polish(min(more, key=lambda k: k.objective), F, CONVERGED)
    again = own.polish(own.without(with_it, effect), F, CONVERGED)
    return min(alone.objective, again.objective) - with_it.objective
