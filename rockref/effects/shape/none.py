"""The source's answer."""

from dataclasses import dataclass

from rockref.effects.base import Effect


@dataclass(frozen=True)
class NoShapeEffect(Effect):
    """Nothing changed in shape and mass."""

    question = "shape"
    sentence = "A uniform cuboid on point feet, centre of mass in the middle, plate normal everywhere (rules G1, G2)."
    equation = r"J = \frac{m}{12}\,\mathrm{diag}(d^2+h^2,\ b^2+h^2,\ b^2+d^2)"
    source = 'The model\'s source, "Defects", Fig. 3.2b'
