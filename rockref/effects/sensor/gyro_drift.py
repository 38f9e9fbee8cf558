"""A gyroscope that does not show zero at rest."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity


@dataclass(frozen=True)
class GyroDrift(Effect):
    """Adds a bias and a rate times t to each measured rate; t counts from release."""

    id = "gyro_drift"
    question = "sensor"
    quantities = {
        **{
            f"bias_{a}": Quantity("rad/s", 0.0, -0.02, 0.02, typical, "any", f"shown at rest, axis {a}")
            for a, typical in (("x", 5e-3), ("y", 2e-3), ("z", -5e-3))
        },
        **{
            f"rate_{a}": Quantity("rad/s2", 0.0, -5e-3, 5e-3, typical, "any", f"change of the bias, axis {a}")
            for a, typical in (("x", 1e-3), ("y", -1e-3), ("z", 1e-3))
        },
    }
    sentence = "Temperature and ageing shift the zero of each axis, and warming up lets it wander."
    equation = r"W_m = W + b + \dot b\,t"
    source = "D. H. Titterton, J. L. Weston (2004), Strapdown Inertial Navigation Technology, doi:10.1049/PBRA017E"
    confounder = "base_vibration"
    experiment = "Record a minute at rest before and after the run: mean and slope are the bias and its rate."

    bias_x: float = 0.0
    bias_y: float = 0.0
    bias_z: float = 0.0
    rate_x: float = 0.0
    rate_y: float = 0.0
    rate_z: float = 0.0

    def sensor(self, t, crv):
        if self.is_absent():
            return crv
        bias, rate = self.vectors(crv.dtype)
        return crv + bias + np.asarray(t, crv.dtype)[:, None] * rate

    def undo(self, t, crv):
        if self.is_absent():
            return t, crv
        bias, rate = self.vectors(crv.dtype)
        return t, crv - bias - np.asarray(t, crv.dtype)[:, None] * rate

    def vectors(self, dtype):
        """Return bias and its rate of change, two (3,) [rad/s, rad/s2]."""
        bias, rate = (self.bias_x, self.bias_y, self.bias_z), (self.rate_x, self.rate_y, self.rate_z)
        return np.array(bias, dtype), np.array(rate, dtype)
