"""The source's answer."""

from dataclasses import dataclass

from rockref.effects.base import Effect


@dataclass(frozen=True)
class NoContactEffect(Effect):
    """Nothing added to the normal contact."""

    question = "contact"
    sentence = (
        "Spring and damper in parallel at every point, without tension, all springs alike (rules N1, N2, P1 to P3)."
    )
    equation = r"F^{(N)} = \max(K^{(N)}\xi + C^{(N)}\dot\xi,\ 0)"
    source = "The model's source, (3.5), (3.7) to (3.9)"
