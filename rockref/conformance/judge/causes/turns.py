"""Whether a turn that is wrong speaks of the exponential (I3), the increment (I2), or a moment of no foot (A2)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.falls import SOME, free
from rockref.conformance.judge.causes.rows_of_the_law import SAME, rows_of_the_law, same
from rockref.conformance.judge.causes.slips import rotation_vector
from rockref.conformance.vectors import Vector

#: How far two directions may be apart to be one [rad]. Decided: far above rounding, far below the next axis.
ALONG = 1e-3
ALONG_A = "What the turns are off by points along the angular acceleration, and where that is zero they are right."


NO_FOOT = "Where the start brings its own moment the first turn is right: others have a moment, and no foot touches."


def rule_of_a_turn(answers: Sequence[tuple[Vector, dict[str, Any]]], rule: str) -> tuple[str, str]:
    """Return I2, and a sentence, where runs above the plate that I3 is blamed for are off by a share of the angular
    acceleration; A2 where those alone are right whose start brings its moment."""
    if rule != "I3":
        return rule, ""
    if moment_of_no_foot(answers):
        return "A2", NO_FOOT
    steady, along = [], []
    for vector, out in answers:
        if vector.layer != "L5s" or not free(vector) or not np.any(vector.inputs["W"]):
            continue
        row, A = rows_of_the_law(vector.id)[1], angular_acceleration(vector.inputs)
        right = same(out, "Lambda", 1, row.Lambda)
        if np.any(A) and not right:
            along.append(is_along(vector.inputs["Lambda"], out, row.Lambda, A))
        elif not np.any(A):
            steady.append(right)
    sure = len(steady) >= SOME and all(steady) and len(along) > 1 and all(along)
    return ("I2", ALONG_A) if sure else (rule, "")


def moment_of_no_foot(answers: Sequence[tuple[Vector, dict[str, Any]]]) -> bool:
    """Return whether first turns above the plate are right where the start brings a moment, and all others of as long
    a step are wrong; and second turns are wrong, too, so that it is not the first evaluation alone."""
    runs = [(v, out, rows_of_the_law(v.id)) for v, out in answers if v.layer == "L5s" and free(v)]
    runs = [(v, out, rows) for v, out, rows in runs if np.any(v.inputs["W"])]
    brought = [(v, out, rows) for v, out, rows in runs if v.inputs.get("T") is not None]
    shortest = min((v.inputs["step"] for v, _, _ in brought), default=np.inf)
    made = [run for run in runs if run[0].inputs.get("T") is None and run[0].inputs["step"] >= shortest]
    second = [same(out, "Lambda", 2, rows[2].Lambda) for _, out, rows in brought if len(rows) > 2]
    first = [same(out, "Lambda", 1, rows[1].Lambda) for _, out, rows in brought]
    wrong = not any(same(out, "Lambda", 1, rows[1].Lambda) for _, out, rows in made)
    return len(first) > 1 and all(first) and len(made) >= SOME and wrong and bool(second) and not any(second)


def angular_acceleration(q: dict[str, Any]) -> np.ndarray:
    """Return the angular acceleration (3,) [rad/s2] of a start above the plate, in body axes (I2)."""
    J, W = q["inertia"], np.asarray(q["W"])
    T = np.zeros(3) if q.get("T") is None else np.asarray(q["T"])
    return np.linalg.solve(J, T - np.cross(W, J @ W))


def is_along(start: np.ndarray, out: dict[str, Any], right: np.ndarray, A: np.ndarray) -> bool:
    """Return whether the turn of a step from an attitude is off by a multiple of A (3,), as far as digits show."""
    pose = np.asarray(out["Lambda"], float)[1]
    if not np.all(np.isfinite(pose)) or np.max(np.abs(pose.T @ pose - np.eye(3))) > SAME:
        return False
    apart = rotation_vector(start.T @ pose) - rotation_vector(start.T @ right)
    across = np.linalg.norm(np.cross(apart, A)) / np.linalg.norm(A)
    return bool(across <= ALONG * np.linalg.norm(apart) + SAME)
