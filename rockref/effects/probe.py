"""Tries every hook of an effect once, on a small problem, and says in words what is wrong with what it gives back."""

from __future__ import annotations

import traceback
from dataclasses import replace
from typing import Any

import numpy as np

from rockref.effects.base import Effect
from rockref.model.errors import InputError
from rockref.model.geometry import EXTERNAL, INTERNAL, cuboid_inertia, eight_points
from rockref.model.integrator import evaluate_contact
from rockref.model.parameters import BLOCK, Parameters, point_properties
from rockref.model.problem import GRAVITY, Block, ContactPoints, Problem, State, as_arrays, stack
from rockref.model.release import release_posture

#: What authors of effects most often forget.
AXES = "Leading axes are runs side by side: index from the end, as in x[..., 2], and it serves one run and many."


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
    """Try every hook on one run and on a batch of two.

    Raises
    ------
    InputError
        E-EFFECT: which hook, the shape or the number that is wrong, and what is expected.
    """
    single = sample_problem()
    for problem in (single, as_arrays(stack([single, single]))):
        memory = call(effect, spec, "start", problem)
        if not isinstance(memory, dict):
            raise wrong(
                spec, "start", f"gives back {type(memory).__name__}", "Return a dict of arrays, or leave it out."
            )
        for key, a in memory.items():
            if np.shape(a)[: len(problem.batch)] != problem.batch:
                what = f"memory {key!r} has shape {np.shape(a)} for a batch of shape {problem.batch}"
                raise wrong(
                    spec, "start", what, "Begin its shape as those of the problem's arrays, with np.zeros_like."
                )
        probe_step(effect, spec, problem, {k: np.asarray(a) for k, a in memory.items()})
    block, points = pair(effect, spec, "points", call(effect, spec, "points", single.block, single.points))
    if not isinstance(block, Block) or not isinstance(points, ContactPoints):
        raise wrong(
            spec, "points", f"gives back {type(block).__name__}, {type(points).__name__}", "Return block, points."
        )
    for key in ("K_N", "K_T", "C_N", "C_T", "mu_0", "mu"):
        numbers(spec, "points", key, getattr(points, key), (points.n,))
    state = call(effect, spec, "release", block, points, single.start)
    if not isinstance(state, State):
        raise wrong(spec, "release", f"gives back {type(state).__name__}", "Return dataclasses.replace(state, ...).")
    numbers(spec, "release", "W", state.W, (3,))
    crv = call(effect, spec, "sensor", np.arange(50) / 2000, np.full((50, 3), 0.1))
    numbers(spec, "sensor", "crv", crv, (50, 3))


def probe_step(effect: Effect, spec: str, problem: Problem, m: dict[str, Any]) -> None:
    """Try the hooks of the step."""
    s, points = problem.start, problem.points
    c = evaluate_contact(problem, s, s.x, s.Lambda, s.v, s.W, np.zeros_like(s.W), 0.0, ())
    motion = call(effect, spec, "plate_motion", 0.0, m)
    if motion is not None:
        for key, a in zip(("displacement", "velocity"), pair(effect, spec, "plate_motion", motion), strict=True):
            numbers(spec, "plate_motion", key, a, s.x.shape)
    F = call(effect, spec, "normal_force", points.K_N * c.k.xi, c.k, points, m)
    numbers(spec, "normal_force", "F", F, points.K_N.shape)
    mu = call(effect, spec, "friction_coefficient", points.mu_0, points.mu, c.F_N, c.k, points, m)
    for key, a in zip(("mu_0", "mu"), pair(effect, spec, "friction_coefficient", mu), strict=True):
        numbers(spec, "friction_coefficient", key, a, points.mu.shape)
    wrenches = {
        "point_wrench": call(effect, spec, "point_wrench", problem, c, m),
        "body_wrench": call(effect, spec, "body_wrench", problem, c, s.x, s.Lambda, s.v, s.W, m),
    }
    for hook, wrench in wrenches.items():
        if wrench is not None:
            for key, a in zip(("force", "moment"), pair(effect, spec, hook, wrench), strict=True):
                numbers(spec, hook, key, a, s.x.shape)
    call(effect, spec, "advance", problem, c, problem.step, m)
    for key, a in m.items():
        numbers(spec, "advance", f"memory {key!r}", a, np.shape(a))


def call(effect: Effect, spec: str, hook: str, *arguments):
    """Call a hook; an exception inside it becomes an InputError that names its line."""
    try:
        with np.errstate(all="ignore"):
            return getattr(effect, hook)(*arguments)
    except InputError:
        raise
    except Exception as e:
        line = traceback.extract_tb(e.__traceback__)[-1]
        what = f"{hook} fails: {type(e).__name__}: {e}"
        raise InputError("E-EFFECT", f"{spec} (line {line.lineno} of {line.filename})", what, AXES) from e


def pair(effect: Effect, spec: str, hook: str, given):
    """The two results of a hook that gives back two."""
    if not isinstance(given, tuple) or len(given) != 2:
        raise wrong(spec, hook, f"gives back {type(given).__name__}", "Return two things, with a comma between them.")
    return given


def numbers(spec: str, hook: str, key: str, a, shape: tuple[int, ...]) -> None:
    """Refuse a result of the wrong shape, or with a number that is not finite."""
    if np.shape(a) != shape:
        what = f"{key} has shape {np.shape(a)}, the law's has {shape}"
        raise wrong(spec, hook, what, AXES)
    if not np.all(np.isfinite(np.asarray(a, float))):
        raise wrong(
            spec, hook, f"{key} holds a number that is not finite", "Look for 0/0, roots and powers of negatives."
        )


def wrong(spec: str, hook: str, what: str, cure: str) -> InputError:
    """The error for a result that the step cannot use."""
    return InputError("E-EFFECT", f"{spec}: {hook}", what, cure)
