"""Which rule a failure speaks of beside its own, as the same run and the other runs tell."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.as_if import (
    rule_as_if,
    rule_of_feet_that_never_push,
    rule_of_other_feet,
    rule_of_untied_feet,
)
from rockref.conformance.judge.causes.at_the_start import (
    rule_of_brought_loads,
    rule_of_the_first_evaluation,
    rule_of_tied_feet,
)
from rockref.conformance.judge.causes.circumstances import rule_in_common, rule_of_normal_forces
from rockref.conformance.judge.causes.constants import rule_of_a_constant
from rockref.conformance.judge.causes.data_flow import is_clear
from rockref.conformance.judge.causes.falls import rule_of_a_fall
from rockref.conformance.judge.causes.flags import rule_of_lost_numbers
from rockref.conformance.judge.causes.friction import DAMPER, moves_alone, rule_of_friction
from rockref.conformance.judge.causes.handed_out import rule_of_what_is_shown
from rockref.conformance.judge.causes.moments import rule_of_a_moment, rule_of_a_turn_alone
from rockref.conformance.judge.causes.other_integrators import first_rows, rule_of_sixteen_steps
from rockref.conformance.judge.causes.rows_of_the_law import SAME
from rockref.conformance.judge.causes.turns import rule_of_a_turn, rule_of_no_rotation
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

#: Rules of the normal forces, and of all contact forces.
PUSHES = ("K1", "N1", "N2")
OF_FORCES = ("K1", "N1", "N2", "T5", "T1", "T2", "T6", "T3", "T4")
#: A share of its way by which a block that goes up or down goes sideways. Decided: integrators differ by a millionth.
SHARE = 1e-5
SIDEWAYS = "Without friction, what pushes moves the block sideways: the forces are summed wrongly."
PUSHED = "Falls of two steps are right: what pushes after the first step is wrong, and not the velocity."
PUSHES_ALONE = "Normal forces turn the block as they should, and move it otherwise."


def cause_of(
    answers: Sequence[tuple[Vector, dict[str, Any]]], checks: Sequence[Check], check: Check, profile: str
) -> tuple[str, str]:
    """Return the rule that a failure speaks of, and a sentence where that is another than its own.

    Its own numbers are asked first, then the normal forces of its row, then what all runs have in common that are
    wrong, then how a fall or a turn goes on.
    """
    if profile != "float32" and check.weighed and check.layer in ("L5s", "LS"):
        for told in (
            rule_of_what_is_shown,
            rule_of_brought_loads,
            rule_of_the_first_evaluation,
            rule_of_tied_feet,
            rule_of_a_constant,
            rule_of_untied_feet,
            rule_of_lost_numbers,
            rule_of_no_rotation,
        ):
            other, says = told(answers, checks, check)
            if says:
                return other, says
    hidden = profile != "float32" and check.weighed and stands_for_forces(answers, check)
    of_moments = profile != "float32" and check.rule in ("A2", "A3")
    if (of_moments or (hidden and check.rule in PUSHES)) and pushed_sideways(answers, check.layer):
        return "A1", SIDEWAYS
    if of_moments:
        return rule_of_a_moment(answers, checks, check)
    if hidden:
        for told in (rule_of_feet_that_never_push, rule_of_a_turn_alone, rule_of_other_feet, rule_as_if):
            other, says = told(answers, checks, check)
            if says:
                return other, says
    if profile == "scheme" and check.layer == "LS" and check.rule in OF_FORCES and check.name.startswith("Lambda@"):
        other, says = rule_of_a_turn_alone(answers, checks, check)
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
    vector, out = next(((v, out) for v, out in answers if v.id == check.vector), (None, {}))
    if rule == "I4" and vector is not None and not is_clear(vector) and out.get("F") is None:
        return "S1", PUSHED
    return rule_of_a_turn(answers, rule) if rule == "I3" else rule_of_a_fall(answers, rule)


def pushed_sideways(answers: Sequence[tuple[Vector, dict[str, Any]]], layer: str) -> bool:
    """Return whether a block that stands still on ice, on feet that nothing stretches, goes sideways: no normal force,
    no turn and no friction is the cause."""
    for vector, out in answers:
        q = vector.inputs
        if vector.layer != layer or "x@1" not in vector.expect or any(np.any(q[k]) for k in ("mu", "mu_0", "v", "W")):
            continue
        if np.any(stretched(q)):
            continue
        try:
            off = np.asarray(out["x"], float)[1] - q["x"]
        except (KeyError, TypeError, ValueError, IndexError):
            continue
        way = np.max(np.abs(vector.expect["x@1"].value - q["x"]))
        if q.get("a") is None and not is_clear(vector) and np.max(np.abs(off[:2])) > SHARE * way + SAME:
            return True
    return False


def stretched(q: dict[str, Any]) -> np.ndarray:
    """Return which feet (n,) of a start are tied to another place than theirs: on ice they pull where they are held."""
    places = q["x"] + q["P"] @ q["Lambda"].T
    return q["anchored"] & np.any(np.abs(places[:, :2] - q["s"]) > SAME, axis=-1)


def stands_for_forces(answers: Sequence[tuple[Vector, dict[str, Any]]], check: Check) -> bool:
    """Return whether a failure is one of what is looked at in the stead of forces that are not shown."""
    vector, out = next(((v, out) for v, out in answers if v.id == check.vector), (None, {}))
    run = vector is not None and vector.layer in ("L5s", "LS")
    return run and check.rule in OF_FORCES and out.get("F") is None
