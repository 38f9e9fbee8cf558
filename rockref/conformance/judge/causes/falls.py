"""Whether a fall that is wrong speaks of the place (I1), of the acceleration (A1), or of the start (S2).

A wrong place loses the same in each step: what it is off by grows as the number of steps. A wrong acceleration changes
the velocity, too: what the place is off by grows as their square. A first evaluation that is wrong loses the same in
each step as well, but not where the start brings its own acceleration.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.rows_of_the_law import SAME, rows_of_the_law, same
from rockref.conformance.vectors import Vector

#: How far a ratio of two differences may be from that of a rule. Decided: far above rounding, far below the next one.
NEAR = 0.05
AS_THE_STEPS = "What the place is off by grows as the number of steps: the velocity is right."
AT_THE_START = "Where the start brings its own acceleration, the fall is right: the first evaluation is wrong."


def rule_of_a_fall(answers: Sequence[tuple[Vector, dict[str, Any]]], rule: str) -> tuple[str, str]:
    """Return I1 or S2, and a sentence, where runs above the plate that A1 is blamed for lose the same way in every
    step."""
    if rule != "A1":
        return rule, ""
    runs = [(v, out) for v, out in answers if v.layer == "L5s" and free(v)]
    ratios = [g for v, out in runs for g in growth(v, out)]
    if len(ratios) < 2 or any(abs(g - 2) >= NEAR for g in ratios):
        return rule, ""
    own = [same(out, "x", 1, rows_of_the_law(v.id)[1].x) for v, out in runs if lifted(v)]
    return ("S2", AT_THE_START) if own and all(own) else ("I1", AS_THE_STEPS)


def free(vector: Vector) -> bool:
    """Return whether a run has two rows at least, a step apart, and no foot that pushes after the first one."""
    rows = rows_of_the_law(vector.id)
    return len(rows) > 1 and not any(np.any(row.F) for row in rows[1:])


def lifted(vector: Vector) -> bool:
    """Return whether the start of a run brings an acceleration upwards or downwards."""
    a = vector.inputs.get("a")
    return a is not None and bool(np.asarray(a)[2])


def growth(vector: Vector, out: dict[str, Any]) -> list[float]:
    """Return how many times as much the place of a run is off after two steps as after one; nothing where it is
    right, or has fewer."""
    rows = rows_of_the_law(vector.id)
    if len(rows) < 3 or np.any(rows[0].F) or vector.inputs.get("a") is not None:
        return []
    try:
        first, second = (np.asarray(out["x"], float)[i] - rows[i].x for i in (1, 2))
    except (KeyError, TypeError, ValueError, IndexError):
        return []
    size = float(first @ first)
    return [float(first @ second) / size] if np.isfinite(second).all() and np.sqrt(size) > SAME / NEAR else []
