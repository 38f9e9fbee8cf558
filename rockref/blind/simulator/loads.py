"""Loads away from the feet, in the simulator of the blind test."""

from __future__ import annotations

import math

from rockref.blind.simulator.compiled import compiled
from rockref.blind.simulator.slots import G

DRAG, DRAG_FORM = G["drag"], G["drag_form"]
CABLE_K, CABLE_C, CABLE_FORM = G["cable_k"], G["cable_c"], G["cable_form"]
WIRE, WIRE_TAU, WIRE_FORM = G["wire"], G["wire_tau"], G["wire_form"]
SHAKE, SHAKE_F, SHAKE_DIR, SHAKE_PHASE, HARMONIC = (
    G[k] for k in ("shake", "shake_f", "shake_dir", "shake_phase", "shake_harmonic")
)
TOP, BOTTOM, GRAVITY = G["top"], G["bottom"], G["gravity"]
MAGNET, MAGNET_Y, MAGNET_LENGTH = G["magnet"], G["magnet_y"], G["magnet_length"]
GUST, GUST_T, GUST_WIDTH, GUST_Z, GUST_X = (G[k] for k in ("gust", "gust_t", "gust_width", "gust_z", "gust_x"))
HUNG_M, HUNG_Z, SWAY_0 = G["hung_m"], G["hung_z"], G["sway_0"]
KX, KY, KZ, CX, CY, CZ = (G[k] for k in ("hung_kx", "hung_ky", "hung_kz", "hung_cx", "hung_cy", "hung_cz"))
# Gauss-Legendre, five nodes on -1 to 1: exact for polynomials up to the ninth degree.
NODES = (0.0, -0.5384693101056831, 0.5384693101056831, -0.9061798459386640, 0.9061798459386640)
WEIGHTS = (0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891, 0.2369268850561891)


@compiled
def push(height, R, fx, fy, fz, F, M):
    """Add the force (fx, fy, fz) at the body point (0, 0, height) to F, M (3,)."""
    rx, ry, rz = R[0, 2] * height, R[1, 2] * height, R[2, 2] * height
    F[0] += fx
    F[1] += fy
    F[2] += fz
    M[0] += ry * fz - rz * fy
    M[1] += rz * fx - rx * fz
    M[2] += rx * fy - ry * fx


@compiled
def load_on_body(t, x, v, R, w, mass, g, anchor, start, F, M):
    """Add all loads at time t [s] to F, M (3,); w in plate axes. At the start the cable's anchor (2,) is set."""
    top = g[TOP]
    if start:
        anchor[0], anchor[1] = x[0] + R[0, 2] * top, x[1] + R[1, 2] * top
    if g[DRAG] > 0.0 and g[DRAG_FORM] == 0.0:
        turning = math.sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2])
        for k in range(3):
            M[k] -= g[DRAG] * turning * w[k]
    elif g[DRAG] > 0.0:  # another flow: force and moment of the faces, each pair for itself, the broad side a bit more
        middle, reach = 0.5 * (g[TOP] + g[BOTTOM]), 0.5 * (g[TOP] - g[BOTTOM])
        for k in range(5):
            z = middle + reach * NODES[k]
            vx = v[0] + (w[1] * R[2, 2] - w[2] * R[1, 2]) * z
            vy = v[1] + (w[2] * R[0, 2] - w[0] * R[2, 2]) * z
            c = 0.5 * WEIGHTS[k] * g[DRAG] / (2.0 * reach**3)  # about the base it comes to the same moment
            push(z, R, -c * abs(vx) * vx, -1.15 * c * abs(vy) * vy, 0.0, F, M)
    if g[CABLE_K] > 0.0 or g[CABLE_C] > 0.0:
        ox, oy = x[0] + R[0, 2] * top - anchor[0], x[1] + R[1, 2] * top - anchor[1]
        vx = v[0] + (w[1] * R[2, 2] - w[2] * R[1, 2]) * top
        vy = v[1] + (w[2] * R[0, 2] - w[0] * R[2, 2]) * top
        k = g[CABLE_K]
        if g[CABLE_FORM] != 0.0:  # another cable: it stiffens as it straightens; equal at the reference way
            k *= 0.5 + 0.5 * (ox * ox + oy * oy) / g[SWAY_0] ** 2
        push(top, R, -k * ox - g[CABLE_C] * vx, -k * oy - g[CABLE_C] * vy, 0.0, F, M)
    if g[WIRE] > 0.0:
        if g[WIRE_FORM] == 0.0:
            share = math.exp(-t / g[WIRE_TAU])
        else:  # another way to let go: linear to zero in twice the time, the same impulse
            share = max(1.0 - 0.5 * t / g[WIRE_TAU], 0.0)
        push(top, R, 0.0, g[WIRE] * share, 0.0, F, M)
    if g[SHAKE] != 0.0:
        angle = 2.0 * math.pi * g[SHAKE_F] * t + g[SHAKE_PHASE]
        size = -mass * g[SHAKE] * (math.cos(angle) + g[HARMONIC] * math.cos(2.0 * angle))
        F[0] += size * math.sin(g[SHAKE_DIR])
        F[1] += size * math.cos(g[SHAKE_DIR])
    if g[MAGNET] > 0.0:
        away = (g[MAGNET_Y] - x[1] - R[1, 2] * top) / g[MAGNET_LENGTH]
        push(top, R, 0.0, g[MAGNET] * math.exp(-abs(away)), 0.0, F, M)
    if g[GUST] != 0.0 or g[GUST_X] != 0.0:
        since = (t - g[GUST_T]) / g[GUST_WIDTH]
        if 0.0 < since < 1.0:
            share = math.sin(math.pi * since) ** 2
            push(g[GUST_Z], R, g[GUST_X] * share, g[GUST] * share, 0.0, F, M)


@compiled
def hung_force(x, v, R, w, hung, hung_v, g, out, F, M):
    """Write the force (3,) on a mass that hangs on springs inside at (0, 0, HUNG_Z); add its opposite to F, M."""
    rx, ry, rz = hung[0] - x[0], hung[1] - x[1], hung[2] - x[2]
    vx = hung_v[0] - v[0] - (w[1] * rz - w[2] * ry)
    vy = hung_v[1] - v[1] - (w[2] * rx - w[0] * rz)
    vz = hung_v[2] - v[2] - (w[0] * ry - w[1] * rx)
    b0 = -g[KX] * (R[0, 0] * rx + R[1, 0] * ry + R[2, 0] * rz) - g[CX] * (R[0, 0] * vx + R[1, 0] * vy + R[2, 0] * vz)
    b1 = -g[KY] * (R[0, 1] * rx + R[1, 1] * ry + R[2, 1] * rz) - g[CY] * (R[0, 1] * vx + R[1, 1] * vy + R[2, 1] * vz)
    b2 = -g[KZ] * (R[0, 2] * rx + R[1, 2] * ry + R[2, 2] * rz - g[HUNG_Z])
    b2 -= g[CZ] * (R[0, 2] * vx + R[1, 2] * vy + R[2, 2] * vz)
    for k in range(3):
        out[k] = R[k, 0] * b0 + R[k, 1] * b1 + R[k, 2] * b2
        F[k] -= out[k]
    M[0] -= ry * out[2] - rz * out[1]
    M[1] -= rz * out[0] - rx * out[2]
    M[2] -= rx * out[1] - ry * out[0]
    out[2] -= g[HUNG_M] * g[GRAVITY]
