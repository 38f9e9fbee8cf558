"""Many runs on moving plates of which only extremes are kept: lanes that take the next run when theirs has ended.

Memory does not grow with the length of a run: a tick after the other is looked at, and nothing is written but one row a
run. A run that ends early makes room, so no lane waits for the longest of a pack.
"""

from __future__ import annotations

import os
from dataclasses import replace
from typing import Any

import numpy as np

from rockref.engines.compiled import abreast, kernel, pack, slots
from rockref.engines.compiled import columns as col
from rockref.engines.compiled.batch import PIECES, Batch, checked, packs_of, share_out
from rockref.engines.compiled.evaluation import make_evaluation
from rockref.engines.compiled.jit import entered
from rockref.engines.compiled.lanes import LANES, as_lanes
from rockref.engines.compiled.sources import FINGERPRINT
from rockref.engines.compiled.steps import make_steps, switches
from rockref.engines.compiled.watching import FOOT, FOUND, KEPT, begin_watch, watch

#: What a loop calls by these names: each variant gets its own (`rockref.engines.compiled.jit.entered`).
steps: Any = None


def _make_loop(groups: int, lanes: int, source: int):
    """Make the loop for runs with these groups of effects; `lanes` and `source` only mark the stored code."""

    def shaken(
        queue, bodies, all_centres, all_props, memories, all_forces, effects, states, h, samples, limits, every,
        ticks, quiet, found, body_, centres_, props_, memory_, forces_, effects_, state_, foot, kept, cursor,
    ):  # fmt: skip
        """Run all runs of the queue; found (B, FOUND) is written.

        every : steps from tick to tick.  ticks, quiet : (B,) how many ticks a run has, and after which rest counts.
        cursor : (LANES,) the run of each lane, -1 where it has none.  States have their accelerations given.
        """
        _ = groups, lanes, source  # held, so that numba's files on disk belong to this variant of this very text
        body, centres, props, memory = as_lanes(body_), as_lanes(centres_), as_lanes(props_), as_lanes(memory_)
        forces, e, state = as_lanes(forces_), as_lanes(effects_), as_lanes(state_)
        on = switches(effects[queue[0]])
        following, busy = 0, 0
        for lane in range(LANES):
            cursor[lane] = -2
        while True:
            for lane in range(LANES):
                if cursor[lane] >= 0:
                    b = cursor[lane]
                    if not watch(lane, state_, memory_, foot, kept, found[b], limits, ticks[b], quiet[b]):
                        continue
                    busy -= 1
                if cursor[lane] != -1:
                    b = queue[min(following, queue.shape[0] - 1)]  # a lane without a run goes on with some numbers
                    abreast.fill_lane(lane, bodies[b], body_)
                    abreast.fill_lane(lane, effects[b], effects_)
                    abreast.fill_lane(lane, states[b], state_)
                    abreast.fill_lane_by_point(lane, all_centres[b], centres_)
                    abreast.fill_lane_by_point(lane, all_props[b], props_)
                    abreast.fill_lane_by_point(lane, memories[b], memory_)
                    abreast.fill_lane_by_point(lane, all_forces[b], forces_)
                    if following < queue.shape[0]:
                        begin_watch(lane, state_, centres_, memory_, foot, kept, found[b])
                        cursor[lane] = b
                        busy += 1
                    else:
                        cursor[lane] = -1
                    following += 1
            if busy == 0:
                break
            steps(every, body, centres, props, memory, forces, e, on, h, samples, state)

    return shaken


def _make_variant(groups: int):
    evaluate = make_evaluation(groups, bearing=0)
    return entered(_make_loop(groups, LANES, FINGERPRINT), steps=make_steps(groups, evaluate, bearing=0))


#: The compiled loops: motion of the plate alone, and beside effects of any kind.
LOOPS = {groups: _make_variant(groups) for groups in (slots.SHAKEN, slots.ALL)}


def run_shaken(batch: Batch, limits: np.ndarray, every: int, ticks: Any, quiet: Any, workers: int | None = None):
    """Run a batch on `workers` threads (default: all cores), and return what `watching` has found, (B, FOUND).

    limits : as in `rockref.engines.compiled.watching`;  every : steps a tick;  ticks, quiet : (B,) or one number.
    The bits do not depend on the number of workers or on the order of the runs.
    """
    workers = workers or os.cpu_count() or 1
    batch = checked(replace(batch, wanted=np.array([0])))
    evaluate_starts(batch)
    B, n = batch.P.shape[:2]
    found = np.zeros((B, FOUND))
    centres = pack.centres(batch.P, batch.props)
    of_run = [np.require(np.broadcast_to(np.asarray(a, float), (B,)), float, ["C", "W"]) for a in (ticks, quiet)]
    queues = []
    for groups, packs in packs_of(batch):
        runs = np.array(list(dict.fromkeys(packs.ravel().tolist())))
        kinds = np.unique(batch.effects[runs][:, slots.SWITCHED_BY] != 0, axis=0, return_inverse=True)[1].ravel()
        variant = groups if groups in LOOPS else slots.ALL
        for kind in range(kinds.max() + 1):
            own = runs[kinds == kind]
            size = max(LANES, -(-len(own) // (workers * PIECES)))
            queues += [(variant, own[k : k + size]) for k in range(0, len(own), size)]

    def piece(given: tuple[int, np.ndarray]) -> None:
        variant, queue = given
        body, centres_, props, memory, forces, effects, state, *_ = abreast.workspace(n)
        LOOPS[variant](
            queue, batch.body, centres, batch.props, batch.memory, batch.forces, batch.effects, batch.state, batch.h,
            batch.samples, np.asarray(limits, float), every, *of_run, found, body, centres_, props, memory, forces,
            effects, state, np.zeros((n, FOOT, LANES)), np.zeros((KEPT, LANES)), np.zeros(LANES, np.int64),
        )  # fmt: skip

    share_out(piece, queues, workers)
    return found


def evaluate_starts(batch: Batch) -> None:
    """Make the first force evaluation of every run whose start has none; writes into the batch."""
    B, n = batch.P.shape[:2]
    rows = np.zeros((B, 1, col.STATE)), np.zeros((B, 1, n, 3)), np.zeros((B, 1, n, col.MEMORY))
    centres = pack.centres(batch.P, batch.props)
    for groups, packs in packs_of(batch):
        for b in dict.fromkeys(packs.ravel().tolist()):
            kernel.LOOPS[groups](
                b, b + 1, batch.body, centres, batch.props, batch.memory, batch.forces, batch.effects, batch.state,
                batch.h, batch.samples, batch.wanted, True, *rows, np.zeros(B, np.int64),
            )  # fmt: skip
