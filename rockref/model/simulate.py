"""The loop: Problem -> Response."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError, NumericalError
from rockref.model.geometry import check_inertia
from rockref.model.integrator import (
    Inertia,
    angular_acceleration,
    first_evaluation,
    prepared_inertia,
    rotation_increment,
    step,
    times,
)
from rockref.model.problem import ContactPoints, Problem, State, as_arrays
from rockref.model.response import Response
from rockref.model.rotation import dot, hat, product, transposed

RECORDED = ("x", "v", "Lambda", "W", "F", "s", "anchored", "sliding")


def largest_step(problem: Problem) -> float:
    """Return longest stable step [s], all points touching and sticking at once; the least of a batch; infinite without
    points.

    The step of an oscillator x" = -d x' - w^2 x, with the force taken at the predicted velocity, is stable while
    (w h)^2 / 4 + d h <= 1 (the roots of its amplification matrix; a test finds the same limit numerically). w^2 and d
    are the largest eigenvalues of M^-1 K and M^-1 C, with every point as stiff as its stiffer direction.
    """
    block, points = problem.block, problem.points
    if not points.n:
        return np.inf
    P = np.asarray(points.P, float)
    M = np.zeros(P.shape[:-2] + (6, 6))
    M[..., :3, :3] = np.asarray(block.mass)[..., None, None] * np.eye(3)
    M[..., 3:, 3:] = block.inertia
    root = np.linalg.inv(np.linalg.cholesky(M))
    B = np.concatenate([np.broadcast_to(np.eye(3), P.shape + (3,)), -hat(P)], axis=-1)  # velocity of a point from v, W

    def largest_eigenvalue(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        A = np.einsum("...n,...nij,...nik->...jk", np.maximum(a, b).astype(float), B, B)
        return np.linalg.eigvalsh(root @ A @ root.swapaxes(-1, -2))[..., -1]

    w2, d = largest_eigenvalue(points.K_N, points.K_T), largest_eigenvalue(points.C_N, points.C_T)
    return float(np.min(2 * (np.sqrt(d * d + w2) - d) / w2))


def stiffest(problem: Problem) -> str:
    """Name, stiffness and damping of the contact that by itself allows the shortest step, in the stiffer direction."""
    points, mass = problem.points, np.asarray(problem.block.mass)[..., None]
    pairs = [(np.asarray(points.K_N), np.asarray(points.C_N)), (np.asarray(points.K_T), np.asarray(points.C_T))]
    limits = np.stack([(np.sqrt(C * C + K * mass) - C) / K for K, C in pairs])
    place = tuple(np.unravel_index(np.argmin(limits), limits.shape))
    K, C = (np.broadcast_to(a, limits.shape[1:])[place[1:]] for a in pairs[place[0]])
    axis = "NT"[place[0]]
    return f"{points.names[place[-1]]} with K_{axis} = {K:.3g} N/m and C_{axis} = {C:.3g} N s/m"


def rounded_down(a: float) -> float:
    """Return a positive number cut to two digits."""
    place = 10.0 ** (np.floor(np.log10(a)) - 1)
    return float(np.floor(a / place * (1 - 1e-12)) * place)


def check(problem: Problem) -> None:
    """Refuse a problem that cannot be simulated.

    Raises
    ------
    InputError
        E-STEP, E-DURATION, E-RATE, E-SIZE, E-RANGE, E-TYPE, E-BASE: which value, why, and what to do.
    """
    check_base(problem)
    for key in ("step", "duration", "output_rate"):
        value = getattr(problem, key)
        if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
            raise InputError("E-TYPE", key, f"is {value!r}"[:120], "Give one real number.")
        if not (np.isfinite(value) and value > 0):
            raise InputError("E-RANGE", key, f"is {value!r}", "Give a positive, finite number.")
    if problem.duration < problem.step:
        raise InputError(
            "E-DURATION", "duration", f"{problem.duration:g} s is shorter than one step", "Ask for a longer run."
        )
    if problem.output_rate * problem.step > 1 + 1e-9:
        raise InputError(
            "E-RATE",
            "output_rate",
            f"{problem.output_rate:g} Hz asks for more than one row a step of {problem.step:g} s",
            f"Use at most {1 / problem.step:g} Hz or a smaller step.",
        )
    check_size(problem)
    check_points(problem.points)
    check_body(problem)
    limit = largest_step(problem)
    if problem.step > limit:
        raise InputError(
            "E-STEP",
            "step",
            f"{problem.step:g} s is too large for the stiffest contact, {stiffest(problem)}",
            f"Use a step of at most {rounded_down(limit):.2g} s.",
        )


def check_base(problem: Problem) -> None:
    """Refuse effects that cannot act on a plate that moves, beside a motion of the plate (E-TYPE, E-BASE)."""
    if problem.base is None:
        return
    if not isinstance(problem.base, BaseMotion):
        raise InputError("E-TYPE", "base", f"is {problem.base!r}"[:80], "Give a BaseMotion, or None.")
    for effect in problem.effects:
        if effect.not_shaken and not effect.is_absent():
            cure = "Leave the effect out, or the motion of the plate."
            raise InputError(
                "E-BASE", f"effect {effect.id}", f"cannot act on a plate that moves: it {effect.not_shaken}", cure
            )


#: No run is longer. Decided: 1e10 steps take the compiled engine some twenty minutes and the law weeks; a run of the
#: source has 1e6. More is a slip of the keyboard.
MOST_STEPS = 1e10

#: No response is larger [bytes]. Decided: what a desk machine still holds; 10 s of one block at 2 kHz are 1e7.
LARGEST_RESPONSE = 4e9


def check_size(problem: Problem) -> None:
    """Refuse a run of too many steps, or with a response that no memory holds, before anything is made (E-SIZE)."""
    steps, rows = problem.duration / problem.step, problem.duration * problem.output_rate + 1
    if steps > MOST_STEPS:
        raise InputError(
            "E-SIZE",
            "duration",
            f"{problem.duration:g} s in steps of {problem.step:g} s are {steps:.2g} steps, more than {MOST_STEPS:.0e}",
            "Ask for a shorter run, or check the unit of duration and step: both are in seconds.",
        )
    # x, v, Lambda, W; a force, an anchor and two flags a point
    numbers, flags = 18 + 5 * problem.points.n, 2 * problem.points.n
    size = rows * float(np.prod(problem.batch)) * (numbers * np.float64().itemsize + flags)
    if size > LARGEST_RESPONSE:
        raise InputError(
            "E-SIZE",
            "output_rate",
            f"{rows:.2g} rows{' a block' if problem.batch else ''} would take {size / 1e9:.2g} GB, "
            f"more than {LARGEST_RESPONSE / 1e9:g}",
            "Ask for fewer rows a second, or a shorter run.",
        )


#: How far the columns of a start's rotation may be from orthonormal; decided: a run of 1e5 steps in float32 ends at
#: 1e-5 and may be continued, a matrix typed by hand is off by more.
ORTHONORMAL = 1e-3


def check_body(problem: Problem) -> None:
    """Refuse a body without mass or inertia (E-RANGE), and a start that is nowhere or no rotation (E-START)."""
    block, start = problem.block, problem.start
    for key in ("mass", "g"):
        value = np.asarray(getattr(block, key))
        if not np.all(np.isfinite(value)) or np.any(value < 0) or (key == "mass" and np.any(value == 0)):
            raise InputError("E-RANGE", key, f"is {value!s}", "Give a finite number, not negative; a mass is positive.")
    check_inertia(block.inertia)
    for key in ("x", "v", "Lambda", "W"):
        if not np.all(np.isfinite(np.asarray(getattr(start, key)))):
            raise InputError("E-START", f"start.{key}", "is not finite everywhere", "Give finite numbers.")
    Lambda = np.asarray(start.Lambda)
    if np.max(np.abs(product(transposed(Lambda), Lambda) - np.eye(3))) > ORTHONORMAL:
        raise InputError(
            "E-START",
            "start.Lambda",
            "is no rotation",
            "Give a matrix with orthonormal columns, or use from_quaternion.",
        )


def check_points(points: ContactPoints) -> None:
    """Refuse contact points with a negative or non-finite property, or in no place (E-RANGE)."""
    nowhere = ~np.all(np.isfinite(np.asarray(points.P)), axis=-1)
    if np.any(nowhere):
        i = int(np.argwhere(nowhere)[0][-1])
        raise InputError("E-RANGE", f"P of point {points.names[i]}", "is not finite", "Give a place in metres.")
    for key in ("radius", "K_N", "K_T", "C_N", "C_T", "mu_0", "mu"):
        values = getattr(points, key)
        if values is None:
            continue
        values = np.asarray(values)
        bad = ~np.isfinite(values) | (values < 0)
        if key in ("K_N", "K_T"):
            bad |= values == 0
        if np.any(bad):
            i = int(np.argwhere(bad)[0][-1])
            raise InputError(
                "E-RANGE",
                f"{key} of point {points.names[i]}",
                f"is {values[bad][0]!s}",
                "Stiffness must be positive; damping, friction and radius must not be negative.",
            )
    if np.any(np.asarray(points.mu) > np.asarray(points.mu_0)):
        raise InputError("E-RANGE", "mu_0", "is below mu", "Static friction is at least as large as dynamic friction.")


def check_names(points: ContactPoints) -> None:
    """Refuse points of one name (E-KEY): columns, contacts and errors call them by it."""
    twice = [name for k, name in enumerate(points.names) if name in points.names[:k]]
    if twice:
        raise InputError("E-KEY", "names", f"{twice[0]!r} is there twice", "Give every point a name of its own.")


def whole_part(quotient: float) -> int:
    """Return how many whole ones are in it; what is short of one by the rounding of a quotient counts as one."""
    return int(np.floor(quotient * (1 + 4 * np.finfo(float).eps) + 1e-9))


def output_steps(problem: Problem) -> np.ndarray:
    """Return numbers of the steps that are recorded: for each output instant i / output_rate the nearest step, from
    0."""
    last = whole_part(problem.duration / problem.step)
    rows = whole_part(last * problem.step * problem.output_rate) + 1
    return np.unique(np.rint(np.arange(rows) / (problem.output_rate * problem.step)).astype(np.int64))


def simulate(
    problem: Problem, progress: Callable[[float], None] | None = None, dtype=None, keep_going: bool = False
) -> Response:
    """Run the law step by step.

    Parameters
    ----------
    problem : one block or a batch.
    progress : called about 200 times with the fraction done.
    dtype : float32, float64 or longdouble; by default that of the start.
    keep_going : in a batch, do not stop when one of the blocks has lost its numbers.

    Returns
    -------
    Response
        one row per output instant; its `final_state` restarts the run bit for bit.

    Raises
    ------
    InputError
        where the problem cannot be simulated.
    NumericalError
        E-NAN, where a number is no longer finite: at which step, at which point.
    """
    check(problem)
    problem = as_arrays(problem, dtype)
    with np.errstate(all="ignore"):
        state = first_evaluation(problem)
    inertia = prepared_inertia(problem.block)
    wanted = output_steps(problem)
    t = np.empty(len(wanted))
    rows = {k: np.empty((len(wanted),) + getattr(state, k).shape, getattr(state, k).dtype) for k in RECORDED}
    done = 0
    with np.errstate(all="ignore"):
        for i, count in enumerate(wanted):
            good = state
            try:
                for _ in range(done, count):
                    state = step(problem, state, inertia)
            except InputError as error:
                raise not_finite(problem, good, inertia) from error
            done = int(count)
            t[i] = state.t
            for key, column in rows.items():
                column[i] = getattr(state, key)
            if not keep_going and np.any(body_lost(state)):
                raise not_finite(problem, good, inertia)
            if progress is not None and i % max(1, len(wanted) // 200) == 0:
                progress((i + 1) / len(wanted))
    return Response(
        problem=problem, t=t, final_state=state, **{k: time_before_core(problem, c) for k, c in rows.items()}
    )


def time_before_core(problem: Problem, column: np.ndarray) -> np.ndarray:
    """Return (time, batch..., core...) -> (batch..., time, core...), as a view."""
    return np.moveaxis(column, 0, len(problem.batch))


def not_finite(problem: Problem, good: State, inertia: Inertia) -> NumericalError:
    """Return error that names the step and the contact points at which the numbers were lost, found from a good state.

    Raises InputError itself: E-ANGLE where a step turns the block too far, by a finite angle, at which step; and what
    an effect refuses.
    """
    state = good
    while not np.any(body_lost(state)) and not np.any(forces_lost(state)):
        try:
            state = step(problem, state, inertia)
        except InputError as error:
            if error.code != "E-ANGLE":
                raise
            return turned_too_far(problem, state, inertia, error)
    lost = np.argwhere(body_lost(state) | np.any(forces_lost(state), axis=-1))[0]
    # A step moves the block, then asks the points for their forces, then changes the velocities. While the block itself
    # has a place, what its points lost began with them.
    bad = np.flatnonzero(forces_lost(state)[tuple(lost)])
    names = [problem.points.names[i] for i in bad] if not pose_lost(state)[tuple(lost)] else []
    return lost_numbers(problem, state.count, state.t, lost, ", ".join(names) or "none of the contact points")


def turned_too_far(problem: Problem, state: State, inertia: Inertia, refused: InputError) -> NumericalError:
    """Return the error for a step, from `state`, whose angle is no number; raises `refused` (E-ANGLE) with the step's
    number and time where it is one."""
    JW = times(inertia.J, state.W)
    A = angular_acceleration(state.T, state.W, JW, inertia.J_inverse)
    Theta = rotation_increment(state.W, A, state.x.dtype.type(problem.step))
    count, t = state.count + 1, state.origin + (state.count + 1) * problem.step
    overflowed = ~np.isfinite(dot(Theta, Theta))
    if not np.any(overflowed):
        raise InputError(refused.code, step_name(count, t), refused.what, refused.cure) from refused
    return lost_numbers(problem, count, t, np.argwhere(overflowed)[0], "none of the contact points, its turn overflows")


def step_name(count: int, t: float) -> str:
    """Return the place of a step in a run, for an error; t [s]."""
    return f"step {count} (t = {t:.6g} s)"


def lost_numbers(problem: Problem, count: int, t: float, block: np.ndarray, where: str) -> NumericalError:
    """Return the error of a run without numbers from step `count`, time t [s], on; `block`, its place in the batch."""
    of_batch = f" of block {', '.join(map(str, block))}" if problem.batch else ""
    return NumericalError(
        "E-NAN",
        step_name(count, t),
        f"the motion{of_batch} is no longer made of finite numbers; it began at: {where}",
        "Check the start state and the parameters, or use a smaller step.",
    )


def pose_lost(state: State) -> np.ndarray:
    """Return whether position or rotation is no longer finite, (...)."""
    return ~np.all(np.isfinite(state.x) & np.all(np.isfinite(state.Lambda), axis=-1), axis=-1)


def body_lost(state: State) -> np.ndarray:
    """Return whether position, rotation or angular velocity is no longer finite, (...)."""
    return ~np.all(np.isfinite(state.x) & np.isfinite(state.W) & np.all(np.isfinite(state.Lambda), axis=-1), axis=-1)


def forces_lost(state: State) -> np.ndarray:
    """Return which contact forces are no longer finite, (..., n)."""
    return ~np.all(np.isfinite(np.asarray(state.F)), axis=-1)
