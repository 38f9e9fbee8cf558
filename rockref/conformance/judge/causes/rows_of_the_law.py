"""The rows of the law's short runs, with what every foot does in them, and which of a backend's rows are the same."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from rockref.conformance.vectors import layer, problem_of
from rockref.engines import run
from rockref.model.assembly import body_moment, resultant_force, resultant_moment
from rockref.model.contact import norm, point_kinematics, touch, trial_force

#: A share of a force below which its spring or damper is no circumstance, and of the forces of a row from which on one
#: is wrong. Decided: far above rounding; in single precision an anchor is off by more.
SHARE, WRONG = 1e-3, 1e-7
#: Coordinates that differ by so many ulps of a metre are the same: what right programs differ by within three steps.
SAME = 16 * float(np.finfo(float).eps)
#: Rates that differ by so much are the same [rad/s]: what is negligible, as they are gained from forces, which have
#: fewer digits.
SAME_RATE = 1e-12

#: What feet do, by name, (n,) bool; and how fast they go up or down, "sinking" (n,) [m/s].
Feet = Mapping[str, np.ndarray]


@dataclass(frozen=True)
class Row:
    """One row of the law's run: x (3,) [m], Lambda (3, 3), W (3,) [rad/s], F (n, 3) [N], and what its feet do; None in
    `feet` where the row has no evaluation of its own."""

    x: np.ndarray
    Lambda: np.ndarray
    W: np.ndarray
    F: np.ndarray
    feet: Feet | None


@dataclass(frozen=True)
class Memory:
    """What feet remember: s (n, 2) [m], anchored and sliding (n,)."""

    s: np.ndarray
    anchored: np.ndarray
    sliding: np.ndarray


@lru_cache
def rows_of_the_law(id_: str) -> tuple[Row, ...]:
    """Return the rows of a short run; none where they lie several steps apart."""
    vector = next(v for v in layer("L5s") if v.id == id_)
    q, problem = vector.inputs, problem_of(vector.inputs)
    if problem.step * problem.output_rate < 1 - 1e-9:
        return ()
    r = run(problem, engine="numpy")
    found, carried = [], np.zeros(problem.points.n, bool)
    for i in range(len(r.t)):
        before = problem.start if i == 0 else Memory(*(getattr(r, k)[i - 1] for k in ("s", "anchored", "sliding")))
        v, W = (r.v[0], r.W[0]) if i == 0 else predicted(problem, r, i - 1)
        feet = None if i == 0 and q.get("F") is not None else what_feet_do(problem, r, i, before, v, W)
        if feet is not None:
            carried = (carried | feet["moved"]) & feet["touching"] & ~feet["new"]
            feet = {**feet, "carried": carried}
        found.append(Row(r.x[i], r.Lambda[i], r.W[i], r.F[i], feet))
    return tuple(found)


@lru_cache
def feet_at_the_start(id_: str) -> Feet | None:
    """Return what the feet do in the first evaluation of a short run, of another integrator, too; None where the start
    brings its forces."""
    vector = next(v for v in layer(id_.partition("-")[0]) if v.id == id_)
    if vector.inputs.get("F") is not None:
        return None
    problem = problem_of(vector.inputs)
    problem = replace(problem, duration=problem.step, output_rate=1 / problem.step)
    r = run(problem, engine="numpy")
    return what_feet_do(problem, r, 0, problem.start, r.v[0], r.W[0])


def predicted(problem: Any, r: Any, i: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the velocities with which the forces of the row after the i-th are evaluated (S1)."""
    block, J = problem.block, problem.block.inertia
    a = resultant_force(r.F[i], block.mass, block.g) / block.mass
    arms = point_kinematics(r.x[i], r.Lambda[i], r.v[i], r.W[i], problem.points.P).r
    T = body_moment(r.Lambda[i], resultant_moment(arms, r.F[i]))
    A = np.linalg.solve(J, T - np.cross(r.W[i], J @ r.W[i]))
    return r.v[i] + problem.step * a, r.W[i] + problem.step * A


def what_feet_do(problem: Any, r: Any, i: int, before: Any, v: np.ndarray, W: np.ndarray) -> Feet:
    """Return what the feet of the i-th row of a response do.

    A part of the velocity that works in a damper (drift and spin along the plate, fall and tilt across it) has a share
    of the force; one that does not ("no drift") is too small to make the force wrong.

    before : what they remember; v [m/s], W [rad/s] : velocities of the evaluation
    """
    p, here = problem.points, (r.x[i], r.Lambda[i])
    k = point_kinematics(*here, v, W, p.P)
    s, touching = touch(k.xi, k.u[:, :2], before.s, before.anchored)
    whole = trial_force(k.u[:, :2], s, k.v_slide, p.K_T, p.C_T)
    size, damper = norm(whole), norm(p.C_T[:, None] * k.v_slide)
    stretch, F_N = k.u[:, :2] - s, r.F[i][:, 2]
    spring = norm(p.K_T[:, None] * stretch)
    across = p.K_T * p.C_T * np.abs(stretch[:, 0] * k.v_slide[:, 1] - stretch[:, 1] * k.v_slide[:, 0])
    slid, new = np.asarray(before.sliding, bool), ~np.asarray(before.anchored, bool)
    found = {
        "touching": touching, "new": touching & new, "company": touching & ~new & np.any(new & touching),
        "beside": touching & new & ~np.all(new),
        "spring": spring > SHARE * size, "damper": damper > SHARE * size,
        "bent": across > SHARE * size**2, "slides": r.sliding[i], "slid": slid & ~new,
        "moved": slid & ~new & (i > 0), "between": (p.mu * F_N < size) & (size <= p.mu_0 * F_N),
        "dragged": norm(r.F[i][:, :2]) > 0, "later": np.full(len(F_N), i > 0),
        "pressed": F_N > 0, "push": np.abs(p.C_N * k.xi_rate) > SHARE * np.abs(p.K_N * k.xi),
    }  # fmt: skip
    turn = point_kinematics(*here, 0 * v, W, p.P)
    # About the height of the plate alone: a tilt moves all feet alike, as a drift does.
    spin = point_kinematics(*here, 0 * v, r.Lambda[i].T @ [0, 0, (r.Lambda[i] @ W)[2]], p.P)
    parts = {
        "drift": (p.C_T * np.hypot(v[0], v[1]), size), "spin": (norm(p.C_T[:, None] * spin.v_slide), size),
        "fall": (np.abs(p.C_N * v[2]), np.abs(p.K_N * k.xi)),
        "tilt": (np.abs(p.C_N * turn.xi_rate), np.abs(p.K_N * k.xi)),
    }  # fmt: skip
    least = WRONG / 2 * max(float(np.max(np.abs(r.F[i]))), 1.0)
    for name, (force, of) in parts.items():
        found |= {name: force > np.maximum(SHARE * of, least), f"no {name}": force <= least}
    return {name: np.asarray(a, bool) for name, a in found.items()} | {"sinking": np.abs(k.xi_rate)}


def same(out: dict[str, Any], key: str, i: int, right: np.ndarray) -> bool:
    """Return whether a quantity of a row is that of the law, but for rounding."""
    nearly = SAME_RATE if key == "W" else SAME
    try:
        return bool(np.all(np.abs(np.asarray(out[key], float)[i] - right) <= nearly * max(1.0, np.max(np.abs(right)))))
    except (KeyError, TypeError, ValueError, IndexError):
        return False


def off(out: dict[str, Any], i: int, row: Row) -> np.ndarray | None:
    """Return which forces of a row are wrong, (n, 3); None where none can be read."""
    try:
        got = np.asarray(out["F"], float)[i]
        return ~(np.abs(got - row.F) <= WRONG * max(float(np.max(np.abs(row.F))), 1.0))
    except (KeyError, TypeError, ValueError, IndexError):
        return None
