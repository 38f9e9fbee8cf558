"""Mistakes in what is derived, in the sums over the points, in the integrator, in the measured channel."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rockref.conformance.backends.rule_set import Rules
from rockref.conformance.faults.mistake import Mistake
from rockref.model import geometry, release
from rockref.model.assembly import resultant_force, sum_over_points
from rockref.model.integrator import times
from rockref.model.problem import Problem, State
from rockref.model.rotation import (
    apply,
    apply_to_points,
    apply_transposed,
    cross,
    exponential,
    hat,
    product,
    transposed,
)

# -- G, P: what follows from the parameters; and how a run that derives them itself misreads its problem ------------


def axes_exchanged(mass, width, depth, height):
    J = geometry.cuboid_inertia(mass, width, depth, height)
    return np.diag(np.diag(J)[::-1])


def half_sides(mass, width, depth, height):
    return geometry.cuboid_inertia(mass, width, depth, height) / 4


def about_the_base(mass, width, depth, height):
    return geometry.cuboid_inertia(mass, width, depth, height) + np.diag([1.0, 1.0, 0.0]) * mass * height**2 / 4


def inertia_read(change):
    """Return a run that uses `change` of the principal moments and mass."""

    def read(problem: Problem) -> Problem:
        J = problem.block.inertia
        moved = change(np.diag(J), float(problem.block.mass), 2 * float(np.max(-problem.points.P[..., 2])))
        return replace(problem, block=replace(problem.block, inertia=J + np.diag(moved - np.diag(J))))

    return read


def inset_along_the_sides(width, depth, height, delta_long, delta_diag):
    P = geometry.eight_points(width, depth, height, delta_long, 0 * delta_diag)
    P[4:, 0] -= np.sign(P[4:, 0]) * delta_diag
    P[4:, 1] -= np.sign(P[4:, 1]) * delta_diag
    return P


def lowered(width, depth, height, delta_long, delta_diag):
    return geometry.eight_points(width, depth, height, -np.asarray(delta_long), delta_diag)


def level(width, depth, height, delta_long, delta_diag):
    return geometry.eight_points(width, depth, height, 0 * np.asarray(delta_long), delta_diag)


def points_read(change):
    """Return a run that uses `change` of the points (n, 3)."""

    def read(problem: Problem) -> Problem:
        return replace(problem, points=replace(problem.points, P=change(problem.points.P.copy())))

    return read


def inset_again(P):
    inner = np.abs(P[..., 0]) < np.max(np.abs(P[..., 0])) * (1 - 1e-9)
    half, diagonal = np.max(np.abs(P[..., :2]), axis=0), np.sqrt(np.sum(np.max(np.abs(P[..., :2]), axis=0) ** 2))
    inset = half - np.abs(P[..., :2])
    along = inset * (diagonal / half)
    P[..., :2] = np.where(inner[..., None], np.sign(P[..., :2]) * (half - along), P[..., :2])
    return P


def raised_reversed(P):
    base = np.min(P[..., 2])
    P[..., 2] = 2 * base - P[..., 2]
    return P


def all_at_the_base(P):
    P[..., 2] = np.min(P[..., 2])
    return P


def properties_read(**changes):
    """Return a run that uses changed properties: name -> function of the points."""

    def read(problem: Problem) -> Problem:
        points = problem.points
        return replace(problem, points=replace(points, **{k: f(points) for k, f in changes.items()}))

    return read


# -- R1: the release posture ----------------------------------------------------------------------------------------


def without_roll(block, points, theta_0):
    Lambda = exponential(np.array([-theta_0, 0, 0], points.P.dtype))
    height = np.min(apply_to_points(Lambda, points.P)[..., 2])
    x = np.array([0, 0, -height - block.mass * block.g / 2 / points.K_N[0]], points.P.dtype)
    return State.at_rest(x, Lambda, points.n)


def on_the_corners(block, points, theta_0):
    """Plant a fault: the pivots are taken among the external points, wherever the internal ones are."""
    out_of_reach = points.P + np.where(np.arange(points.n) < 4, 0, 1)[:, None] * np.array([0, 0, 1], points.P.dtype)
    return release.release_posture(block, replace(points, P=out_of_reach), theta_0)


def weight_of_the_source(block, points, theta_0):
    return release.release_posture(replace(block, mass=0 * block.mass + 54, g=0 * block.g + 9.81), points, theta_0)


# -- A: sums over the points ----------------------------------------------------------------------------------------


def other_gravity(F, mass, g):
    return resultant_force(F, mass, 0 * g + 9.80665)


def gravity_of_the_source(F, mass, g):
    return resultant_force(F, mass, 0 * g + 9.81)


def mass_of_the_source(F, mass, g):
    return resultant_force(F, 0 * mass + 54, g)


def weight_up(F, mass, g):
    return resultant_force(F, mass, -g)


def no_friction_in_the_sum(F, mass, g):
    return resultant_force(F * np.array([0, 0, 1], F.dtype), mass, g)


def force_cross_lever(r, F):
    return sum_over_points(cross(F, r))


def normal_forces_only(r, F):
    return sum_over_points(cross(r, F * np.array([0, 0, 1], F.dtype)))


def not_turned(Lambda, M):
    return M.copy()


def turned_forward(Lambda, M):
    return apply(Lambda, M)


# -- I: the step ----------------------------------------------------------------------------------------------------


def no_square_term(x, v, a, h):
    return x + h * v


def no_half(x, v, a, h):
    return x + h * v + h * h * a


def no_gyroscopic_term(T, W, JW, J_inverse):
    return times(J_inverse, T)


def gyroscopic_term_reversed(T, W, JW, J_inverse):
    return times(J_inverse, T + cross(W, JW))


def no_square_term_of_rotation(W, A, h):
    return h * W


def transposed_increment(rules: Rules) -> Rules:
    return rules.replace(exponential=lambda Theta: rules.exponential(-Theta))


def increment_transposed_in_the_pose(Lambda, E):
    return Lambda + product(Lambda, transposed(E))


def wrong_side(Lambda, E):
    return Lambda + product(E, Lambda)


def first_order(Theta):
    return hat(Theta)


def short_series_too_far(rules: Rules) -> Rules:
    def exponential(Theta):
        H = hat(Theta)
        small = (np.sum(Theta * Theta, axis=-1) < 1e-2)[..., None, None]
        return np.where(small, H + product(H, H) / 2, rules.exponential(Theta))

    return rules.replace(exponential=exponential)


def old_acceleration_only(v, a, a_next, h):
    return v + h * a


def half_step_velocity(v, a, a_next, h):
    return v + (h / 2) * a


def turned_forth(JW, T, T_next, E, h):
    half = JW + (h / 2) * T
    return half + apply(E, half) + (h / 2) * T_next


def not_turned_back(JW, T, T_next, E, h):
    return JW + (h / 2) * T + (h / 2) * T_next


def new_moment_missing(JW, T, T_next, E, h):
    half = JW + (h / 2) * T
    return half + apply_transposed(E, half)


# -- M1: the channel ------------------------------------------------------------------------------------------------


def channel(change):
    """Return a plant and a report that let `change` rewrite W (N, 3), given Lambda (N, 3, 3)."""

    def plant(rules: Rules) -> Rules:
        return rules.replace(channel=lambda W, Lambda: rules.channel(change(W, Lambda), Lambda))

    return plant, lambda rows: replace(rows, W=change(rows.W, rows.Lambda))


def _in_plate_axes(W, Lambda):
    return apply(Lambda, W)


def _in_rad_s(W, Lambda):
    return W * W.dtype.type(np.pi / 180)


def _y_reversed(W, Lambda):
    return W * np.array([1, -1, 1], W.dtype)


def _a_sample_late(W, Lambda):
    return np.concatenate([W[:1], W[:-1]])


def _one(**changes):
    return lambda rules: rules.replace(**changes)


OF_PARAMETERS = (
    Mistake(
        "Z31", "G1", "Ixx and Izz exchanged",
        _one(inertia=axes_exchanged), inertia_read(lambda J, m, h: J[::-1]),
    ),
    Mistake(
        "Z58", "G1", "half sides in the place of sides",
        _one(inertia=half_sides), inertia_read(lambda J, m, h: J / 4),
    ),
    Mistake(
        "Z59", "G1", "inertia about the base, not about the centre of mass",
        _one(inertia=about_the_base), inertia_read(lambda J, m, h: J + np.array([1.0, 1.0, 0.0]) * m * h * h / 4),
    ),
    Mistake(
        "Z60", "G2", "internal points inset along the sides, not along the diagonal",
        _one(points=inset_along_the_sides), points_read(inset_again),
    ),
    Mistake(
        "Z61", "G2", "external points below the internal plane",
        _one(points=lowered), points_read(raised_reversed),
    ),
    Mistake(
        "Z103", "G2", "heights of the external points forgotten",
        _one(points=level), points_read(all_at_the_base),
    ),
    Mistake(
        "Z07", "P1", "total stiffness shared among the eight points",
        _one(stiffness=lambda K, n: np.full(n, K / n)),
        properties_read(K_N=lambda p: p.K_N / 8, K_T=lambda p: p.K_T / 8),
    ),
    Mistake(
        "Z08", "P2", "damping by an eighth of the mass",
        _one(damping=lambda beta, K, mass: 2 * beta * np.sqrt(K * mass / 8)),
        properties_read(C_N=lambda p: p.C_N / np.sqrt(8), C_T=lambda p: p.C_T / np.sqrt(8)),
    ),
    Mistake(
        "Z62", "P2", "the factor 2 lost",
        _one(damping=lambda beta, K, mass: beta * np.sqrt(K * mass)),
        properties_read(C_N=lambda p: p.C_N / 2, C_T=lambda p: p.C_T / 2),
    ),
    Mistake(
        "Z63", "P3", "no tangential damping ratio",
        _one(damping_ratio=lambda beta: (beta, 0 * beta)), properties_read(C_T=lambda p: 0 * p.C_T),
    ),
    Mistake("Z87", "R1", "tilted about X only: one corner hangs in the air", _one(release=without_roll)),
    Mistake("Z102", "R1", "pivots among the external points only", _one(release=on_the_corners)),
    Mistake("Z104", "R1", "the source's block, 54 kg and 9.81 m/s2, in the code", _one(release=weight_of_the_source)),
)  # fmt: skip

OF_SUMS = (
    Mistake("Z64", "A1", "standard gravity in place of the g that is given", _one(force=other_gravity)),
    Mistake("Z105", "A1", "the source's gravity, 9.81 m/s2, in the code", _one(force=gravity_of_the_source)),
    Mistake("Z106", "A1", "the source's mass, 54 kg, in the weight", _one(force=mass_of_the_source)),
    Mistake("Z65", "A1", "weight with the wrong sign", _one(force=weight_up)),
    Mistake("Z66", "A1", "friction forces left out of the sum", _one(force=no_friction_in_the_sum)),
    Mistake("Z67", "A2", "F x r for r x F", _one(moment=force_cross_lever)),
    Mistake("Z68", "A2", "friction forces left out of the moment", _one(moment=normal_forces_only)),
    Mistake("Z24", "A3", "moment left in plate axes", _one(body_moment=not_turned)),
    Mistake("Z69", "A3", "moment turned by Lambda, not by its transpose", _one(body_moment=turned_forward)),
)

OF_STEPS = (
    Mistake("Z34", "I1", "position by the old velocity alone (forward Euler)", _one(position=no_square_term)),
    Mistake("Z70", "I1", "h^2 a for h^2/2 a", _one(position=no_half)),
    Mistake("Z30", "I2", "gyroscopic term missing", _one(acceleration=no_gyroscopic_term)),
    Mistake("Z71", "I2", "gyroscopic term with the wrong sign", _one(acceleration=gyroscopic_term_reversed)),
    Mistake("Z72", "I2", "increment without h^2/2 A", _one(increment=no_square_term_of_rotation)),
    Mistake("Z26", "I3", "exponential transposed", transposed_increment),
    Mistake("Z73", "I3", "increment transposed in the pose only", _one(rotation=increment_transposed_in_the_pose)),
    Mistake("Z27", "I3", "increment multiplied on the wrong side", _one(rotation=wrong_side)),
    Mistake("Z28", "I3", "first-order exponential, I + Theta^", _one(exponential=first_order)),
    Mistake("Z29", "I3", "two terms of the series up to 0.1 rad", short_series_too_far),
    Mistake("Z74", "I4", "v + h a, the new acceleration forgotten", _one(velocity=old_acceleration_only)),
    Mistake("Z32", "I4", "half-step velocity taken for the full step's", _one(velocity=half_step_velocity)),
    Mistake("Z75", "I5", "momentum turned forth, not back", _one(momentum=turned_forth)),
    Mistake("Z76", "I5", "momentum not turned at all", _one(momentum=not_turned_back)),
    Mistake("Z77", "I5", "half of the new moment forgotten", _one(momentum=new_moment_missing)),
)

OF_THE_CHANNEL = tuple(
    Mistake(id_, "M1", says, channel(change)[0], report=channel(change)[1])
    for id_, says, change in (
        ("Z35", "angular velocity in plate axes", _in_plate_axes),
        ("Z78", "rad/s for deg/s", _in_rad_s),
        ("Z79", "Y axis with the wrong sign", _y_reversed),
        ("Z80", "one sample late", _a_sample_late),
    )
)

OF_BODIES = OF_PARAMETERS + OF_SUMS + OF_STEPS + OF_THE_CHANNEL
