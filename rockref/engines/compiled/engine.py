"""Runs of the compiled step: one problem, or many side by side on all cores."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import kernel, pack
from rockref.model.errors import NumericalError
from rockref.model.integrator import first_evaluation, prepared_inertia
from rockref.model.problem import Problem, State, as_arrays, stack
from rockref.model.response import Response, pick
from rockref.model.simulate import check, not_finite, output_steps


def simulate(problem: Problem, progress=None, keep_going: bool = False) -> Response:
    """Solve one problem, or a batch row by row, with the compiled step. Errors as in `rockref.model.simulate`."""
    check(problem)
    problem = as_arrays(problem, np.float64)
    if problem.batch:
        flat = [pick(problem, i) for i in np.ndindex(problem.batch)]
        return joined(problem, simulate_many(flat, keep_going=keep_going))
    return _one(problem, keep_going)


def simulate_many(problems: Sequence[Problem], workers: int | None = None, keep_going: bool = False) -> list[Response]:
    """Solve many problems on `workers` threads (default: all cores). Each run is by itself, so the results do not
    depend on the number of workers, bit for bit."""
    ready = [as_arrays(p, np.float64) for p in problems]
    for p in ready:
        check(p)
    with ThreadPoolExecutor(workers or os.cpu_count() or 1) as pool:
        return list(pool.map(lambda p: _one(p, keep_going), ready))


def _one(problem: Problem, keep_going: bool) -> Response:
    wanted = output_steps(problem)
    n, rows = problem.points.n, len(wanted)
    problem = pack.with_memory(problem)
    effects, props = pack.effects_row(problem), pack.props_rows(problem)
    states, forces = np.empty((rows, col.STATE)), np.empty((rows, n, 3))
    memories, done = np.empty((rows, n, col.MEMORY)), np.zeros(1, np.int64)
    read = (
        pack.body_row(problem), pack.centres(problem.points.P, props), props, pack.memory_rows(problem.start),
        np.zeros((n, 3)) if problem.start.F is None else problem.start.F.copy(), effects, pack.state_row(problem),
    )  # fmt: skip
    batch_of_one = [a[None] for a in read]
    written_to = (states[None], forces[None], memories[None], done)
    kernel.loop_for(effects)(0, 1, *batch_of_one, float(problem.step), wanted[None], True, *written_to)
    written = int(done[0])
    if not np.isfinite(states[written - 1, :18]).all() and not keep_going:
        good = problem.start
        # What the start's forces have lost, its row does not show otherwise: the law evaluates them anew.
        if written > 1 and np.isfinite(forces[written - 2]).all():
            good = pack.final_state(problem, states[written - 2], memories[written - 2], forces[written - 2])
        raise lost(problem, good)
    states[written:], forces[written:] = np.nan, np.nan
    states[written:, col.COUNT] = states[0, col.COUNT] + (wanted[written:] - wanted[0])
    states[written:, col.ORIGIN] = states[0, col.ORIGIN]
    states[written:, col.TIME] = states[0, col.ORIGIN] + states[written:, col.COUNT] * problem.step
    return Response(
        problem=problem,
        t=states[:, col.TIME],
        x=states[:, 0:3], v=states[:, 3:6], Lambda=states[:, 6:15].reshape(rows, 3, 3), W=states[:, 15:18],
        F=forces, s=memories[:, :, 0:2], anchored=memories[:, :, 2] != 0, sliding=memories[:, :, 3] != 0,
        final_state=pack.final_state(problem, states[-1], memories[-1], forces[-1]),
    )  # fmt: skip


def lost(problem: Problem, good: State) -> NumericalError:
    """The error that names step and point at which the numbers were lost: the law finds them, from a good state.

    Raises InputError (E-ANGLE) itself where a step turns the block too far, as the law does.
    """
    with np.errstate(all="ignore"):
        state = first_evaluation(replace(problem, start=good))
        return not_finite(problem, state, prepared_inertia(problem.block))


def joined(problem: Problem, responses: list[Response]) -> Response:
    """The responses of a batch's problems as one, leading axes as in the batch."""
    fields = ("x", "v", "Lambda", "W", "F", "s", "anchored", "sliding")
    rows = {k: np.stack([getattr(r, k) for r in responses]) for k in fields}
    rows = {k: a.reshape(problem.batch + a.shape[1:]) for k, a in rows.items()}
    finals = stack([replace(r.problem, start=r.final_state, effects=()) for r in responses]).start
    return Response(problem=problem, t=responses[0].t, final_state=finals, **rows)
