"""One foot on the plate, in the simulator of the blind test: normal force and friction with an integrated stretch."""

from __future__ import annotations

import math

from rockref.blind.simulator.compiled import compiled
from rockref.blind.simulator.slots import G, P

KN, KT, CN, CT, MU = P["K_N"], P["K_T"], P["C_N"], P["C_T"], P["mu"]
HERTZ_P, HERTZ_X0, HERTZ_FORM = G["hertz_p"], G["hertz_x0"], G["hertz_form"]
CROSSLEY, CROSSLEY_FORM = G["crossley_a"], G["crossley_form"]
HYSTERESIS, HYSTERESIS_FORM = G["hysteresis"], G["hysteresis_form"]
PULL, PULL_RANGE, PULL_FORM = G["pull"], G["pull_range"], G["pull_form"]
STRIBECK, STRIBECK_V, STRIBECK_FORM = G["stribeck_excess"], G["stribeck_v"], G["stribeck_form"]
LOAD, LOAD_REF, LOAD_FORM = G["load_p"], G["load_ref"], G["load_form"]
VISCOUS, VISCOUS_FORM = G["viscous"], G["viscous_form"]
DEPTH_0, SPEED_0 = G["depth_0"], G["speed_0"]


@compiled
def spring(depth, K, g):
    """Return the elastic force [N] of a point at this depth [m], on first loading."""
    if g[HERTZ_P] == 0.0:
        return K * depth
    if g[HERTZ_FORM] == 0.0:
        return K * g[HERTZ_X0] * (depth / g[HERTZ_X0]) ** g[HERTZ_P]
    # Another stiffening: linear first, quadratic beyond; the same force at the depth x0.
    share = g[HERTZ_P] - 1.0
    return K * depth * (1.0 - share + share * depth / g[HERTZ_X0])


@compiled
def normal_force(depth, rate, deepest, creep, p, g):
    """Return the force [N] of the plate on a point at `depth` [m] >= 0, closing at `rate` [m/s]; never a pull."""
    K = p[KN]
    elastic = spring(depth, K, g)
    kappa = g[HYSTERESIS]
    if kappa > 0.0 and depth < deepest:
        dent = kappa / (1.0 + kappa) * deepest
        if g[HYSTERESIS_FORM] == 0.0:
            unloading = K * (1.0 + kappa) * (depth - dent)
        else:
            # Another unloading: a power 3/2 between the dent and the turning point, and again spring at the most.
            unloading = spring(deepest, K, g) * (max(depth - dent, 0.0) / (deepest - dent)) ** 1.5
        elastic = max(min(elastic, unloading), 0.0)
    viscous = p[CN] * rate
    if g[CROSSLEY] > 0.0:
        if g[CROSSLEY_FORM] == 0.0:
            viscous += g[CROSSLEY] * K * depth * rate
        else:
            # Another depth dependence, a root; equal at the reference depth.
            viscous += g[CROSSLEY] * K * math.sqrt(g[DEPTH_0] * depth) * rate
    return max(elastic + viscous + creep, 0.0)


@compiled
def pull(depth, g):
    """Return the attraction [N] of a point at this depth [m]; negative depth is height."""
    if g[PULL_FORM] == 0.0:
        return g[PULL] * min(max(1.0 + depth / g[PULL_RANGE], 0.0), 1.0)
    # Another fading, exponential; the same work on the way out (range/2).
    return g[PULL] * (1.0 if depth >= 0.0 else math.exp(2.0 * depth / g[PULL_RANGE]))


@compiled
def threshold(N, speed, p, g):
    """Return the largest friction force [N] at normal force N [N] and sliding speed [m/s]."""
    mu = p[MU]
    if g[STRIBECK] != 0.0:
        relative = speed / g[STRIBECK_V]
        if g[STRIBECK_FORM] == 0.0:
            mu *= 1.0 + g[STRIBECK] * math.exp(-relative * relative)
        else:
            mu *= 1.0 + g[STRIBECK] / (1.0 + relative * relative)
    if g[LOAD] != 0.0:
        load = N / g[LOAD_REF]
        if g[LOAD_FORM] == 0.0:
            mu *= max(load, 1e-3) ** (-g[LOAD])
        else:
            # Another fall with the load, bounded at no load; the same slope at the reference.
            mu *= 1.0 + g[LOAD] * math.e * (math.exp(-load) - math.exp(-1.0))
    return max(mu, 0.0) * N


@compiled
def friction(sx, sy, vx, vy, N, p, g):
    """Return the friction of a point: force (x, y) [N] and the stretch (x, y) [m] that is left.

    sx, sy : sliding displacement summed over this contact [m]; vx, vy : sliding velocity [m/s]. Where spring and damper
    would exceed the threshold the force is cut to it and the stretch set to what carries the cut force.
    """
    K, C = p[KT], p[CT]
    fx, fy = -K * sx - C * vx, -K * sy - C * vy
    force = math.sqrt(fx * fx + fy * fy)
    limit = threshold(N, math.sqrt(vx * vx + vy * vy), p, g)
    if force > limit:
        cut = limit / force
        fx, fy = fx * cut, fy * cut
        sx, sy = -(fx + C * vx) / K, -(fy + C * vy) / K
    return fx, fy, sx, sy


@compiled
def film(vx, vy, g):
    """Return force over sliding velocity [N s/m] of a film under a touching point."""
    if g[VISCOUS_FORM] == 0.0:
        return g[VISCOUS]
    # Another rheology, shear thinning with power 0.8; equal at the reference speed.
    return g[VISCOUS] * max(math.sqrt(vx * vx + vy * vy) / g[SPEED_0], 1e-6) ** -0.2
