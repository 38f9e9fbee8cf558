"""Whether a moment that is wrong speaks of the sum (A2), or of the attitude that turns it into body axes (A3).

An attitude that turns the moments of normal forces rightly does so with those of friction. One that turns otherwise
leaves the size of a moment as it is, and the moments of an upright block.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.data_flow import law_extrapolated
from rockref.conformance.judge.causes.rows_of_the_law import rows_of_the_law
from rockref.conformance.judge.causes.slips import rotation_vector
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

Answers = Sequence[tuple[Vector, dict[str, Any]]]
#: Shares of a moment by which two are of one size: as the turn of one step shows it, with seven digits, and as that of
#: sixteen steps does, in which the moment changes. Decided: far below what another attitude or another lever makes.
SIZE = {"L5s": 1e-5, "LS": 1e-3}
#: So many runs have to be right for an attitude to be right. Decided.
SOME = 2
OF_FRICTION = (
    "The moments of normal forces are turned into body axes as they should be; that of friction is another one."
)
TURNED = "The moment has the right size and points another way, where the block leans; upright blocks turn rightly."


def rule_of_a_moment(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return A2 or A3 for a failure that speaks of the other, and a sentence; its own rule elsewhere."""
    vector, out = next(((v, out) for v, out in answers if v.id == check.vector), (None, {}))
    if vector is None or vector.piece != "simulate" or not check.weighed:
        return check.rule, ""
    failed = {c.vector for c in checks if c.failed}
    if check.rule == "A3" and np.any(vector.inputs["mu_0"]):
        on_ice = [
            v.id for v, _ in answers if v.layer == check.layer and v.rule == "A3" and not np.any(v.inputs["mu_0"])
        ]
        return ("A2", OF_FRICTION) if len(on_ice) >= SOME and not failed & set(on_ice) else (check.rule, "")
    if check.rule == "A2" and check.name == "Lambda@1" and points_another_way(vector, out):
        upright = [v.id for v, _ in answers if v.layer == check.layer and v.rule == "A2" and is_upright(v)]
        wrong = {c.vector for c in checks if c.failed and c.name == check.name}
        return ("A3", TURNED) if len(upright) >= SOME and not wrong & set(upright) else (check.rule, "")
    return check.rule, ""


def is_upright(vector: Vector) -> bool:
    """Return whether body axes are plate axes at the start, and a turn is looked at."""
    return "Lambda@1" in vector.expect and np.array_equal(vector.inputs["Lambda"], np.eye(3))


def points_another_way(vector: Vector, out: dict[str, Any]) -> bool:
    """Return whether the moment that turns a block from rest has the right size, and neither the right direction nor
    the opposite one."""
    q = vector.inputs
    if np.any(q["W"]) or q.get("T") is not None:
        return False
    right = (
        law_extrapolated(vector.id)["Lambda"]
        if vector.layer == "LS"
        else [r.Lambda for r in rows_of_the_law(vector.id)]
    )
    try:
        pose = np.asarray(out["Lambda"], float)[1]
    except (KeyError, TypeError, ValueError, IndexError):
        return False
    if len(right) < 2 or not np.all(np.isfinite(pose)):
        return False
    got, wanted = (q["inertia"] @ rotation_vector(q["Lambda"].T @ L) for L in (pose, right[1]))
    size = SIZE[vector.layer] * float(np.linalg.norm(wanted))
    same = abs(float(np.linalg.norm(got) - np.linalg.norm(wanted))) <= size
    return same and min(float(np.linalg.norm(got - wanted)), float(np.linalg.norm(got + wanted))) > size
