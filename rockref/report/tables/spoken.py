"""Sizes in the unit in which a person thinks of them: millimetres, degrees, milliseconds, per cent."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rockref.effects import catalogue
from rockref.effects.base import Quantity
from rockref.model.channel import DEGREES
from rockref.report.tables.table import figures

#: For an SI unit the spoken one and the factor to it.
SPOKEN = {"m": ("mm", 1e3), "rad": ("deg", DEGREES), "rad/s": ("deg/s", DEGREES), "s": ("ms", 1e3)}


@dataclass(frozen=True)
class Spoken:
    """A number of an effect as it is said: value and both ends of its interval as texts, unit, meaning.

    is_determined : whether the interval leaves out the value at which the effect is absent
    """

    name: str
    value: str
    low: str
    high: str
    unit: str
    meaning: str = ""
    is_determined: bool = True

    @property
    def size(self) -> str:
        """Return value and unit, as "0.324 mm"."""
        return f"{self.value} {self.unit}".strip()

    def __str__(self) -> str:
        """Return "0.324 mm (90 %: 0.320 to 0.327)"."""
        return f"{self.size} (90 %: {self.low} to {self.high})"


def spoken(name: str, value: float | None, low: float | None, high: float | None, unit: str) -> Spoken:
    """Return a number named "effect.key" as a person says it; a ratio to a stated value as the per cent off it."""
    known = quantity_of(name)
    meaning = known.meaning if known is not None else ""
    numbers = [math.inf if x is None else x for x in (value, low, high)]
    absent = 0.0 if known is None else known.absent
    sure = absent is None or not numbers[1] <= absent <= numbers[2]
    if known is not None and known.unit == "1" and known.absent == 1.0 and " over " in known.meaning:
        middle, least, most = (f"{100 * (x - 1):+.2g}" for x in numbers)
        return Spoken(name, middle, least, most, "%", meaning, sure)
    said, factor = SPOKEN.get(unit, ("" if unit == "1" else re.sub(r"(?<=[a-z])[23]", raised, unit), 1.0))
    middle, least, most = (figures(x * factor) for x in numbers)
    return Spoken(name, middle, least, most, said, meaning, sure)


def raised(power: re.Match[str]) -> str:
    """Return a power as it is written, raised: s2 as s²."""
    return {"2": "²", "3": "³"}[power[0]]


def quantity_of(name: str) -> Quantity | None:
    """Return what is known of a number named "effect.key" or "effect.key[run]", or None."""
    id, _, key = name.partition(".")
    kind = catalogue.EFFECTS.get(id) or catalogue.OWN.get(id)
    return None if kind is None else kind.quantities.get(key.partition("[")[0])


def spoken_amplitudes(amplitudes: Mapping[str, Mapping[str, Any]], most: int | None = None) -> list[Spoken]:
    """Return the numbers of a diagnosis as they are said, those that all runs share, at most so many."""
    shared = [(name, a) for name, a in amplitudes.items() if "[" not in name]
    return [spoken(name, a["value"], a["low"], a["high"], a["unit"]) for name, a in shared[:most]]
