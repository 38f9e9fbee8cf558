"""Sides that are not as stated."""

from dataclasses import dataclass, replace

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.prior import Prior


@dataclass(frozen=True)
class DimensionDeviation(Effect):
    """Scales the contact points along X, Y, Z by width, depth, height, and the inertia with them; the mass is kept.

    The second moments of mass scale with the square of each side: for a cuboid that is the cuboid formula (G1) with the
    new sides. `inertia_share` is the share of each side's deviation that the mass follows: 1, the body is as large as
    its feet say; 0, only the feet stand elsewhere, as on worn edges.
    """

    id = "dimension_deviation"
    question = "shape"
    quantities = {
        side: Quantity("1", 1.0, 0.98, 1.02, 1.005, "any", f"true {side} over the stated one", POSITIVE)
        for side in ("width", "depth", "height")
    } | {"inertia_share": Quantity("1", 1.0, 0.0, 1.0, 1.0, "any", "of a deviation, in the inertia", 0.0, 1.0)}
    switches = ("width", "depth", "height")
    # Between two laws: from half way, flat within what is possible (decided).
    priors = {"inertia_share": Prior("shape", "linear", centre=0.5, spread=0.5, deviation=2.0)}
    sentence = "A rounded or worn edge, or a wrong drawing: the feet stand closer together than the sides say."
    equation = (
        r"P \to \mathrm{diag}(s_b, s_d, s_h)\,P,\quad "
        r"J(b, d, h) \to J(s'_b b, s'_d d, s'_h h),\quad s' = 1 + \eta (s - 1)"
    )
    source = "The model's source, Fig. 3.2 (what the sides enter: rules G1 and G2); a definition: no DOI"
    confounder = "inertia_deviation"
    experiment = (
        "Measure the sides with a calliper; tip the block slowly until it balances: that angle knows no inertia."
    )

    width: float = 1.0
    depth: float = 1.0
    height: float = 1.0
    inertia_share: float = 1.0

    def points(self, block, points):
        if self.is_absent():
            return block, points
        scale = np.array((self.width, self.depth, self.height), points.P.dtype)
        identity = np.eye(3, dtype=points.P.dtype)
        J = block.inertia
        moments = np.trace(J, axis1=-2, axis2=-1)[..., None, None] / 2 * identity - J
        own = 1 + points.P.dtype.type(self.inertia_share) * (scale - 1)
        moments = moments * (own[:, None] * own)
        J = np.trace(moments, axis1=-2, axis2=-1)[..., None, None] * identity - moments
        return replace(block, inertia=J), replace(points, P=points.P * scale)
