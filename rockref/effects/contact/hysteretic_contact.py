"""A spring that gives back less than it took."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity


@dataclass(frozen=True)
class HystereticContact(Effect):
    """Loading along K_N, unloading and reloading along K_N (1 + kappa), from the largest depth of this contact.

    The spring part becomes max(min(spring, K_N (1 + kappa) (xi - xi_p)), 0) with xi_p = kappa/(1 + kappa) xi_largest;
    the damper stays. Decided: the dent is forgotten when the point leaves the plate, so that each contact is a new one.
    """

    id = "hysteretic_contact"
    question = "contact"
    quantities = {
        "kappa": Quantity("1", 0.0, 0.02, 2.0, 0.3, "+", "unloading stiffness over loading stiffness, less one", 0.0)
    }
    sentence = "Asperities yield: the contact unloads along a steeper line and leaves a dent, a loss without any rate."
    equation = (
        r"F_{el} = \max(\min(K^{(N)}\xi,\ K^{(N)}(1+\kappa)(\xi-\xi_p)),\,0),\quad "
        r"\xi_p = \tfrac{\kappa}{1+\kappa}\,\xi_{max}"
    )
    source = "O. R. Walton, R. L. Braun (1986), J. Rheol. 30:949-980, doi:10.1122/1.549893"
    confounder = "uneven_foot_damping"
    experiment = (
        "Add mass on top: this loss is the same share of an impact's energy at every speed and every contact duration; "
        "a damper's share changes."
    )

    kappa: float = 0.0

    def start(self, problem):
        return {"xi_largest": np.zeros_like(problem.points.K_N)}

    def normal_force(self, F, k, points, m):
        if self.is_absent():
            return F
        m["xi_largest"] = np.where(k.xi < 0, 0, np.maximum(m["xi_largest"], k.xi))
        damper = points.C_N * k.xi_rate
        dent = self.kappa / (1 + self.kappa) * m["xi_largest"]
        unloading = points.K_N * (1 + self.kappa) * (k.xi - dent)
        return np.maximum(np.minimum(F - damper, unloading), 0) + damper
