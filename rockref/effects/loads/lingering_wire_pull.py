"""A wire that lets go slowly."""

import math
from dataclasses import dataclass

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.loads.attachment import arm, half_height
from rockref.model.rotation import cross


@dataclass(frozen=True)
class LingeringWirePull(Effect):
    """A horizontal force at the top toward the side of the lean at release, +y of the laboratory, that dies away.

    The law releases toward +y, turned block or not. Simplified: an exponential decay from t = 0 in a fixed direction.
    """

    id = "lingering_wire_pull"
    question = "loads"
    quantities = {
        "force": Quantity("N", 0.0, 0.1, 10.0, 3.0, "+", "pull at release", 0.0),
        "tau": Quantity("s", 0.1, 0.01, 1.0, 0.3, "+", "time in which the pull falls to 1/e", POSITIVE),
    }
    switches = ("force",)
    sentence = "A latch that sticks or a wire that burns through holds the block back for a moment after release."
    equation = r"F_y = F_w\,e^{-t/\tau}\ \text{at}\ x + \Lambda(0,0,h/2)"
    source = "A load decided here: no DOI; the release by a wire is in the model's source, section 3.3"
    confounder = "release_velocity"
    experiment = (
        "Film the release: with this the block begins at rest, and its acceleration grows as the pull dies away; with "
        "a velocity it moves from the first picture on. Or cut the wire in another way: only this one changes."
    )

    force: float = 0.0
    tau: float = 0.1

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        if self.is_absent():
            return None
        r = arm(Lambda, half_height(problem.points))
        F = np.zeros_like(x)
        # math's exp for one time, so that a run keeps its bits; windows of a fit have a time each.
        F[..., 1] = self.force * (np.exp if np.ndim(c.t) else math.exp)(-c.t / self.tau)
        return F, cross(r, F)
