"""Feet that roll."""

from dataclasses import dataclass, replace

import numpy as np

from rockref.effects.base import Effect, Quantity


@dataclass(frozen=True)
class RoundedFeet(Effect):
    """Every contact point becomes a sphere of this radius, centred above the point on the body axis.

    It replaces the radius that the model may give. The contact is at the sphere's lowest point: below the point while
    the block stands upright, rho sin(tilt) further out while it leans. The tangential spring follows the material
    velocity there, as in discrete-element codes, so that a foot can roll without friction.
    """

    id = "rounded_feet"
    question = "shape"
    quantities = {"radius": Quantity("m", 0.0, 2e-4, 1e-2, 2e-3, "+", "radius of every foot", 0.0)}
    sentence = (
        "A round foot rolls: its contact moves outward as the block leans, the weight's lever grows, arcs are shorter."
    )
    equation = r"r = \Lambda(P + \rho\,e_Z) - \rho\,e_z"
    source = (
        "P. A. Cundall, O. D. L. Strack (1979), Geotechnique 29:47-65, doi:10.1680/geot.1979.29.1.47 (rolling contact)"
    )
    confounder = "gyro_scale"
    experiment = (
        "Releases of different tilt: the rolling shows in the arc time as the tilt grows, a scale error does not."
    )

    radius: float = 0.0

    def points(self, block, points):
        if self.is_absent():
            return block, points
        return block, replace(points, radius=np.full_like(points.K_N, self.radius))
