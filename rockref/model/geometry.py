"""The block's inertia and its contact points: eight, four, or any set."""

import math

import numpy as np

from rockref.model.errors import InputError

#: Signs of x and y at corners 1..4. Decided: the excerpt's Fig. 3.2b is not in the text; the block is released leaning
#: on corners 1 and 2, so both lie on the +y side.
CORNER_SIGNS = ((1, 1), (-1, 1), (-1, -1), (1, -1))
EXTERNAL = ("1ext", "2ext", "3ext", "4ext")
INTERNAL = ("1int", "2int", "3int", "4int")


def cuboid_inertia(mass: float, width: float, depth: float, height: float) -> np.ndarray:
    """Rule G1: inertia of the uniform cuboid about its centre of mass, body axes, (3, 3) [kg m2].

    mass [kg]; width along X, depth along Y, height along Z [m].
    """
    J = np.zeros((3, 3))
    J[0, 0] = mass / 12 * (depth * depth + height * height)
    J[1, 1] = mass / 12 * (width * width + height * height)
    J[2, 2] = mass / 12 * (width * width + depth * depth)
    return J


def eight_points(width: float, depth: float, height: float, delta_long, delta_diag: float) -> np.ndarray:
    """Rule G2: the eight contact points in body axes, (8, 3) [m]: 1ext..4ext, then 1int..4int.

    The internal points lie in the plane z = -h/2, on the diagonals of the base, at delta_diag from the corner
    measured along the diagonal (decided; the excerpt says "the horizontal position of these points along the two
    bisectors is defined by a single parameter"). The external points are the corners, raised by delta_long[i].

    Parameters
    ----------
    width, depth, height : sides along X, Y, Z [m].
    delta_long : 4 heights of the external points above the internal plane [m].
    delta_diag : distance of the internal points from the corners [m].

    Source: "Defects", Fig. 3.2b.
    """
    diagonal = np.sqrt(width * width + depth * depth)
    inward = 1 - delta_diag / (diagonal / 2)
    P = np.empty((8, 3))
    for i, (sign_x, sign_y) in enumerate(CORNER_SIGNS):
        x, y = sign_x * width / 2, sign_y * depth / 2
        P[i] = x, y, -height / 2 + delta_long[i]
        P[4 + i] = x * inward, y * inward, -height / 2
    return P


def four_points(width: float, depth: float, height: float) -> np.ndarray:
    """Return four corners of the base in body axes, (4, 3) [m]: the model that the authors tried first ("Defects")."""
    return np.array([(sx * width / 2, sy * depth / 2, -height / 2) for sx, sy in CORNER_SIGNS])


#: No block's mass, side, stiffness or gravity is as large in SI units, or as small. Decided: products of four of them
#: stay within float64, so that no number of a block overflows before its run.
LARGEST, SMALLEST = 1e30, 1e-30


def check_number(key: str, value, least: float = 0.0, more_than_least: bool = False) -> None:
    """Refuse what is no finite number (E-TYPE, E-RANGE), or too small (E-RANGE)."""
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise InputError("E-TYPE", key, f"is {value!r}"[:120], "Give one real number.")
    finite = isinstance(value, int) or np.isfinite(value)
    if not finite or value < least or (more_than_least and value == least):
        limit = f"{'above' if more_than_least else 'not below'} {least:g}"
        raise InputError("E-RANGE", key, f"is {value!r}", f"Give a finite number, {limit}.")
    if math.isfinite(least) and (value > LARGEST or (more_than_least and value < SMALLEST)):
        raise InputError("E-RANGE", key, f"is {value!r}", "No block has such a number: check its unit.")


def check_inertia(inertia: np.ndarray) -> None:
    """Refuse (..., 3, 3) [kg m2] that no body can have (E-RANGE): not symmetric, or not positive.

    The triangle inequality of the principal moments is not asked for: fitted values may break it a little.
    """
    J = np.asarray(inertia, float)
    good = J.shape[-2:] == (3, 3) and np.all(np.isfinite(J))
    if not good or not np.array_equal(J, J.swapaxes(-1, -2)) or np.min(np.linalg.eigvalsh(J)) <= 0:
        raise InputError(
            "E-RANGE",
            "inertia",
            f"is {J.tolist()!r}"[:200],
            "Give a symmetric, positive definite 3 x 3 matrix in kg m2.",
        )


def check_cuboid(mass: float, width: float, depth: float, height: float, delta_long, delta_diag: float) -> None:
    """Refuse sizes that are no block (E-RANGE): zero or negative sides, defects larger than the block."""
    for key, value in (("mass", mass), ("width", width), ("depth", depth), ("height", height)):
        check_number(key, value, more_than_least=True)
    check_number("delta_diag", delta_diag)
    if len(delta_long) != 4:
        raise InputError("E-SHAPE", "delta_long", f"has {len(delta_long)} values", "Give four heights in metres.")
    for i, value in enumerate(delta_long):
        check_number(f"delta_long[{i}]", value, least=-np.inf)
        if abs(value) >= height:
            raise InputError(
                "E-RANGE", f"delta_long[{i}]", f"is {value!r} m, larger than the block", "Give heights in metres."
            )
    half = np.sqrt(width * width + depth * depth) / 2
    if delta_diag >= half:
        raise InputError(
            "E-RANGE",
            "delta_diag",
            f"is {delta_diag!r} m; half the diagonal of the base is {half:.4g} m",
            "Give a distance from the corner in metres, between 0 and half the diagonal.",
        )


#: Sides [m] between which a block rocks on a plate. Decided: a grain of sand does not, nor does a house; what lies
#: outside was typed in another unit.
SHORTEST_SIDE, LONGEST_SIDE = 1e-3, 100.0


def check_plausible(width: float, depth: float, height: float, delta_long, foot_radius: float) -> None:
    """Refuse lengths that no rocking block has (E-RANGE), most of them typed in another unit.

    Sides are between 1 mm and 100 m; heights of the external points and the radius of the feet, all in m, are at most
    half the width of the base: these are defects and roundings of a block, not its shape.
    """
    for key, value in (("width", width), ("depth", depth), ("height", height)):
        if not SHORTEST_SIDE <= value <= LONGEST_SIDE:
            limits = f"Give metres, between {SHORTEST_SIDE:g} and {LONGEST_SIDE:g}."
            raise InputError("E-RANGE", key, f"is {value!r} m, and no block rocks that is so large or small", limits)
    half = min(width, depth) / 2
    lengths = [*((f"delta_long[{i}]", value) for i, value in enumerate(delta_long)), ("foot_radius", foot_radius)]
    for key, value in lengths:
        if abs(value) > half:
            what = f"is {value!r} m, more than half the width of the base, {half:.4g} m"
            raise InputError("E-RANGE", key, what, "Give metres: a foot is a small part of the block.")
