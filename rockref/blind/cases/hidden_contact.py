"""Hidden effects at the feet: normal contact, friction, shape and mass."""

from __future__ import annotations

import numpy as np

from rockref.blind.cases.drawing import CATALOGUE, about, pick, said, signed, uneven
from rockref.blind.simulator.slots import P
from rockref.blind.simulator.world import World


def hertzian_contact(world: World, rng, size, other, given):
    """Hide a stiffening spring."""
    p = pick(given, "exponent", 1.0 + about(rng, 0.5 * size, 0.1))
    x0 = pick(given, "reference", 2e-5 * world.factor("hertzian_contact.reference"))
    world["hertz_p"], world["hertz_x0"], world["hertz_form"] = p, x0, other
    return said({"exponent": p, "reference": x0}, "linear and quadratic spring" if other else CATALOGUE)


def hunt_crossley_contact(world: World, rng, size, other, given):
    """Hide a damper that grows with depth."""
    a = pick(given, "a", world.factor("hunt_crossley_contact.a") * about(rng, 0.5 * size))
    world["crossley_a"], world["crossley_form"] = a, other
    return said({"a": a}, "damper grows with the root of the depth" if other else CATALOGUE)


def hysteretic_contact(world: World, rng, size, other, given):
    """Hide a spring that gives back less."""
    kappa = pick(given, "kappa", about(rng, 0.3 * size))
    world["hysteresis"], world["hysteresis_form"] = kappa, other
    return said({"kappa": kappa}, "unloading with the power 3/2" if other else CATALOGUE)


def adhesion(world: World, rng, size, other, given):
    """Hide a pull toward the plate."""
    force = pick(given, "force", world.factor("adhesion.force") * about(rng, 50.0 * size))
    reach = pick(given, "range", about(rng, 2e-5, 0.2))
    world["pull"], world["pull_range"], world["pull_form"] = force, reach, other
    return said({"force": force, "range": reach}, "exponential fading" if other else CATALOGUE)


def _feet(factors):
    return {f"foot{i}": float(f) for i, f in enumerate(factors, 1)}


def uneven_foot_stiffness(world: World, rng, size, other, given):
    """Hide feet of different stiffness."""
    factors = uneven(rng, 0.35 * size)
    world.scale("K_N", factors)
    if other:
        world.scale("K_T", factors)
    return said(_feet(factors), "the tangential stiffness goes along" if other else CATALOGUE)


def uneven_foot_damping(world: World, rng, size, other, given):
    """Hide feet of different damping."""
    factors = uneven(rng, 0.55 * size)
    world.scale("C_N", factors)
    if not other:
        world.scale("C_T", factors)
    return said(_feet(factors), "the normal damper alone" if other else CATALOGUE)


def uneven_foot_friction(world: World, rng, size, other, given):
    """Hide feet of different friction."""
    factors = uneven(rng, 0.25 * size)
    world.scale("mu", factors)
    if other:  # the inner points keep theirs
        world.props[~world.external, P["mu"]] /= factors[world.foot[~world.external]]
    return said(_feet(factors), "the outer points alone" if other else CATALOGUE)


def stribeck_friction(world: World, rng, size, other, given):
    """Hide friction that falls with sliding speed."""
    ratio, velocity = pick(given, "ratio", 1.0 + about(rng, 0.5 * size)), pick(given, "velocity", about(rng, 0.01))
    world["stribeck_excess"], world["stribeck_v"], world["stribeck_form"] = ratio - 1.0, velocity, other
    return said({"ratio": ratio, "velocity": velocity}, "algebraic fall" if other else CATALOGUE)


def viscous_friction(world: World, rng, size, other, given):
    """Hide a film under the feet."""
    c = pick(given, "c", world.factor("viscous_friction.c") * about(rng, 1000.0 * size))
    world["viscous"], world["viscous_form"] = c, other
    return said({"c": c}, "shear thinning, power 0.8" if other else CATALOGUE)


def load_dependent_friction(world: World, rng, size, other, given):
    """Hide a coefficient that falls with the load."""
    p = pick(given, "exponent", about(rng, 0.15 * size))
    load = 264.87 * world.factor("load_dependent_friction.reference")
    world["load_p"], world["load_ref"], world["load_form"] = p, load, other
    return said({"exponent": p, "reference": load}, "exponential fall, bounded at no load" if other else CATALOGUE)


def spin_friction(world: World, rng, size, other, given):
    """Hide a foot that resists turning about the vertical."""
    radius = pick(given, "radius", world.factor("spin_friction.radius") * about(rng, 2e-3 * size))
    world["spin"], world["spin_form"] = radius, other
    return said({"radius": radius}, "weakened by sliding" if other else CATALOGUE)


def rolling_resistance(world: World, rng, size, other, given):
    """Hide a foot that resists being rolled over."""
    lever = pick(given, "lever", world.factor("rolling_resistance.lever") * about(rng, 2e-4 * size))
    world["roll"], world["roll_form"] = lever, other
    return said({"lever": lever}, "lever grows with the root of the load" if other else CATALOGUE)


def rounded_feet(world: World, rng, size, other, given):
    """Hide feet that roll."""
    radius = pick(given, "radius", world.factor("rounded_feet.radius") * about(rng, 2e-3 * size))
    world.props[:, P["radius"]] = radius
    if other:
        world.scale("radius", uneven(rng, 0.3))
    return said({"radius": radius}, "another radius at each foot" if other else CATALOGUE)


def uneven_contact_normals(world: World, rng, size, other, given):
    """Hide slopes where the feet stand."""
    slopes = np.array([[signed(rng, 0.009 * size) for _ in range(2)] for _ in range(4)])
    slopes *= world.factor("uneven_contact_normals")
    world.props[:, P["slope_x"]], world.props[:, P["slope_y"]] = slopes[world.foot].T
    world["normals_form"] = other
    parameters = {f"{axis}{i + 1}": float(slopes[i, j]) for i in range(4) for j, axis in enumerate("xy")}
    return said(parameters, "slopes of the feet, which turn with the block" if other else CATALOGUE)


def mass_eccentricity(world: World, rng, size, other, given):
    """Hide the centre of mass off its place."""
    drawn = {axis: world.factor(f"mass_eccentricity.{axis}") * signed(rng, 1e-3 * size) for axis in "xyz"}
    shift = np.array([pick(given, axis, drawn[axis]) for axis in "xyz"])
    world.points -= shift
    world["top"] -= shift[2]
    world["bottom"] -= shift[2]
    if other:  # a lump of 3 kg (of the same share of another block), with what it does to the inertia
        lump = 3.0 * world.factor("mass_eccentricity.lump")
        arm = shift * (world.mass - lump) / lump
        r = arm - shift
        world.J += lump * (r @ r * np.eye(3) - np.outer(r, r))
        world.J += (world.mass - lump) * (shift @ shift * np.eye(3) - np.outer(shift, shift))
    return said(dict(zip("xyz", map(float, shift), strict=True)), "a lump with its inertia" if other else CATALOGUE)


def inertia_deviation(world: World, rng, size, other, given):
    """Hide an inertia that is not the cuboid's."""
    s = np.array([pick(given, k, 1.0 + signed(rng, 0.02 * size)) for k in ("xx", "yy", "zz")])
    root = np.sqrt(s)
    world.J *= np.outer(root, root)
    if other:  # a product of inertia comes along
        product = signed(rng, 0.004 * size) * world.J[0, 0]
        world.J[1, 2] += product
        world.J[2, 1] += product
    return said(
        dict(zip(("xx", "yy", "zz"), map(float, s), strict=True)),
        "a product of inertia comes along" if other else CATALOGUE,
    )


def dimension_deviation(world: World, rng, size, other, given):
    """Hide sides that are not as stated."""
    s = np.array([pick(given, k, 1.0 + signed(rng, 0.005 * size)) for k in ("width", "depth", "height")])
    world.points *= s
    world["top"] *= s[2]
    world["bottom"] *= s[2]
    if not other:
        moments = np.trace(world.J) / 2 * np.eye(3) - world.J
        moments *= np.outer(s, s)
        world.J = np.trace(moments) * np.eye(3) - moments
    return said(
        dict(zip(("width", "depth", "height"), map(float, s), strict=True)), "the inertia stays" if other else CATALOGUE
    )


def foot_defects(world: World, rng, size, other, given):
    """Hide eight points where the experimenter believes in four. The size scales heights and diagonal distance."""
    outer = world.points[world.external]
    inner = world.points[~world.external]
    base = inner[:, 2].copy()
    rise = (outer[:, 2] - base) * size
    outer[:, 2] = base + rise
    inner[:, :2] = outer[:, :2] + (inner[:, :2] - outer[:, :2]) * min(size, 1.5)
    if other:  # another base: each inner point at a distance of its own
        inner[:, :2] = outer[:, :2] + (inner[:, :2] - outer[:, :2]) * uneven(rng, 0.3)[:, None]
    diagonal = float(np.linalg.norm((outer - inner)[:, :2], axis=1).mean())
    world.points[world.external], world.points[~world.external] = outer, inner
    parameters = {f"delta_long{i}": float(h) for i, h in enumerate(rise, 1)} | {"delta_diag": diagonal}
    mu, C = world.props[:, P["mu"]], world.props[:, P["C_N"]]
    parameters |= {"mu_int": float(mu[4] / mu[0]), "beta_int": float(C[4] / C[0])}
    return said(parameters, "another diagonal distance at each foot" if other else CATALOGUE)
