"""The numbers that decide, read from one file."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files


@dataclass(frozen=True)
class Calibration:
    """The numbers of `calibration.toml`, where each has its meaning."""

    temperature: float
    companion: float
    prior_odds: float
    certain: float
    least_amplitude: float
    misfit: float
    misfit_of_run: float
    proof: float
    remnant: float
    trust: float
    interval: float

    @property
    def widths(self) -> tuple[float, float]:
        """Return what sizes' intervals go by: the temperature, and the factor on their half widths."""
        return self.temperature, self.interval


@cache
def calibration() -> Calibration:
    """Return the shipped numbers."""
    text = (files("rockref.discover.verdict") / "calibration.toml").read_text(encoding="utf-8")
    return Calibration(**{name: float(entry["value"]) for name, entry in tomllib.loads(text).items()})
