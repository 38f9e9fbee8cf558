"""From a Problem to the flat arrays of the compiled step, and back to a Response."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rockref.effects.base import Effect
from rockref.engines.compiled import kernel, slots
from rockref.model.errors import InputError
from rockref.model.integrator import prepared_inertia
from rockref.model.problem import Problem, State
from rockref.model.rotation import inverse


def body_row(problem: Problem) -> np.ndarray:
    """(BODY,) mass, gravity, inertia and its inverse."""
    block = problem.block
    row = np.zeros(kernel.BODY)
    inertia = prepared_inertia(block)
    principal = inertia.J.ndim == 1
    row[0], row[1] = block.mass, block.g
    row[2:11] = np.asarray(block.inertia).ravel()
    row[11:20] = np.diag(inertia.J_inverse).ravel() if principal else inverse(np.asarray(block.inertia)).ravel()
    row[20] = principal
    return row


def props_rows(problem: Problem) -> np.ndarray:
    """(n, PROPS) properties of the points."""
    q = problem.points
    rows = np.zeros((q.n, kernel.PROPS))
    for j, name in enumerate(("K_N", "K_T", "C_N", "C_T", "mu_0", "mu")):
        rows[:, j] = getattr(q, name)
    if q.radius is not None:
        rows[:, 6] = q.radius
    rows[:, 7] = [int(name[0]) if name[:1].isdigit() else 0 for name in q.names]
    return rows


def memory_rows(state: State) -> np.ndarray:
    """(n, MEMORY) what the points remember."""
    rows = np.zeros((state.s.shape[0], kernel.MEMORY))
    rows[:, 0:2], rows[:, 2], rows[:, 3] = state.s, state.anchored, state.sliding
    for m in state.memory:
        for key, column in POINT_MEMORY.items():
            if key in m:
                rows[:, column] = m[key]
    return rows


#: Names in an effect's memory and the columns of the compiled point memory in which they stand.
POINT_MEMORY: dict[str, int | slice] = {"xi_largest": 4, "yaw": 5, "roll": slice(6, 8)}


def state_row(problem: Problem) -> np.ndarray:
    """(STATE,) pose, rates, accelerations and time of the start."""
    s = problem.start
    row = np.zeros(kernel.STATE)
    row[0:3], row[3:6], row[6:15], row[15:18] = s.x, s.v, np.asarray(s.Lambda).ravel(), s.W
    if s.a is not None and s.T is not None and s.F is not None:
        row[18:21], row[21:24], row[kernel.GIVEN] = s.a, s.T, 1.0
    row[kernel.TIME] = s.t
    counted = s.h == problem.step
    row[kernel.ORIGIN], row[kernel.COUNT] = (s.origin, s.count) if counted else (s.t, 0)
    for m in s.memory:
        if "q" in m:
            row[kernel.Q], row[kernel.Q_RATE] = m["q"], m["q_rate"]
    return row


def with_memory(problem: Problem) -> Problem:
    """The problem with the memories of its effects begun, where they are not yet."""
    if len(problem.start.memory) == len(problem.effects):
        return problem
    start = replace(problem.start, memory=tuple(e.start(problem) for e in problem.effects))
    return replace(problem, start=start)


def effects_row(problem: Problem) -> np.ndarray:
    """(SLOTS,) the numbers of the effects. Raises InputError (E-TWIN) for an effect that has no compiled twin."""
    row = np.zeros(slots.SLOTS)
    for effect in problem.effects:
        if not knows(effect):
            cure = 'Use engine="numpy", or engine="auto", which does.'
            raise InputError("E-TWIN", f"effect {effect.id}", "has no compiled twin", cure)
        if effect.id in FILL and not effect.is_absent():
            FILL[effect.id](row, effect, problem)
    return row


def knows(effect: Effect) -> bool:
    """Whether the compiled step has a twin of this effect, or the effect does not act in the step at all."""
    return effect.id in FILL or effect.id in slots.OUTSIDE_THE_STEP


def _put(row, first, *values):
    if row[first] != 0.0:
        raise InputError("E-TWIN", "effects", "the same effect is given twice", "Give one of them.")
    row[first : first + 1 + len(values)] = (1.0, *values)


def _heights(problem: Problem) -> tuple[float, float]:
    z = np.asarray(problem.points.P)[:, 2]
    return float(np.min(z)), -float(np.min(z))


def _support(row, e, problem):
    k = (2 * np.pi * e.frequency) ** 2 * e.mass
    _put(row, slots.SUPPORT, e.mass, k, 2 * e.ratio * np.sqrt(k * e.mass))


def _normals(row, e, problem):
    _put(row, slots.NORMALS, e.x1, e.y1, e.x2, e.y2, e.x3, e.y3, e.x4, e.y4)


FILL = {
    "hertzian_contact": lambda r, e, p: _put(r, slots.HERTZ, e.exponent, e.reference),
    "hunt_crossley_contact": lambda r, e, p: _put(r, slots.HUNT, e.a),
    "hysteretic_contact": lambda r, e, p: _put(r, slots.HYSTERESIS, e.kappa),
    "adhesion": lambda r, e, p: _put(r, slots.ADHESION, e.force, e.range),
    "stribeck_friction": lambda r, e, p: _put(r, slots.STRIBECK, e.ratio, e.velocity),
    "viscous_friction": lambda r, e, p: _put(r, slots.VISCOUS, e.c),
    "load_dependent_friction": lambda r, e, p: _put(r, slots.LOAD, e.exponent, e.reference),
    "spin_friction": lambda r, e, p: _put(r, slots.SPIN, e.radius),
    "rolling_resistance": lambda r, e, p: _put(r, slots.ROLLING, e.lever),
    "uneven_contact_normals": _normals,
    "quadratic_drag": lambda r, e, p: _put(r, slots.DRAG, e.c, *_heights(p)),
    "cable_restraint": lambda r, e, p: _put(r, slots.CABLE, e.k, e.c, _heights(p)[1]),
    "lingering_wire_pull": lambda r, e, p: _put(r, slots.WIRE, e.force, e.tau, _heights(p)[1], 1.0),
    "base_vibration": lambda r, e, p: _put(
        r, slots.VIBRATION, e.amplitude, 2 * np.pi * e.frequency, e.direction, e.phase
    ),
    "plate_tilt": lambda r, e, p: _put(r, slots.TILT, e.x, e.y),
    "compliant_support": _support,
}


def final_state(problem: Problem, row: np.ndarray, memory: np.ndarray, forces: np.ndarray) -> State:
    """The State that restarts the run, from the last row of the compiled step."""
    own = []
    for effect, m in zip(problem.effects, problem.start.memory or tuple({} for _ in problem.effects), strict=True):
        started = m or effect.start(problem)
        kept = {k: memory[:, POINT_MEMORY[k]].copy() for k in started if k in POINT_MEMORY}
        if "q" in started:
            kept |= {"q": np.array(row[kernel.Q]), "q_rate": np.array(row[kernel.Q_RATE])}
        own.append({**started, **kept})
    return replace(
        problem.start,
        x=row[0:3].copy(), v=row[3:6].copy(), Lambda=row[6:15].reshape(3, 3).copy(), W=row[15:18].copy(),
        s=memory[:, 0:2].copy(), anchored=memory[:, 2] != 0, sliding=memory[:, 3] != 0,
        a=row[18:21].copy(), T=row[21:24].copy(), F=forces.copy(),
        t=float(row[kernel.TIME]), origin=float(row[kernel.ORIGIN]), count=int(row[kernel.COUNT]), h=problem.step,
        memory=tuple(own),
    )  # fmt: skip
