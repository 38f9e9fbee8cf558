"""The loop of runs that listen, compiled; the text of `rockref.model.listening` for one run after the other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import pack, slots
from rockref.engines.compiled.batch import Batch, checked, in_pieces
from rockref.engines.compiled.evaluation import make_evaluation
from rockref.engines.compiled.jit import entered, inlined
from rockref.engines.compiled.kernel import has_numbers, posed, variant_for
from rockref.engines.compiled.sources import FINGERPRINT
from rockref.engines.compiled.steps import exp_minus_identity, make_begin, make_steps, switches, turned
from rockref.model.listening import LEAST_LOAD

if TYPE_CHECKING:
    from rockref.engines.listening import Listening

#: What the loop calls by these names: each variant gets its own.
begin: Any = None
steps: Any = None


@inlined
def times_columns(r0, r1, r2, turn):
    """A row times a matrix (3, 3)."""
    return (
        r0 * turn[0, 0] + r1 * turn[1, 0] + r2 * turn[2, 0],
        r0 * turn[0, 1] + r1 * turn[1, 1] + r2 * turn[2, 1],
        r0 * turn[0, 2] + r1 * turn[1, 2] + r2 * turn[2, 2],
    )


@inlined
def attitude_correction(L, released, turn, gain):
    """The rotation vector that takes a share of the way to the attitude `released` @ turn."""
    L0, L1, L2, L3, L4, L5, L6, L7, L8 = L
    r0, r1, r2, r3, r4, r5, r6, r7, r8 = released
    O0, O1, O2 = times_columns(r0, r1, r2, turn)
    O3, O4, O5 = times_columns(r3, r4, r5, turn)
    O6, O7, O8 = times_columns(r6, r7, r8, turn)
    return (
        gain * (0.5 * ((L2 * O1 + L5 * O4 + L8 * O7) - (L1 * O2 + L4 * O5 + L7 * O8))),
        gain * (0.5 * ((L0 * O2 + L3 * O5 + L6 * O8) - (L2 * O0 + L5 * O3 + L8 * O6))),
        gain * (0.5 * ((L1 * O0 + L4 * O3 + L7 * O6) - (L0 * O1 + L3 * O4 + L6 * O7))),
    )


@inlined
def move_anchors(centres, props, memory, L, turn0, turn1, turn2, p0, p1, p2):
    """The anchors of touching points move with their feet, which turn about the loaded place."""
    L0, L1, L2, L3, L4, L5, L6, L7, L8 = L
    for i in range(centres.shape[0]):
        if memory[i, col.ANCHORED] != 0.0:
            Px, Py, Pz = centres[i, 0], centres[i, 1], centres[i, 2]
            rx = (L0 * Px + L1 * Py + L2 * Pz) - p0
            ry = (L3 * Px + L4 * Py + L5 * Pz) - p1
            rz = ((L6 * Px + L7 * Py + L8 * Pz) - props[i, col.RADIUS]) - p2
            memory[i, col.S_X] = memory[i, col.S_X] + (turn1 * rz - turn2 * ry)
            memory[i, col.S_Y] = memory[i, col.S_Y] + (turn2 * rx - turn0 * rz)


@inlined
def corrected(body, centres, props, memory, pose, bearing, released, rate, turn, hearing, gain, number):
    """The pose after the correction of a tick; moves the anchors."""
    x0, x1, x2, v0, v1, v2, L0, L1, L2, L3, L4, L5, L6, L7, L8, W0, W1, W2, a0, a1, a2, T0, T1, T2 = pose
    d0 = gain[0] * hearing[0] * (rate[0] - W0)
    d1 = gain[0] * hearing[1] * (rate[1] - W1)
    d2 = gain[0] * hearing[2] * (rate[2] - W2)
    L = (L0, L1, L2, L3, L4, L5, L6, L7, L8)
    q0, q1, q2 = attitude_correction(L, released, turn, gain[1] * hearing[3])
    load, p0, p1, p2 = bearing
    if load > LEAST_LOAD * (body[col.MASS] * body[col.GRAVITY]) * number:
        p0, p1, p2 = p0 / load, p1 / load, p2 / load
        c0 = L0 * d0 + L1 * d1 + L2 * d2
        c1 = L3 * d0 + L4 * d1 + L5 * d2
        c2 = L6 * d0 + L7 * d1 + L8 * d2
        v0, v1, v2 = v0 - (c1 * p2 - c2 * p1), v1 - (c2 * p0 - c0 * p2), v2 - (c0 * p1 - c1 * p0)
        t0 = L0 * q0 + L1 * q1 + L2 * q2
        t1 = L3 * q0 + L4 * q1 + L5 * q2
        t2 = L6 * q0 + L7 * q1 + L8 * q2
        x0, x1, x2 = x0 - (t1 * p2 - t2 * p1), x1 - (t2 * p0 - t0 * p2), x2 - (t0 * p1 - t1 * p0)
        move_anchors(centres, props, memory, L, t0, t1, t2, p0, p1, p2)
    E = exp_minus_identity(q0, q1, q2)
    L0, L1, L2 = turned(L0, L1, L2, E)
    L3, L4, L5 = turned(L3, L4, L5, E)
    L6, L7, L8 = turned(L6, L7, L8, E)
    W0, W1, W2 = W0 + d0, W1 + d1, W2 + d2
    return x0, x1, x2, v0, v1, v2, L0, L1, L2, L3, L4, L5, L6, L7, L8, W0, W1, W2, a0, a1, a2, T0, T1, T2


def _make_loop(groups: int, source: int):
    """The loop for listening runs with these groups of effects; `source` only marks the stored code."""

    def listening_loop(
        first, last, bodies, all_centres, all_props, memories, all_forces, effects, states, h, which, rates, turns,
        heard, gains, every, ticks,
    ):  # fmt: skip
        """All ticks of the listening runs `first` to `last` of a batch.

        ticks : (B, K, 3) the rates [rad/s] before the correction of each tick; rows without numbers stay as they are.
        gains : (B, 2) of rates and attitude.  The rest as in `rockref.engines.listening.Listening`, and as in `loop`.
        """
        _ = groups, source
        for b in range(first, last):
            body, centres, props, memory, forces = bodies[b], all_centres[b], all_props[b], memories[b], all_forces[b]
            e, on, state, target = effects[b], switches(effects[b]), states[b], which[b]
            pose = posed(state)
            released = pose[6:15]
            origin, count = state[col.ORIGIN], state[col.COUNT]
            sunk = (state[col.Q], state[col.Q_RATE], state[col.PITCH], state[col.PITCH_RATE])
            t = state[col.TIME]
            if state[col.GIVEN] == 0.0:
                pose = pose[:18] + begin(body, centres, props, memory, forces, e, state)
            ticks[b, 0, 0], ticks[b, 0, 1], ticks[b, 0, 2] = pose[15], pose[16], pose[17]
            for k in range(1, ticks.shape[1]):
                count, t, pose, sunk, bearing = steps(
                    every, body, centres, props, memory, forces, e, on, h, origin, count, t, pose, sunk
                )
                if not has_numbers(pose):
                    break
                ticks[b, k, 0], ticks[b, k, 1], ticks[b, k, 2] = pose[15], pose[16], pose[17]
                pose = corrected(
                    body, centres, props, memory, pose, bearing, released, rates[target, k], turns[target, k],
                    heard[target, k], gains[b], every,
                )  # fmt: skip

    return listening_loop


def _make_variant(groups: int):
    evaluate = make_evaluation(groups, listening=1)
    own = {"begin": make_begin(groups, evaluate, listening=1), "steps": make_steps(groups, evaluate, listening=1)}
    return entered(_make_loop(groups, FINGERPRINT), **own)


#: The compiled loops of listening runs by their groups of effects.
LOOPS = {groups: _make_variant(groups) for groups in slots.VARIANTS}


def run(batch: Batch, listening: Listening, workers: int | None = None) -> np.ndarray:
    """Run a batch that listens; as `rockref.engines.listening.run_listening`, whose checks are made."""
    batch = checked(batch)
    B, K = len(batch.props), listening.rates.shape[1]
    ticks = np.full((B, K, 3), np.nan)
    loop, centres = LOOPS[variant_for(batch.effects)], pack.centres(batch.P, batch.props)
    gains = np.stack([listening.gain_rate, listening.gain_attitude], axis=-1)

    def piece(bounds) -> None:
        loop(
            *bounds, batch.body, centres, batch.props, batch.memory, batch.forces, batch.effects, batch.state, batch.h,
            listening.which, listening.rates, listening.turns, listening.heard, gains, listening.every, ticks,
        )  # fmt: skip

    in_pieces(piece, B, workers)
    return ticks
