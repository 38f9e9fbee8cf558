"""The posture in which the wire lets go."""

from __future__ import annotations

import numpy as np

from rockref.model.errors import InputError
from rockref.model.problem import Block, ContactPoints, State
from rockref.model.rotation import apply, exponential, product


def tipping_angle(block: Block, points: ContactPoints, side: int = 1) -> float:
    """Return tilt [rad] at which the centre of mass stands above the pivot points; released beyond it the block
    overturns."""
    P = points.P
    return float(np.arctan2(np.max(P[:, 1] * side), -np.min(P[:, 2])))


def check_tilt(block: Block, points: ContactPoints, theta_0: float, side: int = 1) -> None:
    """Refuse a release tilt [rad] that is not in (0, tipping angle) (E-TILT); side as in `tipping_angle`."""
    limit = tipping_angle(block, points, side)
    if not (np.isfinite(theta_0) and 0 < theta_0 < limit):
        raise InputError(
            "E-TILT",
            "theta_0",
            f"is {theta_0!r} rad; the block tips over at {limit:.4g} rad",
            "Give a release tilt in radians between 0 and the tipping angle.",
        )


def check_roll(points: ContactPoints, out_of_plane: float) -> None:
    """Refuse a further roll [rad] about Y with which the centre of mass stands beyond all points (E-TILT)."""
    limit = float(np.arctan2(np.max(np.abs(points.P[:, 0])), -np.min(points.P[:, 2])))
    if not abs(out_of_plane) < limit:
        raise InputError(
            "E-TILT",
            "out_of_plane",
            f"is {out_of_plane!r} rad; the block tips over sideways at {limit:.4g} rad",
            "Give a small roll in radians.",
        )


def pivot_points(points: ContactPoints, theta_0: float, side: int) -> tuple[int, int]:
    """Return the two points on which the tilted block rests: the lowest with x > 0 and the lowest with x < 0."""
    P = points.P
    height = -side * np.sin(theta_0) * P[:, 1] + np.cos(theta_0) * P[:, 2]
    found = []
    for where, there in (("x > 0", P[:, 0] > 0), ("x < 0", P[:, 0] < 0)):
        candidates = np.flatnonzero(there)
        if not len(candidates):
            raise InputError(
                "E-RELEASE",
                "contact points",
                f"there is no point with {where}",
                "A release needs a pivot point on either side; give a start state instead.",
            )
        found.append(int(candidates[np.argmin(height[candidates])]))
    return found[0], found[1]


def release_posture(
    block: Block,
    points: ContactPoints,
    theta_0: float,
    turned: bool = False,
    out_of_plane: float = 0.0,
) -> State:
    """Return state at release: at rest, in equilibrium with the wire, half the weight on each of the two pivot points.

    The block leans to +y of the laboratory by a turn of -theta_0 about X, then the small roll about Y that makes both
    pivot points touch; penetration m g / (2 K_N) at each, anchors at the touching points, zero velocity.

    Parameters
    ----------
    block, points : one block (no batch axes).
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
    side = -1 if turned else 1
    check_tilt(block, points, theta_0, side)
    check_roll(points, out_of_plane)
    i, j = pivot_points(points, theta_0, side)
    dtype = points.P.dtype
    weight = block.mass * block.g
    radius = np.zeros(points.n, dtype) if points.radius is None else points.radius
    centre = points.P.copy()
    centre[:, 2] += radius

    tilt = exponential(np.array([-theta_0, 0, 0], dtype))
    if turned:
        tilt = tilt * np.array([-1, -1, 1], dtype)  # exp(-theta_0 X) times a half turn about Z
    roll = np.eye(3, dtype=dtype)
    depth = weight / 2 / points.K_N
    check_depth(points, depth, i, j)
    # Heights above the plate, row e_z of the tilt times the rolled points, must be -depth_i and -depth_j:
    # a cos - b sin = d, with the roll's sine and cosine as unknowns.
    a = tilt[2, 2] * (centre[i, 2] - centre[j, 2])
    b = tilt[2, 2] * (centre[i, 0] - centre[j, 0])
    d = -tilt[2, 1] * (centre[i, 1] - centre[j, 1]) + (radius[i] - radius[j]) - (depth[i] - depth[j])
    root = np.sqrt(a * a + b * b - d * d)
    cos, sin = (a * d + b * root) / (a * a + b * b), (a * root - b * d) / (a * a + b * b)
    roll[0, 0], roll[0, 2], roll[2, 0], roll[2, 2] = cos, sin, -sin, cos
    Lambda = product(tilt, roll)
    if out_of_plane:
        Lambda = product(Lambda, exponential(np.array([0, out_of_plane, 0], dtype)))

    height_i, height_j = apply(Lambda, centre[i])[2] - radius[i], apply(Lambda, centre[j])[2] - radius[j]
    z = settled_height(height_i, height_j, points.K_N[i], points.K_N[j], weight)
    x = np.array([0, 0, z], dtype)
    check_clear(points, x, Lambda, np.max(depth))
    return State.at_rest(x, Lambda, points.n)


#: How far half the weight may press a pivot point in, in distances between the two; decided: no foot gives way by half
#: the base, and beyond the roll that makes both touch need not exist.
SOFTEST = 0.5


def check_depth(points: ContactPoints, depth, i: int, j: int) -> None:
    """Refuse pivot points i and j that half the weight presses in by `depth` (n,) [m] as no foot is (E-RELEASE)."""
    k = i if depth[i] >= depth[j] else j
    if depth[k] >= SOFTEST * abs(points.P[i, 0] - points.P[j, 0]):
        raise InputError(
            "E-RELEASE",
            f"K_N of point {points.names[k]}",
            f"is {points.K_N[k]:.4g} N/m, so that half the weight presses it in by {depth[k] * 1e3:.3g} mm",
            "No foot gives way that far: give the stiffness in N/m.",
        )


#: How much deeper than the pivot points another point may start [m]; decided: a fitted foot may be pressed in a little,
#: and a tenth of a millimetre of the stiffest foot carries a hundred times the weight.
DEEPEST = 1e-4


def check_clear(points: ContactPoints, x, Lambda, depth) -> None:
    """Refuse a posture in which a point that is no pivot is deep inside the plate (E-RELEASE); a foot at x = 0 may be.

    x (3,) [m] of the centre of mass, Lambda (3, 3), depth [m] to which the pivot points are pressed in.
    """
    height = x[2] + apply(Lambda, points.P)[:, 2]
    k = int(np.argmin(height))
    if height[k] < -depth - DEEPEST:
        raise InputError(
            "E-RELEASE",
            "contact points",
            f"point {points.names[k]} would start {-height[k] * 1e3:.3g} mm inside the plate",
            "A release leans on one point with x > 0 and one with x < 0; give a start state instead.",
        )


def settled_height(height_i, height_j, K_i, K_j, weight):
    """Return height of the centre of mass [m] at which the springs of two points carry the weight [N], without tension.

    height_i, height_j : heights of the points from the centre of mass [m] (negative).
    """
    z = -(weight + K_i * height_i + K_j * height_j) / (K_i + K_j)
    if z + height_i > 0:
        z = -height_j - weight / K_j
    elif z + height_j > 0:
        z = -height_i - weight / K_i
    return z
