"""The source's answer."""

from dataclasses import dataclass

from rockref.effects.base import Effect


@dataclass(frozen=True)
class IdealGyroscope(Effect):
    """The gyroscope shows the crv."""

    question = "sensor"
    sentence = "What is measured is the crv, along the block's axes (rule M1)."
    equation = r"W_m = W"
    source = "The model's source, Fig. 3.4"
