"""Friction that falls with sliding speed."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.prior import Prior


@dataclass(frozen=True)
class StribeckFriction(Effect):
    """Both thresholds are multiplied by 1 + (ratio - 1) exp(-(|v_slide|/velocity)^2).

    Simplified: the survey's curve without its viscous term (that is `viscous_friction`) and without memory. A ratio
    above 1 is Stribeck's: friction falls with speed. Below 1 it rises, which the survey does not have; decided: a fit
    may go there, so that data that speak against the effect can say so.
    """

    id = "stribeck_friction"
    question = "friction"
    quantities = {
        "ratio": Quantity("1", 1.0, 0.5, 3.0, 1.5, "any", "friction at rest over friction when sliding fast", 0.0),
        "velocity": Quantity(
            "m/s", 0.01, 1e-3, 0.1, 0.01, "+", "sliding speed at which the excess has fallen to 1/e", POSITIVE
        ),
    }
    switches = ("ratio",)
    not_with_block = ("velocity",)  # that of the surfaces
    # Decided: factors of one and a half, and of two; friction is positive on either side of none.
    priors = {"ratio": Prior(scale="log", spread=0.4), "velocity": Prior("shape", spread=0.7)}
    sentence = "Surfaces at rest interlock or squeeze out their film; sliding parts them, so friction falls with speed."
    equation = r"\mu \to \mu\left[1 + (\rho - 1)\,e^{-(\|v_s\|/v_0)^2}\right]"
    source = (
        "B. Armstrong-Helouvry, P. Dupont, C. Canudas de Wit (1994), Automatica 30:1083-1138, "
        "doi:10.1016/0005-1098(94)90209-7"
    )
    confounder = "uneven_foot_friction"
    experiment = "Pull the block slowly over the plate: stick-slip and a peak before sliding appear only with it."

    ratio: float = 1.0
    velocity: float = 0.01

    def friction_coefficient(self, mu_0, mu, F_N, k, points, m):
        if self.is_absent():
            return mu_0, mu
        v_x, v_y = k.v_slide[..., 0], k.v_slide[..., 1]
        relative = np.sqrt(v_x * v_x + v_y * v_y) / self.velocity
        factor = 1 + (self.ratio - 1) * np.exp(-(relative * relative))
        return mu_0 * factor, mu * factor
