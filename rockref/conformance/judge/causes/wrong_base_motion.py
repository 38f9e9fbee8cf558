"""Mistakes with a plate that moves (B1): each is a load that stands in for the right one.

The right load is -m a(t) at the centre of mass. A mistake gives force and moment of its own, from the record, the time
and the pose; the run has no base motion beside it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.effects.base import Effect
from rockref.model.base_motion import BaseMotion, plate_acceleration
from rockref.model.problem import Problem
from rockref.model.rotation import apply, cross

#: Force and moment (3), (3) of a record at a time for a block with this pose.
Load = Callable[[BaseMotion, float, Problem, Any], tuple[Any, Any]]


@dataclass(frozen=True)
class BaseMistake:
    """One mistake: name, one line, and the load that it makes."""

    id: str
    says: str
    load: Load


class Shaken(Effect):
    """A load that stands in for B1, as an effect of a run without base motion."""

    id = "base_mistake"

    def __init__(self, load: Load, base: BaseMotion) -> None:
        """Hold the load and the record."""
        object.__setattr__(self, "load", load)
        object.__setattr__(self, "base", base)

    def is_absent(self) -> bool:
        """Return False: the load always acts."""
        return False

    def body_wrench(self, problem: Any, c: Any, x: Any, Lambda: Any, v: Any, W: Any, m: Any) -> Any:
        """Return force [N] and moment [N m]."""
        return self.load(self.base, c.t, problem, Lambda)  # type: ignore[attr-defined]


def planted(problem: Problem, load: Load) -> Problem:
    """Return the problem with this load in the place of its base motion."""
    assert problem.base is not None
    return problem.replace(base=None, effects=(Shaken(load, problem.base),))


def _of(acceleration: Callable[[BaseMotion, float], Any]) -> Load:
    """Return a load at the centre of mass, from an acceleration of its own."""

    def load(base: BaseMotion, t: float, problem: Problem, Lambda: Any) -> tuple[Any, Any]:
        F = -problem.block.mass[..., None] * acceleration(base, t)
        return F, 0 * F

    return load


def _changed(matrix: Any) -> Load:
    """Return the right acceleration, times a matrix or a number."""
    M = np.asarray(matrix, float) * (np.eye(3) if np.ndim(matrix) == 0 else 1.0)
    return _of(lambda base, t: np.sum(M * plate_acceleration(base, t), axis=-1))


def _held(base: BaseMotion, t: float) -> Any:
    k = math.floor((t - base.t_0) / base.dt)
    return base.a[k] if 0 <= k < len(base.a) else np.zeros(3)


def _held_after(base: BaseMotion, t: float) -> Any:
    return base.a[-1] if t > base.end else plate_acceleration(base, t)


def _wrapped(base: BaseMotion, t: float) -> Any:
    return plate_acceleration(base, base.t_0 + (t - base.t_0) % (base.end - base.t_0))


def _from_release(base: BaseMotion, t: float, problem: Problem, Lambda: Any) -> tuple[Any, Any]:
    return _of(lambda b, at: plate_acceleration(b, at - problem.start.t + b.t_0))(base, t, problem, Lambda)


def _one_step_early(base: BaseMotion, t: float, problem: Problem, Lambda: Any) -> tuple[Any, Any]:
    return _of(lambda b, at: plate_acceleration(b, at - problem.step))(base, t, problem, Lambda)


def _in_body_axes(base: BaseMotion, t: float, problem: Problem, Lambda: Any) -> tuple[Any, Any]:
    F = -problem.block.mass[..., None] * apply(Lambda, plate_acceleration(base, t))
    return F, 0 * F


def _at_the_middle(base: BaseMotion, t: float, problem: Problem, Lambda: Any) -> tuple[Any, Any]:
    F, _ = _of(plate_acceleration)(base, t, problem, Lambda)
    P = problem.points.P
    middle = (np.max(P, axis=-2) + np.min(P, axis=-2)) / 2 * np.array([1.0, 1.0, 0.0])
    return F, cross(apply(Lambda, middle), F)


_C, _S = math.cos(math.radians(60)), math.sin(math.radians(60))

#: The mistakes. Scaled twice: a record that was halved; turned back: one that was turned by 30 degrees.
OF_BASE = (
    BaseMistake("ZB1", "cm/s2 read as m/s2", _changed(100.0)),
    BaseMistake("ZB2", "parts of g read as m/s2", _changed(1 / 9.81)),
    BaseMistake("ZB3", "the sign", _changed(-1.0)),
    BaseMistake("ZB4", "each sample held until the next", _of(_held)),
    BaseMistake("ZB5", "a sample late", _of(lambda base, t: plate_acceleration(base, t - base.dt))),
    BaseMistake("ZB6", "a(t) of the step's begin", _one_step_early),
    BaseMistake("ZB7", "the force in body axes", _in_body_axes),
    BaseMistake("ZB8", "the force at the middle of the feet's sides", _at_the_middle),
    BaseMistake("ZB9", "the vertical part dropped", _changed(np.diag([1.0, 1.0, 0.0]))),
    BaseMistake("ZB10", "the vertical part added to g with the wrong sign", _changed(np.diag([1.0, 1.0, -1.0]))),
    BaseMistake("ZB11", "scaled twice", _changed(0.5)),
    BaseMistake("ZB12", "the record begins anew at its end", _of(_wrapped)),
    BaseMistake("ZB13", "the last sample held after the end", _of(_held_after)),
    BaseMistake("ZB14", "started with the run, not at t_0", _from_release),
    BaseMistake("ZB15", "x and y exchanged", _changed([[0.0, 1, 0], [1, 0, 0], [0, 0, 1]])),
    BaseMistake("ZB16", "the mean removed", _of(lambda base, t: plate_acceleration(base, t) - base.a.mean(axis=0))),
    BaseMistake("ZB17", "turned by -30 degrees for 30", _changed([[_C, _S, 0], [-_S, _C, 0], [0, 0, 1.0]])),
)
