"""A plate that is not level."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity


@dataclass(frozen=True)
class PlateTilt(Effect):
    """Gravity turned in the plate's axes: a further force m g (x, y, (x^2 + y^2)/2) at the centre of mass.

    Second order in the angles: the weight along e_z shrinks to m g (1 - (x^2 + y^2)/2). Positive x, y: the plate falls
    toward +x, +y.
    """

    id = "plate_tilt"
    question = "loads"
    quantities = {
        axis: Quantity("rad", 0.0, -5e-3, 5e-3, 1e-3, "any", f"slope of the plate down toward {axis}", -0.2, 0.2)
        for axis in ("x", "y")
    }
    sentence = "On a plate that is not level gravity helps the block to one side and hinders it to the other."
    equation = r"F = m g\,(x,\ y,\ \frac{1}{2}\,(x^2 + y^2))"
    source = "Gravity in turned axes, statics: no DOI"
    confounder = "mass_eccentricity"
    experiment = "Turn the block by 180 degrees on the same plate: a tilt stays, an eccentricity flips. Read a level."

    x: float = 0.0
    y: float = 0.0

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        if self.is_absent():
            return None
        weight = problem.block.mass * problem.block.g
        F = np.zeros_like(x)
        F[..., 0], F[..., 1] = weight * self.x, weight * self.y
        F[..., 2] = weight * ((self.x * self.x + self.y * self.y) / 2)
        return F, np.zeros_like(x)
