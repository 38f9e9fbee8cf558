"""The loop over the steps, compiled. Operation for operation the text of `rockref.model`; the rule ids are at the margin.

One function makes the kernel twice: for the law alone, and with the effects, so that the law pays nothing for them.
Points above the plate are passed over early: their forces are zero in the law, and adding zero changes no bit.
"""

from __future__ import annotations

import math

import numba
import numpy as np

from rockref.engines.compiled import slots
from rockref.engines.compiled.contact import make_normal_force, point_loads, tangential
from rockref.engines.compiled.loads import body_loads

#: Columns of `body`: mass, g, J (9), J^-1 (9), whether the axes are principal.
BODY = 21
#: Columns of `state`: x, v, Lambda (9), W, a, T, whether a and T are given, t, origin, count, plate q and q_rate.
STATE = 30
X, V, L, W_, A_, T_, GIVEN, TIME, ORIGIN, COUNT, Q, Q_RATE = 0, 3, 6, 15, 18, 21, 24, 25, 26, 27, 28, 29
#: Columns of `props` per point: K_N, K_T, C_N, C_T, mu_0, mu, radius, foot (1 to 4, for effects by foot).
PROPS = 8
#: Columns of `memory` per point: anchor s (2), anchored, sliding, largest penetration, yaw, roll (2).
MEMORY = 8


@numba.njit(inline="always")
def _times(B, at, principal, x, y, z):
    if principal:
        return B[at] * x, B[at + 4] * y, B[at + 8] * z
    return (
        B[at] * x + B[at + 1] * y + B[at + 2] * z,
        B[at + 3] * x + B[at + 4] * y + B[at + 5] * z,
        B[at + 6] * x + B[at + 7] * y + B[at + 8] * z,
    )


@numba.njit
def _long_series(t):
    s = c = 1.0
    for k in range(17, 0, -1):
        s = 1.0 - t * s * (1.0 / (2 * k * (2 * k + 1)))
        c = 1.0 - t * c * (1.0 / ((2 * k + 1) * (2 * k + 2)))
    return s, c / 2


@numba.njit(inline="always")
def _series(t):
    if t > 1e-4:
        return _long_series(t)
    s = 1.0 - t * 1.0 * (1.0 / 42.0)
    s = 1.0 - t * s * (1.0 / 20.0)
    s = 1.0 - t * s * (1.0 / 6.0)
    c = 1.0 - t * 1.0 * (1.0 / 56.0)
    c = 1.0 - t * c * (1.0 / 30.0)
    c = 1.0 - t * c * (1.0 / 12.0)
    return s, c / 2


@numba.njit(inline="always")
def _turned(m0, m1, m2, E0, E1, E2, E3, E4, E5, E6, E7, E8):
    """The row m (I + E)."""
    return (
        m0 + (m0 * E0 + m1 * E3 + m2 * E6),
        m1 + (m0 * E1 + m1 * E4 + m2 * E7),
        m2 + (m0 * E2 + m1 * E5 + m2 * E8),
    )


def make_kernel(with_effects: bool):
    """The compiled run: for the law alone, or with the effects that `effects` switches on."""
    normal_force = make_normal_force(with_effects)

    @numba.njit(nogil=True, cache=True, error_model="numpy", _nrt=False)
    def evaluate(
        body, P, props, memory, forces, effects, h, t, q, q_rate,
        x0, x1, x2, v0, v1, v2, L0, L1, L2, L3, L4, L5, L6, L7, L8, W0, W1, W2, turn0, turn1, turn2,
    ):  # fmt: skip
        """Rules K1 to A3 at one pose: acceleration (3), body moment (3), vertical force on the plate."""
        ox = L0 * W0 + L1 * W1 + L2 * W2
        oy = L3 * W0 + L4 * W1 + L5 * W2
        oz = L6 * W0 + L7 * W1 + L8 * W2
        Fx = Fy = Fz = Mx = My = Mz = on_plate = 0.0
        for i in range(P.shape[0]):
            radius = props[i, 6]
            Px, Py, Pz = P[i, 0], P[i, 1], P[i, 2] + radius
            rz = (L6 * Px + L7 * Py + L8 * Pz) - radius
            xi = -(x2 + rz)  # K1
            if with_effects:
                xi = -((x2 + rz) - q)
            touching = xi >= 0
            near = touching
            if with_effects and effects[slots.ADHESION] != 0.0:
                near = near or xi > -effects[slots.ADHESION + 2]
            if not touching:
                if memory[i, 2] != 0.0:
                    memory[i, 2] = memory[i, 3] = 0.0  # T5
                    if with_effects:
                        memory[i, 4] = memory[i, 5] = memory[i, 6] = memory[i, 7] = 0.0
                forces[i, 0] = forces[i, 1] = forces[i, 2] = 0.0  # N2
                if not near:
                    continue
            rx = L0 * Px + L1 * Py + L2 * Pz
            ry = L3 * Px + L4 * Py + L5 * Pz
            ux, uy = x0 + rx, x1 + ry
            vx = v0 + (oy * rz - oz * ry)
            vy = v1 + (oz * rx - ox * rz)
            vz = v2 + (ox * ry - oy * rx)
            if with_effects:
                vz -= q_rate
            fx = fy = fz = 0.0
            if touching:
                fz = normal_force(xi, -vz, props[i, 0], props[i, 2], effects, memory, i)  # N1
                fx, fy = tangential(with_effects, ux, uy, vx, vy, fz, props, memory, i, turn0, turn1, effects)
                forces[i, 0], forces[i, 1], forces[i, 2] = fx, fy, fz
            Fx += fx
            Fy += fy
            Fz += fz
            Mx += ry * fz - rz * fy
            My += rz * fx - rx * fz
            Mz += rx * fy - ry * fx
            if with_effects:
                px, py, pz, tx, ty, tz = point_loads(
                    effects, props, memory, i, touching, xi, vx, vy, fz, ox, oy, oz, turn0, turn1, turn2
                )
                on_plate += fz + pz
                Fx += px
                Fy += py
                Fz += pz
                Mx += (ry * pz - rz * py) + tx
                My += (rz * px - rx * pz) + ty
                Mz += (rx * py - ry * px) + tz
        mass = body[0]
        Fz -= mass * body[1]  # A1
        if with_effects:
            bx, by, bz, nx, ny, nz = body_loads(
                effects, mass, body[1], x0, x1, v0, v1, v2, L2, L5, L8, ox, oy, oz, t
            )  # fmt: skip
            Fx += bx
            Fy += by
            Fz += bz
            Mx += nx
            My += ny
            Mz += nz
        Tx = L0 * Mx + L3 * My + L6 * Mz  # A3
        Ty = L1 * Mx + L4 * My + L7 * Mz
        Tz = L2 * Mx + L5 * My + L8 * Mz
        return Fx / mass, Fy / mass, Fz / mass, Tx, Ty, Tz, on_plate

    @numba.njit(nogil=True, cache=True, error_model="numpy", _nrt=False)
    def run(body, P, props, memory, forces, effects, state, h, wanted, full, rows_state, rows_F, rows_memory):
        """All steps of one run; rows are written at the step numbers `wanted`. Returns the number of rows written."""
        x0, x1, x2, v0, v1, v2 = state[0], state[1], state[2], state[3], state[4], state[5]
        L0, L1, L2, L3, L4, L5, L6, L7, L8 = (
            state[6], state[7], state[8], state[9], state[10], state[11], state[12], state[13], state[14],
        )  # fmt: skip
        W0, W1, W2, a0, a1, a2, T0, T1, T2 = (
            state[15], state[16], state[17], state[18], state[19], state[20], state[21], state[22], state[23],
        )  # fmt: skip
        principal = body[20] != 0.0
        origin, count, t = state[ORIGIN], state[COUNT], state[TIME]
        q, q_rate = state[Q], state[Q_RATE]
        if state[GIVEN] == 0.0:
            a0, a1, a2, T0, T1, T2, _ = evaluate(
                body, P, props, memory, forces, effects, h, t, q, q_rate, x0, x1, x2, v0, v1, v2,
                L0, L1, L2, L3, L4, L5, L6, L7, L8, W0, W1, W2, 0.0, 0.0, 0.0,
            )  # fmt: skip
        done = 0
        half, half_square = h / 2, h * h / 2
        for row in range(wanted.shape[0]):
            for _ in range(done, wanted[row]):
                JW0, JW1, JW2 = _times(body, 2, principal, W0, W1, W2)
                A0, A1, A2 = _times(
                    body, 11, principal,
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
                E0, E4, E8 = c * (-zz - yy), c * (-zz - xx), c * (-yy - xx)
                E1, E3 = c * (ty * tx) - s * tz, c * (ty * tx) + s * tz
                E2, E6 = c * (tz * tx) + s * ty, c * (tz * tx) - s * ty
                E5, E7 = c * (tz * ty) - s * tx, c * (tz * ty) + s * tx
                turn0 = L0 * tx + L1 * ty + L2 * tz
                turn1 = L3 * tx + L4 * ty + L5 * tz
                turn2 = L6 * tx + L7 * ty + L8 * tz
                L0, L1, L2 = _turned(L0, L1, L2, E0, E1, E2, E3, E4, E5, E6, E7, E8)  # I3
                L3, L4, L5 = _turned(L3, L4, L5, E0, E1, E2, E3, E4, E5, E6, E7, E8)
                L6, L7, L8 = _turned(L6, L7, L8, E0, E1, E2, E3, E4, E5, E6, E7, E8)
                count += 1.0
                t = origin + count * h
                b0, b1, b2, N0, N1, N2, on_plate = evaluate(
                    body, P, props, memory, forces, effects, h, t, q, q_rate,
                    x0, x1, x2, v0 + h * a0, v1 + h * a1, v2 + h * a2, L0, L1, L2, L3, L4, L5, L6, L7, L8,
                    W0 + h * A0, W1 + h * A1, W2 + h * A2, turn0, turn1, turn2,
                )  # fmt: skip
                v0 = v0 + half * (a0 + b0)  # I4
                v1 = v1 + half * (a1 + b1)
                v2 = v2 + half * (a2 + b2)
                a0, a1, a2 = b0, b1, b2
                mx, my, mz = JW0 + half * T0, JW1 + half * T1, JW2 + half * T2
                px, py, pz = _turned(mx, my, mz, E0, E1, E2, E3, E4, E5, E6, E7, E8)
                W0, W1, W2 = _times(body, 11, principal, px + half * N0, py + half * N1, pz + half * N2)  # I5
                T0, T1, T2 = N0, N1, N2
                if with_effects and effects[slots.SUPPORT] != 0.0:
                    k = slots.SUPPORT
                    pressed = body[0] * body[1] - on_plate
                    q_rate += h * (pressed - effects[k + 2] * q - effects[k + 3] * q_rate) / effects[k + 1]
                    q += h * q_rate
            done = wanted[row]
            pose = (x0, x1, x2, v0, v1, v2, L0, L1, L2, L3, L4, L5, L6, L7, L8, W0, W1, W2, a0, a1, a2, T0, T1, T2)
            for j in range(24):
                rows_state[row, j] = pose[j]
            rows_state[row, GIVEN], rows_state[row, TIME], rows_state[row, ORIGIN] = 1.0, t, origin
            rows_state[row, COUNT], rows_state[row, Q], rows_state[row, Q_RATE] = count, q, q_rate
            if full:
                for i in range(P.shape[0]):
                    for j in range(3):
                        rows_F[row, i, j] = forces[i, j]
                    for j in range(MEMORY):
                        rows_memory[row, i, j] = memory[i, j]
            if not math.isfinite(W0 + W1 + W2):
                return row + 1
        return wanted.shape[0]

    return run


law = make_kernel(False)
with_effects = make_kernel(True)
