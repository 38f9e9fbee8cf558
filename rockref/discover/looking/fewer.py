"""A pair less one of its effects, where that explains as much."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rockref.discover import verdict as rules
from rockref.discover.fit.families import Family, gain_between, mean_loss
from rockref.discover.fit.search import Setup, baseline
from rockref.discover.looking.winning import finished


def without(setup: Setup, family: Family, effect: str) -> Family:
    """A pair less the effect that came to nothing, fitted afresh; the pair itself, where that is much worse."""
    single = less(setup, family, effect)
    return single if mean_loss(single) < rules.NO_LOSS * mean_loss(family) else family


def both_needed(setup: Setup, pair: Family, seed: int, say: Callable[[str], None]) -> Family:
    """A pair, or its second effect alone, where the first does not gain beside it what a second has to.

    What is found last may explain what the first had stood in for: evenly softer feet, for a contact that stiffens.
    """
    first, second = pair.effects
    single = less(setup, pair, first)
    gain = gain_between(single, pair)
    say(f"  {first} beside {second}: gain {gain:.0f}")
    return pair if gain > rules.SECOND else finished(setup, single, seed)


def less(setup: Setup, family: Family, effect: str) -> Family:
    """A pair less one of its effects, fitted afresh."""
    left = tuple(e for e in family.effects if e != effect)
    own = [
        zi for p, zi in zip(family.fit.parameters, family.point.z, strict=True) if not p.name.startswith(effect + ".")
    ]
    return Family(left, *baseline(setup, left, np.array(own)))
