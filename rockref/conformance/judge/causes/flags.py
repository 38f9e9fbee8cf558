"""Failures that speak of no rule of their own: flags of contact that follow from forces, or are handed out otherwise,
and rows whose numbers are lost."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.rows_of_the_law import feet_at_the_start
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

#: So many runs of one foot have to show right forces for its penetration to be right. Decided.
SOME = 3
FORCES = ("F_N@", "F_T@")
NOTHING_PULLS = "After feet without friction, and there alone, places are no numbers: who is not pulled sticks."


def telling(checks: list[Check], answers: Sequence[tuple[Vector, dict[str, Any]]]) -> list[Check]:
    """Return the checks without failures that speak of no rule of their own."""
    return without_lost_numbers(without_flags_in_company(without_late_flags(checks), answers))


def without_late_flags(checks: list[Check]) -> list[Check]:
    """Return the checks without flags of later rows (S2) where normal forces of later rows are wrong, too: flags that
    are handed out late leave the forces as they are."""
    late = [c for c in checks if c.failed and c.layer in ("L5s", "LS") and c.name.startswith("F_N@") and later(c)]
    return [c for c in checks if not (late and c.rule == "S2" and c.name.startswith("anchored@"))]


def without_lost_numbers(checks: list[Check]) -> list[Check]:
    """Return the checks without those of places, attitudes and rates that are no numbers, where others are wrong
    numbers: a division by zero on the way may be of any rule, and a wrong number tells more."""
    lost = [is_lost(c) for c in checks]
    kept = [c for c, gone in zip(checks, lost, strict=True) if not gone]
    short = {c.layer for c, gone in zip(checks, lost, strict=True) if gone}
    return kept if any(c.failed and c.weighed and not c.follows and c.layer in short for c in kept) else checks


def is_lost(check: Check) -> bool:
    """Return whether what a short run was moved to is no number."""
    moved = check.layer == "LS" or (check.layer == "L5s" and not check.name.startswith(FORCES))
    return moved and check.failed and check.weighed and check.got is not None and not np.isfinite(check.got)


def rule_of_lost_numbers(
    answers: Sequence[tuple[Vector, dict[str, Any]]], checks: Sequence[Check], check: Check
) -> tuple[str, str]:
    """Return T2, and a sentence, where places are no numbers after feet without friction, and nowhere else, and some
    of dragged feet are right; its own rule and "" elsewhere.

    Who divides by the length of a trial force has asked before whether the foot sticks.
    """
    if not is_lost(check):
        return check.rule, ""
    wrong = {c.vector for c in checks if c.failed}
    idle: list[bool] = []
    dragged = 0
    for vector, out in answers:
        feet = feet_at_the_start(vector.id) if vector.layer == check.layer else None
        if feet is None or not np.any(feet["touching"]):
            continue
        if is_nowhere(out):
            idle.append(bool(np.any(feet["touching"] & ~feet["dragged"])))
        elif np.any(feet["dragged"]) and vector.id not in wrong:
            dragged += 1
    return ("T2", NOTHING_PULLS) if idle and all(idle) and dragged >= SOME else (check.rule, "")


def is_nowhere(out: dict[str, Any]) -> bool:
    """Return whether the place in the second row of a run is no number."""
    try:
        return not np.all(np.isfinite(np.asarray(out["x"], float)[1]))
    except (KeyError, TypeError, ValueError, IndexError):
        return False


def later(check: Check) -> bool:
    """Return whether a check is one of a row after the first."""
    return not check.name.endswith("@0")


def first_steps_are_right(checks: Sequence[Check], answers: Sequence[tuple[Vector, dict[str, Any]]]) -> bool:
    """Return whether no short run is wrong before its second step: what a step hands to the next is wrong then."""
    near = {v.id for v, _ in answers if v.layer == "L5s" and v.inputs["step"] * v.inputs["output_rate"] > 1 - 1e-9}
    first = ("@0", "@1")
    return not any(c.failed and c.layer == "L5s" and c.name.endswith(first[: 1 + (c.vector in near)]) for c in checks)


def without_flags_in_company(checks: list[Check], answers: Sequence[tuple[Vector, dict[str, Any]]]) -> list[Check]:
    """Return the checks without flags of feet (K1, T5 of a first row) where runs of one foot show that its penetration
    is right.

    The first wrong force tells the rule then; where no force is wrong, the flags are handed out otherwise (S2).
    """
    wrong = {c.vector for c in checks if c.failed}
    alone = [v.id for v, out in answers if v.layer == "L5s" and one_foot(v) and out.get("F") is not None]
    if len(alone) < SOME or wrong & set(alone):
        return checks
    forces = any(c.failed and c.layer == "L5s" and c.name.startswith(FORCES) for c in checks)
    asked = [c.name.startswith("anchored@") and (c.rule == "K1" or not later(c)) for c in checks]
    flag = [c.failed and c.layer == "L5s" and of_a_flag for c, of_a_flag in zip(checks, asked, strict=True)]
    if forces:
        return [c for c, is_flag in zip(checks, flag, strict=True) if not is_flag]
    return [replace(c, rule="S2") if is_flag else c for c, is_flag in zip(checks, flag, strict=True)]


def one_foot(vector: Vector) -> bool:
    """Return whether one foot alone is down in the first row of a short run."""
    rows = vector.branch.get("rows") or [""]
    return len(rows[0].replace("-", "")) == 1
