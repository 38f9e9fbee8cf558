"""A drag on sliding feet."""

from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.model import assembly


@dataclass(frozen=True)
class ViscousFriction(Effect):
    """A further tangential force -c v_slide on every touching point, outside Coulomb's cone."""

    id = "viscous_friction"
    question = "friction"
    quantities = {"c": Quantity("N s/m", 0.0, 50.0, 5000.0, 1000.0, "+", "force over sliding speed, each point", 0.0)}
    sentence = "A lubricating film between foot and plate shears, with a force in proportion to the sliding speed."
    equation = r"F^{(T)} \to F^{(T)} - c\,v_s \quad (\xi \geq 0)"
    source = (
        "B. Armstrong-Helouvry, P. Dupont, C. Canudas de Wit (1994), Automatica 30:1083-1138, "
        "doi:10.1016/0005-1098(94)90209-7"
    )
    confounder = "stribeck_friction"
    experiment = (
        "Dry the plate, then oil it: this one needs the film. Releases of different size: its loss follows speed."
    )

    c: float = 0.0

    def point_wrench(self, problem, c, m):
        if self.is_absent():
            return None
        F = np.zeros_like(c.F)
        F[..., :2] = np.where(c.touching[..., None], -self.c * c.k.v_slide, 0)
        return assembly.sum_over_points(F), assembly.resultant_moment(c.k.r, F)
