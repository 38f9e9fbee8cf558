"""Which rule a failure speaks of beside its own, as the same run and the other runs tell."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.as_if import rule_as_if
from rockref.conformance.judge.causes.circumstances import rule_in_common, rule_of_normal_forces
from rockref.conformance.judge.causes.falls import rule_of_a_fall
from rockref.conformance.judge.causes.friction import DAMPER, moves_alone, rule_of_friction
from rockref.conformance.judge.causes.moments import rule_of_a_moment, rule_of_a_turn_alone
from rockref.conformance.judge.causes.other_integrators import first_rows, rule_of_sixteen_steps
from rockref.conformance.judge.causes.turns import rule_of_a_turn
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

#: Rules of the contact forces.
OF_FORCES = ("K1", "N1", "N2", "T5", "T1", "T2", "T6", "T3", "T4")
#: A share of what a place is off by from which on that is sideways, too. Decided: far above rounding.
SHARE = 1e-2
SIDEWAYS = "Without friction, what pushes moves the block sideways: the forces are summed wrongly."
PUSHES_ALONE = "Normal forces turn the block as they should, and move it otherwise."


def cause_of(
    answers: Sequence[tuple[Vector, dict[str, Any]]], checks: Sequence[Check], check: Check, profile: str
) -> tuple[str, str]:
    """Return the rule that a failure speaks of, and a sentence where that is another than its own.

    Its own numbers are asked first, then the normal forces of its row, then what all runs have in common that are
    wrong, then how a fall or a turn goes on.
    """
    if profile != "float32" and check.rule in ("A2", "A3"):
        return rule_of_a_moment(answers, checks, check)
    if profile != "float32" and check.weighed and stands_for_forces(answers, check):
        if pushed_sideways(answers, check):
            return "A1", SIDEWAYS
        for told in (rule_of_a_turn_alone, rule_as_if):
            other, says = told(answers, checks, check)
            if says:
                return other, says
    if profile == "scheme" and check.layer == "LS":
        return rule_of_sixteen_steps(answers, checks, check) if check.weighed else (check.rule, "")
    rule, words = rule_of_friction(answers, checks, check)
    if (words and words != DAMPER) or profile == "float32" or check.layer != "L5s":
        return rule, words
    if profile == "scheme":
        answers = first_rows(answers)
    if rule == "N1" and moves_alone(answers, checks, check, "F_N@0"):
        return "A1", PUSHES_ALONE
    for ask in (rule_of_normal_forces, rule_in_common):
        other, says = ask(answers, check, rule)
        if says:
            return other, says
    if words or check.note:
        return rule, words
    return rule_of_a_turn(answers, rule) if rule == "I3" else rule_of_a_fall(answers, rule)


def pushed_sideways(answers: Sequence[tuple[Vector, dict[str, Any]]], check: Check) -> bool:
    """Return whether a block that stands on ice goes sideways, of which no normal force is the cause."""
    vector, out = next((v, out) for v, out in answers if v.id == check.vector)
    name = check.name.removeprefix("x@")
    if not name.isdigit() or np.any(vector.inputs["mu_0"]) or np.any(vector.inputs["mu"]):
        return False
    time, start = int(name) / float(vector.inputs["output_rate"]), np.asarray(vector.inputs["x"], float)
    got = np.asarray(out["x"], float)[int(name)]
    apart = got - np.asarray(vector.expect[check.name].value, float)
    drift = start + time * np.asarray(vector.inputs["v"], float)
    return bool(np.max(np.abs((got - drift)[:2])) > SHARE * np.max(np.abs(apart)) > 0)


def stands_for_forces(answers: Sequence[tuple[Vector, dict[str, Any]]], check: Check) -> bool:
    """Return whether a failure is one of what is looked at in the stead of forces that are not shown."""
    vector, out = next(((v, out) for v, out in answers if v.id == check.vector), (None, {}))
    run = vector is not None and vector.layer in ("L5s", "LS")
    return run and check.rule in OF_FORCES and out.get("F") is None
