"""The source's answer."""

from dataclasses import dataclass

from rockref.effects.base import Effect


@dataclass(frozen=True)
class NoLoad(Effect):
    """No further load."""

    question = "loads"
    sentence = "The weight alone, along e_z (rule A1)."
    equation = r"F = \sum_i F_i - m g\,e_z"
    source = "The model's source, section 3.3"
