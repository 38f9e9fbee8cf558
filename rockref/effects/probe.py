"""Tries every hook of an effect once, on a small problem, and says in words what is wrong with what it gives back."""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from rockref.effects.base import UNDO_HOOKS, Effect
from rockref.effects.guard import MOTION, numbers, wrong
from rockref.model.errors import InputError
from rockref.model.geometry import EXTERNAL, INTERNAL, cuboid_inertia, eight_points
from rockref.model.integrator import evaluate_contact
from rockref.model.parameters import BLOCK, Parameters, point_properties
from rockref.model.problem import GRAVITY, Block, ContactPoints, Problem, as_arrays, stack
from rockref.model.release import release_posture


def sample_problem() -> Problem:
    """Return the block of the source at release, a little turning, with no effects: one run."""
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

    Raises InputError (E-EFFECT): which hook, the shape or the number that is wrong, and what is expected.
    """
    single = sample_problem()
    for problem in (single, as_arrays(stack([single, single]))):
        memory = {key: np.asarray(a) for key, a in effect.start(problem).items()}
        probe_step(effect, spec, problem, memory)
    block, points = effect.points(single.block, single.points)
    effect.release(block, points, single.start)
    for hook in (effect.sensor, effect.undo, effect.heard):
        hook(*sample_record())


def sample_record() -> tuple[np.ndarray, np.ndarray]:
    """Return instants (50,) [s] and rates (50, 3) [rad/s] that a gyroscope is given, or shows."""
    return np.arange(50) / 2000, np.full((50, 3), 0.1)


def probe_step(effect: Effect, spec: str, problem: Problem, m: dict[str, Any]) -> None:
    """Try the hooks of the step."""
    s, points = problem.start, problem.points
    c = evaluate_contact(problem, s, s.x, s.Lambda, s.v, s.W, np.zeros_like(s.W), 0.0, ())
    for key, a in zip(MOTION, effect.plate_motion(0.0, m) or (), strict=False):
        numbers(f"{spec}.plate_motion", key, a, s.x.shape)
    effect.normal_force(points.K_N * c.k.xi, c.k, points, m)
    effect.friction_coefficient(points.mu_0, points.mu, c.F_N, c.k, points, m)
    effect.point_wrench(problem, c, m)
    effect.body_wrench(problem, c, s.x, s.Lambda, s.v, s.W, m)
    effect.advance(problem, c, problem.step, m)


#: What an absent effect may change, of the largest number: its arithmetic may round (decided: a few thousand units in
#: the last place).
ROUNDED = 1e-12


def probe_absent(effect: Effect, spec: str) -> None:
    """Refuse an effect that changes something while it is absent: models drop it there, and a fit would see a jump.

    A hook that cannot be computed at the absent value, such as 0/0, is passed over: it is never called.

    Raises InputError (E-EFFECT): which hook changes something.
    """
    law = Effect()
    for name, arguments in absent_arguments(effect):
        try:
            found = getattr(effect, name)(*arguments)
        except InputError:
            continue
        if not same(found, getattr(law, name)(*arguments)):
            values = ", ".join(f"{key}={value:g}" for key, value in effect.values().items() if value is not None)
            what = f"changes something where the effect is absent ({values})"
            raise wrong(f"{spec}.{name}", what, "Let the parameters that bring it in multiply what it adds.")


def absent_arguments(effect: Effect) -> list[tuple[str, tuple[Any, ...]]]:
    """Return the hooks whose results say whether something changes, with the arguments of the small problem."""
    problem = sample_problem()
    s, points, block = problem.start, problem.points, problem.block
    try:
        m = {key: np.asarray(a) for key, a in effect.start(problem).items()}
    except InputError:
        return []
    c = evaluate_contact(problem, s, s.x, s.Lambda, s.v, s.W, np.zeros_like(s.W), 0.0, ())
    return [
        ("points", (block, points)),
        ("release", (block, points, s)),
        ("plate_motion", (0.0, m)),
        ("normal_force", (points.K_N * c.k.xi, c.k, points, m)),
        ("friction_coefficient", (points.mu_0, points.mu, c.F_N, c.k, points, m)),
        ("point_wrench", (problem, c, m)),
        ("body_wrench", (problem, c, s.x, s.Lambda, s.v, s.W, m)),
        *((name, sample_record()) for name in ("sensor", *UNDO_HOOKS)),
    ]


def same(a: Any, b: Any) -> bool:
    """Return whether two results of a hook are the same but for rounding; a load or a motion of zero is none."""
    if is_dataclass(b):
        return all(same(getattr(a, f.name), getattr(b, f.name)) for f in fields(b))
    if isinstance(b, tuple) and not all(isinstance(name, str) for name in b):
        return all(same(x, y) for x, y in zip(a, b, strict=True))
    if isinstance(a, tuple) and b is None:
        return all(not np.any(x) for x in a)
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray) and a.dtype.kind == "f":
        return a.shape == b.shape and bool(np.all(np.abs(a - b) <= ROUNDED * np.max(np.abs(b), initial=0.0)))
    return a is b or bool(np.all(np.asarray(a == b)))
