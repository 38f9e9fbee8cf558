"""A diagnosis as plain JSON values, and read back."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from rockref.model.errors import InputError

#: The keys that every diagnosis has.
KEYS = (
    "experiment", "verdict", "effects", "ranking", "amplitudes", "error", "separating_experiment", "signature", "gates",
    "seconds", "versions",
)  # fmt: skip


def plain(value: Any) -> Any:
    """Return values of NumPy as plain ones, tuples as lists, and a number that is not finite as None, all the way
    down."""
    if isinstance(value, dict):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def read(path: Path) -> dict[str, Any]:
    """Read what `rockref diagnose --json` printed. Raises InputError (E-FILE, E-JSON)."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except OSError as e:
        raise InputError("E-FILE", str(path), f"cannot be read ({e.strerror})", "Check the path.") from e
    except ValueError as e:
        raise InputError("E-JSON", str(path), f"is no JSON: {e}", "Give what rockref diagnose --json printed.") from e
    missing = [key for key in KEYS if not isinstance(found, dict) or key not in found]
    if missing:
        cure = "Give what rockref diagnose --json printed."
        raise InputError("E-JSON", str(path), f"has no {missing[0]!r}", cure)
    return found
