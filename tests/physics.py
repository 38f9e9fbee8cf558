"""Small problems with known answers, for the tests."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.model.problem import Block, ContactPoints, Problem, State

#: The block of the source: 54 kg, 0.1 x 0.1 x 0.688 m (rule G1).
MASS, J_MAIN, J_LONG = 54.0, 2.175048, 0.09


def block(mass: float = MASS, inertia=(J_MAIN, J_MAIN, J_LONG), g: float = 9.81) -> Block:
    inertia = np.asarray(inertia, float)
    return Block(np.array(mass), np.diag(inertia) if inertia.ndim == 1 else inertia, np.array(g))


def points(P, K_N=6e7, K_T=5e7, C_N=2e4, C_T=1.8e4, mu_0=0.25, mu=None, radius=None) -> ContactPoints:
    P = np.asarray(P, float).reshape(-1, 3)
    n = len(P)
    mu = mu_0 if mu is None else mu
    same = [np.full(n, np.asarray(value, float)) for value in (K_N, K_T, C_N, C_T, mu_0, mu)]
    return ContactPoints(P, *same, None if radius is None else np.full(n, float(radius)), tuple(map(str, range(n))))


def mass_on_a_foot(
    z=0.0, v=(0.0, 0.0, 0.0), mass=MASS, g=9.81, step=1e-5, duration=0.01, effects=(), **foot
) -> Problem:
    """A body whose only foot is its centre of mass: it never turns, so closed forms of a point mass hold."""
    start = State.at_rest(np.array([0.0, 0.0, z]), np.eye(3), 1, v=np.array(v, float))
    return Problem(block(mass, g=g), points([0, 0, 0], **foot), start, step, duration, 1 / step, tuple(effects))


def resting(mass=MASS, g=9.81, K_N=6e7) -> float:
    """Height at which the foot carries the weight [m]."""
    return -mass * g / K_N


def flying(inertia, W, step, duration, output_rate=None, x=(0, 0, 1.0), v=(0, 0, 0), g=9.81, Lambda=None) -> Problem:
    """A body without contact points."""
    Lambda = np.eye(3) if Lambda is None else Lambda
    start = State.at_rest(np.array(x, float), Lambda, 0, v=np.array(v, float), W=np.array(W, float))
    no_points = points(np.zeros((0, 3)))
    return Problem(block(inertia=inertia, g=g), no_points, start, step, duration, output_rate or 1 / step)


@dataclass(frozen=True)
class Pull(Effect):
    """A horizontal force on the body: constant [N] (an incline), and a spring [N/m] with its end moving [m/s]."""

    force: float = 0.0
    stiffness: float = 0.0
    speed: float = 0.0

    id: ClassVar[str] = "test_pull"
    quantities: ClassVar[dict[str, Quantity]] = {
        name: Quantity("", 0.0, -1e6, 1e6, 1.0) for name in ("force", "stiffness", "speed")
    }

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        force = np.zeros_like(x)
        force[..., 0] = self.force + self.stiffness * (self.speed * c.t - x[..., 0])
        return force, np.zeros_like(x)
