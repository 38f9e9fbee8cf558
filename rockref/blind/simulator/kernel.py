"""The simulator of the blind test: leapfrog in time, quaternions in space, one loop over the steps."""

from __future__ import annotations

import math

import numpy as np

from rockref.blind.simulator.compiled import compiled, fingerprint, kept
from rockref.blind.simulator.contact import CN, CT, KN, KT, MU, film, friction, normal_force, pull
from rockref.blind.simulator.loads import hung_force, load_on_body
from rockref.blind.simulator.slots import G, P

RADIUS, SLOPE_X, SLOPE_Y = P["radius"], P["slope_x"], P["slope_y"]
PULL, VISCOUS, SPIN, SPIN_FORM, ROLL, ROLL_FORM = (
    G[k] for k in ("pull", "viscous", "spin", "spin_form", "roll", "roll_form")
)
PULL_RANGE, HYSTERESIS, CREEP_K, CREEP_TAU = G["pull_range"], G["hysteresis"], G["creep_k"], G["creep_tau"]
GRAVITY, GRAVITY_X, GRAVITY_Y, NORMALS_FORM = G["gravity"], G["gravity_x"], G["gravity_y"], G["normals_form"]
PLATE_M, PLATE_F, PLATE_RATIO = G["plate_m"], G["plate_f"], G["plate_ratio"]
PITCH_K, PITCH_J, PITCH_C = G["pitch_k"], G["pitch_J"], G["pitch_c"]
HUNG_M, HALF_WEIGHT = G["hung_m"], G["half_weight"]
ROTOR_X, ROTOR_Y, ROTOR_Z = G["rotor_x"], G["rotor_y"], G["rotor_z"]
# decided: half the base turns a stiffness of a foot into one against rolling; see the effect of that name.
ARM = 0.05
# Columns of a point's memory: stretch (2), last sliding velocity (2), turns (3), deepest, creep force, touching.
MEMORY = 10


@compiled
def rotation(q, R):
    """Write the matrix (3, 3) from body to plate of the quaternion q (4,), scalar first."""
    a, b, c, d = q[0], q[1], q[2], q[3]
    R[0, 0], R[0, 1], R[0, 2] = a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)
    R[1, 0], R[1, 1], R[1, 2] = 2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)
    R[2, 0], R[2, 1], R[2, 2] = 2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d


@compiled
def turn(q, w, dt):
    """Turn q (4,) by the body rates w (3,) [rad/s] held for dt [s], and normalise it."""
    x, y, z = 0.5 * dt * w[0], 0.5 * dt * w[1], 0.5 * dt * w[2]
    square = x * x + y * y + z * z
    # Series of cos and sin(s)/s: a step turns the block by less than 1e-4 rad, the next terms are below 1e-16.
    cos, sinc = 1.0 - square / 2.0 + square * square / 24.0, 1.0 - square / 6.0 + square * square / 120.0
    x, y, z = x * sinc, y * sinc, z * sinc
    a, b, c, d = q[0], q[1], q[2], q[3]
    q[0], q[1] = a * cos - b * x - c * y - d * z, a * x + b * cos + c * z - d * y
    q[2], q[3] = a * y - b * z + c * cos + d * x, a * z + b * y - c * x + d * cos
    size = 1.0 / math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    for i in range(4):
        q[i] *= size


@compiled
def gyroscopic(w, J, g, out):
    """Write -w x (J w + h), (3,) [N m], with h the angular momentum of a rotor inside."""
    a = J[0, 0] * w[0] + J[0, 1] * w[1] + J[0, 2] * w[2] + g[ROTOR_X]
    b = J[1, 0] * w[0] + J[1, 1] * w[1] + J[1, 2] * w[2] + g[ROTOR_Y]
    c = J[2, 0] * w[0] + J[2, 1] * w[1] + J[2, 2] * w[2] + g[ROTOR_Z]
    out[0], out[1], out[2] = w[2] * b - w[1] * c, w[0] * c - w[2] * a, w[1] * a - w[0] * b


@compiled
def foot_forces(x, v, R, w_plate, points, props, memory, plate, g, dt, F, M, reaction):
    """Add the forces of all feet on the block to F, M (3,), about the centre of mass; those on the plate to reaction.

    plate : lift, rate of lift, pitch, rate of pitch. reaction : upward force, and its moment about the X of the plate.
    """
    reach = 0.0
    if g[PULL] > 0.0:
        reach = 4.0 * g[PULL_RANGE]
    for i in range(points.shape[0]):
        p, m = props[i], memory[i]
        cx, cy, cz = points[i, 0], points[i, 1], points[i, 2] + p[RADIUS]  # centre of a round foot
        rx = R[0, 0] * cx + R[0, 1] * cy + R[0, 2] * cz
        ry = R[1, 0] * cx + R[1, 1] * cy + R[1, 2] * cz
        rz = R[2, 0] * cx + R[2, 1] * cy + R[2, 2] * cz - p[RADIUS]
        depth = plate[0] + plate[2] * (x[1] + ry) - x[2] - rz
        if depth < -reach:
            if m[9] != 0.0:
                for k in range(MEMORY):
                    m[k] = 0.0
            continue
        vx = v[0] + w_plate[1] * rz - w_plate[2] * ry
        vy = v[1] + w_plate[2] * rx - w_plate[0] * rz
        rate = plate[1] + plate[3] * (x[1] + ry) - (v[2] + w_plate[0] * ry - w_plate[1] * rx)
        fx, fy, fz, N = 0.0, 0.0, 0.0, 0.0
        if g[PULL] > 0.0:
            fz -= pull(depth, g)
        if depth < 0.0:
            if m[9] != 0.0:
                for k in range(MEMORY):
                    m[k] = 0.0
        else:
            if m[9] != 0.0:  # sliding summed by the trapezoid; a foot that has just landed starts at zero
                m[0] += 0.5 * dt * (m[2] + vx)
                m[1] += 0.5 * dt * (m[3] + vy)
                for k in range(3):
                    m[4 + k] += dt * w_plate[k]
                if g[CREEP_K] > 0.0:
                    m[8] += dt * (g[CREEP_K] * rate - m[8] / g[CREEP_TAU])
            m[2], m[3], m[9] = vx, vy, 1.0
            m[7] = max(m[7], depth)
            N = normal_force(depth, rate, m[7], m[8], p, g)
            a, b, m[0], m[1] = friction(m[0], m[1], vx, vy, N, p, g)
            fx, fy, fz = fx + a, fy + b, fz + N
            if g[VISCOUS] > 0.0:
                c = film(vx, vy, g)
                fx, fy = fx - c * vx, fy - c * vy
            if p[SLOPE_X] != 0.0 or p[SLOPE_Y] != 0.0:
                a, b = p[SLOPE_X], p[SLOPE_Y]
                if g[NORMALS_FORM] != 0.0:  # another cause: slopes of the feet, which turn with the block
                    a, b = R[0, 0] * a + R[0, 1] * b, R[1, 0] * a + R[1, 1] * b
                fx, fy = fx + N * a, fy + N * b
            if g[SPIN] > 0.0:
                K, C = p[KT] * g[SPIN] ** 2, p[CT] * g[SPIN] ** 2
                limit = g[SPIN] * p[MU] * N
                if g[SPIN_FORM] != 0.0:  # another law: a foot that slides resists turning less (Contensou)
                    rim = abs(w_plate[2]) * g[SPIN]
                    limit *= (rim + 1e-6) / (math.sqrt(rim * rim + vx * vx + vy * vy) + 1e-6)
                a = -K * m[6] - C * w_plate[2]
                if abs(a) > limit:
                    a = math.copysign(limit, a)
                    m[6] = -(a + C * w_plate[2]) / K
                M[2] += a
            if g[ROLL] > 0.0:
                lever = g[ROLL]
                if g[ROLL_FORM] != 0.0:  # another law: the lever grows with the root of the load
                    lever *= math.sqrt(N / g[HALF_WEIGHT])
                K, C = p[KN] * g[ROLL] * ARM, p[CN] * g[ROLL] * ARM
                a, b = -K * m[4] - C * w_plate[0], -K * m[5] - C * w_plate[1]
                size, limit = math.sqrt(a * a + b * b), lever * N
                if size > limit:
                    a, b = a * limit / size, b * limit / size
                    m[4], m[5] = -(a + C * w_plate[0]) / K, -(b + C * w_plate[1]) / K
                M[0] += a
                M[1] += b
        F[0] += fx
        F[1] += fy
        F[2] += fz
        M[0] += ry * fz - rz * fy
        M[1] += rz * fx - rx * fz
        M[2] += rx * fy - ry * fx
        reaction[0] += fz
        reaction[1] += fz * (x[1] + ry)


@compiled
def _run(x, v, q, w, J, J_inverse, mass, points, props, g, plate, hung, hung_v, steps, dt, every, rates):
    """Integrate `steps` steps of dt [s] and write the body rates [rad/s] every `every` steps to rates (N, 3).

    Changed in place: x, v (3,), q (4,), w (3,) body; plate (4,), hung, hung_v (3,). points (n, 3), props (n, POINT).
    Each step: half a kick, drift, forces at the new place with the velocities foreseen for it, half a kick.
    """
    n = points.shape[0]
    memory = np.zeros((n, MEMORY))
    R, F, M, T, half = np.zeros((3, 3)), np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3)
    a, alpha, w_plate, spin, before = np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3), np.zeros(3)
    reaction, hung_a, pull_back = np.zeros(2), np.zeros(3), np.zeros(3)
    anchor = np.zeros(2)
    rotation(q, R)
    load_on_body(0.0, x, v, R, w_plate, mass, g, anchor, True, F, M)
    initial_load, initial_moment, plate_a, pitch_a = 0.0, 0.0, 0.0, 0.0
    plate_k = (2.0 * math.pi * g[PLATE_F]) ** 2 * g[PLATE_M]
    plate_c = 2.0 * g[PLATE_RATIO] * math.sqrt(plate_k * g[PLATE_M])
    row = 0
    for step in range(steps + 1):
        if step > 0:
            for k in range(3):
                v[k] += 0.5 * dt * a[k]
                w[k] += 0.5 * dt * alpha[k]
                x[k] += dt * v[k]
            turn(q, w, dt)
            rotation(q, R)
            if g[HUNG_M] > 0.0:
                for k in range(3):
                    hung_v[k] += 0.5 * dt * hung_a[k]
                    hung[k] += dt * hung_v[k]
            if plate_k > 0.0:
                plate[1] += dt * plate_a
                plate[0] += dt * plate[1]
                plate[3] += dt * pitch_a
                plate[2] += dt * plate[3]
        for k in range(3):
            half[k] = v[k] + 0.5 * dt * a[k]
            before[k] = w[k] + 0.5 * dt * alpha[k]
        for k in range(3):
            w_plate[k] = R[k, 0] * before[0] + R[k, 1] * before[1] + R[k, 2] * before[2]
        F[0], F[1], F[2] = mass * g[GRAVITY_X], mass * g[GRAVITY_Y], -mass * g[GRAVITY]
        M[0], M[1], M[2] = 0.0, 0.0, 0.0
        reaction[0], reaction[1] = 0.0, 0.0
        foot_forces(x, half, R, w_plate, points, props, memory, plate, g, dt, F, M, reaction)
        load_on_body(step * dt, x, half, R, w_plate, mass, g, anchor, False, F, M)
        if g[HUNG_M] > 0.0:
            hung_force(x, half, R, w_plate, hung, hung_v, g, pull_back, F, M)
            for k in range(3):
                hung_a[k] = pull_back[k] / g[HUNG_M]
        if plate_k > 0.0:
            if step == 0:
                initial_load, initial_moment = reaction[0], reaction[1]
            plate_a = (initial_load - reaction[0] - plate_k * plate[0] - plate_c * plate[1]) / g[PLATE_M]
            if g[PITCH_K] > 0.0:
                turned = initial_moment - reaction[1] - g[PITCH_K] * plate[2] - g[PITCH_C] * plate[3]
                pitch_a = turned / g[PITCH_J]
        for k in range(3):
            a[k] = F[k] / mass
            T[k] = R[0, k] * M[0] + R[1, k] * M[1] + R[2, k] * M[2]
        gyroscopic(before, J, g, spin)
        for k in range(3):
            alpha[k] = (
                J_inverse[k, 0] * (T[0] + spin[0])
                + J_inverse[k, 1] * (T[1] + spin[1])
                + J_inverse[k, 2] * (T[2] + spin[2])
            )
        if step > 0:
            for k in range(3):
                v[k] += 0.5 * dt * a[k]
                w[k] += 0.5 * dt * alpha[k]
                if g[HUNG_M] > 0.0:
                    hung_v[k] += 0.5 * dt * hung_a[k]
        if step % every == 0:
            for k in range(3):
                rates[row, k] = w[k]
            row += 1


def _entry(sources: int):
    @kept
    def run(x, v, q, w, J, J_inverse, mass, points, props, g, plate, hung, hung_v, steps, dt, every, rates):
        if sources != 0:
            _run(x, v, q, w, J, J_inverse, mass, points, props, g, plate, hung, hung_v, steps, dt, every, rates)

    return run


#: The simulation as Python calls it: arguments as in `_run`.
run = _entry(fingerprint("slots", "contact", "loads", "kernel"))
