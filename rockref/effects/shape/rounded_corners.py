"""Corners that are not sharp."""

from dataclasses import dataclass, replace

import numpy as np

from rockref.effects.base import Effect, Quantity


@dataclass(frozen=True)
class RoundedCorners(Effect):
    """Every corner of a box becomes a sphere of this radius that touches its three faces from inside.

    The sphere's centre moves from the corner by the radius toward the centre along each axis; otherwise as
    `rounded_feet`, which a block that stands on one face has.
    """

    id = "rounded_corners"
    question = "shape"
    quantities = {"radius": Quantity("m", 0.0, 2e-4, 1e-2, 2e-3, "+", "radius of every corner", 0.0, 0.5)}
    sentence = "Corners are round: a tumbling block touches earlier on its faces' sides and later on its tips."
    equation = r"r = \Lambda(P - \rho\,\mathrm{sign}P) - \rho\,e_z"
    source = (
        "P. A. Cundall, O. D. L. Strack (1979), Geotechnique 29:47-65, doi:10.1680/geot.1979.29.1.47 (rolling contact)"
    )
    confounder = "dimension_deviation"
    experiment = "Look at a corner beside a ruler."

    radius: float = 0.0

    def points(self, block, points):
        if self.is_absent():
            return block, points
        P = points.P - self.radius * np.sign(points.P)
        P[..., 2] -= self.radius  # the engines raise each point by its radius to the sphere's centre
        return block, replace(points, P=P, radius=np.full_like(points.K_N, self.radius))
