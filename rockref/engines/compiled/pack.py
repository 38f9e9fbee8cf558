"""From a Problem to the flat arrays of the compiled step, and back to a Response."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rockref.effects.base import Effect
from rockref.effects.feet import foot_numbers
from rockref.effects.loads.attachment import half_height
from rockref.engines.compiled import columns as col
from rockref.engines.compiled import slots
from rockref.model.errors import InputError
from rockref.model.integrator import prepared_inertia
from rockref.model.problem import Problem, State
from rockref.model.rotation import inverse


def body_row(problem: Problem) -> np.ndarray:
    """Return (BODY,) mass, gravity, inertia and its inverse."""
    block = problem.block
    row = np.zeros(col.BODY)
    inertia = prepared_inertia(block)
    principal = inertia.J.ndim == 1
    row[0], row[1] = block.mass, block.g
    row[2:11] = np.asarray(block.inertia).ravel()
    row[11:20] = np.diag(inertia.J_inverse).ravel() if principal else inverse(np.asarray(block.inertia)).ravel()
    row[20] = principal
    return row


def centres(P: np.ndarray, props: np.ndarray) -> np.ndarray:
    """Return (..., n, 3) contact points raised by the radius of their feet [m]."""
    raised = np.array(P, np.float64, order="C")
    raised[..., 2] += props[..., col.RADIUS]
    return raised


def props_rows(problem: Problem) -> np.ndarray:
    """Return (n, PROPS) properties of the points."""
    q = problem.points
    rows = np.zeros((q.n, col.PROPS))
    for j, name in enumerate(("K_N", "K_T", "C_N", "C_T", "mu_0", "mu")):
        rows[:, j] = getattr(q, name)
    if q.radius is not None:
        rows[:, 6] = q.radius
    rows[:, 7] = [int(name[0]) if name[:1].isdigit() else 0 for name in q.names]
    return rows


def memory_rows(state: State) -> np.ndarray:
    """Return (n, MEMORY) what the points remember."""
    rows = np.zeros((state.s.shape[0], col.MEMORY))
    rows[:, 0:2], rows[:, 2], rows[:, 3] = state.s, state.anchored, state.sliding
    for m in state.memory:
        for key, column in POINT_MEMORY.items():
            if key in m:
                rows[:, column] = m[key]
    return rows


#: Names in an effect's memory and the columns of the compiled point memory in which they stand.
POINT_MEMORY: dict[str, int | slice] = {"xi_largest": 4, "yaw": 5, "held": slice(6, 8)}
#: The same for what a plate that yields remembers, in the columns of the state.
PLATE_MEMORY = {"q": col.Q, "q_rate": col.Q_RATE, "pitch": col.PITCH, "pitch_rate": col.PITCH_RATE}


def state_row(problem: Problem) -> np.ndarray:
    """Return (STATE,) pose, rates, accelerations and time of the start."""
    s = problem.start
    row = np.zeros(col.STATE)
    row[0:3], row[3:6], row[6:15], row[15:18] = s.x, s.v, np.asarray(s.Lambda).ravel(), s.W
    if s.a is not None and s.T is not None and s.F is not None:
        row[18:21], row[21:24], row[col.GIVEN] = s.a, s.T, 1.0
    row[col.TIME] = s.t
    counted = s.h == problem.step
    row[col.ORIGIN], row[col.COUNT] = (s.origin, s.count) if counted else (s.t, 0)
    for m in s.memory:
        for key, column in PLATE_MEMORY.items():
            if key in m:
                row[column] = m[key]
    return row


def with_memory(problem: Problem) -> Problem:
    """Return the problem with the memories of its effects started, where they are not yet."""
    if len(problem.start.memory) == len(problem.effects):
        return problem
    start = replace(problem.start, memory=tuple(e.start(problem) for e in problem.effects))
    return replace(problem, start=start)


def effects_rows(problems: Sequence[Problem]) -> tuple[np.ndarray, np.ndarray]:
    """Return (B, SLOTS) the numbers of the effects and of the plate's motions, whose samples follow, (N, 3) [m/s2].

    Runs on the same motion share its samples. Raises InputError as `effects_row`.
    """
    rows = np.stack([effects_row(p) for p in problems])
    first: dict[int, int] = {}
    samples: list[np.ndarray] = []
    for row, p in zip(rows, problems, strict=True):
        if (base := p.base) is None:
            continue
        if id(base.a) not in first:
            first[id(base.a)] = sum(map(len, samples))
            samples.append(np.asarray(base.a, np.float64))
        _put(row, slots.BASE, base.t_0, base.dt, len(base.a) - 1, first[id(base.a)])
    return rows, np.concatenate(samples) if samples else np.zeros((1, 3))


def effects_row(problem: Problem) -> np.ndarray:
    """Return (SLOTS,) the numbers of the effects.

    Raises
    ------
    InputError
        E-TWIN, for an effect without a compiled twin, and for effects in another order than that of the step.
    """
    row = np.zeros(slots.SLOTS)
    active = [effect for effect in problem.effects if not effect.is_absent()]
    for effect in active:
        if not knows(effect):
            raise InputError("E-TWIN", f"effect {effect.id}", "has no compiled twin", NUMPY)
        if effect.id in FILL:
            FILL[effect.id](row, effect, problem)
    if not in_order(active):
        raise InputError("E-TWIN", "effects", "are given twice, or not in the order of the step", NUMPY)
    return row


NUMPY = 'Use engine="numpy", or engine="auto", which does.'


def has_twin(problem: Problem) -> bool:
    """Return whether the compiled step can run this problem."""
    active = [effect for effect in problem.effects if not effect.is_absent()]
    return all(knows(effect) for effect in active) and in_order(active)


def in_order(effects: Sequence[Effect]) -> bool:
    """Return whether the effects that act in the step stand once each, in the order in which the compiled step has
    them."""
    ranks = [slots.IN_THE_STEP.index(effect.id) for effect in effects if effect.id in slots.IN_THE_STEP]
    return all(a < b for a, b in zip(ranks, ranks[1:], strict=False))


def knows(effect: Effect) -> bool:
    """Return whether the compiled step has a twin of this very class, or the effect does not act in the step at all.

    A user's effect has no twin even where it takes the id of one that has.
    """
    return (effect.id in FILL or effect.id in slots.OUTSIDE_THE_STEP) and type(effect).__module__.startswith("rockref.")


def _put(row, first, *values):
    row[first : first + 1 + len(values)] = (1.0, *values)


def _height(problem: Problem) -> float:
    return float(half_height(problem.points))


def _support(row, e, problem):
    _put(row, slots.SUPPORT, *e.bouncing())
    if (pitching := e.pitching()) is not None:
        m = with_memory(problem).start.memory[problem.effects.index(e)]
        row[slots.SUPPORT + 4 : slots.SUPPORT + 8] = *pitching, m["moment"]


def _normals(row, e, problem):
    foot_numbers(problem.points, e.id)  # refuses points without a foot
    _put(row, slots.NORMALS, e.x1, e.y1, e.x2, e.y2, e.x3, e.y3, e.x4, e.y4, e.turning_share)


def _cable(row, e, problem):
    m = with_memory(problem).start.memory[problem.effects.index(e)]
    height = _height(problem) if e.height is None else e.height
    k, growth = e.stiffnesses()
    _put(row, slots.CABLE, k, e.c, height, m["anchor"][0], m["anchor"][1], growth)


def _vibration(row, e, problem):
    omega = 2 * math.pi * e.frequency
    along = math.sin(e.direction), math.cos(e.direction)
    _put(row, slots.VIBRATION, e.amplitude, omega, e.phase, *along, e.harmonic_cosine, e.harmonic_sine)


FILL = {
    "hertzian_contact": lambda r, e, p: _put(r, slots.HERTZ, e.exponent, e.reference),
    "hysteretic_contact": lambda r, e, p: _put(r, slots.HYSTERESIS, e.kappa, e.curved_share),
    "hunt_crossley_contact": lambda r, e, p: _put(r, slots.HUNT, e.a),
    "stribeck_friction": lambda r, e, p: _put(r, slots.STRIBECK, e.ratio, e.velocity),
    "load_dependent_friction": lambda r, e, p: _put(r, slots.LOAD, e.exponent, e.reference),
    "adhesion": lambda r, e, p: _put(r, slots.ADHESION, e.force, e.range),
    "viscous_friction": lambda r, e, p: _put(r, slots.VISCOUS, e.c),
    "uneven_contact_normals": _normals,
    "spin_friction": lambda r, e, p: _put(r, slots.SPIN, e.radius, e.sliding_share),
    "rolling_resistance": lambda r, e, p: _put(r, slots.ROLLING, e.lever),
    "quadratic_drag": lambda r, e, p: _put(r, slots.DRAG, e.c, e.c_v),
    "cable_restraint": _cable,
    "lingering_wire_pull": lambda r, e, p: _put(r, slots.WIRE, e.force, e.tau, _height(p), e.evenness),
    "base_vibration": _vibration,
    "plate_tilt": lambda r, e, p: _put(r, slots.TILT, e.x, e.y),
    "compliant_support": _support,
    "orientation_dependent_damping": lambda r, e, p: _put(r, slots.ORIENTATION, e.a),
}


def final_state(problem: Problem, row: np.ndarray, memory: np.ndarray, forces: np.ndarray) -> State:
    """Return the State that restarts the run, from the last row of the compiled step."""
    own = []
    for effect, m in zip(problem.effects, problem.start.memory or tuple({} for _ in problem.effects), strict=True):
        started = m or effect.start(problem)
        kept = {k: memory[:, POINT_MEMORY[k]].copy() for k in started if k in POINT_MEMORY}
        kept |= {key: np.array(row[column]) for key, column in PLATE_MEMORY.items() if key in started}
        own.append({**started, **kept})
    return replace(
        problem.start,
        x=row[0:3].copy(), v=row[3:6].copy(), Lambda=row[6:15].reshape(3, 3).copy(), W=row[15:18].copy(),
        s=memory[:, 0:2].copy(), anchored=memory[:, 2] != 0, sliding=memory[:, 3] != 0,
        a=row[18:21].copy(), T=row[21:24].copy(), F=forces.copy(),
        t=float(row[col.TIME]), origin=float(row[col.ORIGIN]), count=int(row[col.COUNT]), h=problem.step,
        memory=tuple(own),
    )  # fmt: skip
