"""The law's answer."""

from dataclasses import dataclass

from rockref.effects.base import Effect


@dataclass(frozen=True)
class ReleaseAtRest(Effect):
    """The block starts at rest."""

    question = "release"
    sentence = "At rest, in equilibrium with the wire, both pivot points touching with half the weight each (decided)."
    equation = r"v = 0,\quad W = 0"
    source = "The model's source says only that the block is released by a wire"
