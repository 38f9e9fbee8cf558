"""What the effects add to the force and the moment on the body; compiled."""

from __future__ import annotations

import math

import numba

from rockref.engines.compiled import slots

SLICES = 16


@numba.njit(inline="always")
def body_loads(e, mass, g, x0, x1, v0, v1, v2, L2, L5, L8, ox, oy, oz, t):
    """Force (3) [N] and moment about the centre of mass (3) [N m], plate axes."""
    fx = fy = fz = mx = my = mz = 0.0
    if e[slots.DRAG] != 0.0:
        c, low, high = e[slots.DRAG + 1] / SLICES, e[slots.DRAG + 2], e[slots.DRAG + 3]
        for k in range(SLICES):
            z = low + (high - low) * (k + 0.5) / SLICES
            rx, ry, rz = L2 * z, L5 * z, L8 * z
            vx, vy, vz = v0 + (oy * rz - oz * ry), v1 + (oz * rx - ox * rz), v2 + (ox * ry - oy * rx)
            speed = c * math.sqrt(vx * vx + vy * vy + vz * vz)
            dx, dy, dz = -speed * vx, -speed * vy, -speed * vz
            fx += dx
            fy += dy
            fz += dz
            mx += ry * dz - rz * dy
            my += rz * dx - rx * dz
            mz += rx * dy - ry * dx
    if e[slots.CABLE] != 0.0:
        z = e[slots.CABLE + 3]
        rx, ry, rz = L2 * z, L5 * z, L8 * z
        vx, vy = v0 + (oy * rz - oz * ry), v1 + (oz * rx - ox * rz)
        dx = -e[slots.CABLE + 1] * (x0 + rx) - e[slots.CABLE + 2] * vx
        dy = -e[slots.CABLE + 1] * (x1 + ry) - e[slots.CABLE + 2] * vy
        fx += dx
        fy += dy
        mx -= rz * dy
        my += rz * dx
        mz += rx * dy - ry * dx
    if e[slots.WIRE] != 0.0:
        z = e[slots.WIRE + 3]
        rx, ry, rz = L2 * z, L5 * z, L8 * z
        dy = e[slots.WIRE + 4] * e[slots.WIRE + 1] * math.exp(-t / e[slots.WIRE + 2])
        fy += dy
        mx -= rz * dy
        mz += rx * dy
    if e[slots.VIBRATION] != 0.0:
        force = -mass * e[slots.VIBRATION + 1] * math.cos(e[slots.VIBRATION + 2] * t + e[slots.VIBRATION + 4])
        fx += force * math.sin(e[slots.VIBRATION + 3])
        fy += force * math.cos(e[slots.VIBRATION + 3])
    if e[slots.TILT] != 0.0:
        a, b = e[slots.TILT + 1], e[slots.TILT + 2]
        fx += mass * g * a
        fy += mass * g * b
        fz += mass * g * ((a * a + b * b) / 2)
    return fx, fy, fz, mx, my, mz
