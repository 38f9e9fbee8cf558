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
GENERATIONS, STEPS, LEAPS = (2, 4), 1, (0.5, 1.0, 1.5)
#: Part of the members, the best, from which children leap, two at least, and whose loss tells whether all have arrived.
PARENTS = 1 / 3
#: Share of the children that take the effects of any member, and leave its law.
CROSSED = 0.5
#: Part of its loss that a member has to lose to go on, as have the best in a generation for another one.
GOES_ON = 0.02
#: Prior deviations beyond which no number is moved.
OUTSIDE = 2.5
#: Prior deviations of some number of the law by which members differ that stand in different valleys: a fit goes less
#: far in a step.
DISTINCT = 0.5


def evolved(
    fitter: Fitter,
    field: Sequence[FittedModel],
    stage: Stage,
    size: int,
    rng: np.random.Generator,
    of_each: int | None = None,
) -> list[FittedModel]:
    """Return the best of a population after some generations, best first.

    field : evaluated at the stage.  size : how many live on.  of_each : how many of them with the same effects.
    """
    members = survivors(fitter, field, size, of_each)
    moving = list(members)
    for generation in range(GENERATIONS[1]):
        before = loss_of(members)
        moving = descended(fitter, moving, stage)
        members = survivors(fitter, members, size, of_each)
        born = children(fitter, members, rng)
        fitter.evaluate_all(born, stage)
        moving += descended(fitter, born, stage)
        members = survivors(fitter, [*members, *born], size, of_each)
        moving = [h for h in moving if any(h is m for m in members)]
        if generation + 1 >= GENERATIONS[0] and loss_of(members) > (1 - GOES_ON) * before:
            break
    return members


def parents_of(members: Sequence[FittedModel]) -> int:
    """Return how many of some members, the best, have children."""
    return min(len(members), max(2, round(PARENTS * len(members))))


def loss_of(members: Sequence[FittedModel]) -> float:
    """Return the mean loss of the parents among members, best first."""
    return float(np.mean([h.loss for h in members[: parents_of(members)]]))


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
    """Return as many children as there are members, best first: the law and the releases of one of the best, moved by
    the difference of two others, with its effects or those of any member."""
    shared = fitter.problem.parameters()
    G = len(shared)
    far = OUTSIDE * np.array([p.reach for p in shared])
    least = np.maximum([p.least for p in shared], -far)
    most = np.minimum([p.most for p in shared], far)
    found = []
    for _ in members:
        parent = members[int(rng.integers(parents_of(members)))]
        a, b = rng.choice(len(members), 2, replace=len(members) < 2)
        giver = members[int(rng.integers(len(members)))] if rng.random() < CROSSED else parent
        law = parent.z[:G] + rng.choice(LEAPS) * (members[a].z[:G] - members[b].z[:G])
        found.append(FittedModel(giver.effects, np.concatenate([np.clip(law, least, most), giver.z[G:]])))
    return found


def best(field: Sequence[FittedModel], size: int) -> list[FittedModel]:
    """Return so many of a field with the least loss, best first."""
    return sorted(field, key=lambda h: h.loss)[:size]


def survivors(fitter: Fitter, field: Sequence[FittedModel], size: int, of_each: int | None = None) -> list[FittedModel]:
    """Return so many of a field with the least loss, best first, no more than `of_each` with one set of effects, nor in
    one valley, and each once."""
    most = size if of_each is None else of_each
    found: list[FittedModel] = []
    for h in best(field, len(field)):
        alike = [set(k.effects) == set(h.effects) for k in found]
        near = [is_near(fitter, h, k) for k in found]
        once = not any(a and n for a, n in zip(alike, near, strict=True))
        if once and len(found) < size and sum(alike) < most and sum(near) < most:
            found.append(h)
    return found


def is_near(fitter: Fitter, h: FittedModel, k: FittedModel) -> bool:
    """Return whether two fits stand in one valley, by their laws."""
    law = [i for i, p in enumerate(fitter.problem.parameters()) if p.run is None]
    return bool(np.abs(h.z[law] - k.z[law]).max(initial=0.0) <= DISTINCT)
