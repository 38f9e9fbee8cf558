"""The loop: Problem -> Response."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rockref.model.errors import InputError, NumericalError
from rockref.model.integrator import Inertia, first_evaluation, prepared_inertia, step
from rockref.model.problem import ContactPoints, Problem, State, as_arrays
from rockref.model.response import Response

RECORDED = ("x", "v", "Lambda", "W", "F", "s", "anchored", "sliding")

#: Largest product of step and contact frequency. The explicit step is stable for omega h < 2 without damping; with the
#: damping ratio beta the central-difference limit shrinks to 2 (sqrt(1 + beta^2) - beta) (Hughes 2000, ch. 9), and one
#: foot of the block meets an effective mass below the block's: decided, refuse above 1.
STABILITY_LIMIT = 1.0


def contact_frequency(problem: Problem) -> float:
    """Upper bound of the contact angular frequency [rad/s]: stiffest point against the least effective mass.

    A point at P feels 1/m_eff = 1/m + |P|^2 / J_min (the exact value uses n x P; |P| bounds it).
    """
    block, points = problem.block, problem.points
    J_least = np.min(np.linalg.eigvalsh(np.asarray(block.inertia, float)), axis=-1)
    lever = np.sqrt(np.sum(np.asarray(points.P, float)[..., :2] ** 2, axis=-1))
    J_most = np.max(np.linalg.eigvalsh(np.asarray(block.inertia, float)), axis=-1)
    height = np.max(np.abs(np.asarray(points.P, float)), axis=-1)
    compliance = 1 / np.asarray(block.mass, float)[..., None] + lever**2 / J_least[..., None]
    compliance = np.maximum(compliance, 1 / np.asarray(block.mass, float)[..., None] + height**2 / J_most[..., None])
    K = np.maximum(np.asarray(points.K_N, float), np.asarray(points.K_T, float))
    return float(np.sqrt(np.max(K * compliance)))


def check(problem: Problem) -> None:
    """Refuse a problem that cannot be simulated.

    Raises
    ------
    InputError
        E-STEP, E-DURATION, E-RATE, E-RANGE: which value, why, and what to do.
    """
    for key in ("step", "duration", "output_rate"):
        value = getattr(problem, key)
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
    check_points(problem.points)
    if problem.points.n:
        omega = contact_frequency(problem)
        if omega * problem.step > STABILITY_LIMIT:
            raise InputError(
                "E-STEP",
                "step",
                f"{problem.step:g} s is too large for the stiffest contact ({omega:.4g} rad/s)",
                f"Use a step of at most {STABILITY_LIMIT / omega:.2g} s.",
            )


def check_points(points: ContactPoints) -> None:
    """Refuse contact points with a negative or non-finite property (E-RANGE)."""
    for key, least in (("K_N", 0), ("K_T", 0), ("C_N", 0), ("C_T", 0), ("mu_0", 0), ("mu", 0), ("radius", 0)):
        values = getattr(points, key)
        if values is None:
            continue
        values = np.asarray(values)
        bad = ~np.isfinite(values) | (values < least)
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


def output_steps(problem: Problem) -> np.ndarray:
    """Numbers of the steps that are recorded: for each output instant i / output_rate the nearest step, from 0."""
    last = int(np.floor(problem.duration / problem.step + 1e-9))
    rows = int(np.floor(last * problem.step * problem.output_rate + 1e-9)) + 1
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
            for _ in range(done, count):
                state = step(problem, state, inertia)
            done = int(count)
            t[i] = state.t
            for key, column in rows.items():
                column[i] = getattr(state, key)
            if not keep_going and not (np.all(np.isfinite(state.W)) and np.all(np.isfinite(state.x))):
                raise not_finite(problem, good, inertia)
            if progress is not None and i % max(1, len(wanted) // 200) == 0:
                progress((i + 1) / len(wanted))
    return Response(
        problem=problem, t=t, final_state=state, **{k: time_before_core(problem, c) for k, c in rows.items()}
    )


def time_before_core(problem: Problem, column: np.ndarray) -> np.ndarray:
    """(time, batch..., core...) -> (batch..., time, core...), as a view."""
    return np.moveaxis(column, 0, len(problem.batch))


def not_finite(problem: Problem, good: State, inertia: Inertia) -> NumericalError:
    """The error that names the step and the contact point at which the numbers were lost, found from a good state."""
    state = good
    while np.all(np.isfinite(state.W)) and np.all(np.isfinite(state.x)):
        state = step(problem, state, inertia)
    force = np.zeros_like(problem.points.P) if state.F is None else state.F
    bad = np.argwhere(~np.all(np.isfinite(force), axis=-1))
    point = problem.points.names[int(bad[0][-1])] if len(bad) else "none of the contact points"
    of_batch = ""
    if problem.batch:
        lost = np.argwhere(~np.all(np.isfinite(state.W), axis=-1) | ~np.all(np.isfinite(state.x), axis=-1))[0]
        of_batch = f" of block {', '.join(map(str, lost))}"
    return NumericalError(
        "E-NAN",
        f"step {state.count} (t = {state.t:.6g} s)",
        f"position or angular velocity{of_batch} is no longer a finite number; first bad contact force: {point}",
        "Check the start state and the parameters, or use a smaller step.",
    )
