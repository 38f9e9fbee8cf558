"""What the effects add to the force and the moment on the body, compiled; each sums over the points by itself, as the
text in `rockref.effects` does, so that the bits agree."""

from __future__ import annotations

import math

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import slots
from rockref.engines.compiled.contact import length
from rockref.engines.compiled.jit import called, inlined

#: Slices of the drag, as in `rockref.effects.loads.quadratic_drag`.
SLICES = 16
#: Arm of the turning stiffness [m], as in `rockref.effects.friction.rolling_resistance`.
ARM = 0.05


@inlined
def pull(e, xi):
    """Adhesion of one point at penetration xi [N]."""
    return e[slots.ADHESION + 1] * min(max(1 + xi / e[slots.ADHESION + 2], 0.0), 1.0)


@called
def add_point_forces(load, e, props, memory, forces):
    """Adhesion, viscous friction and uneven normals."""
    Fx, Fy, Fz, Mx, My, Mz = load
    for k in range(3):
        on = e[slots.ADHESION] if k == 0 else e[slots.VISCOUS] if k == 1 else e[slots.NORMALS]
        if on == 0.0:
            continue
        fx = fy = fz = mx = my = mz = 0.0
        for i in range(memory.shape[0]):
            touching, F_N = memory[i, col.ANCHORED] != 0.0, forces[i, 2]
            px = py = pz = 0.0
            if k == 0:
                pz = -pull(e, memory[i, col.XI])
            elif k == 1 and touching:
                px, py = -e[slots.VISCOUS + 1] * memory[i, col.V_X], -e[slots.VISCOUS + 1] * memory[i, col.V_Y]
            elif k == 2 and touching:
                at = slots.NORMALS + 2 * int(props[i, col.FOOT])
                px, py = F_N * e[at - 1], F_N * e[at]
            rx, ry, rz = memory[i, col.R_X], memory[i, col.R_Y], memory[i, col.R_Z]
            fx, fy, fz = fx + px, fy + py, fz + pz
            mx, my, mz = mx + (ry * pz - rz * py), my + (rz * px - rx * pz), mz + (rx * py - ry * px)
        Fx += fx
        Fy += fy
        Fz += fz
        Mx += mx
        My += my
        Mz += mz
    return Fx, Fy, Fz, Mx, My, Mz


@called
def add_point_moments(load, e, props, memory, forces, ox, oy, oz, turn0, turn1, turn2):
    """Spin friction and rolling resistance; their memories move on."""
    Fx, Fy, Fz, Mx, My, Mz = load
    if e[slots.SPIN] != 0.0:
        radius = e[slots.SPIN + 1]
        square, mz = radius * radius, 0.0
        for i in range(memory.shape[0]):
            if memory[i, col.ANCHORED] == 0.0:
                memory[i, col.YAW] = 0.0
                continue
            K, C = props[i, col.K_T] * square, props[i, col.C_T] * square
            yaw = memory[i, col.YAW] + turn2
            M = -K * yaw - C * oz
            limit = radius * props[i, col.MU] * forces[i, 2]
            if abs(M) > limit:
                M = min(max(M, -limit), limit)
                yaw = -(M + C * oz) / K
            memory[i, col.YAW] = yaw
            mz += M
        Mz += mz
    if e[slots.ROLLING] != 0.0:
        lever = e[slots.ROLLING + 1]
        size, mx, my = lever * ARM, 0.0, 0.0
        for i in range(memory.shape[0]):
            if memory[i, col.ANCHORED] == 0.0:
                memory[i, col.ROLL_X] = memory[i, col.ROLL_Y] = 0.0
                continue
            K, C = props[i, col.K_N] * size, props[i, col.C_N] * size
            ax, ay = memory[i, col.ROLL_X] + turn0, memory[i, col.ROLL_Y] + turn1
            tx, ty = -K * ax - C * ox, -K * ay - C * oy
            trial, limit = length(tx, ty), lever * forces[i, 2]
            if trial > limit:
                scale = limit / trial
                tx, ty = scale * tx, scale * ty
                ax, ay = -(tx + C * ox) / K, -(ty + C * oy) / K
            memory[i, col.ROLL_X], memory[i, col.ROLL_Y] = ax, ay
            mx += tx
            my += ty
        Mx += mx
        My += my
    return Fx, Fy, Fz, Mx, My, Mz


@called
def add_body_loads(load, e, mass, g, x0, x1, v0, v1, v2, L2, L5, L8, ox, oy, oz, t):
    """Drag, cable, wire, vibration and tilt."""
    Fx, Fy, Fz, Mx, My, Mz = load
    if e[slots.DRAG] != 0.0:
        c, half = -e[slots.DRAG + 1] / SLICES, e[slots.DRAG + 2]
        fx = fy = fz = mx = my = mz = 0.0
        for k in range(SLICES):
            z = half * ((2 * k + 1) / SLICES - 1)
            rx, ry, rz = L2 * z, L5 * z, L8 * z
            vx, vy, vz = v0 + (oy * rz - oz * ry), v1 + (oz * rx - ox * rz), v2 + (ox * ry - oy * rx)
            scale = c * math.sqrt(vx * vx + vy * vy + vz * vz)
            dx, dy, dz = scale * vx, scale * vy, scale * vz
            fx, fy, fz = fx + dx, fy + dy, fz + dz
            mx, my, mz = mx + (ry * dz - rz * dy), my + (rz * dx - rx * dz), mz + (rx * dy - ry * dx)
        Fx += fx
        Fy += fy
        Fz += fz
        Mx += mx
        My += my
        Mz += mz
    if e[slots.CABLE] != 0.0:
        k, c, z = e[slots.CABLE + 1], e[slots.CABLE + 2], e[slots.CABLE + 3]
        rx, ry, rz = L2 * z, L5 * z, L8 * z
        fx = -k * (x0 + rx - e[slots.CABLE + 4]) - c * (v0 + (oy * rz - oz * ry))
        fy = -k * (x1 + ry - e[slots.CABLE + 5]) - c * (v1 + (oz * rx - ox * rz))
        Fx += fx
        Fy += fy
        Mx -= rz * fy
        My += rz * fx
        Mz += rx * fy - ry * fx
    if e[slots.WIRE] != 0.0:
        z, fy = e[slots.WIRE + 3], e[slots.WIRE + 1] * math.exp(-t / e[slots.WIRE + 2])
        Fy += fy
        Mx -= (L8 * z) * fy
        Mz += (L2 * z) * fy
    if e[slots.VIBRATION] != 0.0:
        k = slots.VIBRATION
        size = -mass * e[k + 1] * math.cos(e[k + 2] * t + e[k + 3])
        Fx += size * e[k + 4]
        Fy += size * e[k + 5]
    if e[slots.TILT] != 0.0:
        weight, a, b = mass * g, e[slots.TILT + 1], e[slots.TILT + 2]
        Fx += weight * a
        Fy += weight * b
        Fz += weight * ((a * a + b * b) / 2)
    return Fx, Fy, Fz, Mx, My, Mz


@called
def add_loads(
    load, e, mass, g, props, memory, forces, x0, x1, v0, v1, v2, L2, L5, L8, ox, oy, oz, turn0, turn1, turn2, t
):
    """Everything that the effects add to force and moment (6), in the order of the step."""
    load = add_point_forces(load, e, props, memory, forces)
    load = add_point_moments(load, e, props, memory, forces, ox, oy, oz, turn0, turn1, turn2)
    return add_body_loads(load, e, mass, g, x0, x1, v0, v1, v2, L2, L5, L8, ox, oy, oz, t)


@called
def advance_support(e, mass, g, h, memory, forces, q, q_rate):
    """The plate on its spring, one step on: q, q_rate."""
    carried = 0.0
    for i in range(memory.shape[0]):
        carried += forces[i, 2]
    if e[slots.ADHESION] != 0.0:
        pulled = 0.0
        for i in range(memory.shape[0]):
            pulled += pull(e, memory[i, col.XI])
        carried -= pulled
    k = slots.SUPPORT
    q_rate = q_rate + h * ((mass * g - carried) - e[k + 2] * q - e[k + 3] * q_rate) / e[k + 1]
    return q + h * q_rate, q_rate
