"""One vector of an effect, and a problem to which an effect is added."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rockref.model.problem import Problem, State


@dataclass(frozen=True)
class Claim:
    """One vector: an effect with its parameters (SI), the inputs, and expected results with bars.

    resolving : by how many bars the run or the record without the effect is off; branch : what the feet do in each row
    (of a record: how many samples change), and the parameters that are at work
    """

    id: str
    effect: str
    piece: str
    parameters: dict[str, Any]
    inputs: dict[str, Any]
    expect: dict[str, tuple[np.ndarray, np.ndarray]]
    resolving: float
    branch: dict[str, Any]


def with_effect(problem: Problem, effect: Any) -> Problem:
    """Return the problem with an effect of the catalogue: body, points and start changed as it says, and its terms
    added."""
    block, points = effect.points(problem.block, problem.points)
    start = effect.release(block, points, with_new_points(problem.start, points.n))
    return replace(problem, block=block, points=points, start=start, effects=(effect,))


def with_new_points(start: State, n: int) -> State:
    """Return the start of a body that an effect gives points beyond those that it had: n of them, the new ones last.

    The pose stays, and so does what the old points remember: s (..., n, 2), anchored, sliding (..., n). A new point has
    touched nothing yet (T5). The forces of the last evaluation are those of another body, and are made anew.
    """
    more = n - np.shape(start.s)[-2]
    if more == 0:
        return start
    new = State.at_rest(start.x, start.Lambda, more)
    s = np.concatenate([start.s, new.s], axis=-2)
    anchored = np.concatenate([start.anchored, new.anchored], axis=-1)
    sliding = np.concatenate([start.sliding, new.sliding], axis=-1)
    return replace(start, s=s, anchored=anchored, sliding=sliding, a=None, T=None, F=None)
