"""Columns of numbers as short text inside the page."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np

LARGEST = 32000
#: What stands for "not a number" in a packed column.
GAP = -32768


def packed(values: np.ndarray, unit: float | None = None) -> dict[str, Any]:
    """Return values (N,) as 16-bit integers in base64 and the unit that they count: two bytes and a third a number.

    Without `unit` it is a 32000th of the largest magnitude. What is not finite becomes the gap.
    """
    values = np.asarray(values, dtype=np.float64)
    known = np.isfinite(values)
    filled = np.where(known, values, 0.0)
    largest = float(np.abs(filled).max(initial=0.0))
    unit = unit or (largest / LARGEST if largest / LARGEST > 0.0 else 1.0)
    whole = np.where(known, np.rint(filled / unit), GAP).astype("<i2")
    return {"unit": unit, "n": len(values), "data": base64.b64encode(whole.tobytes()).decode("ascii")}


def unpacked(column: dict[str, Any]) -> np.ndarray:
    """Return the numbers (N,) of a packed column, NaN in its gaps."""
    whole = np.frombuffer(base64.b64decode(column["data"]), dtype="<i2")
    return np.where(whole == GAP, np.nan, whole * column["unit"])
