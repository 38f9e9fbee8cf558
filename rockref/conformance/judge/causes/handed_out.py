"""Whether rows show something else than what the run goes on with: forces that do not move the block, rates by which it
does not turn, attitudes that are a row late.

What a row hands out wrongly moves nothing: places, attitudes and rates of the rows after it are right. Then the run is
right, and its rows are not (S2). Rates round more than places do; wrong ones show in the next attitude.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.data_flow import wrong_places
from rockref.conformance.judge.causes.rows_of_the_law import SAME, Row, rows_of_the_law, same
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

Answers = Sequence[tuple[Vector, dict[str, Any]]]
#: So many runs have to show it. Decided: no wrong force moves two blocks as the right ones would.
SOME = 2
#: So many times what rounding makes of a place or an attitude is seen. Decided.
SEEN = 10.0
IDLE = "The block moves as the right forces move it, in every run: the forces that are shown are not those."
TURNS = "The block turns by the right rates, in every run: the rates that are shown are not those."
LATE = "Attitudes are those of the row before, and all else is right, in every run: they are handed out a row late."


def rule_of_what_is_shown(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return S2, and a sentence, where all that is wrong of the short runs is what their rows show; the rule that is
    told and "" elsewhere."""
    runs = [(v, out, rows_of_the_law(v.id)) for v, out in answers if v.layer == "L5s"]
    if check.layer != "L5s" or any(c.failed and c.layer == "LS" for c in checks):
        return check.rule, ""
    if check.name.startswith("F"):
        return ("S2", IDLE) if forces_are_idle(runs) else (check.rule, "")
    if check.name.startswith("W@"):
        return ("S2", TURNS) if rates_are_idle(runs) else (check.rule, "")
    if check.name.startswith("Lambda@"):
        return ("S2", LATE) if attitudes_are_late(runs) else (check.rule, "")
    return check.rule, ""


def forces_are_idle(runs: Sequence[tuple[Vector, dict[str, Any], tuple[Row, ...]]]) -> bool:
    """Return whether forces are wrong that would move and turn the block visibly, and no block is moved otherwise."""
    count = 0
    for vector, out, rows in runs:
        kinds = {kind for _, kind in wrong_places(out, rows)}
        if kinds & {"x", "Lambda"}:
            return False
        count += bool(kinds) and would_be_seen(vector, out, rows)
    return count >= SOME


def would_be_seen(vector: Vector, out: dict[str, Any], rows: Sequence[Row]) -> bool:
    """Return whether the wrong forces of a first row would show in the second, by the place or the attitude."""
    if len(rows) < 2 or vector.inputs.get("a") is not None:
        return False
    q = vector.inputs
    apart = np.asarray(out["F"], float)[0] - rows[0].F
    levers, way = q["P"] @ q["Lambda"].T, q["step"] ** 2 / 2
    moved = way * apart.sum(axis=0) / q["mass"]
    turned = way * np.linalg.solve(q["inertia"], q["Lambda"].T @ np.cross(levers, apart).sum(axis=0))
    scale = max(1.0, float(np.max(np.abs(rows[1].x))))
    return bool(np.max(np.abs(moved)) > SEEN * SAME * scale or np.max(np.abs(turned)) > SEEN * SAME)


def rates_are_idle(runs: Sequence[tuple[Vector, dict[str, Any], tuple[Row, ...]]]) -> bool:
    """Return whether rates are wrong by which the block would turn visibly, and no block is moved or turned
    otherwise."""
    count = 0
    for vector, out, rows in runs:
        kinds = {kind for _, kind in wrong_places(out, rows)}
        if kinds - {"W"}:
            return False
        for i in range(1, len(rows) - 1) if kinds else ():
            apart = rates(out, i) - rows[i].W
            count += bool(np.max(np.abs(apart)) * vector.inputs["step"] > SEEN * SAME)
    return count >= SOME


def rates(out: dict[str, Any], i: int) -> np.ndarray:
    """Return the rates (3,) of a row; no numbers where they cannot be read."""
    try:
        return np.asarray(out["W"], float)[i].reshape(3)
    except (KeyError, TypeError, ValueError, IndexError):
        return np.full(3, np.nan)


def attitudes_are_late(runs: Sequence[tuple[Vector, dict[str, Any], tuple[Row, ...]]]) -> bool:
    """Return whether every attitude is that of the row before, and nothing else is wrong; some of them after a turn."""
    late = 0
    for _, out, rows in runs:
        if {kind for _, kind in wrong_places(out, rows)} - {"Lambda", "W"}:
            return False
        for i in range(1, len(rows)):
            if not same(out, "Lambda", i, rows[i - 1].Lambda):
                return False
            late += i > 1 and not same(out, "Lambda", i, rows[i].Lambda)
    return late >= SOME
