"""Tags that are not glued where the drawing has them."""

from dataclasses import dataclass

from rockref.effects.base import Effect, Quantity


@dataclass(frozen=True)
class TagFrame(Effect):
    """The body lies at (x, y, z) from the tracked point, in body axes, and is turned against the tracked axes.

    Lambda = Lambda_t exp(turn^), x = x_t + Lambda (x, y, z). It changes no force: it is applied where measured poses
    become poses of the body, and back.
    """

    id = "tag_frame"
    question = "tracking"
    quantities = {
        axis: Quantity("m", 0.0, -3e-3, 3e-3, 5e-4, "any", f"body from the tracked point along {axis}", -0.1, 0.1)
        for axis in ("x", "y", "z")
    } | {
        f"turn_{axis}": Quantity("rad", 0.0, -0.02, 0.02, 4e-3, "any", f"body from tag axes about {axis}", -0.5, 0.5)
        for axis in ("x", "y", "z")
    }  # fmt: skip
    sentence = "Tags are glued by hand and calibrated from pictures: their frame is not quite that of the faces."
    equation = r"\Lambda = \Lambda_t\,e^{\hat\varphi},\quad x = x_t + \Lambda\,d"
    source = (
        "B. Pfrommer, K. Daniilidis (2019), TagSLAM: Robust SLAM with fiducial markers, arXiv:1910.00679 "
        "(how body poses come from tags)"
    )
    confounder = "mass_eccentricity"
    experiment = "Lay the body on each of its faces on a level plate: the tracked tilt and height then show the frame."

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    turn_x: float = 0.0
    turn_y: float = 0.0
    turn_z: float = 0.0
