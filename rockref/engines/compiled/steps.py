"""The steps between two rows, compiled. Operation for operation the text of `rockref.model`; rule ids at the margin."""

from __future__ import annotations

import math

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import slots
from rockref.engines.compiled.jit import called, inlined, marked
from rockref.engines.compiled.lanes import anyof, choose, negated
from rockref.engines.compiled.loads import advance_support, of_time, plate_acceleration


@inlined
def times(body, at, x, y, z):
    """Multiply J or J^-1, which stand in `body` from column `at`, by a vector."""
    principal = body[col.PRINCIPAL] != 0.0
    a, b, c = body[at] * x, body[at + 4] * y, body[at + 8] * z
    if anyof(negated(principal)):
        a = choose(principal, a, body[at] * x + body[at + 1] * y + body[at + 2] * z)
        b = choose(principal, b, body[at + 3] * x + body[at + 4] * y + body[at + 5] * z)
        c = choose(principal, c, body[at + 6] * x + body[at + 7] * y + body[at + 8] * z)
    return a, b, c


@called
def _long_series(t):
    s = c = choose(t <= 10.24, 1.0, math.nan)  # beyond 3.2 rad the law refuses the step: the caller finds out where
    for k in range(17, 0, -1):
        s = 1.0 - t * s * (1.0 / (2 * k * (2 * k + 1)))
        c = 1.0 - t * c * (1.0 / ((2 * k + 1) * (2 * k + 2)))
    return s, c / 2


@inlined
def series(t):
    """Return sin(theta)/theta and (1 - cos(theta))/theta^2 from t = theta^2, as `rotation.series_coefficients`."""
    s = 1.0 - t * 1.0 * (1.0 / 42.0)
    s = 1.0 - t * s * (1.0 / 20.0)
    s = 1.0 - t * s * (1.0 / 6.0)
    c = 1.0 - t * 1.0 * (1.0 / 56.0)
    c = 1.0 - t * c * (1.0 / 30.0)
    c = 1.0 - t * c * (1.0 / 12.0)
    c = c / 2
    short = t <= 1e-4
    if anyof(negated(short)):
        longer_s, longer_c = _long_series(t)
        s, c = choose(short, s, longer_s), choose(short, c, longer_c)
    return s, c


@inlined
def exp_minus_identity(x, y, z):
    """Return exp(hat(Theta)) - I for Theta = (x, y, z), nine numbers, as `rotation.exp_minus_identity`."""
    xx, yy, zz = x * x, y * y, z * z
    s, c = series(xx + yy + zz)
    sx, sy, sz = s * x, s * y, s * z
    xy, xz, yz = c * (x * y), c * (x * z), c * (y * z)
    return -c * (zz + yy), xy - sz, xz + sy, xy + sz, -c * (zz + xx), yz - sx, xz - sy, yz + sx, -c * (yy + xx)


@inlined
def turned(m0, m1, m2, E):
    """Return the row m (I + E)."""
    E0, E1, E2, E3, E4, E5, E6, E7, E8 = E
    return (
        m0 + (m0 * E0 + m1 * E3 + m2 * E6),
        m1 + (m0 * E1 + m1 * E4 + m2 * E7),
        m2 + (m0 * E2 + m1 * E5 + m2 * E8),
    )


@inlined
def switches(e):
    """Return which effects are on, from their numbers (SLOTS,)."""
    return slots.Switches(
        e[slots.HERTZ] != 0.0, e[slots.HYSTERESIS] != 0.0, e[slots.HUNT] != 0.0, e[slots.ORIENTATION] != 0.0,
        e[slots.STRIBECK] != 0.0, e[slots.LOAD] != 0.0, e[slots.ADHESION] != 0.0, e[slots.VISCOUS] != 0.0,
        e[slots.NORMALS] != 0.0, e[slots.SPIN] != 0.0, e[slots.ROLLING] != 0.0, e[slots.DRAG] != 0.0,
        e[slots.CABLE] != 0.0, e[slots.WIRE] != 0.0, e[slots.VIBRATION] != 0.0, e[slots.TILT] != 0.0,
        e[slots.SUPPORT] != 0.0, e[slots.BASE] != 0.0,
    )  # fmt: skip


@inlined
def plate_of(state):
    """Return q, q_rate, pitch and pitch_rate of the plate."""
    return state[col.Q], state[col.Q_RATE], state[col.PITCH], state[col.PITCH_RATE]


def make_begin(groups: int, evaluate):
    """Make the first force evaluation of a run with these groups of effects."""

    shaken = groups & slots.SHAKEN

    def begin(body, centres, props, memory, forces, e, on, samples, s):
        """Write a and T into the state at the start, and forces and memories."""
        for i in range(centres.shape[0]):
            for j in range(3):
                forces[i, j] = 0.0
        shaking = (0.0, 0.0, 0.0)
        if shaken and on.base:
            shaking = plate_acceleration(e, samples, s[col.TIME])
        a0, a1, a2, T0, T1, T2, _, _, _ = evaluate(
            body, centres, props, memory, forces, e, on, of_time(on, e, s[col.TIME]), shaking, plate_of(s),
            s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], s[8], s[9], s[10], s[11], s[12], s[13], s[14],
            s[15], s[16], s[17], (0.0, 0.0, 0.0),
        )  # fmt: skip
        s[18], s[19], s[20], s[21], s[22], s[23] = a0, a1, a2, T0, T1, T2
        for i in range(centres.shape[0]):
            free = memory[i, col.ANCHORED] == 0.0
            if anyof(free):  # only a touching point slides and remembers, whatever the start says
                for j in range(col.SLIDING, col.MEMORY):
                    memory[i, j] = choose(free, 0.0, memory[i, j])

    return called(marked(begin, groups))


def make_steps(groups: int, evaluate, bearing: int):
    """Make the steps of runs with these groups of effects; `bearing` as in `make_evaluation`."""
    loads, plate, shaken = groups & slots.LOADS, groups & slots.PLATE, groups & slots.SHAKEN

    def steps(number, body, centres, props, memory, forces, e, on, h, samples, state):
        """Make a number of steps; state, forces and memories are written.

        Returns the sums over these steps of normal force and normal force times lever arm (4), or zeros.
        """
        x0, x1, x2, v0, v1, v2 = state[0], state[1], state[2], state[3], state[4], state[5]
        L0, L1, L2, L3, L4, L5 = state[6], state[7], state[8], state[9], state[10], state[11]
        L6, L7, L8, W0, W1, W2 = state[12], state[13], state[14], state[15], state[16], state[17]
        a0, a1, a2, T0, T1, T2 = state[18], state[19], state[20], state[21], state[22], state[23]
        t, origin, count, sunk = state[col.TIME], state[col.ORIGIN], state[col.COUNT], plate_of(state)
        half, half_square = h / 2, h * h / 2
        load = place0 = place1 = place2 = 0.0
        for _ in range(number):
            count += 1.0
            t = origin + count * h
            timed = of_time(on, e, t) if loads else (0.0, 0.0)
            shaking = (0.0, 0.0, 0.0)
            if shaken and on.base:
                shaking = plate_acceleration(e, samples, t)
            JW0, JW1, JW2 = times(body, col.J, W0, W1, W2)
            A0, A1, A2 = times(
                body, col.J_INVERSE,
                T0 - (W1 * JW2 - W2 * JW1), T1 - (W2 * JW0 - W0 * JW2), T2 - (W0 * JW1 - W1 * JW0),
            )  # fmt: skip
            x0 = x0 + h * v0 + half_square * a0  # I1
            x1 = x1 + h * v1 + half_square * a1
            x2 = x2 + h * v2 + half_square * a2
            tx = h * W0 + half_square * A0  # I2
            ty = h * W1 + half_square * A1
            tz = h * W2 + half_square * A2
            E = exp_minus_identity(tx, ty, tz)
            turn0 = L0 * tx + L1 * ty + L2 * tz
            turn1 = L3 * tx + L4 * ty + L5 * tz
            turn2 = L6 * tx + L7 * ty + L8 * tz
            L0, L1, L2 = turned(L0, L1, L2, E)  # I3
            L3, L4, L5 = turned(L3, L4, L5, E)
            L6, L7, L8 = turned(L6, L7, L8, E)
            b0, b1, b2, N0, N1, N2, carried, turning, place = evaluate(
                body, centres, props, memory, forces, e, on, timed, shaking, sunk,
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
            px, py, pz = turned(mx, my, mz, E)
            gain0, gain1, gain2 = times(
                body, col.J_INVERSE,
                (px + half * N0) - JW0, (py + half * N1) - JW1, (pz + half * N2) - JW2,
            )  # fmt: skip
            W0, W1, W2 = W0 + gain0, W1 + gain1, W2 + gain2  # I5
            T0, T1, T2 = N0, N1, N2
            if bearing:
                load += place[0]
                place0 += place[1]
                place1 += place[2]
                place2 += place[3]
        state[0], state[1], state[2], state[3], state[4], state[5] = x0, x1, x2, v0, v1, v2
        state[6], state[7], state[8], state[9], state[10], state[11] = L0, L1, L2, L3, L4, L5
        state[12], state[13], state[14], state[15], state[16], state[17] = L6, L7, L8, W0, W1, W2
        state[18], state[19], state[20], state[21], state[22], state[23] = a0, a1, a2, T0, T1, T2
        state[col.TIME], state[col.COUNT] = t, count
        state[col.Q], state[col.Q_RATE], state[col.PITCH], state[col.PITCH_RATE] = sunk
        return load, place0, place1, place2

    return inlined(marked(steps, groups, bearing))
