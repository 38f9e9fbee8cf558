"""A foot resists turning about the vertical."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.model import assembly
from rockref.model.rotation import apply


@dataclass(frozen=True)
class SpinFriction(Effect):
    """Per touching point a moment about e_z against the yaw rate, of at most radius mu F_N (drilling friction).

    The sign law is regularised like the law's own friction: spring K_T radius^2 and damper C_T radius^2 on the turn
    since touching, with radial return. Simplified: sliding and spinning do not weaken each other (Contensou's
    coupling); mu is the point's stated coefficient. A full disc of radius a under even pressure has radius = 2a/3.
    """

    id = "spin_friction"
    question = "friction"
    quantities = {"radius": Quantity("m", 0.0, 2e-4, 5e-3, 2e-3, "+", "lever of the friction in the contact face", 0.0)}
    sentence = "A contact has a face, not a point: its rim rubs when the block turns on it about the vertical."
    equation = r"M_z = -\,r\,\mu F^{(N)}\,\mathrm{sign}(\omega_z) \quad\text{(spring and return)}"
    source = (
        "R. I. Leine, C. Glocker (2003), A set-valued force law for spatial Coulomb-Contensou friction, "
        "Eur. J. Mech. A/Solids 22:193-216, doi:10.1016/S0997-7538(03)00025-1"
    )
    confounder = "gyro_scale"
    experiment = "Twist the standing block and let go: the yaw stops in a finite time, at a constant rate of loss."

    radius: float = 0.0

    def start(self, problem):
        return {"yaw": np.zeros_like(problem.points.K_T)}

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        if self.is_absent():
            return None
        points, square = problem.points, self.radius * self.radius
        K, C = points.K_T * square, points.C_T * square
        rate = apply(Lambda, W)[..., 2:3]
        yaw = m["yaw"] + c.turn[..., 2:3]
        trial = -K * yaw - C * rate
        limit = self.radius * points.mu * c.F_N
        M = np.clip(trial, -limit, limit)
        yaw = np.where(np.abs(trial) > limit, -(M + C * rate) / K, yaw)
        m["yaw"] = np.where(c.touching, yaw, 0)
        moments = np.zeros_like(c.F)
        moments[..., 2] = np.where(c.touching, M, 0)
        return np.zeros_like(W), assembly.sum_over_points(moments)
