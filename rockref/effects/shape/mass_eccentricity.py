"""The centre of mass off its place."""

from dataclasses import dataclass, replace

import numpy as np

from rockref.effects.base import Effect, Quantity


@dataclass(frozen=True)
class MassEccentricity(Effect):
    """Moves the centre of mass by (x, y, z) in body axes: every contact point P becomes P - (x, y, z).

    Simplified: the inertia about the (moved) centre of mass stays as it is; the exact change is of second order.
    Source: one of the scenarios that the model's authors tried before the eight points ("Defects").
    """

    id = "mass_eccentricity"
    question = "shape"
    quantities = {
        axis: Quantity(
            "m", 0.0, -3e-3, 3e-3, typical, "any", f"centre of mass off its stated place along {axis}", -0.1, 0.1
        )
        for axis, typical in (("x", 1e-3), ("y", -1e-3), ("z", 1e-3))
    }
    sentence = "A hole, a bolted sensor or uneven density moves the centre of mass, so left and right arcs differ."
    equation = r"P_i \to P_i - (x,\ y,\ z)"
    source = 'The model\'s source, "Defects"; a shift of the origin, statics: no DOI'
    confounder = "plate_tilt"
    experiment = "Turn the block by 180 degrees on the same plate: an eccentricity flips, a tilt of the plate stays."

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0

    def points(self, block, points):
        if self.is_absent():
            return block, points
        return block, replace(points, P=points.P - np.array((self.x, self.y, self.z), points.P.dtype))
