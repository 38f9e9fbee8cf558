"""Whether a turn that is wrong speaks of the exponential (I3), the increment (I2), or a moment of no foot (A2)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.falls import SOME, free
from rockref.conformance.judge.causes.rows_of_the_law import SAME, rows_of_the_law, same
from rockref.conformance.judge.causes.slips import rotation_vector
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

#: How far two directions may be apart to be one [rad]. Decided: far above rounding, far below the next axis.
ALONG = 1e-3
ALONG_A = "What the turns are off by points along the angular acceleration, and where that is zero they are right."
#: By how much an attitude is no rotation: far above single precision; where three attitudes are extrapolated, more than
#: any three rotations make. Decided.
BENT = {"L5s": 1e-5, "LS": 1e3}
NO_ROTATION = "The attitude is no rotation any more."
BY_RATES = "Turns from rest are right, as small and larger ones, and all by rates are wrong: it is the increment."
NO_FOOT = "Where the start brings its own moment the first turn is right: others have a moment, and no foot touches."


def rule_of_a_turn(answers: Sequence[tuple[Vector, dict[str, Any]]], rule: str) -> tuple[str, str]:
    """Return I2, and a sentence, where runs above the plate that I3 is blamed for are off by a share of the angular
    acceleration, or blocks at rest turn as they should; A2 where those alone are right whose start brings its
    moment."""
    if rule != "I3":
        return rule, ""
    if moment_of_no_foot(answers):
        return "A2", NO_FOOT
    if right_from_rest(answers):
        return "I2", BY_RATES
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


def rule_of_no_rotation(
    answers: Sequence[tuple[Vector, dict[str, Any]]], checks: Sequence[Check], check: Check
) -> tuple[str, str]:
    """Return I3, and a sentence, where the block of the run that is told has an attitude that is no rotation: no other
    rule makes one of a rotation; its own rule and "" elsewhere."""
    out = next((out for v, out in answers if v.id == check.vector), {})
    try:
        poses = np.asarray(out["Lambda"], float)
        apart = np.max(np.abs(np.swapaxes(poses, -1, -2) @ poses - np.eye(3)), axis=(-2, -1))
    except (KeyError, TypeError, ValueError, IndexError):
        return check.rule, ""
    return ("I3", NO_ROTATION) if apart[0] <= SAME and np.any(apart > BENT[check.layer]) else (check.rule, "")


def right_from_rest(answers: Sequence[tuple[Vector, dict[str, Any]]]) -> bool:
    """Return whether first turns of blocks at rest are right, and all of blocks that turn are wrong, even some that are
    no larger: the exponential is right of what it is given."""
    found: dict[bool, list[tuple[float, bool]]] = {False: [], True: []}
    for vector, out in answers:
        rows = rows_of_the_law(vector.id) if vector.layer == "L5s" else ()
        size = np.linalg.norm(rotation_vector(rows[0].Lambda.T @ rows[1].Lambda)) if len(rows) > 1 else 0.0
        if size > SAME / ALONG:
            right = same(out, "Lambda", 1, rows[1].Lambda)
            found[bool(np.any(vector.inputs["W"]))].append((float(size), right))
    resting, turning = found[False], found[True]
    sure = len(resting) >= SOME and len(turning) >= SOME and min(turning)[0] <= max(resting)[0]
    return sure and all(right for _, right in resting) and not any(right for _, right in turning)


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
