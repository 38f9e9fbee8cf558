"""A gyroscope that runs into its stops."""

import math
from dataclasses import dataclass

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity


@dataclass(frozen=True)
class GyroSaturation(Effect):
    """Each measured rate is cut at plus and minus `range`."""

    id = "gyro_saturation"
    question = "sensor"
    quantities = {"range": Quantity("rad/s", math.inf, 0.1, 10.0, 0.4, "any", "largest rate that is shown", POSITIVE)}
    sentence = "Beyond its range the sensor shows its largest number, and the tops of the record are flat."
    equation = r"W_m = \mathrm{clip}(W,\ -R,\ R)"
    source = "D. H. Titterton, J. L. Weston (2004), Strapdown Inertial Navigation Technology, doi:10.1049/PBRA017E"
    confounder = "gyro_scale"
    experiment = "Choose the sensor's next larger range; a flat top that stays at one number in every run is the range."

    range: float = math.inf

    def sensor(self, t, crv):
        if self.is_absent():
            return crv
        return np.clip(crv, -self.range, self.range)
