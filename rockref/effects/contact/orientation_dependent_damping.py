"""A damper that depends on how a corner is turned when it strikes."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity


@dataclass(frozen=True)
class OrientationDependentDamping(Effect):
    """Adds a P_2(cos phi) C_N xi_rate, with phi between the vertical and the line from the centre of mass to the point.

    P_2 = (3 cos^2 phi - 1)/2 is Legendre's polynomial, the lowest even harmonic of a direction; below zero it counts as
    zero. For the corners of a cube that lies on a face it is 0, on an edge 1/2, for one that strikes with its tip 1. Of
    a round corner the centre of its sphere is meant. Decided: that form; what a body that is no sphere loses depends on
    its orientation, and no closed law of it is known. Before the no-tension cut.
    """

    id = "orientation_dependent_damping"
    question = "contact"
    quantities = {
        "a": Quantity("1", 0.0, 0.1, 10.0, 1.0, "+", "damping of a tip over that of a corner of a face, less one", 0.0)
    }
    sentence = "How a corner is turned when it strikes decides what it loses: with its tip more than lying on a face."
    equation = (
        r"F^{(N)} = \max\left(K^{(N)}\xi + C^{(N)}\left(1 + a\,\max(P_2(\cos\phi),\,0)\right)\dot\xi,\ 0\right),\quad "
        r"\cos\phi = -r_z/\|r\|"
    )
    source = (
        "D. Krengel et al. (2025), On the planar impact of a disc and a square particle considering the impact angle "
        "and particle orientation, arXiv:2503.14822 (restitution depends on the orientation; the form is ours)"
    )
    confounder = "hunt_crossley_contact"
    experiment = "Drop the block from one height on faces, edges and corners, without spin, and compare the rebounds."

    a: float = 0.0

    def normal_force(self, F, k, points, m):
        if self.is_absent():
            return F
        x, y, z = k.r[..., 0], k.r[..., 1], k.r[..., 2] + (0 if points.radius is None else points.radius)
        squares = x * x + y * y + z * z
        tip = np.maximum(1.5 * (z * z / np.where(squares > 0, squares, 1)) - 0.5, 0)
        return F + self.a * tip * points.C_N * k.xi_rate
