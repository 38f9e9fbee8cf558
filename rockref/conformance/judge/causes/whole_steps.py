"""Which rule a result of a whole step (L4) speaks of, where the pieces of the step pass by themselves."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.conformance.judge.causes.at_the_start import loads_are_not_taken
from rockref.conformance.judge.causes.rows_of_the_law import SAME
from rockref.conformance.judge.causes.slips import rotation_vector
from rockref.conformance.judge.compare_answer import LOOK, Check, bar_of
from rockref.conformance.vectors import Vector

#: So many times what rounding makes is another moment. Decided.
FAR = 10.0


def rule_of_a_step(answers: list[tuple[Vector, dict[str, Any]]], check: Check, profile: str) -> str:
    """Return the rule of a result that is wrong in a whole step alone.

    A moment of the right size that points another way is turned by another attitude: A3, not the sum. A rotation that
    is off by no more than what the angular acceleration adds in a step speaks of that: I2, not I3; by a moment of the
    right size that points another way: A3. Every step starts from loads that it is given: where those alone are wrong
    that take such, S2.
    """
    vector, out = next(((v, out) for v, out in answers if v.id == check.vector), (None, {}))
    if vector is None or not check.weighed:
        return check.rule
    if loads_are_not_taken(answers):
        return "S2"
    if check.name == "T":
        expected = vector.expect["T"]
        off = abs(np.linalg.norm(out["T"]) - np.linalg.norm(expected.value))
        bar = bar_of(expected, profile)
        return "A3" if bar is not None and off <= LOOK * np.linalg.norm(bar) else check.rule
    if check.name == "Lambda" and off_by_the_acceleration(vector, np.asarray(out["Lambda"], float)):
        return "A3" if by_a_moment_that_is_turned(vector, np.asarray(out["Lambda"], float)) else "I2"
    return check.rule


def by_a_moment_that_is_turned(vector: Vector, Lambda: np.ndarray) -> bool:
    """Return whether the pose (3, 3) after a step, which the increment (I2) explains by some moment, speaks of one that
    is as large as that of the start and points another way."""
    q = vector.inputs
    if q.get("T") is None:
        return False
    h, J, W, T = q["step"], q["inertia"], np.asarray(q["W"]), np.asarray(q["T"])
    taken = J @ (2 * (rotation_vector(q["Lambda"].T @ Lambda) - h * W) / h**2) + np.cross(W, J @ W)
    # What rounding of the pose makes of a moment.
    bar = 2 * SAME / h**2 * float(np.max(np.abs(J)))
    as_large = abs(np.linalg.norm(taken) - np.linalg.norm(T)) <= bar
    return bool(as_large and np.linalg.norm(taken - T) > FAR * bar)


def off_by_the_acceleration(vector: Vector, Lambda: np.ndarray) -> bool:
    """Return whether the pose after a step, a rotation (3, 3), is off by no more than h^2/2 times the difference of two
    angular accelerations: the largest that moment and rates make by any of the moments of inertia, in any direction."""
    q = vector.inputs
    if not np.all(np.isfinite(Lambda)) or np.max(np.abs(Lambda.T @ Lambda - np.eye(3))) > 1e-12:
        return False
    got, right = (rotation_vector(q["Lambda"].T @ pose) for pose in (Lambda, vector.expect["Lambda"].value))
    moments = np.linalg.eigvalsh(q["inertia"])
    A = (np.linalg.norm(q["T"]) + moments[-1] * q["W"] @ q["W"]) / moments[0]
    return bool(np.linalg.norm(got - right) <= 2 * q["step"] ** 2 / 2 * A)
