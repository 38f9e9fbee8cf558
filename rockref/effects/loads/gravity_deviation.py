"""A weight that is not the stated one."""

from dataclasses import dataclass, replace

from rockref.effects.base import POSITIVE, Effect, Quantity


@dataclass(frozen=True)
class GravityDeviation(Effect):
    """Scales g: gravity, buoyancy and added air, but also lengths or frame times that are not what they are said to be.

    In free flight a length scale s_l and a time scale s_t show as g s_l / s_t^2 and as nothing else.
    """

    id = "gravity_deviation"
    question = "loads"
    quantities = {
        "scale": Quantity("1", 1.0, 0.9, 1.1, 0.98, "any", "acceleration of free fall over g", POSITIVE, 10.0)
    }
    sentence = "What falls through the camera's picture does not gain g: scale, clock and air are in the number."
    equation = r"g \to s\,g"
    source = "G. K. Batchelor (1967), An Introduction to Fluid Dynamics, doi:10.1017/CBO9780511800955 (added mass)"
    confounder = "dimension_deviation"
    experiment = "Throw a steel ball through the same picture and fit its parabola."

    scale: float = 1.0

    def points(self, block, points):
        return replace(block, g=block.g * self.scale), points
