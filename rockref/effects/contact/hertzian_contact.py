"""A spring that stiffens with depth."""

from dataclasses import dataclass, replace

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.prior import Prior


@dataclass(frozen=True)
class HertzianContact(Effect):
    """Power-law spring: K_N ref (xi/ref)^exponent instead of K_N xi; the damper stays.

    Simplified: Hertz's exponent 3/2 belongs to smooth curved bodies, whose stiffness follows from radii and moduli;
    here K_N is the secant stiffness at the depth `reference`, and the exponent is free (rough faces: up to 2).
    At release the two pivot points stand at the depth that carries the weight by this spring.
    """

    id = "hertzian_contact"
    question = "contact"
    quantities = {
        "exponent": Quantity("1", 1.0, 1.0, 2.0, 1.5, "+", "power of the penetration", POSITIVE, 10.0),
        "reference": Quantity(
            "m", 2e-5, 1e-6, 1e-4, 2e-5, "+", "depth at which the spring is as stiff as K_N", POSITIVE
        ),
    }
    switches = ("exponent",)
    priors = {"reference": Prior("shape")}
    sentence = "Curved or rough faces touch over an area that grows with the load, so the contact stiffens with depth."
    equation = r"F^{(N)} = \max\!\left(K^{(N)} x_0 (\xi/x_0)^p + C^{(N)}\dot\xi,\ 0\right)"
    source = (
        "H. Hertz (1882), J. reine angew. Math. 92:156-171, doi:10.1515/crll.1882.92.156; "
        "K. L. Johnson (1985), Contact Mechanics, ch. 4, doi:10.1017/CBO9781139171731"
    )
    confounder = "hunt_crossley_contact"
    experiment = (
        "Tap the standing block and read the contact's frequency, with and without added mass: a linear spring's falls "
        "with the root of the mass, a stiffening one's by less."
    )

    exponent: float = 1.0
    reference: float = 2e-5

    def release(self, block, points, state):
        if self.is_absent():
            return state
        load = block.mass * block.g / 2 / points.K_N
        change = np.mean(load - self.reference * (load / self.reference) ** (1 / self.exponent))
        x = state.x.copy()
        x[..., 2] += change
        return replace(state, x=x)

    def normal_force(self, F, k, points, m):
        if self.is_absent():
            return F
        depth = np.maximum(k.xi, 0)
        return F + points.K_N * (self.reference * (depth / self.reference) ** self.exponent - k.xi)
