"""Whether runs that show no forces are those of the law with other inputs: feet that never slide, or whose anchors
are kept.

Such an input stands for a decision of the law. A run that is wrong, and equals what the law makes of another
input, tells that decision, whichever rule the run is to show.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.backends import call, richardson
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge.causes.rows_of_the_law import SAME
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

Answers = Sequence[tuple[Vector, dict[str, Any]]]
#: Beyond every cone.
HELD = {"mu": 2.0**40, "mu_0": 2.0**40}
#: Rules, in words, and the inputs that stand for another law; numbers for all feet.
INPUTS: tuple[tuple[str, str, dict[str, float | bool]], ...] = (
    ("T2", "feet never slide", HELD),
    ("T5", "feet that touch anew keep an old anchor", {"anchored": True}),
)
#: A run is explained where this share at most is left of what it is off by. Decided: integrators lose a hundred
#: thousandth of what sixteen steps show.
LEFT = 1e-2
#: So many runs have to be explained, and this share of those that are wrong. Decided: no other mistake gives the same
#: rows twice by chance.
SOME, MOST = 2, 0.5
SAYS = "The runs are those of the law where {}."


def rule_as_if(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return the rule of the input that makes the law's runs those that are wrong, and a sentence; its own rule and ""
    where none does."""
    failed = {c.vector for c in checks if c.failed and c.weighed and not c.follows and c.layer == check.layer}
    wrong = [(v, out) for v, out in answers if v.id in failed]
    for rule, words, inputs in INPUTS:
        count = sum(is_explained(v, out, inputs) for v, out in wrong)
        if count >= SOME and count >= MOST * len(wrong):
            return rule, SAYS.format(words)
    return check.rule, ""


def is_explained(vector: Vector, out: dict[str, Any], inputs: dict[str, float | bool]) -> bool:
    """Return whether the rows of a run are nearer to the law's with other inputs than they are to the law's, by far."""
    right, other = law(vector), law(vector, inputs)
    off = left = 0.0
    for key in ("x", "Lambda", "W"):
        try:
            got = np.asarray(out[key], float)
            off += float(np.sum((got - right[key]) ** 2))
            left += float(np.sum((got - other[key]) ** 2))
        except (KeyError, TypeError, ValueError):
            return False
    return bool(np.sqrt(left) <= LEFT * np.sqrt(off) and np.sqrt(off) > SAME)


def law(vector: Vector, inputs: dict[str, float | bool] | None = None) -> dict[str, Any]:
    """Return the law's own answer to a run, with other inputs for all feet."""
    q = {k: np.full_like(vector.inputs[k], a) for k, a in (inputs or {}).items()}
    ask = richardson.ask if vector.layer == "LS" else call.ask
    return ask(NumpyEngine(), replace(vector, inputs=vector.inputs | q))
