"""Air drag."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.effects.loads.attachment import half_height
from rockref.model import assembly
from rockref.model.rotation import apply, cross, dot

#: Slices of the height; decided: with 16 the moment on a block that turns about its base is 0.2 % from the integral.
SLICES = 16
#: Centres of the slices, in parts of half the height, (SLICES, 1).
CENTRES = ((2 * np.arange(SLICES) + 1) / SLICES - 1)[:, None]


@dataclass(frozen=True)
class QuadraticDrag(Effect):
    """A force -c/16 |v_k| v_k on each of 16 slices of the height, at the slice's centre on the body axis.

    c = rho C_d A / 2 of the whole face: 0.05 N s2/m2 for the bare block, which no gyroscope sees; a sail of a square
    metre has some 1 N s2/m2. A moment -q |omega| omega of the same loss has q = c h^3/4. Simplified: the same c for
    every direction, speed of the slice's centre in still air, no added mass.
    """

    id = "quadratic_drag"
    question = "loads"
    quantities = {"c": Quantity("N s2/m2", 0.0, 0.02, 10.0, 4.0, "+", "drag over speed squared, whole height", 0.0)}
    sentence = "Air in front of the moving faces is pushed aside; bare the block hardly feels it, with a sail it does."
    equation = r"F = -\sum_{k=1}^{16} \tfrac{c}{16}\,\|v_k\|\,v_k,\quad c = \tfrac12\rho\,C_d A"
    source = "G. K. Batchelor (1967), An Introduction to Fluid Dynamics, doi:10.1017/CBO9780511800955"
    confounder = "cable_restraint"
    experiment = (
        "Fix a sail of cardboard, ten times the face; or compare large with small swings: drag goes with speed cubed."
    )

    c: float = 0.0

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        if self.is_absent():
            return None
        centres = half_height(problem.points)[..., None, None] * CENTRES.astype(x.dtype)
        r = Lambda[..., None, :, 2] * centres
        v_k = v[..., None, :] + cross(apply(Lambda, W)[..., None, :], r)
        speed = np.sqrt(dot(v_k, v_k))
        F = -self.c / SLICES * speed[..., None] * v_k
        return assembly.sum_over_points(F), assembly.resultant_moment(r, F)
