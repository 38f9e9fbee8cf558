"""Eight points in place of four."""

import math
from dataclasses import dataclass, replace

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.feet import over_mean
from rockref.effects.prior import Prior
from rockref.model.errors import InputError
from rockref.model.geometry import EXTERNAL, INTERNAL
from rockref.model.problem import ContactPoints

#: Share of half the base's diagonal that a fit keeps inner points within (decided: at one they meet in the middle), and
#: within what is plausible, too, since steps of a search add up.
NEARLY = 0.9
FEET = (1, 2, 3, 4)
#: What is known of the height of a corner, and of the distance of an internal point over the mean of the four.
HEIGHT = Quantity("m", 0.0, -2e-4, 2e-4, None, "any", "", -0.01, 0.01)
DIAGONAL = Quantity("1", 1.0, 0.3, 3.0, 1.0, "any", "", POSITIVE)


@dataclass(frozen=True)
class FootDefects(Effect):
    """Gives every corner of the four-point model an internal neighbour and raises the corner itself: rule G2.

    The corners become the external points, raised by delta_long1..4; an internal point stands delta_diag further in on
    each diagonal, in the plane of the base. Of the factors `diag1` to `diag4`, by which the four distances differ, only
    the ratios count (decided: so a common factor cannot trade with delta_diag, their geometric mean). An internal point
    has its corner's properties, its friction times `mu_int` and its damping times `beta_int` (ratios internal over
    external: 1.2 and 0.83 give Table 3.1).
    """

    id = "foot_defects"
    question = "shape"
    quantities = {
        **{
            f"delta_long{i}": HEIGHT._replace(typical=typical, meaning=f"height of corner {i} above the base")
            for i, typical in enumerate((1.0e-5, 4.0e-5, 9.2e-5, 5.8e-5), 1)
        },
        "delta_diag": Quantity("m", 0.0, 0.0, 0.02, 6e-3, "+", "mean way from corner to inner point, diagonally", 0.0),
        "mu_int": Quantity("1", 1.0, 0.5, 2.0, 1.2, "any", "friction of internal over external points", 0.0),
        "beta_int": Quantity("1", 1.0, 0.5, 2.0, 0.15 / 0.18, "any", "damping of internal over external points", 0.0),
    }
    quantities |= {f"diag{i}": DIAGONAL._replace(meaning=f"way to internal point {i} over the mean") for i in FEET}
    switches = tuple(name for name in quantities if not name.startswith("diag"))
    only_on = "four_points"
    # Decided: what a worn or bent base rests on lies as unevenly as feet that are ground by hand, by a third.
    priors = {f"diag{i}": Prior("shape", spread=0.3) for i in FEET}
    priors["delta_diag"] = Prior(high=quantities["delta_diag"].high)
    anywhere = ("delta_long1", "delta_long2", "delta_long3", "delta_long4", "delta_diag")
    seeds = ({},)  # all typical: while inner points stand at their corners, no small step shows what they do
    sentence = "No base is flat: each foot touches at its outer corner and at an inner point, at different heights."
    equation = r"P_{int} = P_{ext} (1 - \delta_{diag} (s_i/\bar s)/\|P_{ext}\|)_{xy},\ z_{ext} = -h/2 + \delta_{long,i}"
    source = 'The model\'s source, "Defects", Fig. 3.2b and Table 3.1, with one distance for all feet: no DOI'
    confounder = "uneven_foot_stiffness"
    experiment = (
        "Measure the base with a feeler gauge or blue ink; turn the block by 180 degrees: the rattle turns, too."
    )

    delta_long1: float = 0.0
    delta_long2: float = 0.0
    delta_long3: float = 0.0
    delta_long4: float = 0.0
    delta_diag: float = 0.0
    mu_int: float = 1.0
    beta_int: float = 1.0
    diag1: float = 1.0
    diag2: float = 1.0
    diag3: float = 1.0
    diag4: float = 1.0

    @classmethod
    def largest_on(cls, name, width, depth):
        return NEARLY * math.hypot(width, depth) / 2 if name == "delta_diag" else math.inf

    def within(self, width, depth):
        """Return the effect with distances of the same ratios, the largest of which the base has room for."""
        most = self.largest_on("delta_diag", width, depth) / float(np.max(self.relative()))
        return self if self.delta_diag <= most else replace(self, delta_diag=most)

    def relative(self) -> np.ndarray:
        """Return distance of each internal point from its corner over their geometric mean, (4,)."""
        return over_mean((self.diag1, self.diag2, self.diag3, self.diag4))

    def points(self, block, points):
        if self.is_absent():
            return block, points
        if points.names != EXTERNAL:
            what = f"finds the contact points {', '.join(points.names)}"
            cure = 'It makes eight points of four: use a model with points = "four_points".'
            raise InputError("E-FEET", f"effect {self.id}", what, cure)
        outer = points.P.copy()
        outer[..., 2] += np.array([self.delta_long1, self.delta_long2, self.delta_long3, self.delta_long4])
        inner = further_in(points.P, self.delta_diag * self.relative().astype(points.P.dtype))
        ratios = dict(K_N=1.0, K_T=1.0, C_N=self.beta_int, C_T=self.beta_int, mu_0=self.mu_int, mu=self.mu_int)
        return block, both(points, np.concatenate([outer, inner], axis=-2), ratios)


def further_in(corners: np.ndarray, way: np.ndarray) -> np.ndarray:
    """Return points (..., 4, 3) that stand `way` (4,) [m] from the corners (..., 4, 3), along the diagonals.

    Raises InputError (E-RANGE) where one would come to the middle or beyond.
    """
    x, y = corners[..., 0], corners[..., 1]
    diagonal = np.sqrt(x * x + y * y)
    if np.any(way >= diagonal):
        what, cure = f"is {float(way.max())!r} m, half the base", "Give a distance from the corner in metres."
        raise InputError("E-RANGE", f"effect {FootDefects.id} delta_diag", what, cure)
    inner = corners.copy()
    inner[..., :2] *= (1 - way / diagonal)[..., None]
    return inner


def both(points: ContactPoints, P: np.ndarray, ratios: dict[str, float]) -> ContactPoints:
    """Return corners and internal points at P (..., 8, 3) [m]; these have the corners' properties times the ratios."""

    def doubled(a, ratio=1.0):
        return np.concatenate([a, a * ratio], axis=-1)

    return replace(
        points,
        P=P,
        radius=None if points.radius is None else doubled(points.radius),
        names=EXTERNAL + INTERNAL,
        **{key: doubled(getattr(points, key), ratio) for key, ratio in ratios.items()},
    )
