"""Eight points in place of four."""

import math
from dataclasses import dataclass, replace

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.effects.prior import Prior
from rockref.model.errors import InputError
from rockref.model.geometry import EXTERNAL, INTERNAL

#: Share of half the base's diagonal that a fit keeps inner points within (decided: at one they meet in the middle), and
#: within what is plausible, too, since steps of a search add up.
NEARLY = 0.9


@dataclass(frozen=True)
class FootDefects(Effect):
    """Gives every corner of the four-point model an internal neighbour and raises the corner itself: rule G2.

    The corners become the external points, raised by delta_long1..4; an internal point stands delta_diag further in on
    each diagonal, in the plane of the base. It has its corner's properties, its friction times `mu_int` and its damping
    times `beta_int` (ratios internal over external: 1.2 and 0.83 give Table 3.1).
    """

    id = "foot_defects"
    question = "shape"
    quantities = {
        **{
            f"delta_long{i}": Quantity(
                "m", 0.0, -2e-4, 2e-4, typical, "any", f"height of corner {i} above the base", -0.01, 0.01
            )
            for i, typical in enumerate((1.0e-5, 4.0e-5, 9.2e-5, 5.8e-5), 1)
        },
        "delta_diag": Quantity(
            "m", 0.0, 0.0, 0.02, 6e-3, "+", "way from the corner to the internal point, along the diagonal", 0.0
        ),
        "mu_int": Quantity("1", 1.0, 0.5, 2.0, 1.2, "any", "friction of internal over external points", 0.0),
        "beta_int": Quantity("1", 1.0, 0.5, 2.0, 0.15 / 0.18, "any", "damping of internal over external points", 0.0),
    }
    only_on = "four_points"
    priors = {"delta_diag": Prior(high=quantities["delta_diag"].high)}
    anywhere = ("delta_long1", "delta_long2", "delta_long3", "delta_long4", "delta_diag")
    seeds = ({},)  # all typical: while inner points stand at their corners, no small step shows what they do
    sentence = "No base is flat: each foot touches at its outer corner and at an inner point, at different heights."
    equation = r"P_{int} = P_{corner}\,(1 - \delta_{diag}/\|P_{corner}\|)_{xy},\quad z_{ext} = -h/2 + \delta_{long,i}"
    source = 'The model\'s source, "Defects", Fig. 3.2b and Table 3.1; the model itself: no DOI'
    confounder = "uneven_foot_stiffness"
    experiment = (
        "Measure the base with a feeler gauge or blue ink; turn the block by 180 degrees: the rattle turns with it."
    )

    delta_long1: float = 0.0
    delta_long2: float = 0.0
    delta_long3: float = 0.0
    delta_long4: float = 0.0
    delta_diag: float = 0.0
    mu_int: float = 1.0
    beta_int: float = 1.0

    @classmethod
    def largest_on(cls, name, width, depth):
        return NEARLY * math.hypot(width, depth) / 2 if name == "delta_diag" else math.inf

    def points(self, block, points):
        if self.is_absent():
            return block, points
        if points.names != EXTERNAL:
            what = f"finds the contact points {', '.join(points.names)}"
            cure = 'It makes eight points of four: use a model with points = "four_points".'
            raise InputError("E-FEET", f"effect {self.id}", what, cure)
        outer, inner = points.P.copy(), points.P.copy()
        outer[..., 2] += np.array([self.delta_long1, self.delta_long2, self.delta_long3, self.delta_long4])
        diagonal = np.sqrt(inner[..., 0:1] * inner[..., 0:1] + inner[..., 1:2] * inner[..., 1:2])
        if np.any(self.delta_diag >= diagonal):
            what, cure = f"is {self.delta_diag!r} m, half the base", "Give a distance from the corner in metres."
            raise InputError("E-RANGE", f"effect {self.id} delta_diag", what, cure)
        inner[..., :2] *= 1 - self.delta_diag / diagonal

        def both(a, ratio=1.0):
            return np.concatenate([a, a * ratio], axis=-1)

        ratios = dict(K_N=1.0, K_T=1.0, C_N=self.beta_int, C_T=self.beta_int, mu_0=self.mu_int, mu=self.mu_int)
        return block, replace(
            points,
            P=np.concatenate([outer, inner], axis=-2),
            radius=None if points.radius is None else both(points.radius),
            names=EXTERNAL + INTERNAL,
            **{key: both(getattr(points, key), ratio) for key, ratio in ratios.items()},
        )
