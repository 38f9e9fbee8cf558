"""Normal force and friction of one contact point, compiled; the text of `rockref.model.contact` for one point."""

from __future__ import annotations

import math

import numba

from rockref.engines.compiled import slots
from rockref.engines.compiled.columns import (
    ANCHORED,
    C_N,
    C_T,
    K_N,
    K_T,
    RADIUS,
    S_X,
    S_Y,
    SLIDING,
    XI_LARGEST,
)  # fmt: skip

#: Squares below this (tiny / eps of float64, as in `rockref.model.contact.norm`) are taken by the longer way.
SMALL = 2.2250738585072014e-308 / 2.220446049250313e-16
#: Least normal force in parts of the reference (as in `rockref.effects.friction.load_dependent_friction`).
FLOOR = 1e-3


@numba.njit(inline="always")
def length(x, y):
    """Length of a plane vector, small ones with care."""
    squares = x * x + y * y
    if squares < SMALL:
        largest = max(abs(x), abs(y))
        if largest > 0:
            return largest * math.sqrt((x / largest) * (x / largest) + (y / largest) * (y / largest))
        return 0.0
    return math.sqrt(squares)


@numba.njit(inline="always")
def altered(force, xi, xi_rate, props, i, e, memory):
    """Spring and damper with the effects on the normal force, in the order of the step."""
    K, C = props[i, K_N], props[i, C_N]
    if e[slots.HERTZ] != 0.0:
        reference = e[slots.HERTZ + 2]
        force = force + K * (reference * (xi / reference) ** e[slots.HERTZ + 1] - xi)
    if e[slots.HYSTERESIS] != 0.0:
        kappa = e[slots.HYSTERESIS + 1]
        memory[i, XI_LARGEST] = max(memory[i, XI_LARGEST], xi)
        damper = C * xi_rate
        dent = kappa / (1 + kappa) * memory[i, XI_LARGEST]
        force = max(min(force - damper, K * (1 + kappa) * (xi - dent)), 0.0) + damper
    if e[slots.HUNT] != 0.0:
        force = force + e[slots.HUNT + 1] * K * xi * xi_rate
    return force


@numba.njit(inline="always")
def altered_friction(mu_0, mu, v_x, v_y, F_N, e):
    """Both friction coefficients with the effects on them, in the order of the step."""
    if e[slots.STRIBECK] != 0.0:
        relative = math.sqrt(v_x * v_x + v_y * v_y) / e[slots.STRIBECK + 2]
        factor = 1 + (e[slots.STRIBECK + 1] - 1) * math.exp(-(relative * relative))
        mu_0, mu = mu_0 * factor, mu * factor
    if e[slots.LOAD] != 0.0:
        reference = e[slots.LOAD + 2]
        factor = (max(F_N, FLOOR * reference) / reference) ** (-e[slots.LOAD + 1])
        mu_0, mu = mu_0 * factor, mu * factor
    return mu_0, mu


@numba.njit(inline="always")
def friction(ux, uy, vx, vy, F_N, mu_0, mu, props, memory, i, turn0, turn1):
    """Rules T1 to T6: the friction force; moves the anchor and notes whether the point slides."""
    K, C = props[i, K_T], props[i, C_T]
    sx, sy = ux, uy  # T5
    if memory[i, ANCHORED] != 0.0:
        radius = props[i, RADIUS]
        sx, sy = memory[i, S_X], memory[i, S_Y]
        if radius != 0.0:
            sx, sy = sx + radius * turn1, sy - radius * turn0
    tx, ty = K * (sx - ux) - C * vx, K * (sy - uy) - C * vy  # T1
    size = length(tx, ty)
    limit = (mu if memory[i, SLIDING] != 0.0 else mu_0) * F_N  # T6
    memory[i, ANCHORED] = 1.0
    if size <= limit:  # T2
        memory[i, S_X], memory[i, S_Y], memory[i, SLIDING] = sx, sy, 0.0
        return tx, ty
    scale = mu * F_N / size
    fx, fy = scale * tx, scale * ty  # T3
    memory[i, S_X], memory[i, S_Y] = ux + (fx + C * vx) / K, uy + (fy + C * vy) / K  # T4
    memory[i, SLIDING] = 1.0
    return fx, fy
