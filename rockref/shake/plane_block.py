"""A block that rocks in a plane on a shaken floor: Housner's block under a recorded motion, with two unlike edges.

The block is rigid, does not slide and does not bounce; an impact takes it from one edge to the other. Source of the
equation: Zhang and Makris, Journal of Engineering Mechanics 127 (2001), doi 10.1061/(ASCE)0733-9399(2001)127:5(473);
of the edges that differ: the conservation of the angular momentum about the new edge, as in Housner (1963).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from types import FunctionType
from typing import Any

import numpy as np

from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError

#: decided: 45 degrees, where a response of the 3-D block counts as overturned too.
FALLEN = 0.25 * math.pi
#: decided: a block that leaves an impact slower than this comes to a tilt of less than 1e-6 rad: it rests.
REST_RATE = 1e-3
#: decided: the longest step of the integration, 1/200 of the shortest time 1/p of a block of 10 cm.
STEP = 5e-4


@dataclass(frozen=True)
class PlaneBlock:
    """What decides how a block rocks in a plane; index 0: about the edge on the side of +x, 1: about the other.

    alpha : angles between the vertical and the line from edge to centre of mass [rad]
    p : frequency parameters sqrt(m g R/I_O) about each edge [rad/s]
    e : ratio of rates after and before an impact *onto* that edge
    """

    alpha: tuple[float, float]
    p: tuple[float, float]
    e: tuple[float, float]


def plane_block(
    height: float, reach: tuple[float, float], gyration: float, g: float = 9.81, restitution: float = 1.0
) -> PlaneBlock:
    """Return the block whose centre of mass stands `height` above the floor, `reach` from its edges at +x and -x [m].

    gyration : radius of gyration about the centre, normal to the plane [m]
    restitution : factor on the ratio of rates of an impact that keeps the angular momentum about the new edge

    Raises InputError E-RANGE.
    """
    if min(height, *reach, gyration) <= 0.0 or not 0.0 <= restitution <= 1.0:
        cure = "Give positive lengths and a restitution from 0 to 1."
        raise InputError("E-RANGE", "plane block", f"{height=}, {reach=}, {gyration=}, {restitution=}", cure)
    alpha = [math.atan2(b, height) for b in reach]
    p = [math.sqrt(g * math.hypot(b, height) / (gyration**2 + b**2 + height**2)) for b in reach]
    # From the centre to the old edge and to the new one: height^2 - b b' is the product of the two levers.
    kept = gyration**2 + height**2 - reach[0] * reach[1]
    e = [restitution * max(0.0, kept) / (gyration**2 + b**2 + height**2) for b in reach]
    return PlaneBlock((alpha[0], alpha[1]), (p[0], p[1]), (e[0], e[1]))


@dataclass(frozen=True)
class PlaneOutcome:
    """fell : whether |tilt| reached `FALLEN`;  largest_tilt [rad];  impacts : how many."""

    fell: bool
    largest_tilt: float
    impacts: int


def rock(
    base: BaseMotion, block: PlaneBlock, g: float = 9.81, linear: bool = False, step: float = STEP
) -> PlaneOutcome:
    """Return how a block at rest comes through the motion along x and the quiet after it.

    linear : take small angles, sin x = x and cos x = 1, in the equation and in the condition of uplift

    The integration is RK4 on equal parts of the record's interval, at most `step` long [s].
    """
    outcome = rock_many(base, np.array([[*block.alpha, *block.p, *block.e]]), g, linear, step)[0]
    return PlaneOutcome(bool(outcome[0]), float(outcome[1]), int(outcome[2]))


def rock_many(base: BaseMotion, blocks: np.ndarray, g: float = 9.81, linear: bool = False, step: float = STEP) -> Any:
    """Return fell, largest tilt [rad] and impacts (n, 3) of blocks (n, 6): alpha, p and e of both edges, in a row."""
    # Twenty times 1/p of quiet: a tilt beside the balance grows by exp(20).
    quiet = int(math.ceil(20.0 / (blocks[:, 2:4].min() * base.dt))) if len(blocks) else 0
    a = np.concatenate([base.a[:, 0], np.zeros(quiet)]).astype(float)
    parts = max(1, math.ceil(base.dt / step - 1e-9))
    return _loop()(a / g, base.dt, parts, np.ascontiguousarray(blocks, dtype=float), linear)


@cache
def _loop() -> Any:
    """Return the loop over blocks, compiled with what it calls where numba is installed."""
    try:
        import numba
    except ImportError:
        return rock_all
    names = dict(globals())
    for function in (tilt_acceleration, rk4, rock_one, rock_all):
        names[function.__name__] = numba.njit(nogil=True)(FunctionType(function.__code__, names))
    return names["rock_all"]


def tilt_acceleration(theta: float, side: float, a: float, alpha: float, p2: float, linear: bool) -> float:
    """Return theta" = -p^2 [side sin(alpha - side theta) + (a/g) cos(alpha - side theta)]; a in parts of g."""
    if linear:
        return -p2 * (side * alpha - theta + a)
    return -p2 * (side * math.sin(alpha - side * theta) + a * math.cos(alpha - side * theta))


def rk4(
    theta: float, rate: float, h: float, side: float, a: float, slope: float, alpha: float, p2: float, linear: bool
) -> tuple[float, float]:
    """Return tilt and rate after h [s] on one edge; the floor's acceleration is a + slope t, in parts of g."""
    half = a + 0.5 * h * slope
    k1, l1 = rate, tilt_acceleration(theta, side, a, alpha, p2, linear)
    k2, l2 = rate + 0.5 * h * l1, tilt_acceleration(theta + 0.5 * h * k1, side, half, alpha, p2, linear)
    k3, l3 = rate + 0.5 * h * l2, tilt_acceleration(theta + 0.5 * h * k2, side, half, alpha, p2, linear)
    k4, l4 = rate + h * l3, tilt_acceleration(theta + h * k3, side, a + h * slope, alpha, p2, linear)
    return theta + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4), rate + h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4)


def rock_one(a: np.ndarray, dt: float, parts: int, block: np.ndarray, linear: bool) -> tuple[bool, float, int]:
    """Return fell, largest tilt and impacts of one block (6,); a (n,) in parts of g."""
    h = dt / parts
    theta, rate, side, largest, impacts = 0.0, 0.0, 0.0, 0.0, 0
    least_a, least_b = (block[0], block[1]) if linear else (math.tan(block[0]), math.tan(block[1]))
    for k in range((len(a) - 1) * parts):
        n, part = k // parts, k % parts
        slope = (a[n + 1] - a[n]) / dt
        now = a[n] + slope * part * h
        if side == 0.0:
            if -now > least_a:
                side = 1.0
            elif now > least_b:
                side = -1.0
            else:
                continue
        edge = 0 if side > 0.0 else 1
        alpha, p2 = block[edge], block[2 + edge] ** 2
        new, new_rate = rk4(theta, rate, h, side, now, slope, alpha, p2, linear)
        if side * new < 0.0:
            # Two secants find the impact; what is left of the step goes on from there.
            first = h * theta / (theta - new)
            at, at_rate = rk4(theta, rate, first, side, now, slope, alpha, p2, linear)
            first = min(h, max(0.0, first - (at / at_rate if at_rate != 0.0 else 0.0)))
            _, before = rk4(theta, rate, first, side, now, slope, alpha, p2, linear)
            other = 1 - edge
            new, new_rate, impacts = 0.0, before * block[4 + other], impacts + 1
            if abs(new_rate) < REST_RATE:
                new_rate, side = 0.0, 0.0
            else:
                side = -side
                new, new_rate = rk4(
                    0.0,
                    new_rate,
                    h - first,
                    side,
                    now + slope * first,
                    slope,
                    block[other],
                    block[2 + other] ** 2,
                    linear,
                )
                if side * new < 0.0:
                    new, new_rate, side = 0.0, 0.0, 0.0
        theta, rate = new, new_rate
        largest = max(largest, abs(theta))
        if largest >= FALLEN:
            return True, largest, impacts
    return False, largest, impacts


def rock_all(a: np.ndarray, dt: float, parts: int, blocks: np.ndarray, linear: bool) -> np.ndarray:
    """Return fell, largest tilt and impacts (n, 3) of blocks (n, 6) under a (m,) in parts of g."""
    out = np.zeros((len(blocks), 3))
    for i in range(len(blocks)):
        fell, largest, impacts = rock_one(a, dt, parts, blocks[i], linear)
        out[i, 0], out[i, 1], out[i, 2] = fell, largest, impacts
    return out
