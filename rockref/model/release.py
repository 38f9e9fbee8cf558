"""The posture in which the wire lets go."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rockref.model.errors import InputError
from rockref.model.problem import Block, ContactPoints, State
from rockref.model.rotation import apply, apply_to_points, exponential, product


def tipping_angle(block: Block, points: ContactPoints, side=1):
    """Return tilt (...) [rad] at which the centre of mass stands above the pivot points; released beyond it the block
    overturns. side : (...) 1, or -1 of a turned block."""
    y = points.P[..., 1] * np.asarray(side)[..., None]
    return np.arctan2(np.max(y, axis=-1), -np.min(points.P[..., 2], axis=-1))


def check_tilt(block: Block, points: ContactPoints, theta_0, side=1) -> None:
    """Refuse a release tilt (...) [rad] that is not in (0, tipping angle) (E-TILT); side as in `tipping_angle`."""
    limit = tipping_angle(block, points, side)
    if not np.all(good := np.isfinite(theta_0) & (0 < np.asarray(theta_0)) & (theta_0 < limit)):
        raise InputError(
            "E-TILT",
            "theta_0",
            f"is {refused(theta_0, good)!r} rad; the block tips over at {refused(limit, good):.4g} rad",
            "Give a release tilt in radians between 0 and the tipping angle.",
        )


def sideways_tipping_angle(points: ContactPoints):
    """Return roll (...) [rad] about Y at which the centre of mass stands above the outermost points."""
    return np.arctan2(np.max(np.abs(points.P[..., 0]), axis=-1), -np.min(points.P[..., 2], axis=-1))


def check_roll(points: ContactPoints, out_of_plane) -> None:
    """Refuse a further roll (...) [rad] about Y with which the centre of mass stands beyond all points (E-TILT)."""
    limit = sideways_tipping_angle(points)
    if not np.all(good := np.abs(out_of_plane) < limit):
        raise InputError(
            "E-TILT",
            "out_of_plane",
            f"is {refused(out_of_plane, good)!r} rad; the block tips over sideways at {refused(limit, good):.4g} rad",
            "Give a small roll in radians.",
        )


def refused(values, good) -> float:
    """Return the first of some numbers (...) for which `good` (...) does not hold."""
    return float(np.broadcast_to(values, np.shape(good))[~good][0])


def pivot_points(points: ContactPoints, theta_0, side) -> tuple:
    """Return the two points (...) on which the tilted block rests: the lowest with x > 0 and the lowest with x < 0."""
    x, y, z = (points.P[..., axis] for axis in range(3))
    theta_0, side = np.asarray(theta_0)[..., None], np.asarray(side)[..., None]
    height = -side * np.sin(theta_0) * y + np.cos(theta_0) * z
    found = []
    for where, there in (("x > 0", x > 0), ("x < 0", x < 0)):
        if not np.all(np.any(there, axis=-1)):
            raise InputError(
                "E-RELEASE",
                "contact points",
                f"there is no point with {where}",
                "A release needs a pivot point on either side; give a start state instead.",
            )
        found.append(np.argmin(np.where(there, height, np.inf), axis=-1))
    return found[0], found[1]


def of_point(a: np.ndarray, k) -> np.ndarray:
    """Return what belongs to point k (...), of numbers (..., n) or of vectors (..., n, 3)."""
    return a[(*np.ix_(*map(range, np.shape(k))), k)]


def release_posture(
    block: Block,
    points: ContactPoints,
    theta_0,
    turned=False,
    out_of_plane=0.0,
) -> State:
    """Return state at release: at rest, in equilibrium with the wire, half the weight on each of the two pivot points.

    The block leans to +y of the laboratory by a turn of -theta_0 about X, then the small roll about Y that makes both
    pivot points touch; penetration m g / (2 K_N) at each, anchors at the touching points, zero velocity.

    Parameters
    ----------
    block, points : one block, or a batch of blocks; the leading axes (...) are those of what follows, too.
    theta_0 : tilt [rad], between 0 and the tipping angle.
    turned : the block is first turned by 180 degrees about its height, so that it leans on corners 3 and 4.
    out_of_plane : further roll [rad] about Y that an oblique wire gives the block; the pivot points then share the
        weight as their penetrations do, and beyond m g / K_N of height difference one carries all.

    Raises
    ------
    InputError
        E-TILT, where theta_0 is not in (0, tipping angle), or the roll beyond it; E-RELEASE, where there are no two
        pivot points, or too soft ones.

    Decided (the excerpt says only "released"): a start that tilts about X only would drop the block onto one corner.
    """
    side = np.where(turned, -1, 1)
    check_tilt(block, points, theta_0, side)
    check_roll(points, out_of_plane)
    i, j = pivot_points(points, theta_0, side)
    dtype, weight = points.P.dtype, np.asarray(block.mass * block.g)
    radius = np.zeros_like(points.K_N) if points.radius is None else points.radius
    centre = points.P.copy()
    centre[..., 2] += radius
    depth = weight[..., None] / 2 / points.K_N
    check_depth(points, depth, i, j)

    centres, radii, depths = ([of_point(a, k) for k in (i, j)] for a in (centre, radius, depth))
    Lambda = levelled(tilted(theta_0, turned, dtype), centres, radii, depths)
    if np.any(out_of_plane):
        Lambda = product(Lambda, exponential(about("Y", out_of_plane, dtype)))
    height_i, height_j = (apply(Lambda, centres[k])[..., 2] - radii[k] for k in (0, 1))
    x = np.zeros(Lambda.shape[:-1], dtype)
    K_i, K_j = (of_point(points.K_N, k) for k in (i, j))
    x[..., 2] = settled_height(height_i, height_j, K_i, K_j, weight)
    check_clear(points, x, Lambda, np.max(depth, axis=-1))
    return State.at_rest(x, Lambda, points.n)


def release_postures(bodies: Sequence[tuple[Block, ContactPoints]], theta_0, turned, out_of_plane) -> list[State]:
    """Return of each of B bodies, with as many points each, what `release_posture` does, from one batch.

    theta_0, turned, out_of_plane : (B,)
    """
    (block, points), point_feet = bodies[0], np.zeros(bodies[0][1].n)
    batch = release_posture(
        replace(block, mass=np.stack([b.mass for b, _ in bodies]), g=np.stack([b.g for b, _ in bodies])),
        replace(
            points,
            P=np.stack([p.P for _, p in bodies]),
            K_N=np.stack([p.K_N for _, p in bodies]),
            radius=np.stack([point_feet if p.radius is None else p.radius for _, p in bodies]),
        ),
        *(np.asarray(a) for a in (theta_0, turned, out_of_plane)),
    )
    return [State.at_rest(batch.x[k], batch.Lambda[k], points.n) for k in range(len(bodies))]


def about(axis: str, angle, dtype) -> np.ndarray:
    """Return the rotation vector (..., 3) of an angle (...) [rad] about the body's X or Y axis."""
    Theta = np.zeros((*np.shape(angle), 3), dtype)
    Theta[..., "XY".index(axis)] = angle
    return Theta


def tilted(theta_0, turned, dtype) -> np.ndarray:
    """Return the attitude (..., 3, 3) of a block that leans to +y, first turned about its height or not."""
    half_turn = np.where(np.asarray(turned)[..., None, None], np.array([-1, -1, 1], dtype), np.ones(3, dtype))
    return exponential(about("X", -np.asarray(theta_0), dtype)) * half_turn


def levelled(tilt: np.ndarray, centres, radii, depths) -> np.ndarray:
    """Return the attitude (..., 3, 3) after the roll about Y that presses both pivot points in by their depths.

    centres (..., 3), radii (...), depths (...) [m] : of the feet at the two points.
    """
    # Heights above the plate, row e_z of the tilt times the rolled points, must be -depth_i and -depth_j:
    # a cos - b sin = d, with the roll's sine and cosine as unknowns.
    apart = centres[0] - centres[1]
    a, b = tilt[..., 2, 2] * apart[..., 2], tilt[..., 2, 2] * apart[..., 0]
    d = -tilt[..., 2, 1] * apart[..., 1] + (radii[0] - radii[1]) - (depths[0] - depths[1])
    root = np.sqrt(a * a + b * b - d * d)
    cos, sin = (a * d + b * root) / (a * a + b * b), (a * root - b * d) / (a * a + b * b)
    roll = np.zeros_like(tilt)
    roll[..., 0, 0], roll[..., 0, 2], roll[..., 2, 0], roll[..., 2, 2] = cos, sin, -sin, cos
    roll[..., 1, 1] = 1
    return product(tilt, roll)


#: How far half the weight may press a pivot point in, in distances between the two; decided: no foot gives way by half
#: the base, and beyond the roll that makes both touch need not exist.
SOFTEST = 0.5


def check_depth(points: ContactPoints, depth, i, j) -> None:
    """Refuse pivot points i and j (...) that half the weight presses in by `depth` (..., n) [m] as no foot is
    (E-RELEASE)."""
    k = np.where(of_point(depth, i) >= of_point(depth, j), i, j)
    apart = np.abs(of_point(points.P, i)[..., 0] - of_point(points.P, j)[..., 0])
    if not np.all(good := of_point(depth, k) < SOFTEST * apart):
        K, deep = (refused(of_point(a, k), good) for a in (points.K_N, depth))
        raise InputError(
            "E-RELEASE",
            f"K_N of point {points.names[int(refused(k, good))]}",
            f"is {K:.4g} N/m, so that half the weight presses it in by {deep * 1e3:.3g} mm",
            "No foot gives way that far: give the stiffness in N/m.",
        )


#: How much deeper than the pivot points another point may start [m]; decided: a fitted foot may be pressed in a little,
#: and a tenth of a millimetre of the stiffest foot carries a hundred times the weight.
DEEPEST = 1e-4


def check_clear(points: ContactPoints, x, Lambda, depth) -> None:
    """Refuse a posture in which a point that is no pivot is deep inside the plate (E-RELEASE); a foot at x = 0 may be.

    x (..., 3) [m] of the centre of mass, Lambda (..., 3, 3), depth (...) [m] to which the pivot points are pressed in.
    """
    height = x[..., 2, None] + apply_to_points(Lambda, points.P)[..., 2]
    k, lowest = np.argmin(height, axis=-1), np.min(height, axis=-1)
    if np.any(bad := lowest < -depth - DEEPEST):
        deep = -refused(lowest, ~bad) * 1e3
        raise InputError(
            "E-RELEASE",
            "contact points",
            f"point {points.names[int(refused(k, ~bad))]} would start {deep:.3g} mm inside the plate",
            "A release leans on one point with x > 0 and one with x < 0; give a start state instead.",
        )


def settled_height(height_i, height_j, K_i, K_j, weight):
    """Return height (...) of the centre of mass [m] at which the springs of two points carry the weight [N], without
    tension.

    height_i, height_j : heights (...) of the points from the centre of mass [m] (negative).
    """
    z = -(weight + K_i * height_i + K_j * height_j) / (K_i + K_j)
    j_alone, i_alone = -height_j - weight / K_j, -height_i - weight / K_i
    return np.where(z + height_i > 0, j_alone, np.where(z + height_j > 0, i_alone, z))
