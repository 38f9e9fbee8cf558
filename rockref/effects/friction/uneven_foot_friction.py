"""Feet of different friction."""

from dataclasses import dataclass, replace

from rockref.effects.base import Effect, Quantity
from rockref.effects.feet import of_foot
from rockref.effects.prior import Prior


@dataclass(frozen=True)
class UnevenFootFriction(Effect):
    """Scales mu_0 and mu of the points of each foot.

    Source: one of the scenarios that the model's authors tried before the eight points ("Defects").
    """

    id = "uneven_foot_friction"
    question = "friction"
    quantities = {
        f"foot{i}": Quantity("1", 1.0, 0.4, 2.5, typical, "any", f"friction of foot {i} over the common one", 0.0)
        for i, typical in enumerate((0.7, 1.3, 0.85, 1.15), 1)
    }
    by_ratio = ("foot1", "foot2", "foot3", "foot4")
    # Decided: between feet of one block a third.
    priors = {f"foot{i}": Prior(scale="log", spread=0.3) for i in (1, 2, 3, 4)}
    sentence = "A foot that is polished, worn or oily holds less than its neighbours."
    equation = r"\mu_i \to s_i\,\mu_i"
    source = 'The model\'s source, "Defects"; a share of the common friction is a definition: no DOI'
    confounder = "uneven_foot_stiffness"
    experiment = (
        "Pull the standing block slowly by each foot, then clean that foot: the pull at which it slides changes, the "
        "pitch of a tap above it, which follows the stiffness, does not."
    )

    foot1: float = 1.0
    foot2: float = 1.0
    foot3: float = 1.0
    foot4: float = 1.0

    def points(self, block, points):
        if self.is_absent():
            return block, points
        scale = of_foot(points, (self.foot1, self.foot2, self.foot3, self.foot4), self.id)
        return block, replace(points, mu_0=points.mu_0 * scale, mu=points.mu * scale)
