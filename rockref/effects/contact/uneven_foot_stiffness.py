"""Feet of different stiffness."""

from dataclasses import dataclass, replace

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.feet import of_foot
from rockref.effects.prior import Prior


@dataclass(frozen=True)
class UnevenFootStiffness(Effect):
    """Scales K_N of the points of each foot; K_T goes along by a power, the dampers stay at the unscaled value.

    A softer spot under a foot yields to the load and holds the foot sideways as before: `tangential_share` 0. Of a foot
    with a smaller face both springs are softer by the same factor, as in Mindlin's contact, where their ratio knows no
    size: `tangential_share` 1.

    Source: one of the scenarios that the model's authors tried before the eight points ("Defects").
    """

    id = "uneven_foot_stiffness"
    question = "contact"
    quantities = {
        f"foot{i}": Quantity("1", 1.0, 0.3, 3.0, typical, "any", f"stiffness of foot {i} over the common one", POSITIVE)
        for i, typical in enumerate((0.6, 1.4, 0.8, 1.2), 1)
    } | {"tangential_share": Quantity("1", 0.0, 0.0, 1.0, 0.0, "any", "power by which K_T goes along", 0.0, 1.0)}
    switches = ("foot1", "foot2", "foot3", "foot4")
    by_ratio = ("foot1", "foot2", "foot3", "foot4")
    # Decided: between feet of one block a factor of one and a half.
    priors = {f"foot{i}": Prior(scale="log", spread=0.4) for i in (1, 2, 3, 4)} | {"tangential_share": Prior("form")}
    sentence = "A foot on a softer spot, or with a smaller face, yields more under the same load."
    equation = r"K^{(N)}_i \to s_i K^{(N)}_i,\quad K^{(T)}_i \to s_i^{\eta} K^{(T)}_i"
    source = (
        'The model\'s source, "Defects"; K. L. Johnson (1985), Contact Mechanics, doi:10.1017/CBO9781139171731; R. D. '
        "Mindlin (1949), Compliance of elastic bodies in contact, doi:10.1115/1.4009973"
    )
    confounder = "uneven_foot_friction"
    experiment = (
        "Tap the standing block above each foot: the pitch of the contact follows the stiffness and knows no friction. "
        "Pull it slowly by each foot: the pull at which it slides follows the friction."
    )

    foot1: float = 1.0
    foot2: float = 1.0
    foot3: float = 1.0
    foot4: float = 1.0
    tangential_share: float = 0.0

    def points(self, block, points):
        if self.is_absent():
            return block, points
        scale = of_foot(points, (self.foot1, self.foot2, self.foot3, self.foot4), self.id)
        return block, replace(points, K_N=points.K_N * scale, K_T=points.K_T * scale**self.tangential_share)
