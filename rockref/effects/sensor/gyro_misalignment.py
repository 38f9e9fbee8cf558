"""A gyroscope that is not square to the block."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.effects.prior import TYPICALLY_NONE, Prior
from rockref.model.rotation import apply, exponential


@dataclass(frozen=True)
class GyroMisalignment(Effect):
    """The measured crv is (I + S) R crv, with R the rotation by the vector (x, y, z), by the exponential.

    S is symmetric, with xy, xz, yz off its diagonal: axes of the sensor that are not square to each other.
    """

    id = "gyro_misalignment"
    question = "sensor"
    quantities = {
        axis: Quantity("rad", 0.0, -0.1, 0.1, typical, "any", f"rotation vector of the sensor, {axis}", -3.2, 3.2)
        for axis, typical in (("x", 0.03), ("y", 0.03), ("z", -0.03))
    } | {
        axes: Quantity(
            "rad", 0.0, -0.05, 0.05, 0.0, "any", f"half of what {axes[0]} and {axes[1]} lack to square", -0.3, 0.3
        )
        for axes in ("xy", "xz", "yz")
    }  # fmt: skip
    # Decided: axes half a degree from square.
    priors = {axes: Prior(spread=0.005, deviation=TYPICALLY_NONE) for axes in ("xy", "xz", "yz")}
    sentence = "A sensor glued on slightly turned shows a part of one rate in the channel of another."
    equation = r"W_m = (I + S)\exp(\hat r)\,W"
    source = "D. H. Titterton, J. L. Weston (2004), Strapdown Inertial Navigation Technology, doi:10.1049/PBRA017E"
    confounder = "release_velocity"
    experiment = "Mount the sensor turned by 90 degrees: does the signal follow the sensor or the block?"

    stage = "mounting"

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    xy: float = 0.0
    xz: float = 0.0
    yz: float = 0.0

    def sensor(self, t, crv):
        if self.is_absent():
            return crv
        turned = apply(self.rotation(crv.dtype), crv)
        return turned if self.is_square() else apply(self.axes(crv.dtype), turned)

    def undo(self, t, crv):
        if self.is_absent():
            return t, crv
        turned = crv if self.is_square() else apply(np.linalg.inv(self.axes(crv.dtype)), crv)
        return t, apply(self.rotation(crv.dtype).T, turned)

    def rotation(self, dtype):
        """Return R (3, 3)."""
        return exponential(np.array((self.x, self.y, self.z), dtype))

    def is_square(self) -> bool:
        """Return whether the sensor's axes are at right angles."""
        return not (self.xy or self.xz or self.yz)

    def axes(self, dtype):
        """Return I + S (3, 3)."""
        return np.array([[1, self.xy, self.xz], [self.xy, 1, self.yz], [self.xz, self.yz, 1]], dtype)
