"""A pair less one of its effects, or one other effect in the place of both, where that explains as much."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rockref.discover import window_rules as rules
from rockref.discover.fit.families import (
    Family,
    gain_between,
    mean_loss,
    refit_all,
    room,
    size_of,
    structured,
)
from rockref.discover.fit.search import Setup, baseline
from rockref.discover.looking.far import cut_back, first_steps
from rockref.discover.looking.look import ITERATIONS, REFITTED, Look, candidates_beside
from rockref.discover.looking.winning import exchanged, finished, polished


def needed(setup: Setup, pair: Family, looks: list[Look], seed: int, say: Callable[[str], None]) -> Family:
    """A pair less what came to nothing, or does not gain beside the other what a second effect has to."""
    if needless := [e for e in pair.effects if size_of(pair, e) < rules.LEAST_SIZE]:
        rest = without(setup, pair, needless[0])
        say(f"  without {needless[0]}: structured {structured(rest):.3f}, room {room(rest):.0f}")
        return rest
    if looks and looks[-1].kept.effects == pair.effects[:1]:
        return both_needed(setup, pair, seed, say)
    return pair


def stood_in_for(setup: Setup, looks: list[Look], pair: Family, seed: int, say: Callable[[str], None]) -> Family:
    """A pair, one effect that explains as much as both, or a pair with another first effect, which fits better.

    looks : of which the first is on top of the plain baseline; one effect in the place of both is a look of its own.
    """
    alone = one_for_both(setup, looks[0], pair, seed, say)
    if alone is None:
        return exchanged(setup, looks[0], pair, seed, say)
    looks.append(alone)
    return alone.order[0]


def without(setup: Setup, family: Family, effect: str) -> Family:
    """A pair less the effect that came to nothing, fitted afresh; the pair itself, where that is much worse."""
    single = less(setup, family, effect)
    return single if mean_loss(single) < rules.NO_LOSS * mean_loss(family) else family


def both_needed(setup: Setup, pair: Family, seed: int, say: Callable[[str], None]) -> Family:
    """A pair, or one of its effects alone, where the other does not gain beside it what a second has to.

    Without the second, the first begins where the pair ended: what leads out of the side valley where the first had
    stopped need not be there (sides, feet and a centre of mass did so alike, where a gyroscope clipped). Without the
    first, the second is fitted afresh: what is found last may explain what the first had stood in for (evenly softer
    feet, for a contact that stiffens).
    """
    first, second = pair.effects
    for needed in (second, first):
        rest = first_alone(setup, pair, seed) if needed == second else less(setup, pair, first)
        gain = gain_between(rest, pair)
        say(f"  {needed} beside {rest.effects[0]}: gain {gain:.0f}")
        if gain <= rules.SECOND:
            return finished(setup, rest, seed)
    return pair


def one_for_both(setup: Setup, look: Look, pair: Family, seed: int, say: Callable[[str], None]) -> Look | None:
    """The look, with one effect at its head that explains as much as the two of the pair, begun where they ended.

    look : the one on top of the plain baseline in which the first of the two was found. An effect that was tried there
    may have ended in a side valley: an inertia came first where the centre of mass was off, and what it left looked
    like a tilt of the plate. Where the two had ended, both taken out, an eccentric mass was 14 units behind them in
    four iterations, and 37 ahead at its end. None where no single effect that has a size comes within CLOSE of them.
    """
    offered = [kind for kind in candidates_beside(setup, look.kept.effects) if kind.id not in pair.effects]
    begun = first_steps(setup, offered, cut_back(setup, pair, look.kept.effects))[:REFITTED]
    raced = refit_all(setup, begun, ITERATIONS, seed)
    best = max(raced, key=lambda f: gain_between(pair, f), default=None)
    if best is None or gain_between(pair, best) < -rules.UNFINISHED:
        return None
    best = finished(setup, best, seed)
    gain = gain_between(pair, best)
    say(f"  {best.effects[-1]} in the place of {' + '.join(pair.effects)}: gain {gain:.0f}")
    if gain < -rules.CLOSE or size_of(best) < rules.LEAST_SIZE:
        return None
    id = best.effects[-1]
    others = [f for f in look.order if f.effects != best.effects]
    return Look(look.kept, [best, *others], look.gains | {id: gain_between(look.kept, best)}, in_full=True)


def first_alone(setup: Setup, pair: Family, seed: int) -> Family:
    """The first effect of a pair, begun where the pair ended."""
    return polished(setup, cut_back(setup, pair, pair.effects[:1]), seed)


def less(setup: Setup, family: Family, effect: str) -> Family:
    """A pair less one of its effects, fitted afresh."""
    left = tuple(e for e in family.effects if e != effect)
    own = [
        zi for p, zi in zip(family.fit.parameters, family.point.z, strict=True) if not p.name.startswith(effect + ".")
    ]
    return Family(left, *baseline(setup, left, np.array(own)))
