"""Air drag."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.effects.prior import TYPICALLY_NONE, Prior
from rockref.model.rotation import apply, dot


@dataclass(frozen=True)
class QuadraticDrag(Effect):
    """A moment -c |omega| omega about the centre of mass and a force -c_v |v| v on it.

    A block that rocks about its base feels both as one moment, of size (c + c_v (height/2)^3) omega^2; its turning
    about the long axis is slowed by c alone, which tells them apart. Faces that are dragged from bottom to top have a
    third of that moment as c and two thirds by c_v. About the base a plate of area A at height H has rho C_d A H^3/2:
    the typical 0.4 N m s2 is a sail of cardboard of 0.7 m2, ten times the block's face, centred 0.8 m above the base
    (rho 1.2 kg/m3, C_d 2); bare, the block has 0.007. A thrown body feels c_v. Simplified: the same c for every axis
    and every direction, still air, no added mass, force and moment do not mix.
    """

    id = "quadratic_drag"
    question = "loads"
    quantities = {
        "c": Quantity("N m s2", 0.0, 0.002, 5.0, 0.4, "+", "moment over angular speed squared", 0.0),
        "c_v": Quantity("N s2/m2", 0.0, 0.02, 80.0, 1.0, "+", "force over speed of the centre squared", 0.0),
    }
    # Decided: drag on the faces from bottom to top, with three times the typical moment about the base, has a force of
    # 20 N s2/m2; air that drags alike about all axes has none.
    priors = {"c_v": Prior(spread=20.0, deviation=TYPICALLY_NONE)}
    sentence = "Air in front of the moving faces is pushed aside; bare the block hardly feels it, with a sail it does."
    equation = r"M = -c\,\|\omega\|\,\omega,\quad F = -c_v\,\|v\|\,v,\quad c_v = \frac{1}{2}\,\rho\,C_d A"
    source = (
        "T. I. Fossen (2011), Handbook of Marine Craft Hydrodynamics and Motion Control, doi:10.1002/9781119994138 "
        "(quadratic damping); G. K. Batchelor (1967), An Introduction to Fluid Dynamics, doi:10.1017/CBO9780511800955"
    )
    not_shaken = "needs the speed through air that stands still in the room, so the velocity of the plate too"
    confounder = "cable_restraint"
    experiment = (
        "Fix a sail of cardboard, ten times the face; or compare large with small swings: drag goes with speed cubed."
    )

    c: float = 0.0
    c_v: float = 0.0

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        if self.is_absent():
            return None
        omega = apply(Lambda, W)
        return (-self.c_v * np.sqrt(dot(v, v))[..., None] * v, -self.c * np.sqrt(dot(omega, omega))[..., None] * omega)
