"""Normal force and friction of one contact point, compiled; the text of `rockref.model.contact` for one point."""

from __future__ import annotations

import math

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import slots
from rockref.engines.compiled.jit import inlined

#: Squares below this (tiny / eps of float64, as in `rockref.model.contact.norm`) are taken by the longer way.
SMALL = 2.2250738585072014e-308 / 2.220446049250313e-16
#: Least normal force in parts of the reference (as in `rockref.effects.friction.load_dependent_friction`).
FLOOR = 1e-3
#: Less than one by more than the roundings of a threshold, some 1e-15 (decided).
SURELY = 1 - 1e-12


@inlined
def length(x, y):
    """Length of a plane vector, small ones with care."""
    squares = x * x + y * y
    if squares < SMALL:
        largest = max(abs(x), abs(y))
        if largest > 0:
            return largest * math.sqrt((x / largest) * (x / largest) + (y / largest) * (y / largest))
        return 0.0
    return math.sqrt(squares)


@inlined
def altered(on, e, force, xi, xi_rate, props, i, memory):
    """Spring and damper with the effects on the normal force, in the order of the step."""
    K, C = props[i, col.K_N], props[i, col.C_N]
    if on.hertz:
        reference = e[slots.HERTZ + 2]
        depth, exponent = xi / reference, e[slots.HERTZ + 1]
        power = depth * math.sqrt(depth) if exponent == 1.5 else depth**exponent
        force = force + K * (reference * power - xi)
    if on.hysteresis:
        kappa, share = e[slots.HYSTERESIS + 1], e[slots.HYSTERESIS + 2]
        memory[i, col.XI_LARGEST] = max(memory[i, col.XI_LARGEST], xi)
        damper = C * xi_rate
        dent = kappa / (1 + kappa) * memory[i, col.XI_LARGEST]
        unloading = K * (1 + kappa) * (xi - dent)
        if share != 0.0:
            way = memory[i, col.XI_LARGEST] - dent
            left = max(xi - dent, 0.0) / (way if way > 0.0 else 1.0)
            unloading = unloading * (1 + share * (math.sqrt(left) - 1))
        force = max(min(force - damper, unloading), 0.0) + damper
    if on.hunt:
        force = force + e[slots.HUNT + 1] * K * xi * xi_rate
    return force


@inlined
def oriented(e, force, xi_rate, props, i, rx, ry, rz):
    """The force with the damper that depends on how its corner is turned, which comes after all of `altered`."""
    z = rz + props[i, col.RADIUS]
    squares = rx * rx + ry * ry + z * z
    tip = max(1.5 * (z * z / (squares if squares > 0.0 else 1.0)) - 0.5, 0.0)
    return force + e[slots.ORIENTATION + 1] * tip * props[i, col.C_N] * xi_rate


@inlined
def altered_friction(on, e, mu_0, mu, v_x, v_y, F_N):
    """Both friction coefficients with the effects on them, in the order of the step."""
    if on.stribeck:
        relative = math.sqrt(v_x * v_x + v_y * v_y) / e[slots.STRIBECK + 2]
        factor = 1 + (e[slots.STRIBECK + 1] - 1) * math.exp(-(relative * relative))
        mu_0, mu = mu_0 * factor, mu * factor
    if on.load:
        reference = e[slots.LOAD + 2]
        factor = (max(F_N, FLOOR * reference) / reference) ** (-e[slots.LOAD + 1])
        mu_0, mu = mu_0 * factor, mu * factor
    return mu_0, mu


@inlined
def surely_held(on, e, mu, F_N):
    """A friction force [N] below which a point sticks whatever its altered coefficient is, and with `mu` itself too.

    exp and power cost more than all the rest of a point, and most points are far from sliding. The factor of Stribeck
    is at least the smaller of 1 and its ratio; that of the load, whose exponent is between -1 and 1, at least
    the smaller of 1 and reference / F_N, or F_N / reference.
    """
    held = SURELY * mu * F_N
    if on.stribeck:
        held = held * min(e[slots.STRIBECK + 1], 1.0)
    if on.load:
        reference = e[slots.LOAD + 2]
        relative = F_N / reference if e[slots.LOAD + 1] < 0.0 else reference / F_N
        held = held * min(relative, 1.0)
    return held


@inlined
def trial(ux, uy, vx, vy, props, memory, i, turn0, turn1):
    """Rules T1 and T5: anchor (2), trial force (2) and its size."""
    K, C = props[i, col.K_T], props[i, col.C_T]
    sx, sy = ux, uy  # T5
    if memory[i, col.ANCHORED] != 0.0:
        radius = props[i, col.RADIUS]
        sx, sy = memory[i, col.S_X], memory[i, col.S_Y]
        if radius != 0.0:
            sx, sy = sx + radius * turn1, sy - radius * turn0
    tx, ty = K * (sx - ux) - C * vx, K * (sy - uy) - C * vy  # T1
    return sx, sy, tx, ty, length(tx, ty)


@inlined
def returned(ux, uy, vx, vy, sx, sy, tx, ty, size, F_N, mu_0, mu, props, memory, i):
    """Rules T2 to T4 and T6: the friction force; moves the anchor and notes whether the point slides."""
    limit = (mu if memory[i, col.SLIDING] != 0.0 else mu_0) * F_N  # T6
    memory[i, col.ANCHORED] = 1.0
    if size <= limit:  # T2
        memory[i, col.S_X], memory[i, col.S_Y], memory[i, col.SLIDING] = sx, sy, 0.0
        return tx, ty
    K, C = props[i, col.K_T], props[i, col.C_T]
    scale = mu * F_N / size
    fx, fy = scale * tx, scale * ty  # T3
    memory[i, col.S_X], memory[i, col.S_Y] = ux + (fx + C * vx) / K, uy + (fy + C * vy) / K  # T4
    memory[i, col.SLIDING] = 1.0
    return fx, fy
