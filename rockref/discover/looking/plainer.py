"""What a fit has not shown to be there is taken out of it again: numbers of an effect that are typically none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rockref.discover import window_rules as rules
from rockref.discover.fit.families import Family
from rockref.discover.fit.search import LITTLE
from rockref.discover.hypotheses.candidates import OF_EACH_FOOT, SELDOM

#: Prior standard deviation that holds a number at none, and iterations of everything else around it.
HELD, ITERATIONS = 1e-3, 6


def plainer(family: Family, seed: int) -> Family:
    """The family without those of its numbers that are typically none, unless they gain as much as an effect has to.

    Left free they take up what is no part of them: two drags that are a moment alone were found with forces at the
    centre of 1.1 and 1.6 N s2/m2 as well, with intervals that did not hold none.
    """
    fit, point = family.fit, family.point
    typically_none = OF_EACH_FOOT | SELDOM
    idle = [i for i, p in enumerate(fit.parameters) if tuple(p.name.split(".")) in typically_none and point.z[i] != 0]
    if not idle:
        return family
    z = point.z.copy()
    z[idle] = 0
    held = replace(
        fit, parameters=tuple(replace(p, prior=HELD) if i in idle else p for i, p in enumerate(fit.parameters))
    )
    found = held.run(held.point(z, point.corrections)[0], ITERATIONS, np.random.default_rng(seed), relative=LITTLE / 5)
    z = found.z.copy()
    z[idle] = 0
    without = fit.point(z, found.corrections)[0]
    return Family(family.effects, fit, without) if without.objective < point.objective + rules.DETECTED else family
