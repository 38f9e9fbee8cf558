"""How a block stands on its feet at the start of a window: what each foot carries, and what holds it from turning.

A gyroscope shows the attitude and the rates, and neither where the block is nor how its springs are strained. Between
two corner impacts they are strained so that they carry the motion, and nothing rings. On one foot the block turns
freely about it; on several they hold it from turning about the vertical, too. Started otherwise, with each foot in
touch as deep as if it stood alone, the block would be thrown up by its own weight.
"""

from __future__ import annotations

import math

import numpy as np

from rockref.engines.compiled import columns as col
from rockref.engines.compiled.contact import altered
from rockref.engines.compiled.kernel import switches
from rockref.engines.on_disk import on_disk

#: Halvings by which the depth is found under which the feet carry the block: to 1e-10 of it.
HALVINGS = 34


@on_disk(nogil=True)
def _solve3(A, b):
    d = (
        A[0, 0] * (A[1, 1] * A[2, 2] - A[1, 2] * A[2, 1])
        - A[0, 1] * (A[1, 0] * A[2, 2] - A[1, 2] * A[2, 0])
        + A[0, 2] * (A[1, 0] * A[2, 1] - A[1, 1] * A[2, 0])
    )
    out = np.empty(3)
    for k in range(3):
        B = A.copy()
        B[:, k] = b
        out[k] = (
            B[0, 0] * (B[1, 1] * B[2, 2] - B[1, 2] * B[2, 1])
            - B[0, 1] * (B[1, 0] * B[2, 2] - B[1, 2] * B[2, 0])
            + B[0, 2] * (B[1, 0] * B[2, 1] - B[1, 1] * B[2, 0])
        ) / d
    return out


@on_disk(nogil=True)
def _skew(r):
    return np.array([[0.0, -r[2], r[1]], [r[2], 0.0, -r[0]], [-r[1], r[0], 0.0]])


@on_disk(nogil=True)
def held(r, omega, inertia, mass, g, moment):
    """Force (3,) [N] of the plate on a block that turns about a resting point, and its angular acceleration (3,).

    r : (3,) from the centre of mass to that point; omega : (3,); inertia : (3, 3) in the laboratory; moment [N m]: of
    the plate about the vertical through that point. Newton's and Euler's equations, A1 to A3 of the law.
    """
    R, S = _skew(r), _skew(omega)
    gravity = np.array([0.0, 0.0, g])
    # a_G = -(domega x r) - omega x (omega x r);  F = m (a_G + g e_z);  I domega + omega x I omega = r x F + moment e_z
    A = inertia - mass * (R @ R)
    Orr = S @ (S @ r)
    rhs = -(S @ (inertia @ omega)) + mass * (R @ (gravity - Orr))
    rhs[2] += moment
    domega = _solve3(A, rhs)
    return mass * (R @ domega - Orr + gravity), domega


@on_disk(nogil=True)
def carried(depth, heights, props, memory, pressed, e, loads):
    """Force [N] on all feet at this depth [m] of the lowest; fills loads (n,). Their memory is spoilt.

    heights : (n,) of the feet above the lowest [m]; pressed : (n,) depth [m] to which each has been; e : (SLOTS,).
    """
    on = switches(e)
    total = 0.0
    for i in range(len(heights)):
        xi = depth - heights[i]
        loads[i] = 0.0
        if xi > 0.0:
            memory[i, col.XI_LARGEST] = pressed[i]
            loads[i] = max(altered(on, e, props[i, col.K_N] * xi, xi, 0.0, props, i, memory, False), 0.0)
            total += loads[i]
    return total


@on_disk(nogil=True)
def depth_under(weight, heights, props, memory, pressed, e, loads):
    """Depth [m] of the lowest foot at which the feet carry this force [N]; fills loads (n,), what each carries."""
    pivot = np.argmin(heights)
    low, high = 0.0, weight / props[pivot, col.K_N]
    while carried(high, heights, props, memory, pressed, e, loads) < weight:
        low, high = high, 2 * high
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        if carried(middle, heights, props, memory, pressed, e, loads) < weight:
            low = middle
        else:
            high = middle
    carried(high, heights, props, memory, pressed, e, loads)
    return high


@on_disk(nogil=True)
def held_share(F, turn, feet, loads, props):
    """Share of a turning moment that friction holds: no foot is pulled out of its cone.

    F : (3,) of the plate; turn : [N/m per N] by which each foot is pulled, times its distance from the middle `feet`
    (n, 2) [m] and its share of the load; loads : (n,) [N].
    """
    share, total = 1.0, np.sum(loads)
    for i in range(len(loads)):
        if loads[i] > 0.0:
            # |F + share turn e_z x feet| <= mu N for the shares of this foot, the larger root of a quadratic
            bx, by = -turn * feet[i, 1], turn * feet[i, 0]
            a, b = bx * bx + by * by, F[0] * bx + F[1] * by
            c = F[0] ** 2 + F[1] ** 2 - (props[i, col.MU] * total) ** 2
            if c >= 0.0:
                return 0.0
            if a > 0.0:
                share = min(share, (math.sqrt(b * b - a * c) - b) / a)
    return share


@on_disk(nogil=True)
def standing_starts(Lambda, W, corrections, body, P, props, effects, pressed, upright, place, plate, state, memory):
    """Start states of B windows on the feet that carry the block, quasi-statically.

    Lambda : (B, 3, 3), W : (B, 3) reconstructed attitude and rates; corrections : (B, 5) tilt and roll [rad, body
    axes], rates [rad/s]. body (B, BODY), P (B, n, 3), props (B, n, PROPS), effects (B, SLOTS) as in the compiled step;
    pressed : (B, n) depth to which each foot has been pressed since it touched [m]; upright : (B, 3, 3) orientation
    and place : (B, 3) position of the standing block, which place the lowest foot on the plate [m]; plate : (B, 4)
    its motion under the block, q, q_rate, pitch, pitch_rate. Fills state (B, STATE) and memory (B, n, MEMORY).

    Turning about its lowest foot the block has a force there; the feet sink until they carry it, each by its own
    spring. They hold the block in their middle then, and, as far as friction goes, from turning about the vertical.
    """
    n = P.shape[1]
    r, heights, loads, feet = np.empty((n, 3)), np.empty(n), np.empty(n), np.empty((n, 2))
    for b in range(Lambda.shape[0]):
        a, c = corrections[b, 0], corrections[b, 1]
        hat = np.array([[0.0, 0.0, c], [0.0, 0.0, -a], [-c, a, 0.0]])
        L = Lambda[b] @ (np.eye(3) + hat + hat @ hat / 2)
        w_body = W[b] + corrections[b, 2:5]
        for i in range(n):
            centre = P[b, i].copy()
            centre[2] += props[b, i, col.RADIUS]
            r[i] = L @ centre
            r[i, 2] -= props[b, i, col.RADIUS]
        heights[:] = r[:, 2] - plate[b, 2] * r[:, 1]
        pivot = np.argmin(heights)
        heights -= heights[pivot]
        inertia = L @ body[b, col.J : col.J + 9].copy().reshape(3, 3) @ L.T
        omega, mass, g = L @ w_body, body[b, col.MASS], body[b, col.GRAVITY]
        F, _ = held(r[pivot], omega, inertia, mass, g, 0.0)
        middle, turn, depth = r[pivot].copy(), 0.0, 0.0
        loads[:] = 0.0
        memory[b, :, :] = 0.0
        if F[2] > 0.0 and math.isfinite(heights[0]):
            depth = depth_under(F[2], heights, props[b], memory[b], pressed[b], effects[b], loads)
            share = loads / np.sum(loads)
            middle[0], middle[1] = np.sum(share * r[:, 0]), np.sum(share * r[:, 1])
            feet[:, 0], feet[:, 1] = r[:, 0] - middle[0], r[:, 1] - middle[1]
            spread = np.sum(share * (feet[:, 0] ** 2 + feet[:, 1] ** 2))
            if spread > 0.0:
                F, free = held(middle, omega, inertia, mass, g, 0.0)
                _, turned = held(middle, omega, inertia, mass, g, 1.0)
                turn = -free[2] / (turned[2] - free[2]) / spread
                turn *= held_share(F, turn, feet, loads, props[b])
                F, _ = held(middle, omega, inertia, mass, g, turn * spread)
        foot = upright[b] @ P[b, pivot] + place[b]
        state[b, :] = 0.0
        state[b, 0:2] = foot[:2] - r[pivot, :2]
        state[b, 2] = plate[b, 0] + plate[b, 2] * foot[1] - r[pivot, 2] - depth
        # The middle rests on the plate: v = -omega x r = r x omega, and the plate's own.
        state[b, col.V : col.V + 3] = _skew(middle) @ omega
        state[b, col.V + 2] += plate[b, 1] + plate[b, 3] * foot[1]
        state[b, col.Q : col.Q + 4] = plate[b]
        for j in range(3):
            for k in range(3):
                state[b, col.L + 3 * j + k] = L[j, k]
        state[b, col.W_ : col.W_ + 3] = w_body
        for i in range(n):
            memory[b, i, col.XI_LARGEST] = 0.0
            if loads[i] > 0.0:
                part = loads[i] / np.sum(loads)
                fx, fy = part * (F[0] - turn * feet[i, 1]), part * (F[1] + turn * feet[i, 0])
                size, limit = math.sqrt(fx * fx + fy * fy), props[b, i, col.MU] * loads[i]
                scale = 1.0 if size <= limit or size == 0 else limit / size
                memory[b, i, col.S_X] = state[b, 0] + r[i, 0] + scale * fx / props[b, i, col.K_T]
                memory[b, i, col.S_Y] = state[b, 1] + r[i, 1] + scale * fy / props[b, i, col.K_T]
                memory[b, i, col.ANCHORED] = 1.0
                memory[b, i, col.SLIDING] = 0.0 if scale == 1.0 else 1.0
                memory[b, i, col.XI_LARGEST] = max(pressed[b, i], depth - heights[i])
