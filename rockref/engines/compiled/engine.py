"""Runs of the compiled step: one problem, or many side by side on all cores."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import kernel, pack
from rockref.engines.compiled.batch import batch_of, run_batch
from rockref.model.errors import NumericalError
from rockref.model.integrator import first_evaluation, prepared_inertia
from rockref.model.problem import Problem, State, as_arrays, stack
from rockref.model.response import Response, pick
from rockref.model.simulate import check, not_finite, output_steps

#: What is called with the fraction done, or None where nobody looks.
Progress = Callable[[float], None] | None


#: Steps between two reports of a run. Decided: a tenth of a second at most; the call itself takes some 1e-5 s.
STEPS_A_REPORT = 100_000

#: Runs between two reports of many, for each thread. Decided: a few packs, so that short ones cost little.
RUNS_A_REPORT = 32


def simulate(problem: Problem, progress: Progress = None, keep_going: bool = False) -> Response:
    """Solve one problem, or a batch row by row, with the compiled step. Errors as in `rockref.model.simulate`.

    progress : called with the fraction done, after every `STEPS_A_REPORT` steps of one block, after every run of a
        batch. The bits do not depend on it.
    """
    check(problem)
    problem = as_arrays(problem, np.float64)
    if problem.batch:
        flat = [pick(problem, i) for i in np.ndindex(problem.batch)]
        return joined(problem, simulate_many(flat, keep_going=keep_going, progress=progress))
    return _one(problem, keep_going, progress)


def simulate_many(
    problems: Sequence[Problem], workers: int | None = None, keep_going: bool = False, progress: Progress = None
) -> list[Response]:
    """Solve many problems on `workers` threads (default: all cores), those of one step and number of points abreast.

    Each run is by itself, so the results do not depend on the number of workers or on what stands beside a run, bit for
    bit. `progress` is called with the fraction of the runs that are done.
    """
    ready = [as_arrays(p, np.float64) for p in problems]
    for p in ready:
        check(p)
    ready = [pack.with_memory(p) for p in ready]
    alike: dict[tuple[float, int], list[int]] = {}
    for i, p in enumerate(ready):
        alike.setdefault((float(p.step), p.points.n), []).append(i)
    responses: dict[int, Response] = {}
    size = len(ready) if progress is None else RUNS_A_REPORT * (workers or os.cpu_count() or 1)
    for members in alike.values():
        for first in range(0, len(members), size):
            some = members[first : first + size]
            for i, response in zip(some, _abreast([ready[i] for i in some], workers, keep_going), strict=True):
                responses[i] = response
            if progress is not None:
                progress(len(responses) / len(ready))
    return [responses[i] for i in range(len(ready))]


def _abreast(problems: list[Problem], workers: int | None, keep_going: bool) -> list[Response]:
    """Solve problems of one step and number of points, with their memories started, in one batch."""
    steps = [output_steps(p) for p in problems]
    wanted = np.full((len(problems), max(map(len, steps))), -1)
    for b, own in enumerate(steps):
        wanted[b, : len(own)] = own
    rows = run_batch(batch_of(problems, wanted), workers, full=True)
    responses = []
    for b, own in enumerate(steps):
        states, forces, memories = (a[b, : len(own)] for a in rows)
        written = _rows_with_numbers(states)
        responses.append(_response(problems[b], own, states, forces, memories, written, keep_going))
    return responses


def _rows_with_numbers(states: np.ndarray) -> int:
    """Return how many rows (R, STATE) the loop has written: to the first one without numbers, which counts."""
    lost = ~np.isfinite(states[:, 0:3].sum(1) + states[:, 3:6].sum(1) + states[:, 15:18].sum(1))
    return int(np.argmax(lost)) + 1 if lost.any() else len(states)


def _in_pieces(loop, read: list, h: float, samples, wanted: np.ndarray, written_to: tuple, progress: Progress) -> int:
    """Run the loop over a piece of the rows after the other, and return how many rows were written.

    A piece starts from the last row of the piece before, which holds all that the step carries on (memories and forces
    stay in their arrays): the bits are those of one call.
    """
    *rest, state = read
    done, total = np.zeros(1, np.int64), len(wanted)
    many = progress is not None and wanted[-1] > STEPS_A_REPORT
    size = max(1, int(total * STEPS_A_REPORT / wanted[-1])) if many else total
    for first in range(0, total, size):
        last, before = min(first + size, total), int(wanted[first - 1]) if first else 0
        rows = [a[:, first:last] for a in written_to]
        loop(0, 1, *rest, state, h, samples, (wanted[first:last] - before)[None], True, *rows, done)
        end = first + int(done[0])
        if progress is not None:
            progress(end / total)
        if end < last or not _has_numbers(written_to[0][0, end - 1]):
            return end
        state = written_to[0][:, end - 1].copy()
    return total


def _has_numbers(row: np.ndarray) -> bool:
    """Return whether a row (STATE,) is still made of numbers, by the test with which the loop ends a run."""
    return bool(np.isfinite(row[0:3].sum() + row[3:6].sum() + row[15:18].sum()))


def _one(problem: Problem, keep_going: bool, progress: Progress = None) -> Response:
    wanted = output_steps(problem)
    n, rows = problem.points.n, len(wanted)
    problem = pack.with_memory(problem)
    (effects,), samples = pack.effects_rows([problem])
    props = pack.props_rows(problem)
    states, forces = np.empty((rows, col.STATE)), np.empty((rows, n, 3))
    memories = np.empty((rows, n, col.MEMORY))
    read = (
        pack.body_row(problem), pack.centres(problem.points.P, props), props, pack.memory_rows(problem.start),
        np.zeros((n, 3)) if problem.start.F is None else problem.start.F.copy(), effects, pack.state_row(problem),
    )  # fmt: skip
    batch_of_one = [a[None] for a in read]
    written_to = (states[None], forces[None], memories[None])
    loop, h = kernel.loop_for(effects), float(problem.step)
    written = _in_pieces(loop, batch_of_one, h, samples, wanted, written_to, progress)
    return _response(problem, wanted, states, forces, memories, written, keep_going)


def _response(problem: Problem, wanted, states, forces, memories, written: int, keep_going: bool) -> Response:
    """Return rows of a run as a Response, or the error where it has lost its numbers; `written` of them hold some."""
    rows = len(wanted)
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
    """Return the error that names step and point at which the numbers were lost: the law finds them, from a good state.

    Raises InputError (E-ANGLE) itself where a step turns the block too far, as the law does.
    """
    with np.errstate(all="ignore"):
        state = first_evaluation(replace(problem, start=good))
        return not_finite(problem, state, prepared_inertia(problem.block))


def joined(problem: Problem, responses: list[Response]) -> Response:
    """Return the responses of a batch's problems as one, leading axes as in the batch."""
    fields = ("x", "v", "Lambda", "W", "F", "s", "anchored", "sliding")
    rows = {k: np.stack([getattr(r, k) for r in responses]) for k in fields}
    rows = {k: a.reshape(problem.batch + a.shape[1:]) for k, a in rows.items()}
    finals = stack([replace(r.problem, start=r.final_state, effects=()) for r in responses]).start
    return Response(problem=problem, t=responses[0].t, final_state=finals, **rows)
