"""A foot resists turning about the vertical."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.effects.prior import Prior
from rockref.model import assembly
from rockref.model.rotation import apply


@dataclass(frozen=True)
class SpinFriction(Effect):
    """Per touching point a moment about e_z against the yaw rate, of at most radius mu F_N (drilling friction).

    The sign law is regularised like the law's own friction: spring K_T radius^2 and damper C_T radius^2 on the turn
    since touching, with radial return. A foot that slides turns more easily (Contensou's coupling): with
    `sliding_share` 1 the largest moment falls by radius |omega_z| over the root of its square and that of the sliding
    velocity, as on a limit surface that is an ellipsoid; with 0 it does not fall. Simplified: spinning does not weaken
    the friction against sliding; mu is the point's stated coefficient. A full disc of radius a under even pressure has
    radius = 2a/3.
    """

    id = "spin_friction"
    question = "friction"
    quantities = {
        "radius": Quantity("m", 0.0, 2e-4, 5e-3, 2e-3, "+", "lever of the friction in the contact face", 0.0),
        "sliding_share": Quantity("1", 0.0, 0.0, 1.0, 0.0, "any", "share by which sliding weakens it", 0.0, 1.0),
    }
    switches = ("radius",)
    priors = {"sliding_share": Prior("form")}
    sentence = "A contact has a face, not a point: its rim rubs when the block turns on it about the vertical."
    equation = (
        r"M_z = -\,r\,\mu F^{(N)}\,\mathrm{sign}(\omega_z)\,\left(1 - \eta + \eta\,"
        r"\frac{r|\omega_z|}{\sqrt{r^2\omega_z^2 + v^2}}\right) \quad\text{(spring and return)}"
    )
    source = (
        "R. I. Leine, C. Glocker (2003), A set-valued force law for spatial Coulomb-Contensou friction, "
        "Eur. J. Mech. A/Solids 22:193-216, doi:10.1016/S0997-7538(03)00025-1; R. D. Howe, M. R. Cutkosky "
        "(1996), Practical force-motion models for sliding manipulation, doi:10.1177/027836499601500603"
    )
    confounder = "gyro_scale"
    experiment = "Twist the standing block and let go: the yaw stops in a finite time, at a constant rate of loss."

    radius: float = 0.0
    sliding_share: float = 0.0

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
        if self.sliding_share:
            limit = limit * self._held(rate, c.k.v_slide)
        M = np.clip(trial, -limit, limit)
        yaw = np.where(np.abs(trial) > limit, -(M + C * rate) / K, yaw)
        m["yaw"] = np.where(c.touching, yaw, 0)
        moments = np.zeros_like(c.F)
        moments[..., 2] = np.where(c.touching, M, 0)
        return np.zeros_like(W), assembly.sum_over_points(moments)

    def _held(self, rate, v):
        """Return what sliding at v (..., n, 2) [m/s] leaves of the largest moment; rate : (..., 1) [rad/s]."""
        rim = self.radius * np.abs(rate)
        size = np.sqrt(rim * rim + v[..., 0] * v[..., 0] + v[..., 1] * v[..., 1])
        moves = size > 0
        return 1 + self.sliding_share * (np.where(moves, rim / np.where(moves, size, 1), 1) - 1)
