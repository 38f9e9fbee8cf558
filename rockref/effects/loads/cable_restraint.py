"""The sensor's cable."""

from dataclasses import dataclass

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.loads.attachment import arm, half_height, velocity_at
from rockref.effects.prior import Prior
from rockref.model.rotation import cross


@dataclass(frozen=True)
class CableRestraint(Effect):
    """A horizontal spring and damper from the body point (0, 0, height) to where that point stands at the start.

    Decided: the cable hangs slack at release, and holds the block back from there. Without `height` it is fixed at the
    top, as far above the centre of mass as the base is below. A cable that straightens stiffens: of its stiffness the
    share `stiffening` grows with the square of the way, and is whole at `reference` (decided: the way of the top of the
    source's block released at 0.12 rad). Simplified: no weight, no vertical part, no friction inside the cable.
    """

    id = "cable_restraint"
    question = "loads"
    quantities = {
        "k": Quantity("N/m", 0.0, 0.05, 20.0, 5.0, "+", "stiffness of the cable", 0.0),
        "c": Quantity("N s/m", 0.0, 0.01, 2.0, 0.3, "+", "damping of the cable", 0.0),
        "height": Quantity("m", None, 0.0, 0.5, None, "any", "of the attachment, above the centre of mass"),
        "stiffening": Quantity("1", 0.0, 0.0, 1.0, 0.0, "any", "share of k that grows with the way squared", 0.0, 1.0),
        "reference": Quantity("m", 0.08, 0.01, 0.5, 0.08, "+", "way at which the stiffness is k", POSITIVE),
    }
    switches = ("k", "c")
    priors = {"stiffening": Prior("form")}
    sentence = "The cable to the sensor is slack at release; then it pulls the top back to where it was, and damps it."
    equation = (
        r"F_{xy} = -k\left(1 - q + q\,o^2/o_0^2\right) o - c\,\dot p_{xy},\quad "
        r"o = p_{xy} - p_{xy}(0),\quad p = x + \Lambda\,(0,0,z_c)"
    )
    source = "Spring, linear or Duffing's, and damper, as in any textbook of vibrations: no DOI"
    not_shaken = "hangs from the room, so needs the place and the velocity of the plate too"
    confounder = "quadratic_drag"
    experiment = "Take the cable off (a logger on the block), or lead it another way: only this effect changes."

    k: float = 0.0
    c: float = 0.0
    height: float | None = None
    stiffening: float = 0.0
    reference: float = 0.08

    def attachment(self, problem, Lambda):
        """Return way from the centre of mass to the attachment, plate axes, (..., 3) [m]."""
        return arm(Lambda, half_height(problem.points) if self.height is None else self.height)

    def stiffnesses(self):
        """Return stiffness at no way [N/m], and its growth with the square of the way [N/m3]."""
        return self.k * (1 - self.stiffening), self.k * self.stiffening / self.reference / self.reference

    def start(self, problem):
        return {"anchor": problem.start.x + self.attachment(problem, problem.start.Lambda)}

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        if self.is_absent():
            return None
        r = self.attachment(problem, Lambda)
        o, (k, growth) = x + r - m["anchor"], self.stiffnesses()
        k = k + growth * (o[..., 0] * o[..., 0] + o[..., 1] * o[..., 1])
        F = -k[..., None] * o - self.c * velocity_at(r, Lambda, v, W)
        F[..., 2] = 0
        return F, cross(r, F)
