"""The loop over the steps, compiled. Operation for operation the text of `rockref.model`; rule ids at the margin.

One function makes the loop twice: for the law alone, and with the effects, so that the law pays nothing for them. It
holds the fingerprint of the sources, by which numba's files of compiled code are told apart.
"""

from __future__ import annotations

import math

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import slots
from rockref.engines.compiled.columns import BODY, MEMORY, ORIGIN, PROPS, STATE, TIME
from rockref.engines.compiled.evaluation import evaluate_law, evaluate_with_effects
from rockref.engines.compiled.jit import called, entered, inlined
from rockref.engines.compiled.loads import advance_support
from rockref.engines.compiled.sources import FINGERPRINT

__all__ = ["BODY", "MEMORY", "ORIGIN", "PROPS", "STATE", "TIME", "law", "with_effects"]


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


def _make_begin(with_effects: bool, source: int):
    """The first force evaluation of a run: a and T (6); `source` only marks the stored code."""

    @entered
    def begin(body, centres, props, memory, forces, e, s):
        _ = source  # held, so that numba's files on disk belong to this very text
        forces[:, :] = 0.0
        if with_effects:
            first = evaluate_with_effects(
                body, centres, props, memory, forces, e, s[col.TIME], s[col.Q], s[col.Q_RATE],
                s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[8], s[9], s[10], s[11], s[12], s[13], s[14],
                s[15], s[16], s[17], 0.0, 0.0, 0.0,
            )  # fmt: skip
        else:
            first = evaluate_law(
                body, centres, props, memory, forces, e, 0.0, 0.0, 0.0,
                s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[8], s[9], s[10], s[11], s[12], s[13], s[14],
                s[15], s[16], s[17], 0.0, 0.0, 0.0,
            )  # fmt: skip
        for i in range(centres.shape[0]):
            if memory[i, col.ANCHORED] == 0.0:  # only a touching point slides, whatever the start says
                memory[i, col.SLIDING] = 0.0
        return first

    return begin


begin_law, begin_with_effects = _make_begin(False, FINGERPRINT), _make_begin(True, FINGERPRINT)


def _make_run(with_effects: bool, source: int):
    """The compiled run: for the law alone, or with the effects that `e` switches on; `source` as above."""

    @entered
    def run(body, centres, props, memory, forces, e, state, h, wanted, full, rows_state, rows_F, rows_memory):
        """All steps of one run; rows are written at the step numbers `wanted`. Returns the number of rows written.

        centres : contact points, raised by their radius.  The rest as in `rockref.engines.compiled.batch.Batch`.
        """
        _ = source
        x0, x1, x2, v0, v1, v2 = state[0], state[1], state[2], state[3], state[4], state[5]
        L0, L1, L2, L3, L4, L5 = state[6], state[7], state[8], state[9], state[10], state[11]
        L6, L7, L8, W0, W1, W2 = state[12], state[13], state[14], state[15], state[16], state[17]
        a0, a1, a2, T0, T1, T2 = state[18], state[19], state[20], state[21], state[22], state[23]
        origin, count, q, q_rate = state[col.ORIGIN], state[col.COUNT], state[col.Q], state[col.Q_RATE]
        if state[col.GIVEN] == 0.0:
            if with_effects:
                a0, a1, a2, T0, T1, T2 = begin_with_effects(body, centres, props, memory, forces, e, state)
            else:
                a0, a1, a2, T0, T1, T2 = begin_law(body, centres, props, memory, forces, e, state)
        done, t = 0, state[col.TIME]
        half, half_square = h / 2, h * h / 2
        for row in range(wanted.shape[0]):
            for _ in range(done, wanted[row]):
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
                count += 1.0
                t = origin + count * h
                if with_effects:
                    b0, b1, b2, N0, N1, N2 = evaluate_with_effects(
                        body, centres, props, memory, forces, e, t, q, q_rate,
                        x0, x1, x2, v0 + h * a0, v1 + h * a1, v2 + h * a2, L0, L1, L2, L3, L4, L5, L6, L7, L8,
                        W0 + h * A0, W1 + h * A1, W2 + h * A2, turn0, turn1, turn2,
                    )  # fmt: skip
                    if e[slots.SUPPORT] != 0.0:
                        q, q_rate = advance_support(e, body[col.MASS], body[col.GRAVITY], h, memory, forces, q, q_rate)
                else:
                    b0, b1, b2, N0, N1, N2 = evaluate_law(
                        body, centres, props, memory, forces, e, t, q, q_rate,
                        x0, x1, x2, v0 + h * a0, v1 + h * a1, v2 + h * a2, L0, L1, L2, L3, L4, L5, L6, L7, L8,
                        W0 + h * A0, W1 + h * A1, W2 + h * A2, turn0, turn1, turn2,
                    )  # fmt: skip
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
            pose = (x0, x1, x2, v0, v1, v2, L0, L1, L2, L3, L4, L5, L6, L7, L8, W0, W1, W2, a0, a1, a2, T0, T1, T2)
            for j in range(24):
                rows_state[row, j] = pose[j]
            rows_state[row, col.GIVEN], rows_state[row, col.TIME], rows_state[row, col.ORIGIN] = 1.0, t, origin
            rows_state[row, col.COUNT], rows_state[row, col.Q], rows_state[row, col.Q_RATE] = count, q, q_rate
            if full:
                for i in range(centres.shape[0]):
                    for j in range(3):
                        rows_F[row, i, j] = forces[i, j]
                    for j in range(col.MEMORY):
                        rows_memory[row, i, j] = memory[i, j]
            if not math.isfinite((x0 + x1 + x2) + (v0 + v1 + v2) + (W0 + W1 + W2)):
                return row + 1
        return wanted.shape[0]

    return run


law, with_effects = _make_run(False, FINGERPRINT), _make_run(True, FINGERPRINT)
