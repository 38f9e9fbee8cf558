"""The loop over packs of runs that go abreast, in the lanes of vector registers, plain or listening.

The runs of a pack have the same effects and begin in the same way. They are copied into a workspace of lanes, make
their steps together, and stop where one of them wants a row. A run that has its rows, or has lost its numbers, goes on
unrecorded until the last of the pack has ended; it disturbs no other.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import slots
from rockref.engines.compiled.correction import HEARD, correct
from rockref.engines.compiled.evaluation import make_evaluation
from rockref.engines.compiled.jit import called, entered
from rockref.engines.compiled.lanes import LANES, as_lanes
from rockref.engines.compiled.sources import FINGERPRINT
from rockref.engines.compiled.steps import make_begin, make_steps, switches

#: What a loop calls by these names: each variant gets its own (`rockref.engines.compiled.jit.entered`).
begin: Any = None
steps: Any = None


def workspace(n: int) -> tuple[np.ndarray, ...]:
    """Return arrays of lanes for a pack of runs with n points, each from a multiple of a register on.

    In order: body, centres, props, memory, forces, effects, state, attitude at the start, what is heard, gains.
    """
    shapes = [
        (col.BODY + 1,), (n, 3), (n, col.PROPS), (n, col.MEMORY), (n, 3), (slots.SLOTS,), (col.STATE,), (9,), (HEARD,),
        (2,),
    ]  # fmt: skip
    sizes = [int(np.prod(shape)) * LANES for shape in shapes]
    whole = np.zeros(sum(sizes) + LANES)
    first = -whole.ctypes.data // whole.itemsize % LANES
    edges = first + np.cumsum([0, *sizes])
    pieces = zip(shapes, edges[:-1], edges[1:], strict=True)
    return tuple(whole[a:b].reshape(*shape, LANES) for shape, a, b in pieces)


def no_target(runs: int) -> tuple:
    """Return what the loop takes from `which` to `ticks` for runs that do not listen."""
    empty = np.zeros((1, 1, 3)), np.zeros((1, 1, 3, 3)), np.zeros((1, 1, 4))
    return np.zeros(runs, np.int64), *empty, np.zeros((runs, 2)), 0, np.zeros((1, 1, 3))


def no_rows(wanted: np.ndarray) -> tuple:
    """Return what the loop takes from `all_wanted` to `written` for runs of which no rows are wanted."""
    empty = np.zeros((1, 1, col.STATE)), np.zeros((1, 1, 1, 3)), np.zeros((1, 1, 1, col.MEMORY))
    return wanted, False, *empty, np.zeros(len(wanted), np.int64)


@called
def fill_lane(lane, source, target):
    """Copy the numbers of one run into its lane."""
    for j in range(source.shape[0]):
        target[j, lane] = source[j]


@called
def fill_lane_by_point(lane, source, target):
    """Copy the numbers by point of one run into its lane."""
    for i in range(source.shape[0]):
        for j in range(source.shape[1]):
            target[i, j, lane] = source[i, j]


@called
def lane_has_numbers(state, lane):
    """Return whether position, velocity and rates of one run are still finite."""
    x, v = state[0, lane] + state[1, lane] + state[2, lane], state[3, lane] + state[4, lane] + state[5, lane]
    return math.isfinite(x + v + (state[15, lane] + state[16, lane] + state[17, lane]))


@called
def record(runs, done, cursor, all_wanted, full, state, forces, memory, rows_state, rows_F, rows_memory, written):
    """Write the rows that are wanted after `done` steps; return the steps to the next one, or -1 where none is left."""
    after = -1
    for lane in range(LANES):
        b, row = runs[lane], cursor[lane]
        rows = all_wanted.shape[1]
        while row < rows and all_wanted[b, row] == done:
            for j in range(col.STATE):
                rows_state[b, row, j] = state[j, lane]
            if full:
                for i in range(forces.shape[0]):
                    for j in range(3):
                        rows_F[b, row, i, j] = forces[i, j, lane]
                    for j in range(col.MEMORY):
                        rows_memory[b, row, i, j] = memory[i, j, lane]
            row += 1
            written[b] = row
            if not lane_has_numbers(state, lane):
                row = rows
        if row < rows and all_wanted[b, row] >= 0:
            wait = all_wanted[b, row] - done
            after = wait if after < 0 else min(after, wait)
        cursor[lane] = row
    return after


@called
def hear(runs, k, cursor, which, rates, turns, heard, state, tick, ticks):
    """Write the rates at tick k, and read what is heard there; return whether some run goes on.

    cursor : 0, and 1 for a run that has lost its numbers.
    """
    goes_on = False
    for lane in range(LANES):
        b = runs[lane]
        if k > 0 and not lane_has_numbers(state, lane):
            cursor[lane] = 1
        if cursor[lane] == 0:
            goes_on = True
            for j in range(3):
                ticks[b, k, j] = state[15 + j, lane]
        m = which[b]
        for j in range(3):
            tick[j, lane] = rates[m, k, j]
            for i in range(3):
                tick[3 + 3 * i + j, lane] = turns[m, k, i, j]
        for j in range(4):
            tick[12 + j, lane] = heard[m, k, j]
    return goes_on and k + 1 < ticks.shape[1]


def _make_loop(groups: int, lanes: int, source: int):
    """Make the loop for packs of runs with these groups of effects; `lanes` and `source` only mark the stored code."""

    def abreast(
        first, last, packs, bodies, all_centres, all_props, memories, all_forces, effects, states, h, samples,
        all_wanted, full, rows_state, rows_F, rows_memory, written, which, rates, turns, heard, all_gains, every, ticks,
        body_, centres_, props_, memory_, forces_, effects_, state_, released_, tick_, gains_, cursor,
    ):  # fmt: skip
        """Run all steps of the packs `first` to `last`; plain runs where `every` is 0, else ticks of listening ones.

        packs : (packs, LANES) the runs of each, the last one again where there are fewer.  From `bodies` to `written`
        as in `rockref.engines.compiled.kernel`; from `which` on as in `rockref.engines.heard.Listening`, with gains
        (B, 2) and ticks (B, K, 3), rows without numbers stay as they are.  The rest: see `workspace`;
        cursor : (LANES,) the next row of each run.
        """
        _ = groups, lanes, source  # held, so that numba's files on disk belong to this variant of this very text
        body, centres, props, memory = as_lanes(body_), as_lanes(centres_), as_lanes(props_), as_lanes(memory_)
        forces, e, state, released = as_lanes(forces_), as_lanes(effects_), as_lanes(state_), as_lanes(released_)
        tick, gains = as_lanes(tick_), as_lanes(gains_)
        for p in range(first, last):
            runs = packs[p]
            on = switches(effects[runs[0]])
            for lane in range(LANES):
                b = runs[lane]
                fill_lane(lane, bodies[b], body_)
                body_[col.ONSET, lane] = h if every > 0 else 0.0
                fill_lane(lane, effects[b], effects_)
                fill_lane(lane, states[b], state_)
                fill_lane(lane, states[b, col.L : col.L + 9], released_)
                fill_lane(lane, all_gains[b], gains_)
                fill_lane_by_point(lane, all_centres[b], centres_)
                fill_lane_by_point(lane, all_props[b], props_)
                fill_lane_by_point(lane, memories[b], memory_)
                fill_lane_by_point(lane, all_forces[b], forces_)
                cursor[lane] = 0
            if state_[col.GIVEN, 0] == 0.0:
                begin(body, centres, props, memory, forces, e, on, samples, state)
                state[col.GIVEN] = 1.0
            done, k, bearing = 0, 0, (0.0, 0.0, 0.0, 0.0)
            while True:
                if every > 0:
                    if not hear(runs, k, cursor, which, rates, turns, heard, state_, tick_, ticks):
                        break
                    if k > 0:
                        correct(body, centres, props, memory, state, bearing, released, tick, gains, every)
                    k, number = k + 1, every
                else:
                    number = record(
                        runs, done, cursor, all_wanted, full, state_, forces_, memory_, rows_state, rows_F,
                        rows_memory, written,
                    )  # fmt: skip
                    if number < 0:
                        break
                bearing = steps(number, body, centres, props, memory, forces, e, on, h, samples, state)
                done += number

    return abreast


def _make_variant(groups: int):
    evaluate = make_evaluation(groups, bearing=1)
    own = {"begin": make_begin(groups, evaluate), "steps": make_steps(groups, evaluate, bearing=1)}
    return entered(_make_loop(groups, LANES, FINGERPRINT), **own)


#: The compiled loops by their groups of effects.
LOOPS = {groups: _make_variant(groups) for groups in slots.VARIANTS}
