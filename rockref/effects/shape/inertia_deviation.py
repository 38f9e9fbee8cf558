"""An inertia that is not the uniform cuboid's."""

from dataclasses import dataclass, replace

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.prior import TYPICALLY_NONE, Prior


@dataclass(frozen=True)
class InertiaDeviation(Effect):
    """Scales the principal inertias by xx, yy, zz; products of inertia, if any, by the geometric mean of their two.

    xy, xz, yz are further products of inertia over that mean: principal axes that are not the block's.
    """

    id = "inertia_deviation"
    question = "shape"
    quantities = {
        axis: Quantity(
            "1", 1.0, 0.95, 1.05, 1.02, "any", f"inertia about {axis[0].upper()} over the stated one", POSITIVE
        )
        for axis in ("xx", "yy", "zz")
    } | {
        axes: Quantity(
            "1", 0.0, -0.1, 0.1, 0.0, "any", f"product of inertia of {axes[0].upper()} and {axes[1].upper()}", -0.5, 0.5
        )
        for axes in ("xy", "xz", "yz")
    }  # fmt: skip
    # Decided: half a kilogram more at one corner makes products of inertia of 0.02 with the long axis.
    priors = {axes: Prior(spread=0.02, deviation=TYPICALLY_NONE) for axes in ("xy", "xz", "yz")}
    sentence = "Holes, fittings and density change the resistance to turning without moving the centre of mass."
    equation = r"J_{ij} \to \sqrt{s_i s_j}\,\left(J_{ij} + p_{ij}\sqrt{J_{ii}J_{jj}}\right)"
    source = (
        "J. C. Simo, K. K. Wong (1991), Int. J. Numer. Methods Eng. 31:19-52, doi:10.1002/nme.1620310103 (how J enters)"
    )
    confounder = "gyro_scale"
    experiment = "Hang the block on two wires and time its swing; or turn the gyroscope by 90 degrees and repeat a run."

    xx: float = 1.0
    yy: float = 1.0
    zz: float = 1.0
    xy: float = 0.0
    xz: float = 0.0
    yz: float = 0.0

    def points(self, block, points):
        if self.is_absent():
            return block, points
        root = np.sqrt(np.array((self.xx, self.yy, self.zz), block.inertia.dtype))
        inertia = block.inertia
        if self.xy or self.xz or self.yz:
            size = np.sqrt(np.diag(inertia))
            p = np.array([[0, self.xy, self.xz], [self.xy, 0, self.yz], [self.xz, self.yz, 0]], inertia.dtype)
            inertia = inertia + p * (size[:, None] * size)
        return replace(block, inertia=inertia * (root[:, None] * root)), points
