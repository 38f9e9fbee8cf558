"""Feet that roll."""

from dataclasses import dataclass, replace

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.feet import of_foot, over_mean
from rockref.effects.prior import Prior
from rockref.model.problem import ContactPoints


@dataclass(frozen=True)
class RoundedFeet(Effect):
    """Every contact point becomes a sphere, centred above the point on the body axis.

    `radius` is the geometric mean of the four feet's radii; of the factors `foot1` to `foot4`, by which the radii
    differ, only the ratios count (decided: so a common factor cannot trade with the radius). Both points of a foot have
    its radius. It replaces the radius that the model may give. The contact is at the sphere's lowest point: below the
    point while the block stands upright, rho sin(tilt) further out while it leans. The tangential spring follows the
    material velocity there, as in discrete-element codes, so that a foot can roll without friction.
    """

    id = "rounded_feet"
    question = "shape"
    quantities = {"radius": Quantity("m", 0.0, 2e-4, 1e-2, 2e-3, "+", "mean radius of the feet", 0.0)} | {
        f"foot{i}": Quantity("1", 1.0, 0.3, 3.0, 1.0, "any", f"radius of foot {i} over the mean", POSITIVE)
        for i in (1, 2, 3, 4)
    }
    switches = ("radius",)
    # Decided: radii of feet that are ground by hand, by a third.
    priors = {f"foot{i}": Prior("shape", spread=0.3) for i in (1, 2, 3, 4)}
    sentence = (
        "A round foot rolls: its contact moves outward as the block leans, the weight's lever grows, arcs are shorter."
    )
    equation = r"r_i = \Lambda(P_i + \rho_i\,e_Z) - \rho_i\,e_z,\quad \rho_i = \rho\,s_i/(s_1 s_2 s_3 s_4)^{1/4}"
    source = (
        "P. A. Cundall, O. D. L. Strack (1979), Geotechnique 29:47-65, doi:10.1680/geot.1979.29.1.47 (rolling contact)"
    )
    confounder = "gyro_scale"
    experiment = (
        "Releases of different tilt: the rolling shows in the arc time as the tilt grows, a scale error does not."
    )

    radius: float = 0.0
    foot1: float = 1.0
    foot2: float = 1.0
    foot3: float = 1.0
    foot4: float = 1.0

    def points(self, block, points):
        if self.is_absent():
            return block, points
        return block, replace(points, radius=self.radius * self.relative(points))

    def relative(self, points: ContactPoints) -> np.ndarray:
        """Return (..., n) radius of every point over the geometric mean of the four feet's."""
        feet, alike = (self.foot1, self.foot2, self.foot3, self.foot4), np.ones_like(points.K_N)
        if all(foot == 1 for foot in feet):
            return alike
        return alike * of_foot(points, over_mean(feet), self.id)
