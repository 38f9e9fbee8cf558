"""Many runs of one structure from stacked arrays: no Python between the runs, all cores, the same bits on any number.

For searches and for short windows, where building a `Problem` per run would cost more than the run.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import kernel, pack, slots
from rockref.model.errors import InputError
from rockref.model.problem import Problem
from rockref.model.simulate import output_steps

#: Pieces per thread: enough that a piece of long runs does not leave the other cores idle at the end, few enough that
#: handing them out costs nothing (decided).
PIECES = 4


@dataclass(frozen=True)
class Batch:
    """B runs of n points; the columns are those of `rockref.engines.compiled.kernel` and `slots`.

    body : (B, BODY);  P : (B, n, 3) [m];  props : (B, n, PROPS);  memory : (B, n, MEMORY);  effects : (B, SLOTS)
    state : (B, STATE), the starts; without accelerations given, the run evaluates them first
    h : step [s];  wanted : (R,) or (B, R) int64, the step numbers that are recorded, rising; from a negative one on
        nothing of that run is recorded: its rows are NaN, those of a given `out` stay as they are
    forces : (B, n, 3) of the starts [N], or None; recorded only where step 0 of a given start is wanted
    """

    body: np.ndarray
    P: np.ndarray
    props: np.ndarray
    memory: np.ndarray
    effects: np.ndarray
    state: np.ndarray
    h: float
    wanted: np.ndarray
    forces: np.ndarray | None = None


def from_problems(problems: Sequence[Problem]) -> Batch:
    """The arrays of problems that share step, duration, output rate and number of points.

    Raises
    ------
    InputError
        E-STACK, where they differ in what a batch shares; E-TWIN, for an effect without a compiled twin.
    """
    problems = [pack.with_memory(p) for p in problems]
    first = problems[0]
    for p in problems[1:]:
        for key in ("step", "duration", "output_rate"):
            if getattr(p, key) != getattr(first, key):
                raise InputError("E-STACK", key, "differs between the problems of a batch", "Run them one by one.")
        if p.points.n != first.points.n:
            raise InputError("E-STACK", "points", "differ in number between the problems", "Run them one by one.")
    given = [np.zeros((p.points.n, 3)) if p.start.F is None else np.asarray(p.start.F, float) for p in problems]
    return Batch(
        body=np.stack([pack.body_row(p) for p in problems]),
        P=np.stack([np.asarray(p.points.P, float) for p in problems]),
        props=np.stack([pack.props_rows(p) for p in problems]),
        memory=np.stack([pack.memory_rows(p.start) for p in problems]),
        effects=np.stack([pack.effects_row(p) for p in problems]),
        state=np.stack([pack.state_row(p) for p in problems]),
        h=float(first.step),
        wanted=output_steps(first),
        forces=np.stack(given),
    )


def run_batch(batch: Batch, workers: int | None = None, full: bool = False, out: np.ndarray | None = None):
    """Run a batch on `workers` threads (default: all cores).

    Returns
    -------
    states : (B, R, STATE), `out` where it is given (fresh memory costs as much as short runs). A run that loses its
        numbers has NaN from the row after the first bad one on; nothing is raised, since in a search such a candidate
        is only a bad one.
    forces, memories : with `full` also (B, R, n, 3) [N] and (B, R, n, MEMORY).

    Raises
    ------
    InputError
        E-SHAPE, where the arrays do not fit together.
    """
    batch = checked(batch)
    B, n = batch.P.shape[:2]
    R = batch.wanted.shape[1]
    states = np.empty((B, R, col.STATE)) if out is None else out
    kept = B if full else 1
    forces, memories = np.empty((kept, R, n, 3)), np.empty((kept, R, n, col.MEMORY))
    loop = kernel.loop_for(batch.effects)
    written = np.zeros(B, np.int64)
    centres = pack.centres(batch.P, batch.props)

    def piece(bounds) -> None:
        loop(
            *bounds, batch.body, centres, batch.props, batch.memory, batch.forces, batch.effects, batch.state, batch.h,
            batch.wanted, full, states, forces, memories, written,
        )  # fmt: skip

    in_pieces(piece, B, workers)
    asked = np.sum(batch.wanted >= 0, axis=1) if out is not None else np.full(B, R)
    for b in np.flatnonzero(written < asked):  # lost, or not asked for
        rest = slice(written[b], asked[b])
        states[b, rest] = np.nan
        if full:
            forces[b, rest] = memories[b, rest] = np.nan
    return (states, forces, memories) if full else states


def in_pieces(piece: Callable[[tuple[int, int]], None], runs: int, workers: int | None) -> None:
    """Call `piece` with the bounds of pieces of the runs, on threads (None: as many as there are cores)."""
    workers = workers or os.cpu_count() or 1
    edges = np.linspace(0, runs, min(runs, workers * PIECES) + 1).astype(int)
    pieces = list(zip(edges[:-1], edges[1:], strict=True))
    if workers == 1 or len(pieces) == 1:
        for bounds in pieces:
            piece(bounds)
    else:
        with ThreadPoolExecutor(workers) as pool:
            list(pool.map(piece, pieces))


def checked(batch: Batch) -> Batch:
    """The batch as the compiled loop takes it; raises InputError (E-SHAPE).

    What the run writes becomes an array of its own. The others stay as they are where they are contiguous float64, and
    writeable: for those that are not, numba would compile everything once more.
    """
    B, n = np.shape(batch.P)[:2]
    wanted = np.require(np.broadcast_to(batch.wanted, (B, np.shape(batch.wanted)[-1])), np.int64, ["C", "W"])
    shapes = {
        "body": (B, col.BODY), "P": (B, n, 3), "props": (B, n, col.PROPS), "memory": (B, n, col.MEMORY),
        "effects": (B, slots.SLOTS), "state": (B, col.STATE), "forces": (B, n, 3),
    }  # fmt: skip
    given = {k: np.zeros(shape) if getattr(batch, k) is None else getattr(batch, k) for k, shape in shapes.items()}
    for key, shape in shapes.items():
        if np.shape(given[key]) != shape:
            raise InputError("E-SHAPE", f"batch.{key}", f"has shape {np.shape(given[key])}", f"Give {shape}.")
    written = {k: np.array(given[k], np.float64, order="C") for k in ("memory", "forces")}
    read = {k: np.require(given[k], np.float64, ["C", "W"]) for k in shapes if k not in written}
    return replace(batch, wanted=wanted, h=float(batch.h), **written, **read)
