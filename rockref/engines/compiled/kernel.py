"""The loops over the rows of a run, compiled.

One function makes each loop once for the law alone, once for each group of effects, and once for all of them
(`rockref.engines.compiled.slots.VARIANTS`), so that the law pays nothing for the effects and one effect little for the
others. A variant is compiled when it is first needed. It holds the fingerprint of the sources and its groups, by which
numba's files of compiled code are told apart.
"""

from __future__ import annotations

import math
from typing import Any

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import slots
from rockref.engines.compiled.evaluation import make_evaluation
from rockref.engines.compiled.jit import entered, inlined
from rockref.engines.compiled.sources import FINGERPRINT
from rockref.engines.compiled.steps import make_begin, make_steps, switches

#: What a loop calls by these names: each variant gets its own (`rockref.engines.compiled.jit.entered`).
begin: Any = None
steps: Any = None


@inlined
def has_numbers(state):
    """Return whether position, velocity and rates are still finite."""
    x, v, W = state[0] + state[1] + state[2], state[3] + state[4] + state[5], state[15] + state[16] + state[17]
    return math.isfinite(x + v + W)


def _make_loop(groups: int, source: int):
    """Make the loop for runs with these groups of effects; `source` only marks the stored code."""

    def loop(
        first, last, bodies, all_centres, all_props, memories, all_forces, effects, states, h, samples, all_wanted,
        full, all_rows_state, all_rows_F, all_rows_memory, written,
    ):  # fmt: skip
        """Step the runs `first` to `last` of a batch to their ends; rows are written at the numbers `wanted`, and none
        from a negative one on.

        all_centres : contact points, raised by their radius.  samples : (N, 3) of the plate's motion.
        written : (B,) the number of rows written; a run ends with the first row without numbers.
        The rest as in `rockref.engines.compiled.batch.Batch`.
        """
        _ = groups, source  # held, so that numba's files on disk belong to this variant of this very text
        for b in range(first, last):
            k = b if full else 0
            body, centres, props, memory, forces = bodies[b], all_centres[b], all_props[b], memories[b], all_forces[b]
            e, on, state, wanted = effects[b], switches(effects[b]), states[b], all_wanted[b]
            rows_state, rows_F, rows_memory = all_rows_state[b], all_rows_F[k], all_rows_memory[k]
            if state[col.GIVEN] == 0.0:
                begin(body, centres, props, memory, forces, e, on, samples, state)
                state[col.GIVEN] = 1.0
            done = 0
            for row in range(wanted.shape[0]):
                if wanted[row] < 0:
                    break
                steps(wanted[row] - done, body, centres, props, memory, forces, e, on, h, samples, state)
                done = wanted[row]
                for j in range(col.STATE):
                    rows_state[row, j] = state[j]
                if full:
                    for i in range(centres.shape[0]):
                        for j in range(3):
                            rows_F[row, i, j] = forces[i, j]
                        for j in range(col.MEMORY):
                            rows_memory[row, i, j] = memory[i, j]
                written[b] = row + 1
                if not has_numbers(state):
                    break

    return loop


def _make_variant(groups: int):
    evaluate = make_evaluation(groups, bearing=0)
    own = {"begin": make_begin(groups, evaluate), "steps": make_steps(groups, evaluate, bearing=0)}
    return entered(_make_loop(groups, FINGERPRINT), **own)


#: The compiled loops by their groups of effects.
LOOPS = {groups: _make_variant(groups) for groups in slots.VARIANTS}


def variant_for(effects) -> int:
    """Return the groups of the variant for runs with these numbers of effects, (..., SLOTS): no more than they need."""
    needed = sum(group for group, at in slots.GROUPS.items() if effects[..., at].any())
    return needed if needed in slots.VARIANTS else slots.ALL


def loop_for(effects):
    """Return the loop for runs with these numbers of effects, (..., SLOTS)."""
    return LOOPS[variant_for(effects)]
