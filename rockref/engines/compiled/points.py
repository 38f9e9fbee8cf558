"""What the effects at the contact points add to force and moment, compiled.

Each effect sums over the points by itself, as its text does, so that the bits agree; the sums are tuples.
"""

from __future__ import annotations

import math

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import slots
from rockref.engines.compiled.contact import length
from rockref.engines.compiled.jit import inlined

#: Arm of the turning stiffness [m], as in `rockref.effects.friction.rolling_resistance`.
ARM = 0.05


@inlined
def pulled(sums, e, height, rx, ry):
    """Adhesion: force along z and moments about x and y, with the pull of one point at this height [m] added."""
    z, mx, my = sums
    pull = e[slots.ADHESION + 1]
    if height > 0.0:
        pull = pull * max(1 + -height / e[slots.ADHESION + 2], 0.0)
    return z - pull, mx - ry * pull, my + rx * pull


@inlined
def pushed(sums, px, py, rx, ry, rz):
    """Force in the plate (2) and moment (3), with those of one point added: viscous friction, uneven normals."""
    x, y, mx, my, mz = sums
    return x + px, y + py, mx - rz * py, my + rz * px, mz + (rx * py - ry * px)


@inlined
def spin_moment(e, props, memory, i, F_N, vx, vy, oz, turn2):
    """Moment about the vertical of a touching point; its yaw moves on."""
    radius, share = e[slots.SPIN + 1], e[slots.SPIN + 2]
    square = radius * radius
    K, C = props[i, col.K_T] * square, props[i, col.C_T] * square
    yaw = memory[i, col.YAW] + turn2
    M = -K * yaw - C * oz
    limit = radius * props[i, col.MU] * F_N
    if share != 0.0:
        rim = radius * abs(oz)
        size = math.sqrt(rim * rim + vx * vx + vy * vy)
        limit = limit * (1 + share * ((rim / size if size > 0.0 else 1.0) - 1))
    if abs(M) > limit:
        M = min(max(M, -limit), limit)
        yaw = -(M + C * oz) / K
    memory[i, col.YAW] = yaw
    return M


@inlined
def roll_moment(e, props, memory, i, F_N, ox, oy, turn0, turn1):
    """Moments about x and y of a touching point; the moments that its springs hold move on."""
    lever = e[slots.ROLLING + 1]
    size = lever * ARM
    K, C = props[i, col.K_N] * size, props[i, col.C_N] * size
    hx, hy = memory[i, col.ROLL_X] - K * turn0, memory[i, col.ROLL_Y] - K * turn1
    dx, dy = C * ox, C * oy
    mx, my = hx - dx, hy - dy
    trial, limit = length(mx, my), lever * F_N
    if trial > limit:
        scale = limit / trial
        mx, my = scale * mx, scale * my
        hx, hy = mx + dx, my + dy
    memory[i, col.ROLL_X], memory[i, col.ROLL_Y] = hx, hy
    return mx, my
