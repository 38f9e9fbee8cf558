"""An inertia that is not the uniform cuboid's."""

from dataclasses import dataclass, replace

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity


@dataclass(frozen=True)
class InertiaDeviation(Effect):
    """Scales the principal inertias by xx, yy, zz; products of inertia, if any, by the geometric mean of their two."""

    id = "inertia_deviation"
    question = "shape"
    quantities = {
        axis: Quantity(
            "1", 1.0, 0.95, 1.05, 1.02, "any", f"inertia about {axis[0].upper()} over the stated one", POSITIVE
        )
        for axis in ("xx", "yy", "zz")
    }
    sentence = "Holes, fittings and density change the resistance to turning without moving the centre of mass."
    equation = r"J_{ii} \to s_i J_{ii}"
    source = (
        "J. C. Simo, K. K. Wong (1991), Int. J. Numer. Methods Eng. 31:19-52, doi:10.1002/nme.1620310103 (how J enters)"
    )
    confounder = "gyro_scale"
    experiment = "Hang the block on two wires and time its swing; or turn the gyroscope by 90 degrees and repeat a run."

    xx: float = 1.0
    yy: float = 1.0
    zz: float = 1.0

    def points(self, block, points):
        if self.is_absent():
            return block, points
        root = np.sqrt(np.array((self.xx, self.yy, self.zz), block.inertia.dtype))
        return replace(block, inertia=block.inertia * (root[:, None] * root)), points
