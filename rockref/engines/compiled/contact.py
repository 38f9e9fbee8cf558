"""Normal force and friction of one contact point, compiled; the text of `rockref.model.contact` for one point.

For one run or for lanes of several (`rockref.engines.compiled.lanes`): `above` says in which the point does not touch.
"""

from __future__ import annotations

import math

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import slots
from rockref.engines.compiled.jit import inlined
from rockref.engines.compiled.lanes import anyof, both, choose, negated

#: Squares below this (tiny / eps of float64, as in `rockref.model.contact.norm`) are taken by the longer way.
SMALL = 2.2250738585072014e-308 / 2.220446049250313e-16
#: Least normal force in parts of the reference (as in `rockref.effects.friction.load_dependent_friction`).
FLOOR = 1e-3
#: Less than one by more than the roundings of a threshold, some 1e-15 (decided).
SURELY = 1 - 1e-12


@inlined
def length(x, y):
    """Return length of a plane vector, small ones with care."""
    squares = x * x + y * y
    size = math.sqrt(squares)
    small = squares < SMALL
    if anyof(small):
        largest = max(abs(x), abs(y))
        unit = choose(largest > 0, largest, 1.0)
        size = choose(small, largest * math.sqrt((x / unit) * (x / unit) + (y / unit) * (y / unit)), size)
    return size


@inlined
def altered(on, e, force, xi, xi_rate, props, i, memory, above):
    """Return spring and damper with the effects on the normal force, in the order of the step."""
    K, C = props[i, col.K_N], props[i, col.C_N]
    if on.hertz:
        reference = e[slots.HERTZ + 2]
        depth, exponent = xi / reference, e[slots.HERTZ + 1]
        power = depth * math.sqrt(depth)
        if anyof(exponent != 1.5):
            power = choose(exponent == 1.5, power, depth**exponent)
        force = force + K * (reference * power - xi)
    if on.hysteresis:
        kappa, share = e[slots.HYSTERESIS + 1], e[slots.HYSTERESIS + 2]
        largest = max(memory[i, col.XI_LARGEST], xi)
        memory[i, col.XI_LARGEST] = choose(above, 0.0, largest)
        damper = C * xi_rate
        dent = kappa / (1 + kappa) * largest
        unloading = K * (1 + kappa) * (xi - dent)
        if anyof(share != 0.0):
            way = largest - dent
            left = max(xi - dent, 0.0) / choose(way > 0.0, way, 1.0)
            unloading = choose(share != 0.0, unloading * (1 + share * (math.sqrt(left) - 1)), unloading)
        force = max(min(force - damper, unloading), 0.0) + damper
    if on.hunt:
        force = force + e[slots.HUNT + 1] * K * xi * xi_rate
    return force


@inlined
def oriented(e, force, xi_rate, props, i, rx, ry, rz):
    """Return the force with the damper that depends on how its corner is turned, which comes after all of `altered`."""
    z = rz + props[i, col.RADIUS]
    squares = rx * rx + ry * ry + z * z
    tip = max(1.5 * (z * z / choose(squares > 0.0, squares, 1.0)) - 0.5, 0.0)
    return force + e[slots.ORIENTATION + 1] * tip * props[i, col.C_N] * xi_rate


@inlined
def altered_friction(on, e, mu_0, mu, v_x, v_y, F_N):
    """Return both friction coefficients with the effects on them, in the order of the step."""
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
    """Return the friction force [N] below which a point sticks, whatever its altered coefficient is, also with `mu`.

    exp and power cost more than all the rest of a point, and most points are far from sliding. The factor of Stribeck
    is at least the smaller of 1 and its ratio; that of the load, whose exponent is between -1 and 1, at least
    the smaller of 1 and reference / F_N, or F_N / reference.
    """
    held = SURELY * mu * F_N
    if on.stribeck:
        held = held * min(e[slots.STRIBECK + 1], 1.0)
    if on.load:
        reference = e[slots.LOAD + 2]
        relative = choose(e[slots.LOAD + 1] < 0.0, F_N / reference, reference / F_N)
        held = held * min(relative, 1.0)
    return held


@inlined
def trial(ux, uy, vx, vy, props, memory, i, turn0, turn1):
    """Rules T1 and T5: anchor (2), trial force (2) and its size."""
    K, C, radius = props[i, col.K_T], props[i, col.C_T], props[i, col.RADIUS]
    anchored = memory[i, col.ANCHORED] != 0.0
    sx, sy = memory[i, col.S_X], memory[i, col.S_Y]
    if anyof(radius != 0.0):
        sx, sy = choose(radius != 0.0, sx + radius * turn1, sx), choose(radius != 0.0, sy - radius * turn0, sy)
    sx, sy = choose(anchored, sx, ux), choose(anchored, sy, uy)  # T5
    tx, ty = K * (sx - ux) - C * vx, K * (sy - uy) - C * vy  # T1
    return sx, sy, tx, ty, length(tx, ty)


@inlined
def by_share(begins, xi, way, fx, fy, fz):
    """Return the force on a point, in lanes where its contact begins by the share of the step in contact."""
    share = choose(begins, 0.5 + xi / choose(begins, way, 1.0), 1.0)
    return share * fx, share * fy, share * fz


@inlined
def returned(ux, uy, vx, vy, sx, sy, tx, ty, size, F_N, mu_0, mu, props, memory, i, above):
    """Rules T2 to T4 and T6: the friction force; moves the anchor and notes whether the point slides."""
    limit = choose(memory[i, col.SLIDING] != 0.0, mu, mu_0) * F_N  # T6
    slides = negated(size <= limit)  # T2
    fx, fy, sliding = tx, ty, 0.0
    if anyof(both(slides, negated(above))):
        K, C = props[i, col.K_T], props[i, col.C_T]
        scale = mu * F_N / size
        fx, fy = choose(slides, scale * tx, tx), choose(slides, scale * ty, ty)  # T3
        sx, sy = choose(slides, ux + (fx + C * vx) / K, sx), choose(slides, uy + (fy + C * vy) / K, sy)  # T4
        sliding = choose(slides, 1.0, 0.0)
    memory[i, col.S_X] = choose(above, memory[i, col.S_X], sx)
    memory[i, col.S_Y] = choose(above, memory[i, col.S_Y], sy)
    memory[i, col.ANCHORED] = choose(above, 0.0, 1.0)
    memory[i, col.SLIDING] = choose(above, 0.0, sliding)
    return fx, fy
