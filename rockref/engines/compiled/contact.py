"""Normal force and friction of one contact point, and what the effects add there; compiled."""

from __future__ import annotations

import math

import numba

from rockref.engines.compiled import slots

#: Squares below this (tiny / eps of float64, as in `rockref.model.contact.norm`) are taken by the longer way.
SMALL = 2.2250738585072014e-308 / 2.220446049250313e-16


@numba.njit(inline="always")
def _length(x, y):
    squares = x * x + y * y
    if squares < SMALL:
        largest = max(abs(x), abs(y))
        if largest > 0:
            return largest * math.sqrt((x / largest) * (x / largest) + (y / largest) * (y / largest))
        return 0.0
    return math.sqrt(squares)


def make_normal_force(with_effects: bool):
    """Rules N1 and N2 at xi >= 0, with the effects on the normal force."""

    @numba.njit(inline="always")
    def normal_force(xi, xi_rate, K, C, effects, memory, i):
        if not with_effects:
            return max(K * xi + C * xi_rate, 0.0)  # (3.5a)
        elastic = K * xi
        if effects[slots.HERTZ] != 0.0:
            reference = effects[slots.HERTZ + 2]
            elastic = K * reference * (xi / reference) ** effects[slots.HERTZ + 1]
        if effects[slots.HYSTERESIS] != 0.0:
            kappa = effects[slots.HYSTERESIS + 1]
            memory[i, 4] = max(memory[i, 4], xi)
            elastic = max(min(elastic, K * (1 + kappa) * (xi - kappa / (1 + kappa) * memory[i, 4])), 0.0)
        force = elastic + C * xi_rate
        if effects[slots.HUNT] != 0.0:
            force += effects[slots.HUNT + 1] * K * xi * xi_rate
        return max(force, 0.0)

    return normal_force


@numba.njit(inline="always")
def tangential(with_effects, ux, uy, vx, vy, F_N, props, memory, i, turn0, turn1, effects):
    """Rules T1 to T6: the friction force; moves the anchor and notes whether the point slides."""
    K, C, mu_0, mu = props[i, 1], props[i, 3], props[i, 4], props[i, 5]
    if with_effects:
        factor = 1.0
        if effects[slots.STRIBECK] != 0.0:
            speed = math.sqrt(vx * vx + vy * vy) / effects[slots.STRIBECK + 2]
            factor *= 1 + (effects[slots.STRIBECK + 1] - 1) * math.exp(-(speed * speed))
        if effects[slots.LOAD] != 0.0:
            reference = effects[slots.LOAD + 2]
            factor *= (max(F_N, 1e-3 * reference) / reference) ** (-effects[slots.LOAD + 1])
        mu_0, mu = mu_0 * factor, mu * factor
    if memory[i, 2] != 0.0:
        sx, sy = memory[i, 0], memory[i, 1]
        radius = props[i, 6]
        if radius != 0.0:
            sx += radius * turn1
            sy -= radius * turn0
    else:
        sx, sy = ux, uy  # T5
        memory[i, 2] = 1.0
        memory[i, 3] = 0.0
    tx, ty = K * (sx - ux) - C * vx, K * (sy - uy) - C * vy  # T1
    size = _length(tx, ty)
    limit = (mu if memory[i, 3] != 0.0 else mu_0) * F_N  # T6
    if size <= limit:  # T2
        memory[i, 0], memory[i, 1], memory[i, 3] = sx, sy, 0.0
        return tx, ty
    scale = mu * F_N / size
    fx, fy = scale * tx, scale * ty  # T3
    memory[i, 0], memory[i, 1], memory[i, 3] = ux + (fx + C * vx) / K, uy + (fy + C * vy) / K, 1.0  # T4
    return fx, fy


@numba.njit(inline="always")
def point_loads(effects, props, memory, i, touching, xi, vx, vy, F_N, ox, oy, oz, turn0, turn1, turn2):
    """What the effects add at one point: force (3) and moment (3), plate axes."""
    px = py = pz = tx = ty = tz = 0.0
    if effects[slots.ADHESION] != 0.0:
        pz -= effects[slots.ADHESION + 1] * min(max(1 + xi / effects[slots.ADHESION + 2], 0.0), 1.0)
    if not touching:
        return px, py, pz, tx, ty, tz
    if effects[slots.VISCOUS] != 0.0:
        px -= effects[slots.VISCOUS + 1] * vx
        py -= effects[slots.VISCOUS + 1] * vy
    if effects[slots.NORMALS] != 0.0:
        foot = int(props[i, 7])
        if foot > 0:
            px += F_N * effects[slots.NORMALS + 2 * foot - 1]
            py += F_N * effects[slots.NORMALS + 2 * foot]
    if effects[slots.SPIN] != 0.0:
        radius = effects[slots.SPIN + 1]
        K, C = props[i, 1] * radius * radius, props[i, 3] * radius * radius
        yaw = memory[i, 5] + turn2
        trial = -K * yaw - C * oz
        limit = radius * props[i, 5] * F_N
        if abs(trial) > limit:
            trial = math.copysign(limit, trial)
            yaw = -(trial + C * oz) / K
        memory[i, 5] = yaw
        tz += trial
    if effects[slots.ROLLING] != 0.0:
        lever = effects[slots.ROLLING + 1]
        K, C = props[i, 0] * lever * lever, props[i, 2] * lever * lever
        ax, ay = memory[i, 6] + turn0, memory[i, 7] + turn1
        mx, my = -K * ax - C * ox, -K * ay - C * oy
        size, limit = math.sqrt(mx * mx + my * my), lever * F_N
        if size > limit:
            mx, my = mx * (limit / size), my * (limit / size)
            ax, ay = -(mx + C * ox) / K, -(my + C * oy) / K
        memory[i, 6], memory[i, 7] = ax, ay
        tx += mx
        ty += my
    return px, py, pz, tx, ty, tz
