"""A pull toward the plate."""

from dataclasses import dataclass, replace

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.prior import Prior
from rockref.model import assembly


@dataclass(frozen=True)
class Adhesion(Effect):
    """A constant pull on every touching point that fades linearly to zero over `range` above the plate.

    Simplified: one force per point in place of a surface energy; friction sees the compressive force only, so the
    pull presses the point deeper and raises the threshold by that alone. The pull depends on the height only: what it
    takes at lift-off it gives back at landing. At release the pivot points stand deeper by force / K_N.
    """

    id = "adhesion"
    question = "contact"
    quantities = {
        "force": Quantity("N", 0.0, 0.5, 200.0, 50.0, "+", "pull on a touching point", 0.0),
        "range": Quantity("m", 2e-5, 5e-6, 1e-4, 2e-5, "+", "height at which the pull has faded", POSITIVE),
    }
    switches = ("force",)
    priors = {"range": Prior("shape")}
    # A small pull changes when a foot lifts off, a larger one whether it does. Decided: 0.3 to 1.4 typical ones.
    seeds = ({"force": 15.0}, {"force": 35.0}, {"force": 70.0})
    not_with_block = ("range",)  # that of the film
    sentence = "Magnetism, an oil film or clean metal hold the feet down until they are some micrometres off the plate."
    equation = r"F_z = -F_a\,\mathrm{clip}(1 + \xi/d_a,\ 0,\ 1)"
    source = (
        "B. V. Derjaguin, V. M. Muller, Y. P. Toporov (1975), J. Colloid Interface Sci. 53:314-326, "
        "doi:10.1016/0021-9797(75)90018-1 (pull of the surface outside the contact; here with a linear fade)"
    )
    confounder = "uneven_contact_normals"
    experiment = "Demagnetise and degrease feet and plate, then oil them on purpose: only adhesion changes."

    force: float = 0.0
    range: float = 2e-5

    def release(self, block, points, state):
        if self.is_absent():
            return state
        x = state.x.copy()
        x[..., 2] -= np.mean(self.force / points.K_N)
        return replace(state, x=x)

    def pull(self, xi):
        """Return size of the pull at penetration xi [m], same shape [N]."""
        return self.force * np.clip(1 + xi / self.range, 0, 1)

    def point_wrench(self, problem, c, m):
        if self.is_absent():
            return None
        F = np.zeros_like(c.F)
        F[..., 2] = -self.pull(c.k.xi)
        return assembly.sum_over_points(F), assembly.resultant_moment(c.k.r, F)
