"""Feet that do not stand square on the plate."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.effects.feet import of_foot
from rockref.effects.prior import Prior
from rockref.model import assembly


@dataclass(frozen=True)
class UnevenContactNormals(Effect):
    """The normal at foot i is (x_i, y_i, 1), in plate axes: a further force F_N (x_i, y_i, 0) at its points.

    First order in the angles. Simplified: penetration and friction keep to the flat plate. So the force is not
    conservative: it pushes sideways as hard as the foot is pressed, and no height pays for that. A foot that slides
    along its own slope gains or loses energy, and round a closed way of pressing, sliding and lifting it gives or takes
    what encloses depth times way.

    A scratched plate tilts the normal at the place where the foot stands, whichever way the block is turned:
    `turning_share` 0. The chamfer of a foot is turned with the block: `turning_share` 1.

    Source: one of the scenarios that the model's authors tried before the eight points ("Defects").
    """

    id = "uneven_contact_normals"
    question = "shape"
    quantities = {
        f"{axis}{i}": Quantity(
            "rad", 0.0, -0.05, 0.05, typical[j], "any", f"tilt of the normal at foot {i} toward {axis}", -0.5, 0.5
        )
        for i, typical in enumerate(((0.01, -0.01), (-0.01, 0.005), (0.005, 0.01), (-0.005, -0.01)), 1)
        for j, axis in enumerate("xy")
    } | {"turning_share": Quantity("1", 0.0, 0.0, 1.0, 0.0, "any", "share of the tilts that the block turns", 0.0, 1.0)}
    switches = tuple(f"{axis}{i}" for i in (1, 2, 3, 4) for axis in "xy")
    priors = {"turning_share": Prior("form")}
    sentence = "Scratches and chamfers turn the plate's push a little sideways, differently at each foot."
    equation = (
        r"F_i \to F_i + F_i^{(N)}\,(a_i + \eta\,(\Lambda_2 a_i - a_i),\ 0),\quad a_i = (x_i,\ y_i),\quad "
        r"\Lambda_2 = (\Lambda_{jk}),\ j, k \leq 2"
    )
    source = 'The model\'s source, "Defects"; a force along another normal, statics: no DOI'
    confounder = "uneven_foot_friction"
    experiment = "Move the block to another place on the plate, then turn it by 180 degrees in the same place."

    x1: float = 0.0
    y1: float = 0.0
    x2: float = 0.0
    y2: float = 0.0
    x3: float = 0.0
    y3: float = 0.0
    x4: float = 0.0
    y4: float = 0.0
    turning_share: float = 0.0

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        if self.is_absent():
            return None
        a_x = of_foot(problem.points, (self.x1, self.x2, self.x3, self.x4), self.id)
        a_y = of_foot(problem.points, (self.y1, self.y2, self.y3, self.y4), self.id)
        turned_x = Lambda[..., 0, 0, None] * a_x + Lambda[..., 0, 1, None] * a_y
        turned_y = Lambda[..., 1, 0, None] * a_x + Lambda[..., 1, 1, None] * a_y
        F = np.zeros_like(c.F)
        F[..., 0] = c.F_N * (a_x + self.turning_share * (turned_x - a_x))
        F[..., 1] = c.F_N * (a_y + self.turning_share * (turned_y - a_y))
        return assembly.sum_over_points(F), assembly.resultant_moment(c.k.r, F)
