"""The prior of a quantity, completed from what the quantity says of itself, and the way to its scale and back."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

from rockref.effects.base import Effect, Quantity
from rockref.effects.prior import OF_ROLE, RIGID, SHAPE_SPREAD, Prior


def prior_of(kind: type[Effect], name: str) -> Prior:
    """Return the prior of a quantity: what its effect declares, completed from the Quantity."""
    found: Prior = _prior_of(kind, name)  # type: ignore[arg-type]  # a class is hashable; its protocol is not seen
    return found


@cache
def _prior_of(kind: type[Effect], name: str) -> Prior:
    declared, q = kind.priors.get(name, Prior()), kind.quantities[name]
    brings_in = kind.switches is None or name in kind.switches
    role = declared.role or ("size" if brings_in else "fixed")
    scale = declared.scale or ("log" if role == "shape" else "inverse" if q.absent == math.inf else "linear")
    low, high = bounds(q, scale)
    completed = {
        "centre": centre(q, role, scale), "spread": spread(q, role, scale), "deviation": OF_ROLE[role],
        "low": low, "high": high,
    }  # fmt: skip
    left_out = {key: value for key, value in completed.items() if math.isnan(getattr(declared, key))}
    return replace(declared, role=role, scale=scale, **left_out)


def centre(q: Quantity, role: str, scale: str) -> float:
    """Return the value at z = 0: typical for a shape, else that of absence."""
    if scale in ("inverse", "compliance"):
        return 0.0
    return float((q.typical if role in ("shape", "fixed") else q.absent) or 0.0)


def spread(q: Quantity, role: str, scale: str) -> float:
    """Return what one z is: the typical size of a quantity; of one that is typically none a quarter of its range."""
    if role == "shape":
        return SHAPE_SPREAD
    if role == "form" or scale == "compliance":
        return 1.0
    typical, absent = float(q.typical or 0.0), float(q.absent or 0.0)
    if scale == "inverse":
        return 1 / typical
    return abs(math.log(typical / absent) if scale == "log" else typical - absent) or (q.high - q.low) / 4


def bounds(q: Quantity, scale: str) -> tuple[float, float]:
    """Return the least and the largest value on the scale."""
    if scale == "linear":
        return float(q.absent or 0.0) if q.sign == "+" else q.least, q.most
    return (-math.inf if scale == "log" else 0.0), math.inf


def from_scale(kind: type[Effect], name: str, value: float) -> float:
    """Return the quantity itself of a value on its scale."""
    scale = prior_of(kind, name).scale
    if scale == "inverse":
        return 1 / value if value > 0 else math.inf
    if scale == "compliance":
        return typical_of(kind, name) / value**0.5 if value > RIGID else 0.0
    return value


def to_scale(kind: type[Effect], name: str, value: float) -> float:
    """Return the value on its scale of a quantity."""
    scale = prior_of(kind, name).scale
    if scale == "inverse":
        return 1 / value if math.isfinite(value) and value > 0 else 0.0
    if scale == "compliance":
        return (typical_of(kind, name) / value) ** 2 if value > 0 else 0.0
    return value


def typical_of(kind: type[Effect], name: str) -> float:
    """Return the typical value of a quantity that has one."""
    typical = kind.quantities[name].typical
    assert typical is not None
    return float(typical)
