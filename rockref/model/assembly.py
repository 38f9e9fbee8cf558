"""From point forces to the force and the moment on the body.

The sum over the points runs left to right, in one block as in a batch, so that a compiled twin gives the same bits.
"""

import numpy as np

from rockref.model.rotation import apply_transposed, cross


def sum_over_points(a: np.ndarray) -> np.ndarray:
    """Sum of the point vectors, (..., n, 3) -> (..., 3), in the order of the points.

    `add.reduce` adds one by one along an axis that is not the fastest in memory, as here, where the three components
    or the batch are; a test holds it to the written-out sum, bit by bit.
    """
    return np.add.reduce(a, axis=-2)


def resultant_force(F: np.ndarray, mass: np.ndarray, g: np.ndarray) -> np.ndarray:
    """Rule A1: sum of the point forces and the weight [N], in plate axes.

    F : (..., n, 3) [N]; mass : (...) [kg]; g : (...) gravity [m/s2]  ->  (..., 3).
    """
    force = sum_over_points(F)
    force[..., 2] -= mass * g
    return force


def resultant_moment(r: np.ndarray, F: np.ndarray) -> np.ndarray:
    """Rule A2: moment of the point forces about the centre of mass [N m], in plate axes.

    r : (..., n, 3) lever arms from the centre of mass [m]; F : (..., n, 3) [N]  ->  (..., 3).
    """
    return sum_over_points(cross(r, F))


def body_moment(Lambda: np.ndarray, M: np.ndarray) -> np.ndarray:
    """Rule A3: the moment in body axes, T = Lambda^T M [N m]. Lambda : (..., 3, 3); M : (..., 3)."""
    return apply_transposed(Lambda, M)
