"""How the block of the blind test stands when the wire lets go: two feet touch, each with half the weight."""

from __future__ import annotations

import math

import numpy as np

from rockref.blind.simulator.contact import pull, spring
from rockref.blind.simulator.slots import P
from rockref.blind.simulator.world import World


def depth_under(load: float, K: float, world: World) -> float:
    """Return depth [m] at which a point carries `load` [N] at rest: bisection on spring less pull."""
    low, high = 0.0, 1e-2
    for _ in range(80):
        middle = 0.5 * (low + high)
        force = spring(middle, K, world.g) - (pull(middle, world.g) if world["pull"] else 0.0)
        low, high = (middle, high) if force < load else (low, middle)
    return 0.5 * (low + high)


def matrix(tilt: float, roll: float, turned: bool) -> np.ndarray:
    """Return body to plate: lean toward +y by `tilt`, after a roll about body Y, after a half turn about Z."""
    c, s = math.cos(tilt), math.sin(tilt)
    lean = np.array([[1, 0, 0], [0, c, s], [0, -s, c]])
    if turned:
        lean = lean * np.array([-1.0, -1.0, 1.0])
    c, s = math.cos(roll), math.sin(roll)
    return lean @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def stand(world: World, tilt: float, turned: bool) -> tuple[np.ndarray, np.ndarray, tuple[int, int]]:
    """Return centre of mass (3,) [m], matrix (3, 3) and the two pivot points, at `tilt` [rad] before the release."""
    weight = (world.mass + world["hung_m"]) * world["gravity"]
    radius = world.props[:, P["radius"]]
    centres = world.points + np.column_stack([np.zeros((len(radius), 2)), radius])
    depth = np.array([depth_under(weight / 2, K, world) for K in world.props[:, P["K_N"]]])

    def lowest(roll: float) -> tuple[float, int, int, np.ndarray]:
        R = matrix(tilt, roll, turned)
        height = centres @ R[2] - radius
        side = (centres @ R[0]) > 0
        i = int(np.flatnonzero(side)[np.argmin((height + depth)[side])])
        j = int(np.flatnonzero(~side)[np.argmin((height + depth)[~side])])
        return (height + depth)[i] - (height + depth)[j], i, j, height

    low, high = -0.02, 0.02
    rising = lowest(high)[0] > lowest(low)[0]
    for _ in range(80):
        middle = 0.5 * (low + high)
        if (lowest(middle)[0] > 0) == rising:
            high = middle
        else:
            low = middle
    roll = 0.5 * (low + high)
    _, i, j, height = lowest(roll)
    x = np.array([0.0, 0.0, -0.5 * ((height + depth)[i] + (height + depth)[j])])
    return x, matrix(tilt, roll, turned), (i, j)


def quaternion(R: np.ndarray) -> np.ndarray:
    """Return unit quaternion (4,), scalar first, of a rotation matrix (3, 3): the largest component by the diagonal."""
    four = np.array([
        1 + R[0, 0] + R[1, 1] + R[2, 2], 1 + R[0, 0] - R[1, 1] - R[2, 2],
        1 - R[0, 0] + R[1, 1] - R[2, 2], 1 - R[0, 0] - R[1, 1] + R[2, 2],
    ])  # fmt: skip
    k = int(np.argmax(four))
    a, b, c = R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]
    d, e, f = R[1, 0] + R[0, 1], R[0, 2] + R[2, 0], R[2, 1] + R[1, 2]
    rows = ((four[0], a, b, c), (a, four[1], d, e), (b, d, four[2], f), (c, e, f, four[3]))
    return np.array(rows[k]) / (2 * math.sqrt(four[k]))
