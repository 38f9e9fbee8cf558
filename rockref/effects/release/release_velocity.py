"""A release with a push."""

from dataclasses import dataclass, replace

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.model.rotation import apply, apply_to_points, cross


@dataclass(frozen=True)
class ReleaseVelocity(Effect):
    """The crv at release is (x, y, z); the centre of mass moves as if the block turned about the middle of its pivots.

    The pivots are the lowest point with body x > 0 and the lowest with x < 0, as in the release posture.
    """

    id = "release_velocity"
    question = "release"
    quantities = {
        axis: Quantity(
            "rad/s", 0.0, -0.1, 0.1, typical, "any", f"crv about body {axis.upper()} at release", -10.0, 10.0
        )
        for axis, typical in (("x", 0.02), ("y", 0.01), ("z", 0.02))
    }
    sentence = "A wire that snaps or a hand that steadies leaves the block turning when it is let go."
    equation = r"W(0) = (x, y, z),\quad v(0) = -\omega \times r_{pivot}"
    source = "Kinematics of a turning body, as in any textbook of mechanics: no DOI"
    confounder = "lingering_wire_pull"
    experiment = (
        "Film the release: with this the block moves from the first picture on, and then as the law says; a wire that "
        "still pulls lets it begin at rest and bends the acceleration after it."
    )

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0

    def release(self, block, points, state):
        if self.is_absent():
            return state
        r = apply_to_points(state.Lambda, points.P)
        sides = [np.flatnonzero(points.P[:, 0] * sign > 0) for sign in (1, -1)]
        pivots = [side[np.argmin(r[side, 2])] for side in sides if len(side)]
        middle = np.mean(r[pivots], axis=0) if pivots else np.zeros(3, r.dtype)
        W = np.array((self.x, self.y, self.z), state.W.dtype)
        return replace(state, W=state.W + W, v=state.v - cross(apply(state.Lambda, W), middle))
