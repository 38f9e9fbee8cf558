"""A population of fits that learns from itself: differences between its members lead along the ridges of the problem.

Differential evolution (R. Storn, K. Price 1997, J. Glob. Optim. 11:341-359, doi:10.1023/A:1008202821328) whose members
descend: each child takes Gauss-Newton steps before it competes, so it does not matter that a leap leaves the valley.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.stages import Stage

#: Generations at least and at most, the steps of a member in each, and the factors on the difference of two members by
#: which a child leaps (decided on simulated blocks of other feet, as the numbers below).
GENERATIONS, STEPS, LEAPS = (2, 4), 2, (0.5, 1.0, 1.5)
#: Part of the members, the best, from which children leap, two at least.
PARENTS = 1 / 3
#: Part of its loss that a member has to lose to go on, as have all in a generation for another one.
GOES_ON = 0.02
#: Prior deviations beyond which no number is moved.
OUTSIDE = 2.5
#: Prior deviations of some number of the law by which members differ that stand in different valleys: a fit goes less
#: far in a step.
DISTINCT = 0.5


def evolved(
    fitter: Fitter, field: Sequence[FittedModel], stage: Stage, size: int, rng: np.random.Generator
) -> list[FittedModel]:
    """Return the best of a population of one hypothesis after some generations, best first.

    field : evaluated at the stage.  size : how many live on.
    """
    members = best(field, size)
    moving = list(members)
    for generation in range(GENERATIONS[1]):
        before = members[0].loss
        moving = descended(fitter, moving, stage)
        born = children(fitter, best(members, size), rng)
        fitter.evaluate_all(born, stage)
        moving += descended(fitter, born, stage)
        members = best([*members, *born], size)
        moving = [h for h in moving if any(h is m for m in members)]
        if generation + 1 >= GENERATIONS[0] and members[0].loss > (1 - GOES_ON) * before:
            break
    return members


def descended(fitter: Fitter, field: Sequence[FittedModel], stage: Stage) -> list[FittedModel]:
    """Let members take their steps; return those that have not arrived."""
    found = []
    for h in field:
        before = h.loss
        fitter.tempered(h, stage, STEPS)
        if h.loss < (1 - GOES_ON) * before:
            found.append(h)
    return found


def children(fitter: Fitter, members: Sequence[FittedModel], rng: np.random.Generator) -> list[FittedModel]:
    """Return as many children as there are members: one of the best each, moved by the difference of two others."""
    parameters = fitter.parameters(members[0])
    far = OUTSIDE * np.array([p.reach for p in parameters])
    least = np.maximum([p.least for p in parameters], -far)
    most = np.minimum([p.most for p in parameters], far)
    parents = min(len(members), max(2, round(PARENTS * len(members))))
    found = []
    for _ in members:
        parent = members[int(rng.integers(parents))]
        a, b = rng.choice(len(members), 2, replace=len(members) < 2)
        z = parent.z + rng.choice(LEAPS) * (members[a].z - members[b].z)
        found.append(FittedModel(parent.effects, np.clip(z, least, most)))
    return found


def best(field: Sequence[FittedModel], size: int) -> list[FittedModel]:
    """Return so many of a field with the least loss, best first."""
    return sorted(field, key=lambda h: h.loss)[:size]


def distinct(fitter: Fitter, field: Sequence[FittedModel]) -> list[FittedModel]:
    """Return those of a field whose law is not that of a better one, best first."""
    law = [k for k, p in enumerate(fitter.parameters(field[0])) if p.run is None and not p.effect]
    found: list[FittedModel] = []
    for h in best(field, len(field)):
        if all(np.abs(h.z[law] - k.z[law]).max(initial=0.0) > DISTINCT for k in found):
            found.append(h)
    return found
