"""The loop over the steps, compiled. Operation for operation the text of `rockref.model`; rule ids at the margin.

One function makes the loop once for the law alone, once for each group of effects, and once for all of them
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
from rockref.engines.compiled.jit import called, entered, inlined, marked
from rockref.engines.compiled.loads import advance_support, of_time
from rockref.engines.compiled.sources import FINGERPRINT


@inlined
def _times(body, at, x, y, z):
    """J or J^-1, which stand in `body` from column `at`, times a vector."""
    if body[col.PRINCIPAL] != 0.0:
        return body[at] * x, body[at + 4] * y, body[at + 8] * z
    return (
        body[at] * x + body[at + 1] * y + body[at + 2] * z,
        body[at + 3] * x + body[at + 4] * y + body[at + 5] * z,
        body[at + 6] * x + body[at + 7] * y + body[at + 8] * z,
    )


@called
def _long_series(t):
    s = c = 1.0 if t <= 10.24 else math.nan  # beyond 3.2 rad the law refuses the step: the caller finds out where
    for k in range(17, 0, -1):
        s = 1.0 - t * s * (1.0 / (2 * k * (2 * k + 1)))
        c = 1.0 - t * c * (1.0 / ((2 * k + 1) * (2 * k + 2)))
    return s, c / 2


@inlined
def _series(t):
    """sin(theta)/theta and (1 - cos(theta))/theta^2 from t = theta^2, as `rotation.series_coefficients`."""
    if not t <= 1e-4:
        return _long_series(t)
    s = 1.0 - t * 1.0 * (1.0 / 42.0)
    s = 1.0 - t * s * (1.0 / 20.0)
    s = 1.0 - t * s * (1.0 / 6.0)
    c = 1.0 - t * 1.0 * (1.0 / 56.0)
    c = 1.0 - t * c * (1.0 / 30.0)
    c = 1.0 - t * c * (1.0 / 12.0)
    return s, c / 2


@inlined
def _turned(m0, m1, m2, E0, E1, E2, E3, E4, E5, E6, E7, E8):
    """The row m (I + E)."""
    return (
        m0 + (m0 * E0 + m1 * E3 + m2 * E6),
        m1 + (m0 * E1 + m1 * E4 + m2 * E7),
        m2 + (m0 * E2 + m1 * E5 + m2 * E8),
    )


@inlined
def switches(e):
    """Which effects are on, from their numbers (SLOTS,)."""
    return slots.Switches(
        e[slots.HERTZ] != 0.0, e[slots.HYSTERESIS] != 0.0, e[slots.HUNT] != 0.0, e[slots.ORIENTATION] != 0.0,
        e[slots.STRIBECK] != 0.0, e[slots.LOAD] != 0.0, e[slots.ADHESION] != 0.0, e[slots.VISCOUS] != 0.0,
        e[slots.NORMALS] != 0.0, e[slots.SPIN] != 0.0, e[slots.ROLLING] != 0.0, e[slots.DRAG] != 0.0,
        e[slots.CABLE] != 0.0, e[slots.WIRE] != 0.0, e[slots.VIBRATION] != 0.0, e[slots.TILT] != 0.0,
        e[slots.SUPPORT] != 0.0,
    )  # fmt: skip


def _make_begin(groups: int, evaluate):
    """The first force evaluation of a run with these groups of effects."""

    def begin(body, centres, props, memory, forces, e, s):
        """a and T (6) at the start; forces and memories are written."""
        forces[:, :] = 0.0
        on = switches(e)
        sunk = (s[col.Q], s[col.Q_RATE], s[col.PITCH], s[col.PITCH_RATE])
        a0, a1, a2, T0, T1, T2, _, _ = evaluate(
            body, centres, props, memory, forces, e, on, of_time(on, e, s[col.TIME]), sunk,
            s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[8], s[9], s[10], s[11], s[12], s[13], s[14],
            s[15], s[16], s[17], (0.0, 0.0, 0.0),
        )  # fmt: skip
        for i in range(centres.shape[0]):
            if memory[i, col.ANCHORED] == 0.0:  # only a touching point slides and remembers, whatever the start says
                for j in range(col.SLIDING, col.MEMORY):
                    memory[i, j] = 0.0
        return a0, a1, a2, T0, T1, T2

    return called(marked(begin, groups))


#: What the loop calls by these names: each variant gets its own (`rockref.engines.compiled.jit.entered`).
begin: Any = None
evaluate: Any = None


def _make_loop(groups: int, source: int):
    """The loop for runs with these groups of effects; `source` only marks the stored code."""
    loads, plate = groups & slots.LOADS, groups & slots.PLATE

    def loop(
        first, last, bodies, all_centres, all_props, memories, all_forces, effects, states, h, all_wanted, full,
        all_rows_state, all_rows_F, all_rows_memory, written,
    ):  # fmt: skip
        """All steps of the runs `first` to `last` of a batch; rows are written at the step numbers `wanted`, and none
        from a negative one on.

        all_centres : contact points, raised by their radius.  written : (B,) the number of rows written; a run ends
        with the first row without numbers.  The rest as in `rockref.engines.compiled.batch.Batch`.
        """
        _ = groups, source  # held, so that numba's files on disk belong to this variant of this very text
        for b in range(first, last):
            k = b if full else 0
            body, centres, props, memory, forces = bodies[b], all_centres[b], all_props[b], memories[b], all_forces[b]
            e, on, state, wanted = effects[b], switches(effects[b]), states[b], all_wanted[b]
            rows_state, rows_F, rows_memory = all_rows_state[b], all_rows_F[k], all_rows_memory[k]
            x0, x1, x2, v0, v1, v2 = state[0], state[1], state[2], state[3], state[4], state[5]
            L0, L1, L2, L3, L4, L5 = state[6], state[7], state[8], state[9], state[10], state[11]
            L6, L7, L8, W0, W1, W2 = state[12], state[13], state[14], state[15], state[16], state[17]
            a0, a1, a2, T0, T1, T2 = state[18], state[19], state[20], state[21], state[22], state[23]
            origin, count = state[col.ORIGIN], state[col.COUNT]
            sunk = (state[col.Q], state[col.Q_RATE], state[col.PITCH], state[col.PITCH_RATE])
            done, t = 0, state[col.TIME]
            if state[col.GIVEN] == 0.0:
                a0, a1, a2, T0, T1, T2 = begin(body, centres, props, memory, forces, e, state)
            half, half_square = h / 2, h * h / 2
            for row in range(wanted.shape[0]):
                if wanted[row] < 0:
                    break
                for _ in range(done, wanted[row]):
                    count += 1.0
                    t = origin + count * h
                    timed = of_time(on, e, t) if loads else (0.0, 0.0)
                    JW0, JW1, JW2 = _times(body, col.J, W0, W1, W2)
                    A0, A1, A2 = _times(
                        body, col.J_INVERSE,
                        T0 - (W1 * JW2 - W2 * JW1), T1 - (W2 * JW0 - W0 * JW2), T2 - (W0 * JW1 - W1 * JW0),
                    )  # fmt: skip
                    x0 = x0 + h * v0 + half_square * a0  # I1
                    x1 = x1 + h * v1 + half_square * a1
                    x2 = x2 + h * v2 + half_square * a2
                    tx = h * W0 + half_square * A0  # I2
                    ty = h * W1 + half_square * A1
                    tz = h * W2 + half_square * A2
                    xx, yy, zz = tx * tx, ty * ty, tz * tz
                    s, c = _series(xx + yy + zz)
                    E0, E4, E8 = -c * (zz + yy), -c * (zz + xx), -c * (yy + xx)
                    E1, E3 = c * (tx * ty) - s * tz, c * (tx * ty) + s * tz
                    E2, E6 = c * (tx * tz) + s * ty, c * (tx * tz) - s * ty
                    E5, E7 = c * (ty * tz) - s * tx, c * (ty * tz) + s * tx
                    turn0 = L0 * tx + L1 * ty + L2 * tz
                    turn1 = L3 * tx + L4 * ty + L5 * tz
                    turn2 = L6 * tx + L7 * ty + L8 * tz
                    L0, L1, L2 = _turned(L0, L1, L2, E0, E1, E2, E3, E4, E5, E6, E7, E8)  # I3
                    L3, L4, L5 = _turned(L3, L4, L5, E0, E1, E2, E3, E4, E5, E6, E7, E8)
                    L6, L7, L8 = _turned(L6, L7, L8, E0, E1, E2, E3, E4, E5, E6, E7, E8)
                    b0, b1, b2, N0, N1, N2, carried, turning = evaluate(
                        body, centres, props, memory, forces, e, on, timed, sunk,
                        x0, x1, x2, v0 + h * a0, v1 + h * a1, v2 + h * a2, L0, L1, L2, L3, L4, L5, L6, L7, L8,
                        W0 + h * A0, W1 + h * A1, W2 + h * A2, (turn0, turn1, turn2),
                    )  # fmt: skip
                    if plate and on.support:
                        weight = body[col.MASS] * body[col.GRAVITY]
                        sunk = advance_support(e, weight, h, carried, turning, sunk)
                    v0 = v0 + half * (a0 + b0)  # I4
                    v1 = v1 + half * (a1 + b1)
                    v2 = v2 + half * (a2 + b2)
                    a0, a1, a2 = b0, b1, b2
                    mx, my, mz = JW0 + half * T0, JW1 + half * T1, JW2 + half * T2
                    px, py, pz = _turned(mx, my, mz, E0, E1, E2, E3, E4, E5, E6, E7, E8)
                    gain0, gain1, gain2 = _times(
                        body, col.J_INVERSE,
                        (px + half * N0) - JW0, (py + half * N1) - JW1, (pz + half * N2) - JW2,
                    )  # fmt: skip
                    W0, W1, W2 = W0 + gain0, W1 + gain1, W2 + gain2  # I5
                    T0, T1, T2 = N0, N1, N2
                done = wanted[row]
                pose = (
                    x0, x1, x2, v0, v1, v2, L0, L1, L2, L3, L4, L5, L6, L7, L8, W0, W1, W2, a0, a1, a2, T0, T1, T2,
                )  # fmt: skip
                for j in range(24):
                    rows_state[row, j] = pose[j]
                rows_state[row, col.GIVEN], rows_state[row, col.TIME], rows_state[row, col.ORIGIN] = 1.0, t, origin
                rows_state[row, col.COUNT] = count
                for j in range(4):
                    rows_state[row, col.Q + j] = sunk[j]
                if full:
                    for i in range(centres.shape[0]):
                        for j in range(3):
                            rows_F[row, i, j] = forces[i, j]
                        for j in range(col.MEMORY):
                            rows_memory[row, i, j] = memory[i, j]
                written[b] = row + 1
                if not math.isfinite((x0 + x1 + x2) + (v0 + v1 + v2) + (W0 + W1 + W2)):
                    break

    return loop


def _make_variant(groups: int):
    evaluate = make_evaluation(groups)
    return entered(_make_loop(groups, FINGERPRINT), evaluate=evaluate, begin=_make_begin(groups, evaluate))


#: The compiled loops by their groups of effects.
LOOPS = {groups: _make_variant(groups) for groups in slots.VARIANTS}


def loop_for(effects):
    """The loop for runs with these numbers of effects, (..., SLOTS): the variant with no more than it needs."""
    needed = sum(group for group, at in slots.GROUPS.items() if effects[..., at].any())
    return LOOPS[needed if needed in LOOPS else slots.ALL]
