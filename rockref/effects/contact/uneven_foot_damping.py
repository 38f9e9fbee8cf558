"""Feet of different damping."""

from dataclasses import dataclass, replace

from rockref.effects.base import Effect, Quantity
from rockref.effects.feet import of_foot
from rockref.effects.prior import Prior


@dataclass(frozen=True)
class UnevenFootDamping(Effect):
    """Scales C_N of the points of each foot; C_T goes along, less by a power.

    A film of oil under a foot damps both ways: `normal_share` 0. A shim that is squeezed and not sheared damps across
    the plate alone: `normal_share` 1.

    Source: one of the scenarios that the model's authors tried before the eight points ("Defects").
    """

    id = "uneven_foot_damping"
    question = "contact"
    quantities = {
        f"foot{i}": Quantity("1", 1.0, 0.2, 5.0, typical, "any", f"damping of foot {i} over the common one", 0.0)
        for i, typical in enumerate((0.5, 2.0, 0.6, 1.6), 1)
    } | {"normal_share": Quantity("1", 0.0, 0.0, 1.0, 0.0, "any", "power by which C_T stays behind", 0.0, 1.0)}
    switches = ("foot1", "foot2", "foot3", "foot4")
    by_ratio = ("foot1", "foot2", "foot3", "foot4")
    # Decided: between feet of one block a factor of one and a half.
    priors = {f"foot{i}": Prior(scale="log", spread=0.4) for i in (1, 2, 3, 4)} | {"normal_share": Prior("form")}
    sentence = "Feet lose different shares of an impact: one on bare steel, another on a film of oil or a shim."
    equation = r"C^{(N)}_i \to s_i C^{(N)}_i,\quad C^{(T)}_i \to s_i^{1 - \eta} C^{(T)}_i"
    source = 'The model\'s source, "Defects", (3.8); a share of the common damping is a definition: no DOI'
    confounder = "uneven_foot_stiffness"
    experiment = (
        "Tap the standing block above each foot: uneven dampers let the ringing die at each foot's own rate, uneven "
        "stiffness gives each foot its own pitch."
    )

    foot1: float = 1.0
    foot2: float = 1.0
    foot3: float = 1.0
    foot4: float = 1.0
    normal_share: float = 0.0

    def points(self, block, points):
        if self.is_absent():
            return block, points
        scale = of_foot(points, (self.foot1, self.foot2, self.foot3, self.foot4), self.id)
        return block, replace(points, C_N=points.C_N * scale, C_T=points.C_T * scale ** (1 - self.normal_share))
