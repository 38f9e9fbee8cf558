"""What a failure of another integrator speaks of beside its own rule.

The forces of the start are the law's, whatever the integrator: what the feet do there tells as much as of the law's own
scheme. What sixteen steps add up to tells less: where forces are not shown, the block is moved by their sum and turned
by their moment.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.data_flow import is_clear, law_extrapolated
from rockref.conformance.judge.causes.falls import NEAR, ON_TIME, SOME, TOO_FAR, too_far
from rockref.conformance.judge.causes.rows_of_the_law import rows_of_the_law
from rockref.conformance.judge.compare_answer import Check, compare_one
from rockref.conformance.vectors import Vector

Answers = Sequence[tuple[Vector, dict[str, Any]]]
#: A share of the way of sixteen steps from which on a place is another one, and how much of that share a turn may be
#: off by to be right. Decided: integrators differ by a millionth after two extrapolations; a block that is moved
#: otherwise turns otherwise by a thousandth of it, and a wrong force turns it by a tenth or more.
SHARE, HARDLY = 1e-5, 1e-2
#: A share of the rates of a ball by which no integrator changes them. Decided: far above rounding.
STEADY = 1e-9
#: How many times as much the place of a drifting block loses in a step as in the step before, where its velocity
#: changes: 3/2 or more of three steps, 2 or more of two; 1 where the place loses the same in each. Decided: between.
GROWTH = 1.25
#: A coefficient of friction beyond every cone, as short runs have it. Decided.
HELD = 2.0**20
#: A share of the normal forces after sixteen steps by which they are no longer those of springs at the places that are
#: shown. Decided: integrators of first order differ by half a hundredth, before any extrapolation.
UNFIT = 2e-2
#: A share of the runs with dampers that have to be wrong for the dampers to be. Decided.
MOST = 0.5
SLID = "Anchors of feet that never slide are right: those of feet that slide are not."
SUMMED = "Springs alone turn the block as they should, and move it otherwise."
RATE = "Springs alone push as they should; dampers turn the block as they should, and move it otherwise."
STICKING = "Where feet stick, friction moves the block as it should; where they slide on, it does not."
AFTER_THE_START = "Forces of the start and all that springs alone make are right: after a step dampers are wrong."
SLOWED = "The rates of a ball that nothing turns change."
DRAGGED = "Friction turns the block as it should, and moves it otherwise: the sum is wrong."
NO_SPRINGS = "After sixteen steps normal forces without dampers are not those of springs where the feet are."
PULLED = "What the place of a drifting block is off by grows faster than the steps: its velocity changes."


def first_rows(answers: Answers) -> list[tuple[Vector, dict[str, Any]]]:
    """Return the answers to short runs of the law's own scheme, the first row of each: no step has been made there."""
    return [(v, {k: cut(a) for k, a in out.items()}) for v, out in answers if v.layer == "L5s"]


def cut(rows: Any) -> Any:
    """Return the first of some rows; what has none as it is."""
    try:
        return rows[:1]
    except TypeError:
        return rows


def rule_of_sixteen_steps(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return the rule that a failure of LS speaks of, and a sentence where that is another than its own."""
    if check.rule == "S2" and gains_speed(answers):
        return "A1", PULLED
    if check.rule == "S2" and turns_are_on_time(answers):
        return "I1", ON_TIME
    if check.rule == "T1" and dragged_alone(answers):
        return "A1", DRAGGED
    if check.rule == "A1" and is_clear(next(v for v, _ in answers if v.id == check.vector)) and too_far(answers, "LS"):
        return "I1", TOO_FAR
    if check.rule in ("A1", "A2", "A3") and pushes_do_not_fit(answers):
        return "N1", NO_SPRINGS
    if check.rule in ("A1", "N1") and dampers_alone(answers, checks, check):
        return "S1", AFTER_THE_START
    if check.rule == "I2" and balls_are_slowed(answers):
        return "I5", SLOWED
    if check.rule == "N1":
        return rule_of_pushes(answers)
    if check.rule == "T5" and anchors_are_right(answers, checks, check):
        return "T4", SLID
    if check.rule == "A1" and sticking_is_right(answers, checks, check):
        return "T4", STICKING
    return check.rule, ""


def turns_are_on_time(answers: Answers) -> bool:
    """Return whether all blocks that spin steadily above the plate are right after sixteen steps, and those that drift
    have made the same share of their way: the place is wrong, and neither the clock nor the start."""
    clear = [(v, out) for v, out in answers if v.layer == "LS" and is_clear(v)]
    turned = [(v, out) for v, out in clear if v.rule == "I3" and "Lambda@1" in v.expect]
    drift = [(v, out) for v, out in clear if v.rule == "S2" and "x_T@1" in v.expect and np.any(v.inputs["v"])]
    right = all(compare_one("Lambda@1", v, out, "scheme").grade != "outside" for v, out in turned)
    wrong = all(compare_one("x_T@1", v, out, "scheme").grade == "outside" for v, out in drift)
    if len(turned) < SOME or not right or len(drift) < 2 or not wrong:
        return False
    ways = [(np.asarray(out["x"], float)[1] - v.inputs["x"])[:2] for v, out in drift]
    made = [v.expect["x_T@1"].value - v.inputs["x"][:2] for v, _ in drift]
    share = float(ways[0] @ made[0] / (made[0] @ made[0]))
    apart = [np.linalg.norm(way - share * of) / np.linalg.norm(of) for way, of in zip(ways, made, strict=True)]
    return bool(max(apart) <= NEAR * abs(share - 1))


def pushes_do_not_fit(answers: Answers) -> bool:
    """Return whether forces are shown, and in no run without normal dampers those after sixteen steps are what springs
    make at the places of the same row: it is the force, whatever is made of it."""
    shares = []
    for vector, out in answers:
        q = vector.inputs
        if vector.layer != "LS" or damped(vector) or is_clear(vector):
            continue
        try:
            got, x, Lambda = (np.asarray(out[key], float)[1] for key in ("F", "x", "Lambda"))
        except (KeyError, TypeError, ValueError, IndexError):
            return False
        springs = q["K_N"] * np.maximum(-(x + q["P"] @ Lambda.T)[:, 2], 0.0)
        if np.max(springs) > 0.0:
            shares.append(float(np.max(np.abs(got[:, 2] - springs)) / np.max(springs)))
    return len(shares) >= SOME and min(shares) > UNFIT


def dragged_alone(answers: Answers) -> bool:
    """Return whether friction that turns a leaning block as it should moves it otherwise, and springs of friction alone
    are off by no more in the turn than in the place: levers make more of a wrong force, and less of a wrong sum."""
    dragged = [
        (v, out) for v, out in answers if v.layer == "LS" and np.any(v.inputs["mu_0"]) and v.rule in ("A2", "A3")
    ]
    leaning = [shares_off(v, out) for v, out in dragged if v.rule == "A3"]
    springs = [shares_off(v, out) for v, out in dragged if not np.any(v.inputs["C_T"])]
    alone = bool(leaning) and all(moved_alone(*s) for s in leaning)
    return alone and bool(springs) and all(turned <= moved for moved, turned in springs)


def dampers_alone(answers: Answers, checks: Sequence[Check], check: Check) -> bool:
    """Return whether forces of the start are shown and right, and on ice all runs without dampers are right and most
    others wrong, the one that is told among them."""
    told = next(v for v, _ in answers if v.id == check.vector)
    failed = {c.vector for c in checks if c.failed and c.layer == "LS"}
    pushed = [v for v, _ in answers if v.layer == "LS" and "Lambda@1" in v.expect and on_ice(v)]
    springs, dampers = ({v.id for v in pushed if damped(v) is is_damped} for is_damped in (False, True))
    shown = [v.id for v, out in answers if v.layer == "L5s" and "F_N@0" in v.expect and out.get("F") is not None]
    right = bool(shown) and not any(c.failed and c.layer == "L5s" for c in checks)
    damped_alone = damped(told) and not is_clear(told) and not np.any(told.inputs["mu_0"])
    return (
        right
        and damped_alone
        and len(springs) > 1
        and not failed & springs
        and len(failed & dampers) >= MOST * len(dampers)
    )


def damped(vector: Vector) -> bool:
    """Return whether any foot of a run has a normal damper."""
    return bool(np.any(vector.inputs["C_N"]))


def sticking_is_right(answers: Answers, checks: Sequence[Check], check: Check) -> bool:
    """Return whether forces of the start are right, and friction moves the block as it should where feet stick: what
    is wrong of a block that slides on is left by its sliding, and not the sum."""
    told = next(v for v, _ in answers if v.id == check.vector)
    stick = [(v, out) for v, out in answers if v.layer == "LS" and v.rule == "T1" and "x@1" in v.expect]
    stick = [(v, out) for v, out in stick if out.get("F") is not None]
    if not np.any(told.inputs["mu_0"]) or any(c.failed and c.layer == "L5s" for c in checks):
        return False
    return len(stick) > 1 and all(compare_one("x@1", v, out, "scheme").grade != "outside" for v, out in stick)


def anchors_are_right(answers: Answers, checks: Sequence[Check], check: Check) -> bool:
    """Return whether the anchors of all feet that never slide are right in runs that show them, and the run that is
    told slides."""
    failed = {c.vector for c in checks if c.failed and c.layer == "LS"}
    told = next(v for v, _ in answers if v.id == check.vector)
    held = [v.id for v, _ in answers if v.layer == "LS" and v.rule == "T5" and never_slides(v)]
    return not never_slides(told) and len(held) > 1 and not failed & set(held)


def never_slides(vector: Vector) -> bool:
    """Return whether no force makes the feet of a run slide."""
    return bool(np.min(vector.inputs["mu"]) >= HELD)


def rule_of_pushes(answers: Answers) -> tuple[str, str]:
    """Return N1; A1 where springs alone move the block wrongly and turn it rightly; K1 where that holds for dampers,
    and springs alone are right."""
    pushed = [(v, out) for v, out in answers if v.layer == "LS" and "Lambda@1" in v.expect and on_ice(v)]
    springs = [shares_off(v, out) for v, out in pushed if not np.any(v.inputs["C_N"])]
    dampers = [shares_off(v, out) for v, out in pushed if np.any(v.inputs["C_N"]) and np.any(v.inputs["W"])]
    if springs and all(moved_alone(*s) for s in springs):
        return "A1", SUMMED
    right = bool(springs) and all(max(s) <= SHARE for s in springs)
    return ("K1", RATE) if right and dampers and all(moved_alone(*s) for s in dampers) else ("N1", "")


def moved_alone(moved: float, turned: float) -> bool:
    """Return whether a block is moved otherwise, and turned as it should be, by shares."""
    return moved > SHARE and turned <= HARDLY * moved


def on_ice(vector: Vector) -> bool:
    """Return whether feet that push have no friction."""
    q = vector.inputs
    lowest = float(np.min((q["x"] + q["P"] @ q["Lambda"].T)[:, 2]))
    return lowest < 0 and not np.any(q["mu_0"]) and bool(np.any(vector.expect["Lambda@1"].value != q["Lambda"]))


def shares_off(vector: Vector, out: dict[str, Any]) -> tuple[float, float]:
    """Return by which share of its way a block is elsewhere after sixteen steps, and by which share of its turn;
    infinite where no rows are shown."""
    right, q = law_extrapolated(vector.id), vector.inputs
    shares = []
    for key in ("x", "Lambda"):
        try:
            off = np.linalg.norm(np.asarray(out[key], float)[1] - right[key][1])
        except (KeyError, TypeError, ValueError, IndexError):
            return np.inf, np.inf
        size = np.linalg.norm(right[key][1] - q[key])
        shares.append(float(off / size) if size > 0 else np.inf if off > 0 else 0.0)
    return shares[0], shares[1]


def balls_are_slowed(answers: Answers) -> bool:
    """Return whether the rates of balls above the plate change, which no gyroscopic moment does."""
    for vector, out in answers:
        if vector.layer != "LS" or vector.rule != "I3" or not is_ball(vector):
            continue
        W = np.asarray(vector.inputs["W"], float)
        try:
            got = np.asarray(out["W"], float)[1]
        except (KeyError, TypeError, ValueError, IndexError):
            continue
        if not np.linalg.norm(got - W) <= STEADY * np.linalg.norm(W):
            return True
    return False


def is_ball(vector: Vector) -> bool:
    """Return whether all moments of inertia are alike."""
    J = vector.inputs["inertia"]
    return np.array_equal(J, J[0, 0] * np.eye(3))


def gains_speed(answers: Answers) -> bool:
    """Return whether blocks that nothing pulls drift with another velocity from step to step."""
    runs = [(v, out, rows_of_the_law(v.id)) for v, out in answers if v.layer == "L5s" and v.rule == "S2"]
    runs = [run for run in runs if drifts(run[0], run[2])]
    longest = max((len(rows) for _, _, rows in runs), default=0)
    ratios = [g for _, out, rows in runs if len(rows) == longest for g in growth(rows, out)]
    return bool(ratios) and all(g > GROWTH for g in ratios)


def drifts(vector: Vector, rows: Sequence[Any]) -> bool:
    """Return whether a run of two steps or more has a velocity, and nothing that pulls."""
    q = vector.inputs
    return len(rows) > 2 and bool(np.any(q["v"])) and q.get("a") is None and not any(np.any(row.F) for row in rows)


def growth(rows: Sequence[Any], out: dict[str, Any]) -> list[float]:
    """Return how many times as much the place of a drifting block loses in the last step as in the step before it;
    nothing where it is right, or fewer rows are shown, or the second step is right: a velocity that changes shows."""
    way = rows[1].x - rows[0].x
    try:
        off = [float((np.asarray(out["x"], float)[i] - rows[i].x) @ way) for i in range(len(rows))]
    except (KeyError, TypeError, ValueError, IndexError):
        return []
    before, last = np.diff(off)[-2:]
    least = 1e-12 * float(way @ way)
    if not min(abs(off[-1]), abs(off[2])) > least:
        return []
    return [abs(float(last)) / max(abs(float(before)), least)]
