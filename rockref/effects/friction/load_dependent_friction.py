"""Friction that is not quite in proportion to the load."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity

#: Least normal force, in parts of the reference, at which the power is taken; decided: below a thousandth of half the
#: weight a foot neither holds nor loses anything that a gyroscope sees, and the power would run to infinity.
FLOOR = 1e-3


@dataclass(frozen=True)
class LoadDependentFriction(Effect):
    """Both thresholds are multiplied by (F_N/reference)^(-exponent), F_N floored at a thousandth of the reference.

    The reference is half the weight of the 54 kg block: there the coefficient is the stated one. Archard's areas give
    exponents of 0 (many contacts) to 1/3 (one smooth one). Below zero, where friction rises with the load, there is no
    theory here; decided: a fit may go there, so that data that speak against the effect can say so.
    """

    id = "load_dependent_friction"
    question = "friction"
    quantities = {
        "exponent": Quantity(
            "1", 0.0, -0.33, 0.33, 0.15, "any", "how fast the coefficient falls with the load", -1.0, 1.0
        ),
        "reference": Quantity(
            "N", 264.87, 50.0, 1000.0, 264.87, "+", "load at which the coefficient is as stated", POSITIVE
        ),
    }
    switches = ("exponent",)
    sentence = "The true area of contact grows more slowly than the load, so the coefficient falls as the load rises."
    equation = r"\mu \to \mu\,(F^{(N)}/F_0)^{-p}"
    source = (
        "J. F. Archard (1957), Elastic deformation and the laws of friction, Proc. R. Soc. Lond. A 243:190-205, "
        "doi:10.1098/rspa.1957.0214 (area between load^(2/3), one smooth contact, and load^1, many)"
    )
    confounder = "stribeck_friction"
    experiment = (
        "Add mass on top: the coefficient at which the feet begin to slide changes with the load, not with speed."
    )

    exponent: float = 0.0
    reference: float = 264.87

    def friction_coefficient(self, mu_0, mu, F_N, k, points, m):
        if self.is_absent():
            return mu_0, mu
        factor = (np.maximum(F_N, FLOOR * self.reference) / self.reference) ** (-self.exponent)
        return mu_0 * factor, mu * factor
