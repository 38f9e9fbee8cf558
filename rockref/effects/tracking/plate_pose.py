"""A plate that is not where the camera's board is."""

from dataclasses import dataclass

from rockref.effects.base import Effect, Quantity


@dataclass(frozen=True)
class PlatePose(Effect):
    """The plate is z = height + slope_x x + slope_y y in the frame of the throw: board axes, turned about e_z so that
    the block is thrown toward -x.

    Gravity stays along the plate's normal (its direction is `plate_tilt`). It changes no force: it is applied where
    measured poses become poses over the plate, and back. The frame of the throw is used because a recording's heading
    may be arbitrary; who throws from one place of the laboratory keeps it.
    """

    id = "plate_pose"
    question = "tracking"
    quantities = {
        "height": Quantity("m", 0.0, -5e-3, 5e-3, 1e-3, "any", "plate above the board's origin", -0.5, 0.5),
        "slope_x": Quantity("1", 0.0, -0.02, 0.02, 4e-3, "any", "rise of the plate against the throw", -0.5, 0.5),
        "slope_y": Quantity("1", 0.0, -0.02, 0.02, 4e-3, "any", "rise of the plate to the throw's right", -0.5, 0.5),
    }  # fmt: skip
    sentence = "The board that defines the camera's axes does not lie in the surface on which the block lands."
    equation = r"z_p = h + s_x x + s_y y"
    source = (
        "B. Pfrommer, K. Daniilidis (2019), TagSLAM: Robust SLAM with fiducial markers, arXiv:1910.00679 "
        "(the board's frame)"
    )
    confounder = "dimension_deviation"
    experiment = "Lay the block on its faces at several places of the plate and fit a plane through its centres."

    height: float = 0.0
    slope_x: float = 0.0
    slope_y: float = 0.0
