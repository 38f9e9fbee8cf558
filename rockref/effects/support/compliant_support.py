"""A plate that yields."""

import math
from dataclasses import dataclass

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.contact.adhesion import Adhesion
from rockref.model import assembly


@dataclass(frozen=True)
class CompliantSupport(Effect):
    """The plate is a mass on a spring and a damper, free in the vertical; it carries the contact forces.

    M q'' = -sum F_N + m g - k q - c q', with k = (2 pi f)^2 M, c = 2 ratio sqrt(k M); q counts from the static
    equilibrium under the block's weight, so the release posture stays. Stepped by semi-implicit Euler after the block:
    the points see the plate of one step before. Simplified: no pitching of the plate.
    """

    id = "compliant_support"
    question = "support"
    quantities = {
        "mass": Quantity("kg", 100.0, 20.0, 2000.0, 100.0, "+", "of the plate that moves along", POSITIVE),
        "frequency": Quantity("Hz", 0.0, 20.0, 300.0, 60.0, "+", "of the plate alone; 0: rigid", 0.0),
        "ratio": Quantity("1", 0.03, 0.0, 0.2, 0.03, "+", "damping ratio of the plate alone", 0.0),
    }
    switches = ("frequency",)
    sentence = "The plate and its table give a little under each impact and ring on after it."
    equation = r"M\ddot q = -\sum_i F_i^{(N)} + m g - k q - c\dot q,\quad \xi_i = q - z_i"
    source = (
        "I. N. Psycharis, P. C. Jennings (1983), Rocking of slender rigid bodies allowed to uplift, "
        "Earthquake Eng. Struct. Dyn. 11:57-76, doi:10.1002/eqe.4290110106"
    )
    confounder = "hertzian_contact"
    experiment = (
        "Put an accelerometer on the plate, or the plate on the floor: its ringing after an impact goes or stays."
    )

    mass: float = 100.0
    frequency: float = 0.0
    ratio: float = 0.03

    def start(self, problem):
        return {"q": np.zeros_like(problem.block.mass), "q_rate": np.zeros_like(problem.block.mass)}

    def plate_motion(self, t, m):
        if self.is_absent():
            return None
        up = np.array((0, 0, 1), m["q"].dtype)
        return m["q"][..., None] * up, m["q_rate"][..., None] * up

    def advance(self, problem, c, h, m):
        if self.is_absent():
            return
        k = (2 * math.pi * self.frequency) ** 2 * self.mass
        damping = 2 * self.ratio * math.sqrt(k * self.mass)
        carried = assembly.sum_over_points(c.F)[..., 2]
        for effect in problem.effects:
            if isinstance(effect, Adhesion) and not effect.is_absent():
                carried = carried + effect.point_wrench(problem, c, {})[0][..., 2]
        load = problem.block.mass * problem.block.g - carried
        m["q_rate"] = m["q_rate"] + h * (load - k * m["q"] - damping * m["q_rate"]) / self.mass
        m["q"] = m["q"] + h * m["q_rate"]
