"""A gyroscope that shows too much or too little."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity


@dataclass(frozen=True)
class GyroScale(Effect):
    """Each measured rate is multiplied by its own factor."""

    id = "gyro_scale"
    question = "sensor"
    quantities = {
        axis: Quantity("1", 1.0, 0.9, 1.1, typical, "any", f"shown over true rate, axis {axis}")
        for axis, typical in (("x", 1.02), ("y", 0.98), ("z", 1.02))
    }
    sentence = "Calibration and temperature change the scale factor of each axis of the sensor."
    equation = r"W_m = \mathrm{diag}(s_x, s_y, s_z)\,W"
    source = "D. H. Titterton, J. L. Weston (2004), Strapdown Inertial Navigation Technology, doi:10.1049/PBRA017E"
    confounder = "inertia_deviation"
    experiment = "Turn the sensor by hand through 90 degrees between two stops: the integral must be 90 degrees."

    stage = "mounting"

    x: float = 1.0
    y: float = 1.0
    z: float = 1.0

    def sensor(self, t, crv):
        if self.is_absent():
            return crv
        return crv * np.array((self.x, self.y, self.z), crv.dtype)

    def undo(self, t, crv):
        return t, crv if self.is_absent() else crv / np.array((self.x, self.y, self.z), crv.dtype)
