"""Many runs of one structure from stacked arrays: no Python between the runs, all cores, the same bits on any number.

For searches and for short windows, where building a `Problem` per run would cost more than the run.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np

from rockref.engines.compiled import abreast, kernel, pack, slots
from rockref.engines.compiled import columns as col
from rockref.engines.compiled.lanes import LANES
from rockref.engines.heard import Listening
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
    samples : (N, 3) accelerations of plates [m/s2], of all records one after another, or None; `slots.BASE` says where
        the record of a run begins
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
    samples: np.ndarray | None = None


def from_problems(problems: Sequence[Problem]) -> Batch:
    """Return the arrays of problems that share step, duration, output rate and number of points.

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
    return batch_of(problems, output_steps(first))


def batch_of(problems: Sequence[Problem], wanted: np.ndarray) -> Batch:
    """Return the arrays of problems of one step and number of points, their memories started, that want these rows."""
    effects, samples = pack.effects_rows(problems)
    given = [np.zeros((p.points.n, 3)) if p.start.F is None else np.asarray(p.start.F, float) for p in problems]
    bodies, feet = {id(p.block): p for p in problems}, {id(p.points): p for p in problems}
    body_rows = {key: pack.body_row(p) for key, p in bodies.items()}
    props_rows = {key: pack.props_rows(p) for key, p in feet.items()}
    return Batch(
        body=np.stack([body_rows[id(p.block)] for p in problems]),
        P=np.stack([np.asarray(p.points.P, float) for p in problems]),
        props=np.stack([props_rows[id(p.points)] for p in problems]),
        memory=np.stack([pack.memory_rows(p.start) for p in problems]),
        effects=effects,
        state=np.stack([pack.state_row(p) for p in problems]),
        h=float(problems[0].step),
        wanted=wanted,
        forces=np.stack(given),
        samples=samples,
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
    written = np.zeros(B, np.int64)
    rows = (batch.wanted, full, states, forces, memories, written)
    if B == 1:
        centres = pack.centres(batch.P, batch.props)
        kernel.loop_for(batch.effects)(
            0, 1, batch.body, centres, batch.props, batch.memory, batch.forces, batch.effects, batch.state, batch.h,
            batch.samples, *rows,
        )  # fmt: skip
    else:
        run_abreast(batch, rows, abreast.no_target(B), workers)
    asked = np.sum(batch.wanted >= 0, axis=1) if out is not None else np.full(B, R)
    for b in np.flatnonzero(written < asked):  # lost, or not asked for
        rest = slice(written[b], asked[b])
        states[b, rest] = np.nan
        if full:
            forces[b, rest] = memories[b, rest] = np.nan
    return (states, forces, memories) if full else states


#: Rows of one piece of a reduced batch, over all its runs. Decided: 64 MB of states.
ROWS_A_PIECE = 250_000


def run_reduced(batch: Batch, reduce: Callable[[np.ndarray], np.ndarray], workers: int | None = None) -> np.ndarray:
    """Run a batch of which only a summary is wanted, in memory that does not grow with the number of runs.

    reduce : makes (b, ...) of the states (b, R, STATE) of some runs, for example their largest rates.

    Returns
    -------
    (B, ...) the summaries, in the order of the runs.
    """
    B, R = len(batch.props), np.shape(batch.wanted)[-1]
    size = max(PIECES * LANES * (workers or os.cpu_count() or 1), ROWS_A_PIECE // R)
    wanted = np.broadcast_to(batch.wanted, (B, R))
    found = []
    for first in range(0, B, size):
        some = slice(first, first + size)
        runs = ("body", "P", "props", "memory", "effects", "state")
        own = {key: getattr(batch, key)[some] for key in runs}
        forces = None if batch.forces is None else batch.forces[some]
        found.append(np.array(reduce(run_batch(replace(batch, **own, wanted=wanted[some], forces=forces), workers))))
    return np.concatenate(found)


def packs_of(batch: Batch) -> list[tuple[int, np.ndarray]]:
    """Return which runs go abreast: for each variant of the loop the packs (packs, LANES); short ones repeat their last
    run.

    The runs of a pack have the same effects, inertia of the same form, and both or neither given accelerations; those
    with as many steps go together.
    """
    kind = np.concatenate(
        [
            batch.effects[:, slots.SWITCHED_BY] != 0,
            batch.body[:, [col.PRINCIPAL]] != 0,
            batch.state[:, [col.GIVEN]] != 0,
        ],
        axis=1,
    )
    _, kinds = np.unique(kind, axis=0, return_inverse=True)
    order = np.lexsort((batch.wanted.max(axis=1), kinds))
    by_variant: dict[int, list[np.ndarray]] = {}
    for same in np.split(order, np.flatnonzero(np.diff(kinds[order])) + 1):
        short = -len(same) % LANES
        filled = np.concatenate([same, np.repeat(same[-1], short)])
        by_variant.setdefault(kernel.variant_for(batch.effects[same[0]]), []).append(filled.reshape(-1, LANES))
    return [(groups, np.concatenate(packs)) for groups, packs in by_variant.items()]


def run_abreast(batch: Batch, rows: tuple, target: tuple, workers: int | None) -> None:
    """Run a checked batch in packs, on threads (None: as many as there are cores).

    rows : from `all_wanted` to `written`, target : from `which` to `ticks`, as in the compiled loop.
    """
    workers = workers or os.cpu_count() or 1
    centres, packs = pack.centres(batch.P, batch.props), packs_of(batch)
    total = sum(len(p) for _, p in packs)
    size = max(1, math.ceil(total / (workers * PIECES)))
    pieces = [(groups, p[k : k + size]) for groups, p in packs for k in range(0, len(p), size)]

    def piece(given: tuple[int, np.ndarray]) -> None:
        groups, own = given
        abreast.LOOPS[groups](
            0, len(own), own, batch.body, centres, batch.props, batch.memory, batch.forces, batch.effects, batch.state,
            batch.h, batch.samples, *rows, *target, *abreast.workspace(batch.P.shape[1]), np.zeros(LANES, np.int64),
        )  # fmt: skip

    share_out(piece, pieces, workers)


def share_out(do: Callable[[tuple], None], pieces: Sequence[tuple], workers: int) -> None:
    """Do all pieces on `workers` threads; in this one, where one is enough."""
    if workers == 1 or len(pieces) == 1:
        for given in pieces:
            do(given)
    else:
        with ThreadPoolExecutor(workers) as pool:
            list(pool.map(do, pieces))


def run_listening(batch: Batch, listening: Listening, workers: int | None = None) -> np.ndarray:
    """Run a batch that listens; as `rockref.engines.listening.run_listening`, which checks what is heard."""
    batch = checked(replace(batch, wanted=np.array([-1])))
    ticks = np.full((len(batch.props), listening.rates.shape[1], 3), np.nan)
    gains = np.stack([listening.gain_rate, listening.gain_attitude], axis=-1)
    target = (
        listening.which, listening.rates, listening.turns, listening.heard, gains, listening.every, ticks,
    )  # fmt: skip
    run_abreast(batch, abreast.no_rows(batch.wanted), target, workers)
    return ticks


def checked(batch: Batch) -> Batch:
    """Return the batch as the compiled loop takes it; raises InputError (E-SHAPE).

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
    written = {k: np.array(given[k], np.float64, order="C") for k in ("memory", "forces", "state")}
    read = {k: np.require(given[k], np.float64, ["C", "W"]) for k in shapes if k not in written}
    samples = np.require(np.zeros((1, 3)) if batch.samples is None else batch.samples, np.float64, ["C", "W"])
    return replace(batch, wanted=wanted, h=float(batch.h), samples=samples, **written, **read)
