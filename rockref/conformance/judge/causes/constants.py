"""Whether runs are those of the law with a constant of the block that only some of them have.

What is made of it once is kept, then, from the first run on, or stands in the code.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.as_if import MOST, SOME, is_explained, law
from rockref.conformance.judge.causes.data_flow import is_clear
from rockref.conformance.judge.causes.rows_of_the_law import SAME
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector
from rockref.model.errors import InputError

#: Constants of which runs have several values, and the rule by which each comes in first. Those of feet stand for
#: decisions as well: none slides by a large coefficient, none pushes by a soft spring.
CONSTANTS = (("I2", "inertia"), ("A1", "g"))
SAYS = "The runs that are wrong are those of the law with the {} of {}, which is right."
#: A change of the rates that shows an inertia [rad/s]. Decided: moments of feet make a thousand times as much,
#: and less than a tenth of it of a block that is to turn by nothing.
TURNS = 1e-8
#: So many of the wrong runs are asked before all. Decided: constants explain all of them, or none.
FEW = 3
#: By how many times as much a quantity may be off that other constants do not explain. Decided: what is right is off by
#: what an integrator is.
WORSE = 2.0


def rule_of_a_constant(
    answers: Sequence[tuple[Vector, dict[str, Any]]], checks: Sequence[Check], check: Check
) -> tuple[str, str]:
    """Return the rule of the constant by which the runs that are wrong are explained, and a sentence; the rule that is
    told and "" where there is none.

    Runs that have it themselves have to be right, one that shows it among them.
    """
    runs = [(v, out) for v, out in answers if v.piece == "simulate" and v.layer == check.layer]
    failed = {c.vector for c in checks if c.failed and c.weighed and c.layer == check.layer}
    wrong = [(v, out) for v, out in runs if v.id in failed]
    told = next(v for v, _ in answers if v.id == check.vector)
    for rule, key in CONSTANTS:
        if key == "inertia" and not is_clear(told):
            # Moments that are wrong turn a block as another inertia does.
            continue
        for vectors in by_value([v for v, _ in runs if v.id not in failed], key):
            own = {key: np.asarray(vectors[0].inputs[key])}
            if not all(has_another(v, own) for v, _ in wrong) or not any(is_made_with(*w, own) for w in wrong[:FEW]):
                continue
            count = sum(is_made_with(v, out, own) for v, out in wrong)
            if count >= SOME and count >= MOST * len(wrong) and any(shows(v, key) for v in vectors):
                return rule, SAYS.format(key, vectors[0].id)
    return check.rule, ""


def by_value(vectors: Sequence[Vector], key: str) -> list[list[Vector]]:
    """Return the runs that have the same value of a constant, together."""
    found: dict[bytes, list[Vector]] = {}
    for v in vectors:
        found.setdefault(np.asarray(v.inputs[key]).tobytes(), []).append(v)
    return list(found.values())


def shows(vector: Vector, key: str) -> bool:
    """Return whether a run depends on a constant: on gravity, all; on the inertia, one whose rates change."""
    if key == "g":
        return True
    W = law(vector)["W"]
    return bool(np.max(np.abs(W[-1] - W[0])) > TURNS)


def is_made_with(vector: Vector, out: dict[str, Any], constants: dict[str, np.ndarray]) -> bool:
    """Return whether a run is that of the law with another constant: what was right is right with them, too. None is
    where the law refuses them."""
    try:
        if not is_explained(vector, out, constants):
            return False
        right, other = law(vector), law(vector, constants)
    except InputError:
        return False
    for key in ("x", "Lambda", "W"):
        off, left = (float(np.max(np.abs(np.asarray(out[key], float) - of[key]))) for of in (right, other))
        if left > WORSE * off + SAME:
            return False
    return True


def has_another(vector: Vector, constant: dict[str, np.ndarray]) -> bool:
    """Return whether a run has another value of a constant, of the same shape."""
    q = {key: np.asarray(vector.inputs[key]) for key in constant}
    return any(q[key].shape == value.shape and not np.array_equal(q[key], value) for key, value in constant.items())
