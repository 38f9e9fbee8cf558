"""Which result of one foot is wrong first, of those that a vector does not ask for but the answer shows."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.conformance.backends.law import RulesBackend
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.rules import ORDER

#: A force, or an anchor by the force of its spring, is another one where it differs by this share of the largest.
#: Decided: far above rounding, also of single precision.
SAME = 1e-5
#: Results in the order in which they are made, and the rule of each.
CHAIN = (
    ("F_N", "N1"), ("s_trial", "T5"), ("F_trial", "T1"), ("threshold", "T6"), ("sliding", "T2"), ("F_T", "T3"),
    ("s", "T4"),
)  # fmt: skip
EARLIER = "The {} of the same foot is wrong already."
ANCHORED = "The anchor of the same foot is right: it is the trial force."
NAMES = {"F_N": "normal force", "s_trial": "anchor", "F_trial": "trial force", "threshold": "threshold"}


def rule_of_one_foot(q: dict[str, Any], out: dict[str, Any], check: Check) -> tuple[str, str]:
    """Return the rule of the first result that is wrong of a foot that touches, where that comes before the one that
    is told, and a sentence. q : inputs of `contact_law`"""
    if not q["xi"] >= 0:
        return check.rule, ""
    right = RulesBackend().contact_law(**q)
    shown, right = ({**(a.get("trace") or {}), **a} for a in (out, right))
    for name, rule in CHAIN:
        if ORDER[rule] >= check.rank:
            break
        if name in NAMES and differs(shown.get(name), right[name], right, q, name):
            return rule, EARLIER.format(NAMES[name])
    anchor = "s_trial" if shown.get("s_trial") is not None else "s"
    of_anchor = check.rule == "T5" and check.name == "F_T" and not right["sliding"] and shown.get(anchor) is not None
    if of_anchor and not differs(shown[anchor], right[anchor], right, q, anchor):
        return "T1", ANCHORED
    return check.rule, ""


def differs(got: Any, wanted: Any, right: dict[str, Any], q: dict[str, Any], name: str) -> bool:
    """Return whether a result that is shown is another one; lengths are weighed by the spring of friction."""
    if got is None:
        return False
    by = float(q["K_T"]) if name.startswith("s") else 1.0
    size = max(float(np.max(np.abs(right[k]))) for k in ("F_N", "F_trial"))
    got = np.asarray(got, float)
    return got.shape != np.shape(wanted) or not bool(np.max(np.abs(got - wanted)) * by <= SAME * max(size, 1e-3))
