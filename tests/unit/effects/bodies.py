"""Small bodies on which one effect at a time has a closed form, and a walk through their steps."""

from __future__ import annotations

import numpy as np

from rockref.model.contact import Kinematics
from rockref.model.integrator import Contact, first_evaluation, prepared_inertia, step
from rockref.model.problem import Block, ContactPoints, Problem, State, as_arrays

H = 1e-5


def points_at(P, K_N=1e6, K_T=1e6, C_N=0.0, C_T=0.0, mu=0.0, radius=None, names=None) -> ContactPoints:
    """Contact points, all of the same make."""
    P = np.array(P, float)
    n = len(P)
    names = names or tuple(f"{i}ext" for i in range(1, n + 1))
    full = [np.full(n, float(a)) for a in (K_N, K_T, C_N, C_T, mu, mu)]
    return ContactPoints(P, *full, None if radius is None else np.full(n, float(radius)), names)


def body(
    points, effects=(), mass=1.0, J=(1.0, 1.0, 1.0), g=9.81, x=(0, 0, 0), v=(0, 0, 0), W=(0, 0, 0), h=H, Lambda=None
):
    """A problem with one rigid body; times are set by the walk."""
    start = State.at_rest(
        np.array(x, float), np.eye(3) if Lambda is None else Lambda, points.n, np.array(v, float), np.array(W, float)
    )
    block = Block(np.array(float(mass)), np.diag(np.array(J, float)), np.array(float(g)))
    return as_arrays(Problem(block, points, start, h, 1.0, 1 / h, tuple(effects)))


def ball(effects=(), **kwargs):
    """A mass point that can only bounce: one contact point below the centre of mass."""
    made = {key: kwargs.pop(key) for key in ("K_N", "K_T", "C_N", "C_T", "mu", "radius") if key in kwargs}
    return body(points_at([(0, 0, -1e-3)], **made), effects, **kwargs)


def puck(effects=(), **kwargs):
    """A flat body on four feet, so heavy to turn that it only slides."""
    made = {key: kwargs.pop(key) for key in ("K_N", "K_T", "C_N", "C_T", "mu") if key in kwargs}
    corners = [(0.1, 0.1, -1e-6), (-0.1, 0.1, -1e-6), (-0.1, -0.1, -1e-6), (0.1, -0.1, -1e-6)]
    settings = {"J": (1e3, 1e3, 1e3)} | kwargs
    mass, g = settings.get("mass", 1.0), settings.get("g", 9.81)
    sink = mass * g / 4 / made.get("K_N", 1e6)
    return body(points_at(corners, **made), effects, **({"x": (0, 0, 1e-6 - sink)} | settings))


def walk(problem: Problem, steps: int):
    """The states, one after another, from the start."""
    state = first_evaluation(problem)
    inertia = prepared_inertia(problem.block)
    yield state
    for _ in range(steps):
        state = step(problem, state, inertia)
        yield state


def last(problem: Problem, steps: int) -> State:
    """The state after so many steps."""
    *_, state = walk(problem, steps)
    return state


def contact(xi, r=0.0, xi_rate=0.0, v_slide=0.0, F_N=0.0, turn=(0.0, 0.0, 0.0), t=0.0, dtype=float) -> Contact:
    """Points that do what is stated: they touch where xi (..., n) is not negative, and carry F_N alone."""
    xi = np.asarray(xi, dtype)

    def full(a, *core):
        return np.array(np.broadcast_to(a, xi.shape + core), dtype)

    F = full(0.0, 3)
    F[..., 2] = F_N
    k = Kinematics(full(r, 3), full(r, 3), full(0.0, 3), xi, full(xi_rate), full(v_slide, 2))
    touching = xi >= 0
    return Contact(t, k, touching, np.zeros_like(touching), full(0.0, 2), full(F_N), F, np.asarray(turn, dtype))


#: A rotation without a zero: by the angles of the 3-4-5 triangle about x, then about z.
TURNED = np.array([[0.8, -0.6, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, 1.0]]) @ np.array(
    [[1.0, 0.0, 0.0], [0.0, 0.8, -0.6], [0.0, 0.6, 0.8]]
)
