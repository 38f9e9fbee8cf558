"""What the effects on the body add to force and moment, and the plate on its spring, compiled."""

from __future__ import annotations

import math

from rockref.effects.loads.lingering_wire_pull import LEAST_EVENNESS
from rockref.engines.compiled import slots
from rockref.engines.compiled.jit import inlined
from rockref.engines.compiled.lanes import anyof, both, choose, entry, negated, whole


@inlined
def of_time(on, e, t):
    """Return what of the loads depends on the time alone: pull of the wire [N], wave of the vibration."""
    pull = wave = 0.0
    if on.wire:
        even = e[slots.WIRE + 4]
        evenly = even > LEAST_EVENNESS
        left = even
        if anyof(evenly):
            left = max(1.0 - even * t / e[slots.WIRE + 2], 0.0) ** (1.0 / choose(evenly, even, 1.0))
        if anyof(negated(evenly)):
            left = choose(evenly, left, math.exp(-t / e[slots.WIRE + 2]))
        pull = e[slots.WIRE + 1] * left
    if on.vibration:
        psi = e[slots.VIBRATION + 2] * t + e[slots.VIBRATION + 3]
        x, y = math.cos(psi), math.sin(psi)
        wave = x + e[slots.VIBRATION + 6] * (x * x - y * y) + e[slots.VIBRATION + 7] * (2.0 * x * y)
    return pull, wave


@inlined
def plate_acceleration(e, samples, t):
    """Return acceleration of the plate (3), as `rockref.model.base_motion`; samples (N, 3), of all records in turn."""
    place, last = (t - e[slots.BASE + 1]) / e[slots.BASE + 2], e[slots.BASE + 3]
    inside = both(place >= 0.0, place <= last)
    k = choose(inside, whole(place), 0.0)
    share, here = place - k, e[slots.BASE + 4] + k
    after = e[slots.BASE + 4] + min(k + 1.0, last)
    a0, a1, a2 = entry(samples, here, 0), entry(samples, here, 1), entry(samples, here, 2)
    return (
        choose(inside, a0 + (entry(samples, after, 0) - a0) * share, 0.0),
        choose(inside, a1 + (entry(samples, after, 1) - a1) * share, 0.0),
        choose(inside, a2 + (entry(samples, after, 2) - a2) * share, 0.0),
    )


@inlined
def resistance(on, e, v0, v1, v2, ox, oy, oz):
    """Return what the drag multiplies the velocity of the centre and the rates with."""
    moving = turning = 0.0
    if on.drag:
        turning = -e[slots.DRAG + 1] * math.sqrt(ox * ox + oy * oy + oz * oz)
        moving = -e[slots.DRAG + 2] * math.sqrt(v0 * v0 + v1 * v1 + v2 * v2)
    return moving, turning


@inlined
def add_loads(on, e, load, timed, resisting, mass, g, x0, x1, v0, v1, v2, L2, L5, L8, ox, oy, oz):
    """Return force and moment (6) with drag, cable, wire, vibration and tilt, in the order of the step."""
    Fx, Fy, Fz, Mx, My, Mz = load
    (pull, wave), (moving, turning) = timed, resisting
    if on.drag:
        Fx += moving * v0
        Fy += moving * v1
        Fz += moving * v2
        Mx += turning * ox
        My += turning * oy
        Mz += turning * oz
    if on.cable:
        k, c, z = e[slots.CABLE + 1], e[slots.CABLE + 2], e[slots.CABLE + 3]
        rx, ry, rz = L2 * z, L5 * z, L8 * z
        wx, wy = x0 + rx - e[slots.CABLE + 4], x1 + ry - e[slots.CABLE + 5]
        k = k + e[slots.CABLE + 6] * (wx * wx + wy * wy)
        fx = -k * wx - c * (v0 + (oy * rz - oz * ry))
        fy = -k * wy - c * (v1 + (oz * rx - ox * rz))
        Fx += fx
        Fy += fy
        Mx -= rz * fy
        My += rz * fx
        Mz += rx * fy - ry * fx
    if on.wire:
        z = e[slots.WIRE + 3]
        Fy += pull
        Mx -= (L8 * z) * pull
        Mz += (L2 * z) * pull
    if on.vibration:
        k = slots.VIBRATION
        size = -mass * e[k + 1] * wave
        Fx += size * e[k + 4]
        Fy += size * e[k + 5]
    if on.tilt:
        weight, a, b = mass * g, e[slots.TILT + 1], e[slots.TILT + 2]
        Fx += weight * a
        Fy += weight * b
        Fz += weight * ((a * a + b * b) / 2)
    return Fx, Fy, Fz, Mx, My, Mz


@inlined
def advance_support(e, weight, h, carried, turning, plate):
    """Move the plate on its spring one step on: q, q_rate, pitch, pitch_rate."""
    k, (q, q_rate, pitch, pitch_rate) = slots.SUPPORT, plate
    q_rate = q_rate + h * ((weight - carried) - e[k + 2] * q - e[k + 3] * q_rate) / e[k + 1]
    q = q + h * q_rate
    pitches = e[k + 4] != 0.0
    if anyof(pitches):
        load = e[k + 7] - turning
        inertia = choose(pitches, e[k + 4], 1.0)
        next_rate = pitch_rate + h * (load - e[k + 5] * pitch - e[k + 6] * pitch_rate) / inertia
        pitch = choose(pitches, pitch + h * next_rate, pitch)
        pitch_rate = choose(pitches, next_rate, pitch_rate)
    return q, q_rate, pitch, pitch_rate
