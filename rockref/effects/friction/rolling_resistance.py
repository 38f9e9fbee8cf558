"""A foot resists being rolled over."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.model import assembly
from rockref.model.contact import norm
from rockref.model.rotation import apply

#: Makes a turning stiffness of a stiffness and a lever [m]; decided: half the base, so that half the weight is held
#: within 0.1 mrad, a thousandth of a swing. With the lever alone, K_N lever^2, it would be held within a tenth of one.
ARM = 0.05


@dataclass(frozen=True)
class RollingResistance(Effect):
    """Per touching point a moment against the horizontal angular velocity, of at most lever F_N.

    The sign law is regularised like the law's own friction: spring K_N lever ARM and damper C_N lever ARM on the
    horizontal turn since touching (two components), with radial return; type C of the review cited.
    """

    id = "rolling_resistance"
    question = "friction"
    quantities = {
        "lever": Quantity("m", 0.0, 1e-6, 1e-3, 2e-4, "+", "shift of the pressure's centre ahead of the motion", 0.0)
    }
    sentence = "The face under a turning edge presses harder ahead than behind, so the centre of pressure runs ahead."
    equation = r"M_{xy} = -\,a\,F^{(N)}\,\omega_{xy}/\|\omega_{xy}\| \quad\text{(spring and return)}"
    source = (
        "J. Ai, J.-F. Chen, J. M. Rotter, J. Y. Ooi (2011), Assessment of rolling resistance models in discrete "
        "element simulations, Powder Technol. 206:269-282, doi:10.1016/j.powtec.2010.09.030"
    )
    confounder = "quadratic_drag"
    experiment = (
        "Change the edge (sharp, rounded, hardened shim) or add mass: this loss follows load and edge, not speed."
    )

    lever: float = 0.0

    def start(self, problem):
        return {"held": np.zeros(problem.points.K_N.shape + (2,), problem.points.K_N.dtype)}

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        if self.is_absent():
            return None
        points, size = problem.points, self.lever * ARM
        K, C = (points.K_N * size)[..., None], (points.C_N * size)[..., None]
        damped = C * apply(Lambda, W)[..., None, :2]
        held = m["held"] - K * c.turn[..., None, :2]  # the moment of the spring
        trial = held - damped
        length, limit = norm(trial), self.lever * c.F_N
        returned = length > limit
        M = np.where(returned, limit / np.where(returned, length, 1), 1)[..., None] * trial
        held = np.where(returned[..., None], M + damped, held)
        m["held"] = np.where(c.touching[..., None], held, 0)
        moment = np.zeros_like(W)
        moment[..., :2] = assembly.sum_over_points(np.where(c.touching[..., None], M, 0))
        return np.zeros_like(W), moment
