"""Whether a fall that is wrong speaks of the place (I1), the velocity (I4), the acceleration (A1), or the start (S2).

A wrong place loses the same in each step: what it is off by grows as the number of steps. A wrong acceleration changes
the velocity, too: what the place is off by grows as their square. A first evaluation that is wrong loses the same in
each step as well, but not where the start brings its own acceleration. A wrong velocity is seen a step later than a
wrong acceleration. A wrong clock makes turns wrong, too.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.data_flow import is_clear
from rockref.conformance.judge.causes.rows_of_the_law import SAME, rows_of_the_law, same
from rockref.conformance.vectors import Vector

#: How far a ratio of two differences may be from that of a rule. Decided: far above rounding, far below the next one.
NEAR = 0.05
#: So many runs have to be right for what they show to be right. Decided.
SOME = 3
AS_THE_STEPS = "What the place is off by grows as the number of steps: the velocity is right."
AT_THE_START = "Where the start brings its own acceleration, the fall is right: the first evaluation is wrong."

#: So many weights no wrong force or acceleration makes. Decided: a sign of the weight makes two, of a moving block.
FAR = 4.0
TOO_FAR = "Falls from rest are right, others off by more in a step than a weight makes: it is the velocity."
TURNED_OFF = "Blocks that turn fall by more in a step than a weight makes, others as they should: it is the place."
A_STEP_LATE = "The first step of every fall is right, and the second of some is not: the velocity is wrong."
ADD_UP = "Falls gain more in each step, by the same whatever their velocity: loads add up from step to step."
WHOLE_STEP = (
    "Blocks drift by another step than that by which their velocity changes: it is the place, and not the clock."
)
ON_TIME = "Turns are right at the same instants: the place is wrong, and not the clock."

Answers = Sequence[tuple[Vector, dict[str, Any]]]


def rule_of_a_fall(answers: Answers, rule: str) -> tuple[str, str]:
    """Return I1, I4 or S2, and a sentence, where runs above the plate tell it from the rule that is blamed for them.

    I1 or S2 where they lose the same way in every step; I4 where nothing is lost in the first one.
    """
    if rule == "S2":
        if on_time(answers):
            return "I1", ON_TIME
        return ("I1", WHOLE_STEP) if velocity_is_on_time(answers) else (rule, "")
    if rule == "I4" and loads_add_up(answers):
        return "A1", ADD_UP
    if rule != "A1":
        return rule, ""
    if a_step_late(answers):
        return "I4", A_STEP_LATE
    runs = [(v, out) for v, out in answers if v.layer == "L5s" and free(v)]
    if too_far(answers, "L5s"):
        return "I1", TOO_FAR
    if turns_off(answers):
        return "I1", TURNED_OFF
    ratios = [g for v, out in runs for g in growth(v, out)]
    if len(ratios) < 2 or any(abs(g - 2) >= NEAR for g in ratios):
        return rule, ""
    own = [same(out, "x", 1, rows_of_the_law(v.id)[1].x) for v, out in runs if lifted(v)]
    return ("S2", AT_THE_START) if own and all(own) else ("I1", AS_THE_STEPS)


def too_far(answers: Answers, layer: str) -> bool:
    """Return whether falls of leaning blocks from rest are right, and others off by more in a row than their weight
    would make."""
    rest, moving = [], []
    for vector, out in answers:
        q = vector.inputs
        if vector.layer != layer or q.get("a") is not None or not way_of_the_weight(q) > SAME / NEAR:
            continue
        if not is_clear(vector):
            continue
        if np.any(q["v"]):
            moving.append(in_weights(q, out))
        elif np.any(q["Lambda"] != np.eye(3)):
            rest.append(in_weights(q, out))
    return len(rest) >= SOME and max(rest) <= NEAR and sum(w > FAR for w in moving) > 1


def turns_off(answers: Answers) -> bool:
    """Return whether falls of blocks that do not turn are right, and of those that do off by more in a row than their
    weight would make."""
    straight: list[float] = []
    turning: list[float] = []
    for vector, out in answers:
        q = vector.inputs
        asked = vector.layer == "L5s" and q.get("a") is None and way_of_the_weight(q) > SAME / NEAR
        if asked and is_clear(vector):
            (turning if np.any(q["W"]) else straight).append(in_weights(q, out))
    return len(straight) >= SOME and max(straight) <= NEAR and sum(w > FAR for w in turning) > 1


def in_weights(q: dict[str, Any], out: dict[str, Any]) -> float:
    """Return what the place of a falling block is off by in the second row, by the way of its weight; infinite where
    none is shown."""
    t, fall = 1 / float(q["output_rate"]), way_of_the_weight(q)
    try:
        return float(np.max(np.abs(np.asarray(out["x"], float)[1] - q["x"] - t * q["v"] + [0, 0, fall]))) / fall
    except (KeyError, TypeError, ValueError, IndexError):
        return np.inf


def way_of_the_weight(q: dict[str, Any]) -> float:
    """Return how far a block falls from rest to the second row [m]."""
    return float(q["g"]) / float(q["output_rate"]) ** 2 / 2


def on_time(answers: Answers) -> bool:
    """Return whether in runs of one step above the plate places are wrong of what moves, and no turn is."""
    runs = [(v, out, rows_of_the_law(v.id)[1]) for v, out in answers if v.layer == "L5s" and free(v)]
    turned = [same(out, "Lambda", 1, row.Lambda) for v, out, row in runs if np.any(v.inputs["W"])]
    moved = [same(out, "x", 1, row.x) for v, out, row in runs if np.any(v.inputs["v"]) and not np.any(v.inputs["W"])]
    return len(turned) >= SOME and all(turned) and len(moved) >= SOME and not all(moved)


def velocity_is_on_time(answers: Answers) -> bool:
    """Return whether blocks drift by another share of the step than one, and falling ones gain the velocity of a whole
    step in a step: a wrong clock loses the same share of both."""
    shares, gains = [], []
    for vector, out in answers:
        q = vector.inputs
        drifts = is_clear(vector) and q.get("a") is None and bool(np.any(q["v"][:2]))
        if vector.layer != "L5s" or not free(vector) or not drifts:
            continue
        rows = rows_of_the_law(vector.id)
        try:
            x = np.asarray(out["x"], float)[: len(rows)]
            way, right = x[1] - x[0], rows[1].x - rows[0].x
        except (KeyError, TypeError, ValueError, IndexError):
            return False
        shares.append(float(way[:2] @ right[:2] / (right[:2] @ right[:2])))
        if len(rows) > 2 and way_of_the_weight(q) > SAME / NEAR:
            gains.append(float(np.diff(x, 2, axis=0)[0, 2] / np.diff([row.x[2] for row in rows], 2)[0]))
    drift = shares[0] if shares else 1.0
    alike = len(shares) >= SOME and max(abs(s - drift) for s in shares) <= NEAR * abs(drift)
    off = abs(drift - 1) > NEAR
    return alike and off and len(gains) > 1 and all(abs(g - drift) <= NEAR * abs(drift) for g in gains)


def loads_add_up(answers: Answers) -> bool:
    """Return whether falls of several steps gain more speed in each, and those of all velocities alike."""
    found = []
    for vector, out in answers:
        rows = rows_of_the_law(vector.id) if vector.layer == "L5s" and free(vector) else ()
        if len(rows) < 5:
            continue
        try:
            gained = np.diff(np.asarray(out["x"], float)[:, 2], 2) / np.diff([row.x[2] for row in rows], 2)
        except (KeyError, TypeError, ValueError, IndexError):
            return False
        found.append(gained)
    alike = len(found) > 1 and all(bool(np.max(np.abs(f - found[0])) <= NEAR) for f in found)
    return alike and bool(np.min(np.diff(found[0])) > NEAR)


def a_step_late(answers: Answers) -> bool:
    """Return whether all runs above the plate that evaluate their start are right after a step, and some are wrong
    after two."""
    runs = [
        (rows_of_the_law(v.id), out) for v, out in answers if v.layer == "L5s" and free(v) and v.inputs.get("a") is None
    ]
    first = [same(out, "x", 1, rows[1].x) for rows, out in runs]
    second = [same(out, "x", 2, rows[2].x) for rows, out in runs if len(rows) > 2]
    return len(first) >= SOME and all(first) and not all(second)


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
