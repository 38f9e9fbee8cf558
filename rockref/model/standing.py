"""A block that stands: at rest on the feet that carry it, in static equilibrium with their springs."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from rockref.model.errors import InputError
from rockref.model.problem import Block, ContactPoints, State
from rockref.model.rotation import apply_to_points, exponential, product

#: Iterations of the search for the equilibrium. Decided: eight even feet take three, defects of a millimetre some ten.
ITERATIONS = 200
#: Up to so many feet all triples are tried for a start; decided: 560 take a millisecond.
MOST_FEET = 16
#: Least determinant of three feet that make a triangle, and how far a foot may be below a plane through others by
#: rounding, in half widths of the base.
FLAT, ROUNDING = 1e-6, 1e-12
#: Largest share of the weight, and of the weight times the half width of the base, that may be left over as force and
#: moment. Decided: heights are rounded to some 1e-16 m, which stiff springs turn into 1e-9 of the weight at most.
LEFT_OVER = 1e-8
#: The same share at which the search ends. Decided: a hundredth of it.
AT_REST = 1e-10
#: What a step adds to the stiffness against each motion, as shares of the stiffness of all feet. Decided: none where
#: three feet carry; where fewer do, so much that the step stays short. A block on two feet of a diagonal tips away from
#: it with a stiffness of -m g h, a thousandth to a tenth of that of soft feet: the shares there are close together.
DAMPING = (0.0, 1e-12, 1e-9, 1e-6, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 1.0)
#: Tilt [rad] by which a block is tipped off a balance on two feet. Decided: far above rounding, below every foot.
TIPPED = 1e-7
#: Largest tilt [rad] of a block that stands. Decided: no foot is so long that a block on it stands askew by more.
MOST_ASKEW = 0.1


def standing_posture(
    block: Block, points: ContactPoints, heading: float = 0.0, place: tuple[float, float] = (0.0, 0.0)
) -> State:
    """Return the state of a block that stands on the plate: at rest, its feet's springs carry the weight.

    Springs push and do not pull, so which feet carry is part of the solution: all where they are even, three where one
    is shorter than its spring's compression. Height and two tilts follow from force and moments,

        sum F_i = m g,   sum F_i (x_i, y_i) = 0,   F_i = K_N max(0, -u_z),

    with arms from the centre of mass. Anchors stand where the feet stand, so no foot is pulled sideways.

    Parameters
    ----------
    block, points : one block (no batch axes).
    heading : turn of the block about the vertical [rad].
    place : x and y of the centre of mass [m].

    Raises
    ------
    InputError
        E-STAND, where the block falls over by itself: the centre of mass is not above a triangle of feet, or the feet
        are too soft for its height.
    """
    check_inside(points)
    n, height = equilibrium(block, points)
    turn = heading - 2 * np.pi * np.rint(heading / (2 * np.pi))
    Lambda = product(exponential(np.array([0, 0, turn], n.dtype)), upright(n))
    return State.at_rest(np.array([*place, height]), Lambda, points.n)


def raised(points: ContactPoints) -> tuple[np.ndarray, np.ndarray]:
    """Return centres of the feet in body axes (n, 3) [m] and their radii (n,) [m]."""
    radius = np.zeros_like(points.K_N) if points.radius is None else points.radius
    centre = points.P.copy()
    centre[:, 2] += radius
    return centre, radius


def upright(n: np.ndarray) -> np.ndarray:
    """Return the shortest rotation (3, 3) that takes the unit vector n (3,) of the body to the vertical."""
    axis = np.zeros_like(n)  # n x e_z
    axis[0], axis[1] = n[1], 0 - n[0]
    sine = np.sqrt(np.sum(axis * axis))
    if sine == 0:
        return exponential(axis)
    return exponential(np.arctan2(sine, n[2]) / sine * axis)


def equilibrium(block: Block, points: ContactPoints) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertical in body axes (3,) and the height of the centre of mass [m] at which the block stands.

    Newton's method on the potential energy, which is quadratic between two sets of carrying feet; halved steps and a
    small multiple of the unit matrix lead it from one set to the next. Raises InputError (E-STAND).
    """
    centre, radius = raised(points)
    weight, K = block.mass * block.g, points.K_N
    b = np.max(np.abs(points.P[:, :2]))  # the unit of length of the tilts
    q = rigid_support(centre, radius, b)  # height, then b times the first two components of the vertical
    q[0] -= weight / np.sum(K)

    def at(q):
        return potential(q, b, weight, K, centre, radius)

    for _ in range(ITERATIONS):
        _, gradient, curvature = at(q)
        askew = np.max(np.abs(q[1:])) > MOST_ASKEW * b
        if askew:
            break
        at_rest = np.max(np.abs(gradient)) < AT_REST * weight
        step = None if at_rest else descent(q, at, np.sum(K))
        if step is None:
            step = tipped(gradient, curvature, b)
        if step is None:
            break
        q = q + step
    stable = np.linalg.eigvalsh(np.float64(curvature))[0] > 0
    if askew or not stable or np.max(np.abs(gradient)) > LEFT_OVER * weight:
        raise falls("springs and weight find no equilibrium near the upright")
    return vertical(q, b), q[0]


def tipped(gradient: np.ndarray, curvature: np.ndarray, b: float) -> np.ndarray | None:
    """Return the step that tips a block which balances on two feet to the lower side; None where it stands."""
    values, vectors = np.linalg.eigh(np.float64(curvature))
    if values[0] >= 0:
        return None
    way = vectors[:, 0] * (-1 if vectors[:, 0] @ np.float64(gradient) > 0 else 1)
    return (TIPPED * b * way).astype(gradient.dtype)


def descent(q: np.ndarray, at, stiffness) -> np.ndarray | None:
    """Return Newton's step, or the first of the steps with more and more damping, that leads down; None without one."""
    energy, gradient, curvature = at(q)
    least = np.linalg.eigvalsh(np.float64(curvature))[0]
    for share in DAMPING:
        # On fewer than three feet the block tips over, and energy falls all the way: a step goes at most as far as it
        # would if the block were as stiff there as it is unstable, so that the next foot is not passed by.
        if least + share * stiffness < abs(least):
            continue
        try:
            # LAPACK knows no long double. What a step lacks in digits the next one finds.
            stiff = np.float64(curvature + share * stiffness * np.eye(3))
            trial = -np.linalg.solve(stiff, np.float64(gradient))
        except np.linalg.LinAlgError:
            continue
        step = lower(q, trial, energy, gradient, at)
        if step is not None:
            return step
    return None


def rigid_support(centre: np.ndarray, radius: np.ndarray, b: float) -> np.ndarray:
    """Return height and tilts (3,) [m] on three rigid feet, as `potential` takes them; flat where there are many feet.

    Of all planes through three feet with no foot below, the one on which the centre of mass is lowest.
    """
    low = radius - centre[:, 2]
    flat = np.array([np.max(low), 0, 0])
    if len(centre) > MOST_FEET:
        return flat
    slope = np.concatenate([np.ones_like(centre[:, :1]), centre[:, :2] / b], axis=1).astype(float)
    triples = np.array(list(combinations(range(len(centre)), 3)))
    matrices = slope[triples]
    whole = np.abs(np.linalg.det(matrices)) > FLAT
    planes = np.linalg.solve(matrices[whole], low[triples[whole]].astype(float)[..., None])[..., 0]
    above = np.min(planes @ slope.T - low, axis=1) >= -ROUNDING * b
    if not np.any(above):
        return flat
    planes = planes[above]
    return planes[np.argmin(planes[:, 0])].astype(centre.dtype)


def lower(q, trial, energy, gradient, at) -> np.ndarray | None:
    """Return the trial step, halved until the energy falls with it, or the gradient by half; None where neither does.

    Near the equilibrium the energy's changes are below its rounding, and the gradient's are not.
    """
    if not np.all(np.isfinite(trial)) or np.sum(gradient * trial) >= 0:
        return None
    for _ in range(40):
        if np.all(q + trial == q):
            return None
        there, slope, _ = at(q + trial)
        if there < energy or np.sum(slope * slope) < np.sum(gradient * gradient) / 4:
            return trial
        trial = trial / 2
    return None


def vertical(q: np.ndarray, b: float) -> np.ndarray:
    """Return the unit vector (3,) in body axes that points upwards."""
    x, y = q[1] / b, q[2] / b
    return np.array([x, y, np.sqrt(1 - x * x - y * y)])


def potential(q, b, weight, K, centre, radius) -> tuple[float, np.ndarray, np.ndarray]:
    """Return energy [J] of weight and springs, its gradient (3,) [N] and its second derivatives (3, 3) [N/m]."""
    if np.sum(q[1:] ** 2) > (b / 2) ** 2:  # beyond 30 degrees nothing stands
        return np.inf, np.zeros_like(q), np.eye(3, dtype=q.dtype)
    n = vertical(q, b)
    depth = radius - (q[0] + np.sum(centre * n, axis=1))
    F = K * np.maximum(depth, 0)
    x, y, z = centre.T
    slope = np.stack([np.ones_like(x), (x - z * n[0] / n[2]) / b, (y - z * n[1] / n[2]) / b], axis=1)  # of the heights
    gradient = -np.sum(F[:, None] * slope, axis=0)
    gradient[0] += weight
    curvature = np.sum((K * (depth > 0))[:, None, None] * slope[:, :, None] * slope[:, None, :], axis=0)
    turning = np.sum(F * z) / n[2] / b**2
    bend = turning * (np.eye(2) + n[:2, None] * n[None, :2] / n[2] ** 2)
    curvature[1:, 1:] += bend
    return weight * q[0] + np.sum(F * np.maximum(depth, 0)) / 2, gradient, curvature


def check_inside(points: ContactPoints) -> None:
    """Refuse feet that leave the centre of mass over an edge, or beyond it (E-STAND)."""
    around = np.sort(np.arctan2(points.P[:, 1], points.P[:, 0]))
    gaps = np.diff(np.append(around, around[:1] + 2 * np.pi))
    if points.n < 3 or np.max(gaps) >= np.pi:
        raise falls("the centre of mass does not stand above a triangle of feet")


def falls(what: str) -> InputError:
    """Return the error for a block that does not stand by itself (E-STAND)."""
    cure = "Check the feet, their stiffness in N/m and the centre of mass, or give a start state."
    return InputError("E-STAND", "contact points", what, cure)


def carrying(points: ContactPoints, state: State) -> np.ndarray:
    """Return which feet touch the plate, (n,) bool, in a state without history."""
    centre, radius = raised(points)
    return state.x[2] + apply_to_points(state.Lambda, centre)[:, 2] - radius <= 0
