"""Whether a fall that is wrong speaks of the place (I1) or of the acceleration (A1).

A wrong place loses the same in each step: what it is off by grows as the number of steps. A wrong acceleration changes
the velocity, too: what the place is off by grows as their square.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.circumstances import SAME, rows_of_the_law
from rockref.conformance.vectors import Vector

#: How far a ratio of two differences may be from that of a rule. Decided: far above rounding, far below the next one.
NEAR = 0.05
AS_THE_STEPS = "What the place is off by grows as the number of steps: the velocity is right."


def rule_of_a_fall(answers: Sequence[tuple[Vector, dict[str, Any]]], rule: str) -> tuple[str, str]:
    """Return I1 and a sentence where runs above the plate that A1 is blamed for lose the same way in every step."""
    if rule != "A1":
        return rule, ""
    grown = [g for v, out in answers if v.layer == "L5s" for g in growth(v, out)]
    return ("I1", AS_THE_STEPS) if len(grown) > 1 and all(abs(g - 2) < NEAR for g in grown) else (rule, "")


def growth(vector: Vector, out: dict[str, Any]) -> list[float]:
    """Return how many times as much the place of a run above the plate is off after two steps as after one; nothing
    where it is right, or feet touch."""
    rows = rows_of_the_law(vector.id)
    if len(rows) < 3 or any(np.any(row.F) for row in rows[:2]):
        return []
    try:
        first, second = (np.asarray(out["x"], float)[i] - rows[i].x for i in (1, 2))
    except (KeyError, TypeError, ValueError, IndexError):
        return []
    size = float(first @ first)
    return [float(first @ second) / size] if np.isfinite(second).all() and np.sqrt(size) > SAME / NEAR else []
