"""Tries every hook of an effect once, on a small problem, and says in words what is wrong with what it gives back."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from rockref.effects.base import Effect
from rockref.effects.guard import numbers
from rockref.model.geometry import EXTERNAL, INTERNAL, cuboid_inertia, eight_points
from rockref.model.integrator import evaluate_contact
from rockref.model.parameters import BLOCK, Parameters, point_properties
from rockref.model.problem import GRAVITY, Block, ContactPoints, Problem, as_arrays, stack
from rockref.model.release import release_posture


def sample_problem() -> Problem:
    """The block of the source at release, a little turning, with no effects: one run."""
    p = Parameters()
    mass, width, depth, height = (BLOCK[k].value for k in ("mass", "width", "depth", "height"))
    block = Block(np.array(mass), cuboid_inertia(mass, width, depth, height), np.array(GRAVITY))
    P = eight_points(width, depth, height, p.delta_long, p.delta_diag)
    properties = point_properties(p, mass, np.arange(8) < 4)
    points = ContactPoints(P, **properties, radius=None, names=EXTERNAL + INTERNAL)
    start = replace(release_posture(block, points, p.theta_0), W=np.array([0.2, 0.1, 0.05]))
    return as_arrays(Problem(block, points, start, 1e-5, 1.0, 2000.0))


def probe(effect: Effect, spec: str) -> None:
    """Try every hook on one run and on a batch of two; the hooks are guarded, and look their results over themselves.

    Raises
    ------
    InputError
        E-EFFECT: which hook, the shape or the number that is wrong, and what is expected.
    """
    single = sample_problem()
    for problem in (single, as_arrays(stack([single, single]))):
        memory = {key: np.asarray(a) for key, a in effect.start(problem).items()}
        probe_step(effect, spec, problem, memory)
    block, points = effect.points(single.block, single.points)
    effect.release(block, points, single.start)
    effect.sensor(np.arange(50) / 2000, np.full((50, 3), 0.1))


def probe_step(effect: Effect, spec: str, problem: Problem, m: dict[str, Any]) -> None:
    """Try the hooks of the step."""
    s, points = problem.start, problem.points
    c = evaluate_contact(problem, s, s.x, s.Lambda, s.v, s.W, np.zeros_like(s.W), 0.0, ())
    for key, a in zip(("displacement", "velocity"), effect.plate_motion(0.0, m) or (), strict=False):
        numbers(f"{spec}.plate_motion", key, a, s.x.shape)
    effect.normal_force(points.K_N * c.k.xi, c.k, points, m)
    effect.friction_coefficient(points.mu_0, points.mu, c.F_N, c.k, points, m)
    effect.point_wrench(problem, c, m)
    effect.body_wrench(problem, c, s.x, s.Lambda, s.v, s.W, m)
    effect.advance(problem, c, problem.step, m)
