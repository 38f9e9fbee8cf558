"""How the blind test draws the size of an effect."""

from __future__ import annotations

from typing import Any

import numpy as np

CATALOGUE = "catalogue"


def about(rng: np.random.Generator, value: float, spread: float = 0.15) -> float:
    """Return a number near `value`, log-normal."""
    return float(value * np.exp(spread * rng.normal()))


def signed(rng: np.random.Generator, value: float) -> float:
    """Return a number of about this size with either sign, never near zero."""
    return float(rng.choice([-1.0, 1.0])) * about(rng, value, 0.25)


def pick(given: dict[str, float], name: str, drawn: float) -> float:
    """Return what was set for this parameter, or else what was drawn."""
    return float(given.get(name, drawn))


def said(parameters: dict[str, float], form: str = CATALOGUE) -> dict[str, Any]:
    """Return the truth of one effect: its parameters as the catalogue names them, and the form in which it acts."""
    return {"parameters": parameters, "form": form}


def uneven(rng: np.random.Generator, spread: float) -> np.ndarray:
    """Return four factors, geometric mean one, whose logarithms have exactly this standard deviation."""
    z = rng.normal(size=4)
    z -= z.mean()
    while z.std() < 1e-3:
        z = rng.normal(size=4)
        z -= z.mean()
    return np.exp(spread * z / z.std())
