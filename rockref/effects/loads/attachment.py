"""Forces that act at a height on the body's axis."""

import numpy as np

from rockref.model.rotation import apply, cross


def half_height(points):
    """Return height of the centre of mass above the base, -min(P_z), (...) [m]; the top of a uniform block is as far
    away."""
    return -np.min(points.P[..., 2], axis=-1)


def arm(Lambda, height):
    """Return way from the centre of mass to the body point (0, 0, height), plate axes: (..., 3, 3), (...) [m] -> (...,
    3)."""
    return Lambda[..., :, 2] * np.asarray(height)[..., None]


def velocity_at(r, Lambda, v, W):
    """Return velocity of the body point at r from the centre of mass, all (..., 3), plate axes [m/s]."""
    return v + cross(apply(Lambda, W), r)
