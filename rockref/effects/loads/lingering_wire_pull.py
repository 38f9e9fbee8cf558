"""A wire that lets go slowly."""

import math
from dataclasses import dataclass

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.loads.attachment import arm, half_height
from rockref.effects.prior import Prior
from rockref.model.rotation import cross

#: Evenness up to which the pull is the exponential. Decided: there both are wrong by some 1e-8 of it, the power by
#: rounding, 1e-16 over the evenness, the exponential by the evenness itself.
LEAST_EVENNESS = 1e-8


@dataclass(frozen=True)
class LingeringWirePull(Effect):
    """A horizontal force at the top toward the side of the lean at release, +y of the laboratory, that dies away.

    The law releases toward +y, turned block or not. The pull falls at the rate F_w/tau (F/F_w)^(1 - evenness): what
    creeps lets go in proportion to what still holds (`evenness` 0, an exponential), what is paid out or burns through
    lets go at a steady rate, and is gone after tau (`evenness` 1). Simplified: from t = 0, in a fixed direction.
    """

    id = "lingering_wire_pull"
    question = "loads"
    quantities = {
        "force": Quantity("N", 0.0, 0.1, 10.0, 3.0, "+", "pull at release", 0.0),
        "tau": Quantity("s", 0.1, 0.01, 1.0, 0.3, "+", "time in which the pull would end at its first rate", POSITIVE),
        "evenness": Quantity("1", 0.0, 0.0, 1.0, 0.0, "any", "0: it falls to 1/e in tau; 1: evenly", 0.0, 1.0),
    }
    switches = ("force",)
    priors = {"tau": Prior("shape"), "evenness": Prior("form")}
    sentence = "A latch that sticks or a wire that burns through holds the block back for a moment after release."
    equation = (
        r"F_y = F_w \max(1 - q\,t/\tau,\ 0)^{1/q} \to F_w\,e^{-t/\tau}\ (q \to 0)\ \text{at}\ x + \Lambda(0,0,h/2)"
    )
    source = "A load decided here: no DOI; the release by a wire is in the model's source, section 3.3"
    not_shaken = "is pulled from the room, towards which the plate moves"
    confounder = "release_velocity"
    experiment = (
        "Film the release: with this the block begins at rest, and its acceleration grows as the pull dies away; with "
        "a velocity it moves from the first picture on. Or cut the wire in another way: only this one changes."
    )

    force: float = 0.0
    tau: float = 0.1
    evenness: float = 0.0

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        if self.is_absent():
            return None
        r = arm(Lambda, half_height(problem.points))
        F = np.zeros_like(x)
        F[..., 1] = self.force * self.left(c.t)
        return F, cross(r, F)

    def left(self, t):
        """Return what is left of the pull at time t (...) s, as a share."""
        if self.evenness > LEAST_EVENNESS:
            return np.maximum(1.0 - self.evenness * t / self.tau, 0.0) ** (1.0 / self.evenness)
        # math's exp for one time, so that a run keeps its bits; windows of a fit have a time each.
        return (np.exp if np.ndim(t) else math.exp)(-t / self.tau)
