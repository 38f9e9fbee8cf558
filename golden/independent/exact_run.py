"""Steps and runs of the law in exact arithmetic, on top of `exact`; and the release posture."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from golden.independent import exact
from golden.independent.exact import Matrix, Number, Point, Touch, Vector


@dataclass(frozen=True)
class Body:
    """A block on its points, as plain numbers: mass, J, g, P (n vectors), made (n `Point`)."""

    mass: Number
    J: Matrix
    g: Number
    P: list[Vector]
    made: list[Point]


@dataclass(frozen=True)
class Moment:
    """A state: pose, velocities, contact memory; a, T, F of the last force evaluation (None before the first)."""

    x: Vector
    v: Vector
    Lambda: Matrix
    W: Vector
    s: list
    anchored: list[bool]
    sliding: list[bool]
    a: Vector | None = None
    T: Vector | None = None
    F: list[Vector] | None = None


def evaluate(body: Body, memory: Moment, x, Lambda, v, W, m) -> tuple[list[Touch], list[Vector], Vector, Vector]:
    """Return all points at one pose with one pair of velocities: touches, forces, acceleration, body moment."""
    touches, levers, forces = [], [], []
    for i, (P, point) in enumerate(zip(body.P, body.made, strict=True)):
        k = exact.kinematics(x, Lambda, v, W, P)
        touch = exact.contact(
            k.xi, k.xi_rate, k.u[:2], k.v_slide, memory.s[i], memory.anchored[i], memory.sliding[i], point, m
        )
        touches.append(touch)
        levers.append(k.r)
        forces.append([touch.F_T[0], touch.F_T[1], touch.F_N])
    force, _, T = exact.resultants(Lambda, levers, forces, body.mass, body.g)
    return touches, forces, [f / body.mass for f in force], T


def started(body: Body, state: Moment, m) -> Moment:
    """Return the state with a, T, F and the contact memory of the first force evaluation, where it has none yet."""
    if state.a is not None:
        return state
    touches, forces, a, T = evaluate(body, state, state.x, state.Lambda, state.v, state.W, m)
    return replace(state, a=a, T=T, F=forces, **_memory(touches))


def _memory(touches: list[Touch]) -> dict[str, Any]:
    return {
        "s": [t.s for t in touches],
        "anchored": [t.touching for t in touches],
        "sliding": [t.sliding for t in touches],
    }


def step(body: Body, state: Moment, h: Number, m) -> Moment:
    """Return one step of length h from a started state."""
    assert state.a is not None and state.T is not None
    half = exact.first_half(state.x, state.v, state.Lambda, state.W, state.a, state.T, h, body.J, m)
    touches, forces, a, T = evaluate(body, state, half.x, half.Lambda, half.v_predicted, half.W_predicted, m)
    v, W = exact.second_half(state.v, state.a, state.T, a, T, h, body.J, half)
    return Moment(half.x, v, half.Lambda, W, a=a, T=T, F=forces, **_memory(touches))


def run(body: Body, state: Moment, h: Number, wanted: list[int], m) -> Iterator[Moment]:
    """Yield the states at the wanted step numbers, in order."""
    state = started(body, state, m)
    done = 0
    for count in wanted:
        for _ in range(done, count):
            state = step(body, state, h, m)
        done = count
        yield state


def release(mass: Number, g: Number, P: list[Vector], K_N: list, theta_0: Number, m) -> tuple[Vector, Matrix]:
    """Return release posture: x and Lambda = exp(-theta_0 X) exp(phi Y), both pivot points bearing half the weight.

    phi by Newton's method on the difference of the two heights; the pivots are the lowest points with x > 0 and x < 0
    at phi = 0.
    """
    zero = theta_0 - theta_0
    tilt = exact.exponential([-theta_0, zero, zero], m)
    pivots = []
    for sign in (1, -1):
        side = [i for i, p in enumerate(P) if p[0] * sign > 0]
        pivots.append(min(side, key=lambda i: exact.dot(tilt[2], P[i])))
    i, j = pivots
    depth = [mass * g / 2 / K for K in K_N]
    phi = zero
    for _ in range(60):
        Lambda = exact.product(tilt, exact.exponential([zero, phi, zero], m))
        gap = exact.dot(Lambda[2], P[i]) - exact.dot(Lambda[2], P[j]) + depth[i] - depth[j]
        # d(Lambda p)/dphi = Lambda (Y x p)
        slope = exact.dot(Lambda[2], exact.cross([zero, zero + 1, zero], [P[i][c] - P[j][c] for c in range(3)]))
        change = gap / slope
        if not change:
            break
        phi = phi - change
    Lambda = exact.product(tilt, exact.exponential([zero, phi, zero], m))
    return [zero, zero, -depth[i] - exact.dot(Lambda[2], P[i])], Lambda
