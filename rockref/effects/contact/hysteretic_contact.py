"""A spring that gives back less than it took."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.effects.prior import Prior


@dataclass(frozen=True)
class HystereticContact(Effect):
    """Loading along K_N, unloading and reloading along K_N (1 + kappa), from the largest depth of this contact.

    The spring part becomes max(min(spring, K_N (1 + kappa) (xi - xi_p)), 0) with xi_p = kappa/(1 + kappa) xi_largest;
    the damper stays. With `curved_share` 1 the way back from xi_largest to the dent follows the power 3/2 and not a
    line, as of a sphere that yields where it is pressed most and unloads as Hertz's does. Decided: the dent is
    forgotten when the point leaves the plate, so that each contact is a new one.
    """

    id = "hysteretic_contact"
    question = "contact"
    quantities = {
        "kappa": Quantity("1", 0.0, 0.02, 2.0, 0.3, "+", "unloading stiffness over loading stiffness, less one", 0.0),
        "curved_share": Quantity("1", 0.0, 0.0, 1.0, 0.0, "any", "share of the power 3/2 in the unloading", 0.0, 1.0),
    }
    switches = ("kappa",)
    priors = {"curved_share": Prior("form")}
    sentence = "Asperities yield: the contact unloads along a steeper line and leaves a dent, a loss without any rate."
    equation = (
        r"F_{el} = \max(\min(K^{(N)}\xi,\ K^{(N)}\xi_{max}(1 - \eta + \eta\sqrt{\zeta})\,\zeta),\,0),\quad "
        r"\zeta = \frac{\xi-\xi_p}{\xi_{max}-\xi_p},\quad \xi_p = \frac{\kappa}{1+\kappa}\,\xi_{max}"
    )
    source = (
        "O. R. Walton, R. L. Braun (1986), J. Rheol. 30:949-980, doi:10.1122/1.549893; C. Thornton (1997), Coefficient "
        "of restitution for collinear collisions of elastic-perfectly plastic spheres, doi:10.1115/1.2787319"
    )
    confounder = "uneven_foot_damping"
    experiment = (
        "Add mass on top: this loss is the same share of an impact's energy at every speed and every contact duration; "
        "a damper's share changes."
    )

    kappa: float = 0.0
    curved_share: float = 0.0

    def start(self, problem):
        return {"xi_largest": np.zeros_like(problem.points.K_N)}

    def normal_force(self, F, k, points, m):
        if self.is_absent():
            return F
        m["xi_largest"] = np.where(k.xi < 0, 0, np.maximum(m["xi_largest"], k.xi))
        damper = points.C_N * k.xi_rate
        dent = self.kappa / (1 + self.kappa) * m["xi_largest"]
        unloading = points.K_N * (1 + self.kappa) * (k.xi - dent)
        if self.curved_share:
            way = m["xi_largest"] - dent
            left = np.maximum(k.xi - dent, 0) / np.where(way > 0, way, 1)
            unloading = unloading * (1 + self.curved_share * (np.sqrt(left) - 1))
        return np.maximum(np.minimum(F - damper, unloading), 0) + damper
