"""Numbers with units as they are typed: 54kg, 100mm, 6.7deg."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

import typer

MASS = {"": 1.0, "kg": 1.0, "g": 1e-3, "t": 1e3}
LENGTH = {"": 1.0, "m": 1.0, "cm": 1e-2, "mm": 1e-3}
ANGLE = {"deg": math.pi / 180.0, "°": math.pi / 180.0, "rad": 1.0, "mrad": 1e-3}
RATE = {"deg/s": math.pi / 180.0, "dps": math.pi / 180.0, "rad/s": 1.0}
FREQUENCY = {"": 1.0, "Hz": 1.0, "kHz": 1e3}
#: Length of no block [m]; decided: larger ones are written with their unit.
NO_BLOCK = 10.0
_NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*")


def quantity(text: str, units: Mapping[str, float], example: str) -> float:
    """Return a typed number in SI. Raises typer.BadParameter where it is none, or its unit is not offered."""
    match = _NUMBER.fullmatch(str(text))
    folded = {unit.lower(): worth for unit, worth in units.items()}
    if match is None or match[2].lower() not in folded:
        offered = ", ".join(unit for unit in units if unit)
        raise typer.BadParameter(f"{text!r} is no number with a unit ({offered}); write it as {example}.")
    value = float(match[1]) * folded[match[2].lower()]
    if not (math.isfinite(value) and value > 0.0):
        raise typer.BadParameter(f"{text!r} is not above zero.")
    return value


def mass(text: str) -> float:
    """Return a mass in kg."""
    return quantity(text, MASS, "54kg")


def length(text: str) -> float:
    """Return a length in m; a number alone is metres, and one that no block has is asked for its unit."""
    value = quantity(text, LENGTH, "100mm")
    if value >= NO_BLOCK and re.fullmatch(r"[\d.+eE\s]+", str(text)):
        raise typer.BadParameter(f"{text!r} has no unit, and metres are too many; write it as {str(text).strip()}mm.")
    return value


def angle(text: str) -> float:
    """Return an angle in rad."""
    return quantity(text, ANGLE, "6.7deg")


def rate(text: str) -> float:
    """Return an angular rate in rad/s."""
    return quantity(text, RATE, "0.05deg/s")


def frequency(text: str) -> float:
    """Return a frequency in Hz."""
    return quantity(text, FREQUENCY, "300Hz")
