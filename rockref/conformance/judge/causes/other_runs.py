"""Which rule a failure speaks of beside its own, as the same run and the other runs tell."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rockref.conformance.judge.causes.circumstances import rule_in_common, rule_of_normal_forces
from rockref.conformance.judge.causes.falls import rule_of_a_fall
from rockref.conformance.judge.causes.friction import DAMPER, moves_alone, rule_of_friction
from rockref.conformance.judge.causes.moments import rule_of_a_moment
from rockref.conformance.judge.causes.other_integrators import first_rows, rule_of_sixteen_steps
from rockref.conformance.judge.causes.turns import rule_of_a_turn
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

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
    if profile == "scheme" and check.layer == "LS":
        return rule_of_sixteen_steps(answers, check) if check.weighed else (check.rule, "")
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
