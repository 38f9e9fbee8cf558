"""Failures that speak of no rule of their own: flags of contact that follow from forces, or are handed out otherwise,
and rows whose numbers are lost."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

#: So many runs of one foot have to show right forces for its penetration to be right. Decided.
SOME = 3
FORCES = ("F_N@", "F_T@")


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


def later(check: Check) -> bool:
    """Return whether a check is one of a row after the first."""
    return not check.name.endswith("@0")


def without_flags_in_company(checks: list[Check], answers: Sequence[tuple[Vector, dict[str, Any]]]) -> list[Check]:
    """Return the checks without flags of feet (K1) where runs of one foot show that its penetration is right.

    The first wrong force tells the rule then; where no force is wrong, the flags are handed out otherwise (S2).
    """
    wrong = {c.vector for c in checks if c.failed}
    alone = [v.id for v, out in answers if v.layer == "L5s" and one_foot(v) and out.get("F") is not None]
    if len(alone) < SOME or wrong & set(alone):
        return checks
    forces = any(c.failed and c.layer == "L5s" and c.name.startswith(FORCES) for c in checks)
    flag = [c.failed and c.layer == "L5s" and c.rule == "K1" and c.name.startswith("anchored@") for c in checks]
    if forces:
        return [c for c, is_flag in zip(checks, flag, strict=True) if not is_flag]
    return [replace(c, rule="S2") if is_flag else c for c, is_flag in zip(checks, flag, strict=True)]


def one_foot(vector: Vector) -> bool:
    """Return whether one foot alone is down in the first row of a short run."""
    rows = vector.branch.get("rows") or [""]
    return len(rows[0].replace("-", "")) == 1
