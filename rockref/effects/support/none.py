"""The source's answer."""

from dataclasses import dataclass

from rockref.effects.base import Effect


@dataclass(frozen=True)
class RigidSupport(Effect):
    """The plate does not move."""

    question = "support"
    sentence = "The plate is fixed (rule K1: penetration is -z)."
    equation = r"\xi = -z"
    source = 'The model\'s source, "Contact non-linearities"'
