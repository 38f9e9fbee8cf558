"""A pair less one of its effects, where that explains as much."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rockref.discover import verdict as rules
from rockref.discover.fit.families import Family, gain_between, mean_loss
from rockref.discover.fit.search import Setup, baseline
from rockref.discover.looking.winning import finished, polished


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


def first_alone(setup: Setup, pair: Family, seed: int) -> Family:
    """The first effect of a pair, begun where the pair ended."""
    fit = setup.fit(pair.fit.series.twin(), pair.effects[:1])
    point, _ = fit.point(pair.point.z[: len(fit.parameters)], pair.point.corrections)
    return polished(setup, Family(pair.effects[:1], fit, point), seed)


def less(setup: Setup, family: Family, effect: str) -> Family:
    """A pair less one of its effects, fitted afresh."""
    left = tuple(e for e in family.effects if e != effect)
    own = [
        zi for p, zi in zip(family.fit.parameters, family.point.z, strict=True) if not p.name.startswith(effect + ".")
    ]
    return Family(left, *baseline(setup, left, np.array(own)))
