"""Whether a moment that is wrong speaks of the sum (A2), of the attitude that turns it into body axes (A3), or of the
velocities after a step (S1).

An attitude that turns the moments of normal forces rightly does so with those of friction. One that turns otherwise
leaves the size of a moment as it is, and the moments of an upright block.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.data_flow import law_extrapolated
from rockref.conformance.judge.causes.other_integrators import HARDLY, shares_off
from rockref.conformance.judge.causes.rows_of_the_law import rows_of_the_law
from rockref.conformance.judge.causes.slips import rotation_vector
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

Answers = Sequence[tuple[Vector, dict[str, Any]]]
#: Shares of a moment by which two are of one size: as the turn of one step shows it, with seven digits, and as that of
#: sixteen steps does, in which the moment changes. Decided: far below what another attitude or another lever makes.
SIZE = {"L5s": 1e-5, "LS": 1e-4}
#: So many runs have to be right for an attitude to be right. Decided.
SOME = 2
OF_FRICTION = (
    "The moments of normal forces are turned into body axes as they should be; that of friction is another one."
)
SECOND = "Moments of the start turn the block as they should; after a step they are wrong where dampers work."
ALONE = "What forces move is right in every run, and what they turn is not: it is the moment."
TIED = "Friction of feet that are tied turns the block as it should; that of feet that touch anew does not."
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
        if len(on_ice) < SOME or failed & set(on_ice):
            return check.rule, ""
        tied = [v.id for v, _ in answers if v.layer == check.layer and is_dragged(v) and np.all(v.inputs["anchored"])]
        anew = out.get("F") is None and not np.all(vector.inputs["anchored"])
        return ("T5", TIED) if anew and len(tied) >= SOME and not failed & set(tied) else ("A2", OF_FRICTION)
    if check.rule == "A2" and check.name == "Lambda@1" and points_another_way(vector, out):
        shown = [moments(v, out) for v, out in answers if v.layer == check.layer and is_upright(v)]
        largest = max((float(np.linalg.norm(wanted)) for _, wanted in shown), default=0.0)
        upright = [pair for pair in shown if not np.linalg.norm(pair[1]) <= SIZE["LS"] * largest]
        right = all(is_as_it_should_be(*pair, SIZE[check.layer]) for pair in upright)
        return ("A3", TURNED) if len(upright) >= SOME and right else (check.rule, "")
    if check.name == "W@1" and check.layer == "L5s" and damped_after_a_step(answers, failed):
        return "S1", SECOND
    return check.rule, ""


def damped_after_a_step(answers: Answers, failed: set[str]) -> bool:
    """Return whether the moments of all starts are right, and those after a step where no damper works."""
    runs = [v for v, _ in answers if v.layer == "L5s" and v.rule in ("A2", "A3")]
    first = {v.id for v in runs if "Lambda@1" in v.expect}
    springs = {v.id for v in runs if "W@1" in v.expect and not np.any(v.inputs["C_N"])}
    return len(first) >= SOME and bool(springs) and not failed & (first | springs)


def is_dragged(vector: Vector) -> bool:
    """Return whether friction turns the block in a run that shows the attitude after a step."""
    return bool(np.any(vector.inputs["mu_0"])) and "Lambda@1" in vector.expect


def rule_of_a_turn_alone(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return A2 or A3, and a sentence, for a turn that is wrong where no place is, in runs that show both; its own rule
    elsewhere."""
    both = {v.id for v, _ in answers if v.layer == check.layer and {"x@1", "Lambda@1"} <= v.expect.keys()}
    wrong = [c for c in checks if c.failed and c.weighed and not c.follows and c.layer == check.layer]
    names = [c.name for c in wrong if c.vector in both]
    known = {v.id: (v, out) for v, out in answers}
    moved = [c for c in wrong if c.vector in both and c.name == "x@1" and not hardly_moved(*known[c.vector])]
    if not check.name.startswith("Lambda@") or names.count("Lambda@1") < SOME or moved:
        return check.rule, ""
    of_moments = [c for c in wrong if c.rule == "A2" and c.name == "Lambda@1"]
    if check.rule == "K1" and undamped_moments_are_right(answers, checks, check.layer):
        return check.rule, ""
    return rule_of_a_moment(answers, checks, of_moments[0])[0] if of_moments else "A2", ALONE


def undamped_moments_are_right(answers: Answers, checks: Sequence[Check], layer: str) -> bool:
    """Return whether feet without dampers of friction turn the block as they should, by friction, too: a wrong sliding
    velocity works in dampers alone, a wrong moment everywhere."""
    failed = {c.vector for c in checks if c.failed}
    runs = [v for v, _ in answers if v.layer == layer and v.rule in ("A2", "A3") and "Lambda@1" in v.expect]
    undamped = [v for v in runs if not np.any(v.inputs["C_T"])]
    dragged = any(np.any(v.inputs["mu_0"]) for v in undamped)
    return len(undamped) >= SOME and dragged and not failed & {v.id for v in undamped}


def hardly_moved(vector: Vector, out: dict[str, Any]) -> bool:
    """Return whether what a run of sixteen steps is off by is its turn, by far."""
    if vector.layer != "LS":
        return False
    way, turn = shares_off(vector, out)
    return way <= HARDLY * turn


def is_upright(vector: Vector) -> bool:
    """Return whether the moment alone turns a block, the body axes of which are plate axes at the start."""
    q = vector.inputs
    resting = not np.any(q["W"]) and q.get("T") is None
    return resting and vector.rule == "A2" and "Lambda@1" in vector.expect and np.array_equal(q["Lambda"], np.eye(3))


def moments(vector: Vector, out: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Return the inertia times the turn (3,) from the start to the second row, as it is and as it should be; not
    numbers where it is not shown."""
    q = vector.inputs
    of_the_law = law_extrapolated(vector.id)["Lambda"] if vector.layer == "LS" else None
    right = [row.Lambda for row in rows_of_the_law(vector.id)] if of_the_law is None else of_the_law
    nothing = np.full(3, np.nan)
    try:
        pose = np.asarray(out["Lambda"], float)[1]
    except (KeyError, TypeError, ValueError, IndexError):
        return nothing, nothing
    if len(right) < 2 or not np.all(np.isfinite(pose)):
        return nothing, nothing
    got, wanted = (q["inertia"] @ rotation_vector(q["Lambda"].T @ L) for L in (pose, right[1]))
    return got, wanted


def is_as_it_should_be(got: np.ndarray, wanted: np.ndarray, share: float) -> bool:
    """Return whether two vectors are one, to a share of their size."""
    return bool(np.linalg.norm(got - wanted) <= share * np.linalg.norm(wanted))


def points_another_way(vector: Vector, out: dict[str, Any]) -> bool:
    """Return whether the moment that turns a block from rest has the right size, and neither the right direction nor
    the opposite one."""
    if np.any(vector.inputs["W"]) or vector.inputs.get("T") is not None:
        return False
    (got, wanted), share = moments(vector, out), SIZE[vector.layer]
    same = abs(float(np.linalg.norm(got) - np.linalg.norm(wanted))) <= share * float(np.linalg.norm(wanted))
    return same and not is_as_it_should_be(got, wanted, share) and not is_as_it_should_be(-got, wanted, share)
