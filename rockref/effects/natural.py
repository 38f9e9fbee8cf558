"""Natural units of a block: what the typical size of an effect becomes on a block of another mass and size.

An effect acts on another block as it acts on the source's where it takes the same share of what moves the block. Its
quantities then grow with the block's own units: mass, half the diagonal R, and the time sqrt(R/g) in which it rocks
(G. W. Housner 1963, Bull. Seismol. Soc. Am. 53:403-417); gravity is the same for both. What belongs to a sensor, a film
or a floor keeps its size.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from rockref.model.parameters import BLOCK

if TYPE_CHECKING:
    from rockref.effects.base import Effect

#: Powers of mass, length and time in a unit.
POWERS = {"kg": (1, 0, 0), "m": (0, 1, 0), "s": (0, 0, 1), "N": (1, 1, -2), "Hz": (0, 0, -1)}
#: One unit and its power, as in "N m s2".
PART = re.compile(r"([A-Za-z]+)(\d*)")


class Cuboid(Protocol):
    """What natural units are read from: mass [kg] and sides [m]."""

    @property
    def mass(self) -> float:
        """Return the mass."""

    @property
    def width(self) -> float:
        """Return the side across the edge on which the block rocks."""

    @property
    def height(self) -> float:
        """Return the upright side."""


@dataclass(frozen=True)
class NaturalUnits:
    """Mass and length of a block over those of the source's block."""

    mass: float = 1.0
    length: float = 1.0

    def factor(self, unit: str) -> float:
        """Return the factor on a quantity of this unit ("N m s2", "rad/s2"); one for what has no mass, length, time."""
        above, _, below = unit.partition("/")
        mass = length = 0.0
        for part, sign in ((above, 1), (below, -1)):
            for name, power in PART.findall(part):
                M, L, T = POWERS.get(name, (0, 0, 0))
                mass += sign * int(power or 1) * M
                length += sign * int(power or 1) * (L + T / 2)
        return self.mass**mass * self.length**length


#: Those of the source's block.
SOURCE = NaturalUnits()


def natural_units(block: Cuboid) -> NaturalUnits:
    """Return the natural units of a block, or of a model of it."""
    width, height, mass = (BLOCK[name].value for name in ("width", "height", "mass"))
    return NaturalUnits(block.mass / mass, math.hypot(block.width, block.height) / math.hypot(width, height))


def factor_of(kind: type[Effect], name: str, units: NaturalUnits) -> float:
    """Return the factor on the typical value of a quantity of an effect."""
    if kind.question == "sensor" or name in kind.not_with_block:
        return 1.0
    return units.factor(kind.quantities[name].unit)
