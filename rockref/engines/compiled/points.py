"""What the effects at the contact points add to force and moment, compiled.

Each effect sums over the points by itself, as its text does, so that the bits agree; the sums are tuples.
"""

from __future__ import annotations

import math

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import slots
from rockref.engines.compiled.contact import length
from rockref.engines.compiled.jit import inlined
from rockref.engines.compiled.lanes import anyof, choose

#: Arm of the turning stiffness [m], as in `rockref.effects.friction.rolling_resistance`.
ARM = 0.05


@inlined
def pulled(sums, e, height, rx, ry):
    """Return the adhesion: force along z and moments about x and y, the pull of one point at this height [m] added."""
    z, mx, my = sums
    pull = e[slots.ADHESION + 1]
    pull = choose(height > 0.0, pull * max(1 + -height / e[slots.ADHESION + 2], 0.0), pull)
    return z - pull, mx - ry * pull, my + rx * pull


@inlined
def pushed(sums, px, py, rx, ry, rz):
    """Return force in the plate (2) and moment (3), with those of one point added: viscous friction, uneven normals."""
    x, y, mx, my, mz = sums
    return x + px, y + py, mx - rz * py, my + rz * px, mz + (rx * py - ry * px)


@inlined
def of_foot(e, first, foot):
    """Return the number of one of the four feet, of which the first stands at `first` and each next one two further."""
    return choose(
        foot < 2.5, choose(foot < 1.5, e[first], e[first + 2]), choose(foot < 3.5, e[first + 4], e[first + 6])
    )


@inlined
def spin_moment(e, props, memory, i, F_N, vx, vy, oz, turn2, above):
    """Return the moment about the vertical of a touching point; its yaw moves on."""
    radius, share = e[slots.SPIN + 1], e[slots.SPIN + 2]
    square = radius * radius
    K, C = props[i, col.K_T] * square, props[i, col.C_T] * square
    yaw = memory[i, col.YAW] + turn2
    M = -K * yaw - C * oz
    limit = radius * props[i, col.MU] * F_N
    if anyof(share != 0.0):
        rim = radius * abs(oz)
        size = math.sqrt(rim * rim + vx * vx + vy * vy)
        weaker = limit * (1 + share * (choose(size > 0.0, rim / size, 1.0) - 1))
        limit = choose(share != 0.0, weaker, limit)
    slides = abs(M) > limit
    if anyof(slides):
        M = choose(slides, min(max(M, -limit), limit), M)
        yaw = choose(slides, -(M + C * oz) / K, yaw)
    memory[i, col.YAW] = choose(above, 0.0, yaw)
    return M


@inlined
def roll_moment(e, props, memory, i, F_N, ox, oy, turn0, turn1, above):
    """Return moments about x and y of a touching point; the moments that its springs hold move on."""
    lever = e[slots.ROLLING + 1]
    size = lever * ARM
    K, C = props[i, col.K_N] * size, props[i, col.C_N] * size
    hx, hy = memory[i, col.ROLL_X] - K * turn0, memory[i, col.ROLL_Y] - K * turn1
    dx, dy = C * ox, C * oy
    mx, my = hx - dx, hy - dy
    trial, limit = length(mx, my), lever * F_N
    slides = trial > limit
    if anyof(slides):
        scale = limit / trial
        mx, my = choose(slides, scale * mx, mx), choose(slides, scale * my, my)
        hx, hy = choose(slides, mx + dx, hx), choose(slides, my + dy, hy)
    memory[i, col.ROLL_X], memory[i, col.ROLL_Y] = choose(above, 0.0, hx), choose(above, 0.0, hy)
    return mx, my
