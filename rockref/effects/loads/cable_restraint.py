"""The sensor's cable."""

from dataclasses import dataclass

from rockref.effects.base import Effect, Quantity
from rockref.effects.loads.attachment import arm, half_height, velocity_at
from rockref.model.rotation import cross


@dataclass(frozen=True)
class CableRestraint(Effect):
    """A horizontal spring and damper from the body point (0, 0, height) to where that point stands at the start.

    Decided: the cable hangs slack at release, and holds the block back from there. Without `height` it is fixed at the
    top, as far above the centre of mass as the base is below. Simplified: no weight of the cable, no vertical part, no
    friction inside it.
    """

    id = "cable_restraint"
    question = "loads"
    quantities = {
        "k": Quantity("N/m", 0.0, 0.05, 20.0, 5.0, "+", "stiffness of the cable", 0.0),
        "c": Quantity("N s/m", 0.0, 0.01, 2.0, 0.3, "+", "damping of the cable", 0.0),
        "height": Quantity("m", None, 0.0, 0.5, None, "any", "of the attachment, above the centre of mass"),
    }
    switches = ("k", "c")
    sentence = "The cable to the sensor is slack at release; then it pulls the top back to where it was, and damps it."
    equation = r"F_{xy} = -k\,(p_{xy} - p_{xy}(0)) - c\,\dot p_{xy},\quad p = x + \Lambda\,(0,0,z_c)"
    source = "Linear spring and damper, as in any textbook of vibrations: no DOI"
    not_shaken = "hangs from the room, so needs the place and the velocity of the plate too"
    confounder = "quadratic_drag"
    experiment = "Take the cable off (a logger on the block), or lead it another way: only this effect changes."

    k: float = 0.0
    c: float = 0.0
    height: float | None = None

    def attachment(self, problem, Lambda):
        """Return way from the centre of mass to the attachment, plate axes, (..., 3) [m]."""
        return arm(Lambda, half_height(problem.points) if self.height is None else self.height)

    def start(self, problem):
        return {"anchor": problem.start.x + self.attachment(problem, problem.start.Lambda)}

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        if self.is_absent():
            return None
        r = self.attachment(problem, Lambda)
        F = -self.k * (x + r - m["anchor"]) - self.c * velocity_at(r, Lambda, v, W)
        F[..., 2] = 0
        return F, cross(r, F)
