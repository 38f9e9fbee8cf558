"""The source's answer."""

from dataclasses import dataclass

from rockref.effects.base import Effect


@dataclass(frozen=True)
class NoFrictionEffect(Effect):
    """Nothing added to friction."""

    question = "friction"
    sentence = (
        "Coulomb's cone with a stick spring and damper, radial return, no resistance to turning (rules T1 to T6)."
    )
    equation = r"\|F^{(T)}\| \leq \mu F^{(N)}"
    source = "The model's source, (3.6)"
