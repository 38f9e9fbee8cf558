"""Which effects may be missing beside a model."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rockref.effects import catalogue

if TYPE_CHECKING:
    from rockref.discover.fit.problem import FitProblem


def candidates_of(problem: FitProblem, own: Sequence[str] = ()) -> tuple[str, ...]:
    """Return the ids of the effects that may be missing: the catalogue's that act in the model, and the user's own.

    An effect of one point set is no candidate beside another one. own : ids of effects of the user's own.
    """
    kinds = [*catalogue.IN_STEP_ORDER, *map(catalogue.find, own)]
    left = set(problem.carried)
    return tuple(k.id for k in kinds if k.id not in left and may_act(k.id, problem))


def may_act(id: str, problem: FitProblem) -> bool:
    """Return whether an effect can change the motion of the baseline of a problem or its record."""
    from rockref.discover.fit.candidates import LEFT_OUT

    if id == "foot_defects":
        return problem.base.points == "four_points"
    return id not in LEFT_OUT
