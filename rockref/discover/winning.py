"""Who wins a look: it stands against the family without it, and its rivals are fitted as far as it is."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from rockref.discover import verdict as rules
from rockref.discover.beside import side_by_side
from rockref.discover.families import Family, gain_between, refit, size_of, structured
from rockref.discover.looking import PLAIN, POLISH, Look, challenge, ranked
from rockref.discover.plainer import plainer
from rockref.discover.resized import resized
from rockref.discover.search import LITTLE, MISSING, Setup, baseline

#: Share of the winner's gain above which a rival is fitted to its end, too, and most such rivals. Decided: sides that
#: were off under the stated inertia ended at 2010 where a scale factor had 2370, and at 2300 when fitted on.
CONTENDS, CONTENDERS = 0.7, 2


def upheld(look: Look, winner: Family, second: bool, seed: int, say: Callable[[str], None]) -> Family | None:
    """The winner, if it has a size and stands against the narrower family begun where it ended; or who comes next.

    A trifle of one effect may stand in for a whole size of another: then the best of those that have a size is asked.
    second : whether another effect was found before.
    """
    sizes = [f for f in look.order if f is not winner and size_of(f) >= rules.LEAST_SIZE]
    for family in (winner, *sizes[:1]):
        id = family.effects[-1]
        if look.gains[id] < PLAIN:
            challenge(look, family, seed)
            say(f"  {id} against the family begun where it ended: {look.gains[id]:.0f}")
        if rules.is_detected(look.gains[id], size_of(family), second):
            return family
    return None


def finished(setup: Setup, family: Family, seed: int) -> Family:
    """A family fitted as far as it goes, from changed sizes too, less what it has not shown to be there."""
    family = Family(family.effects, family.fit.twin(setup.log), family.point)
    return plainer(resized(setup, refit(family, 3 * POLISH, seed, relative=LITTLE / 5), seed), seed)


def to_the_end(setup: Setup, look: Look, winner: Family, second: bool, seed: int, say: Callable[[str], None]) -> Family:
    """The winner and its nearest rivals fitted as far as they go; the best of them that is an effect. Gains are mended.

    A fit that stops in a side valley is left some hundred units behind, which is more than what tells effects apart.
    Where most windows contradict the winner another effect is missing, and its rivals stay where they are.
    """

    least = CONTENDS * look.gains[winner.effects[-1]]
    rivals = [f for f in look.order if f.effects != winner.effects and look.gains[f.effects[-1]] > least]
    if structured(winner) > MISSING:
        rivals = []
    ended = ranked(look.kept, side_by_side(setup, partial(finished, seed=seed), [winner, *rivals[:CONTENDERS]]), say)
    look.gains |= {id: max(gain, look.gains[id]) for id, gain in ended.gains.items()}
    left = [f for f in look.order if f.effects[-1] not in ended.gains]
    look.order = sorted([*ended.order, *left], key=lambda f: -look.gains[f.effects[-1]])
    effects = [f for f in ended.order if rules.is_detected(look.gains[f.effects[-1]], size_of(f), second)]
    return next(iter(effects), ended.order[0])


def exchanged(setup: Setup, look: Look, pair: Family, seed: int, say: Callable[[str], None]) -> Family:
    """The pair, or one in which a near rival of its first effect stands in that one's place, if that fits better.

    The first effect won its look while the second was still missing. Where both fit alike the one with fewer parameters
    is taken: what is more flexible can nearly always follow (four numbers of `dimension_deviation` the three of
    `gyro_scale`, 5 of 3970 units ahead), and what it follows cannot follow it.
    """
    first, second = pair.effects
    least = rules.RIVAL * look.gains.get(first, np.inf)
    rivals = [f for f in look.order if f.effects[-1] not in pair.effects and look.gains[f.effects[-1]] > least]
    mine = [p.name.startswith(second + ".") for p in pair.fit.parameters]

    def fitted(own: Setup, rival: Family) -> Family:
        effects = (*rival.effects, second)
        begun = Family(effects, *baseline(own, effects, np.concatenate([rival.point.z, pair.point.z[mine]])))
        return refit(begun, 3 * POLISH, seed, relative=LITTLE / 5)

    best, ahead = pair, 0.0
    for other in side_by_side(setup, fitted, rivals[:CONTENDERS]):
        gain = gain_between(pair, other)
        fewer = len(other.fit.parameters) < len(best.fit.parameters)
        say(f"  {' + '.join(other.effects)} in the place of {' + '.join(pair.effects)}: gain {gain:.0f}")
        if gain > ahead + (-rules.CLOSE if fewer else rules.CLOSE):
            best, ahead = other, gain
    return best
