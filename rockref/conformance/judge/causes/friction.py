"""Which rule a wrong friction force speaks of: the trial force, the decision between sticking and sliding, or the sum.

A foot that sticks shows its trial force, and friction moves and turns the block at once. What is wrong of these tells
more than the first result that is outside.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.one_foot import rule_of_one_foot
from rockref.conformance.judge.compare_answer import LOOK, Check, weighed_in_bars
from rockref.conformance.judge.negligible import size_and_unit
from rockref.conformance.vectors import Vector
from rockref.conformance.vectors.fields import Missing, result
from rockref.model.contact import (
    Kinematics,
    kelvin_voigt,
    norm,
    open_gap,
    point_kinematics,
    radial_return,
    touch,
    trial_force,
)

Answers = Sequence[tuple[Vector, dict[str, Any]]]
HELD = "Feet that should slide show their trial force: they are held to stick."
LOOSE = "Feet that should stick show the sliding force: they are made to slide."
DAMPER = "The spring's part of the friction force is right, the damper's is not."
ON_THE_CONE = "All friction that is wrong is that of sliding feet, and of the right size: its direction is wrong."
OTHER_TRIAL = "The foot is held to stick, and shows another force than the trial force."
OPEN = "The friction of a foot above the plate is no trial force: it is not asked whether the foot is open."
STALE = "The friction forces are those of the row before."
MOVES_ALONE = "Friction turns the block as it should, and moves it otherwise."
#: Rules whose vectors show the friction of the start. A wrong sliding velocity (K1) has vectors of its own.
OF_FRICTION = ("T5", "T1", "T2", "T6", "T3")
#: A force is another one where it differs by this share. Decided: far above rounding, also of single precision.
SAME = 1e-5
#: So many feet have to show it. Decided.
FEET = 3


def rule_of_friction(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return the rule that a failure about friction speaks of, and a sentence where that is another than its own."""
    vector, out = next(((v, out) for v, out in answers if v.id == check.vector), (None, {}))
    if vector is None or not check.weighed or check.rule not in OF_FRICTION:
        return check.rule, ""
    if vector.piece == "contact_law":
        if check.rule == "T2" and check.name == "F_T" and shows_another_trial_when_open(vector.inputs, out):
            return "T5", OPEN
        rule, words = rule_of_one_foot(vector.inputs, out, check)
        if words:
            return rule, words
        held = check.name == "sliding" and check.got is False
        # Where the sliding force is right, the foot slides, and the flag alone is wrong.
        right = any(c.vector == check.vector and c.name == "F_T" and c.grade in ("bitwise", "inside") for c in checks)
        other = held and not right and shows_another_trial(vector.inputs, out)
        return ("T1", OTHER_TRIAL) if other else (check.rule, "")
    if vector.piece != "simulate":
        return check.rule, ""
    if check.name == "F_T@0" and vector.inputs.get("F") is None:
        return rule_of_the_start(answers, vector, out, check)
    if check.name.startswith("F_T@"):
        return ("S1", STALE) if of_the_row_before(vector, out, check) else (check.rule, "")
    return ("A1", MOVES_ALONE) if moves_alone(answers, checks, check, "F_T@0") else (check.rule, "")


def shows_another_trial(q: dict[str, Any], out: dict[str, Any]) -> bool:
    """Return whether the force of a foot that is held to stick is not its trial force. q : inputs of `contact_law`"""
    return bool(q["xi"] >= 0) and is_another_trial(q, out, bool(q["anchored"]))


def shows_another_trial_when_open(q: dict[str, Any], out: dict[str, Any]) -> bool:
    """Return whether a foot above the plate has a friction that is no trial force, wherever its spring is tied: who
    holds that of an open foot to no threshold shows a trial force."""
    return bool(q["xi"] < 0) and all(is_another_trial(q, out, tied) for tied in (True, False))


def is_another_trial(q: dict[str, Any], out: dict[str, Any], tied: bool) -> bool:
    """Return whether the friction that is shown is not the trial force of a foot that is tied to its old anchor, or to
    where it is."""
    if out.get("F_T") is None:
        return False
    stretch = np.asarray(q["u_t"]) - q["s"] if tied else np.zeros(2)
    spring, damper = -q["K_T"] * stretch, -q["C_T"] * np.asarray(q["v_slide"])
    scale = max(np.max(np.abs(spring)), np.max(np.abs(damper)))
    return bool(np.max(np.abs(np.asarray(out["F_T"], float) - spring - damper)) > SAME * scale)


@dataclass(frozen=True)
class FirstRow:
    """Friction (n, 2) [N] of the first row of a run: as it is and as it should be; the trial force and its damper's
    part; how two of them are compared, foot by foot."""

    got: np.ndarray
    right: np.ndarray
    whole: np.ndarray
    damper: np.ndarray
    k: Kinematics
    alike: Callable[[np.ndarray, np.ndarray], np.ndarray]

    @property
    def off(self) -> np.ndarray:
        """Return which feet (n,) have another friction than they should."""
        return ~self.alike(self.got, self.right)


def first_row(vector: Vector, out: dict[str, Any]) -> FirstRow:
    """Return what the first row of a run shows of friction. Raises Missing, TypeError, ValueError, IndexError where it
    is not shown."""
    q, expected = vector.inputs, vector.expect["F_T@0"]
    got = np.asarray(result("F_T@0", out, vector.branch), float)
    bar = np.broadcast_to(np.asarray(expected.bar, float), expected.value.shape)
    size = size_and_unit("F_T@0", vector.layer)[0]

    def alike(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.all(weighed_in_bars(a, b, bar, size)[0] <= LOOK, axis=-1)

    k = point_kinematics(q["x"], q["Lambda"], q["v"], q["W"], q["P"])
    s, _ = touch(k.xi, k.u[:, :2], q["s"], q["anchored"])
    whole = trial_force(k.u[:, :2], s, k.v_slide, q["K_T"], q["C_T"])
    return FirstRow(got, expected.value, whole, -q["C_T"][:, None] * k.v_slide, k, alike)


def rule_of_the_start(answers: Answers, vector: Vector, out: dict[str, Any], check: Check) -> tuple[str, str]:
    """Return the rule that the friction of the first row speaks of, and a sentence."""
    row = first_row(vector, out)
    off, size = row.off, size_and_unit("F_T@0", vector.layer)[0]
    if not np.any(off):
        return check.rule, ""
    if not np.all(np.isfinite(row.got)):
        return ("T2", LOOSE) if check.rule == "T3" and all_are_loose(answers) else (check.rule, "")
    if check.rule == "T3" and np.all(row.alike(row.got, row.whole)[off]) and all_are_held(answers):
        return "T2", HELD
    if check.rule == "T2" and all_are_on_the_cone(answers):
        return "T3", ON_THE_CONE
    stick = row.alike(row.right, row.whole)
    slide = sliding_force(vector.inputs, row.k, row.whole)
    loose = np.all(stick[off]) and np.allclose(row.got[off], slide[off], rtol=SAME, atol=size)
    if check.rule in ("T5", "T1") and loose:
        return "T2", LOOSE
    left = row.got - (row.whole - row.damper)
    share = np.sum(left[off] * row.damper[off]) / max(np.sum(row.damper[off] ** 2), 1e-300)
    of_damper = np.any(row.damper[off]) and np.all(row.alike(left, share * row.damper)[off])
    if check.rule == "T5" and np.all(stick[off]) and of_damper:
        return "T1", DAMPER
    return check.rule, ""


def all_are_held(answers: Answers) -> bool:
    """Return whether every foot that should slide and has a wrong friction in a first row shows its trial force: that
    of a foot without friction may be anything that is left of it."""
    return not any(np.any(row.off & ~row.alike(row.got, row.whole)) for _, row in rows_with_friction(answers))


def all_are_loose(answers: Answers) -> bool:
    """Return whether every foot that should stick and has a wrong friction in a first row shows the sliding force, some
    feet, and all that should slide are right; feet without a trial force have no direction to slide in."""
    loose, size = 0, size_and_unit("F_T@0", "L5s")[0]
    for vector, row in rows_with_friction(answers):
        wrong = row.off & np.all(np.isfinite(row.got), axis=-1)
        slide = sliding_force(vector.inputs, row.k, row.whole)
        if np.any(wrong & ~row.alike(row.right, row.whole)):
            return False
        if not np.allclose(row.got[wrong], slide[wrong], rtol=SAME, atol=size):
            return False
        loose += int(np.sum(wrong))
    return loose >= FEET


def all_are_on_the_cone(answers: Answers) -> bool:
    """Return whether every foot that has a wrong friction in a first row should slide, and has one of the right size,
    some feet, and none shows its trial force: it was decided rightly that they slide, and how large the force is."""
    wrong = 0
    for _, row in rows_with_friction(answers):
        off, slide = row.off, ~row.alike(row.right, row.whole)
        sizes = norm(row.got), norm(row.right)
        held = off & row.alike(row.got, row.whole)
        if np.any(held | (off & ~slide)) or not np.allclose(sizes[0][off], sizes[1][off], rtol=SAME, atol=0.0):
            return False
        wrong += int(np.sum(off))
    return wrong >= FEET


def rows_with_friction(answers: Answers) -> Iterator[tuple[Vector, FirstRow]]:
    """Yield the first rows that show friction."""
    for vector, out in answers:
        if vector.layer != "L5s" or "F_T@0" not in vector.expect or vector.inputs.get("F") is not None:
            continue
        try:
            row = first_row(vector, out)
        except (Missing, TypeError, ValueError, IndexError):
            continue
        if row.got.shape == row.right.shape:
            yield vector, row


def sliding_force(q: dict[str, Any], k: Kinematics, F_trial: np.ndarray) -> np.ndarray:
    """Return friction (n, 2) [N] of feet that all slide along it (3.6b); F_trial (n, 2) [N], q : inputs of a run"""
    F_N = open_gap(k.xi, kelvin_voigt(k.xi, k.xi_rate, q["K_N"], q["C_N"]))
    size = norm(F_trial)
    return radial_return(F_trial, size, size == 0, q["mu"] * F_N)


def of_the_row_before(vector: Vector, out: dict[str, Any], check: Check) -> bool:
    """Return whether the friction forces of a later row that are off are those of the row before it."""
    row = int(check.name.partition("@")[2])
    if row == 0:
        return False
    before, got = (np.asarray(out["F"], float)[i][:, :2] for i in (row - 1, row))
    off = np.any(np.abs(got - vector.expect[check.name].value) > SAME * np.max(np.abs(got)), axis=-1)
    return bool(np.any(off) and np.array_equal(got[off], before[off]))


def moves_alone(answers: Answers, checks: Sequence[Check], check: Check, force: str) -> bool:
    """Return whether, where rows stand in for forces that are not shown, the block is moved wrongly by them and never
    turned wrongly in the step after the start. force : F_N@0 or F_T@0"""
    # Where the row after the start is several steps away, what moved the block has turned it, too.
    vectors = {v.id: v for v, _ in answers if v.piece == "simulate" and one_step_a_row(v.inputs)}
    standing = {"x@1": 0, "Lambda@1": 0}
    for c in checks:
        e = vectors[c.vector].expect.get(c.name) if c.vector in vectors else None
        if c.failed and c.name in standing and e is not None and e.instead_of == force:
            standing[c.name] += 1
    return check.name == "x@1" and standing["x@1"] > 1 and standing["Lambda@1"] == 0


def one_step_a_row(q: dict[str, Any]) -> bool:
    """Return whether the rows of a run lie one step apart."""
    return bool(q["step"] * q["output_rate"] > 1 - 1e-9)
