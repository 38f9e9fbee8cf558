"""Which failures of a short run are consequences of an earlier one in the same run.

In a step data flows one way: the pose of a row makes its forces, the forces make the rates of the row, and all of
these the pose of the next one. What comes after the first wrong quantity of a run says nothing about its own rule.

Of another integrator only the forces of the start are the law's. They know of no step: where some are wrong, the
contact law is, and all that steps show follows where feet come near the plate. Its rates make its attitude: one that
is off by no more than they explain follows, and all do where rates change in a time that is too short for a turn.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from rockref.conformance.backends import richardson
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge.causes.rows_of_the_law import Row, off, rows_of_the_law, same
from rockref.conformance.judge.causes.slips import rotation_vector
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector, layer

#: Place of a quantity in the flow of data through a row; each row has three places.
PLACE = {"x": 0, "x_T": 0, "Lambda": 0, "F": 1, "F_N": 1, "F_T": 1, "anchored": 1, "W": 2}
PLACES = 3
#: Decided: a block moves by centimetres in a short run.
CLEAR = 1.0
#: A turn [rad] that is none, and a share of the rates that no moment makes of it. Decided: from a run whose steps last
#: for a billionth of a second, in which the largest change of the rates is a millionth of a millionth.
NO_TURN, JUMP = 1e-6, 1e-3
AT_THE_START = ("F_N@0", "F_T@0")


def with_consequences_marked(checks: list[Check], answers: Sequence[tuple[Vector, dict[str, Any]]]) -> list[Check]:
    """Return the checks, those marked as following that come after what is wrong before them."""
    known = {v.id: (v, out) for v, out in answers if v.layer in ("L5s", "LS")}
    at_the_start = any(c.failed and c.weighed and c.layer == "L5s" and c.name in AT_THE_START for c in checks)

    jumps = any(rates_jump(v, out) for v, out in known.values())

    def is_one(c: Check) -> bool:
        vector, out = known.get(c.vector, (None, {}))
        if vector is None or not c.failed or not c.weighed or c.name not in vector.expect:
            return False
        if vector.layer == "L5s":
            return follows(c, vector, out)
        of_rates = c.rule == "I3" and (jumps or explained_by_rates(vector, out))
        return of_rates or (at_the_start and not is_clear(vector))

    return [replace(c, follows=True) if is_one(c) else c for c in checks]


def is_clear(vector: Vector) -> bool:
    """Return whether all feet are so high above the plate [m] that none of them has a force in a short run."""
    q = vector.inputs
    return float(np.min((q["x"] + q["P"] @ q["Lambda"].T)[:, 2])) > CLEAR


def follows(check: Check, vector: Vector, out: dict[str, Any]) -> bool:
    """Return whether something else that comes before a failure in the same run is wrong already."""
    # What stands in for a force is looked at in the place of the force.
    name = vector.expect[check.name].instead_of or check.name
    before = [(place, kind) for place, kind in wrong_places(out, rows_of_the_law(vector.id)) if place < place_of(name)]
    return bool(before) and kind_of(name) not in {kind for place, kind in before if place == min(before)[0]}


def place_of(name: str) -> int:
    """Return the place of a result, as F_T@2, in the flow of data through a run."""
    quantity, _, row = name.partition("@")
    return PLACES * int(row) + PLACE[quantity]


def kind_of(name: str) -> str:
    """Return which quantity a result is: friction of one row is kept for the next, and no other than itself."""
    return name.partition("@")[0].removesuffix("_T") if name.startswith("x") else name.partition("@")[0]


def wrong_places(out: dict[str, Any], rows: Sequence[Row]) -> list[tuple[int, str]]:
    """Return the places of a run in which a quantity is another one than the law's, and which."""
    found: list[tuple[int, str]] = []
    for i, row in enumerate(rows):
        for key in ("x", "Lambda", "W"):
            if key in out and not same(out, key, i, getattr(row, key)):
                found.append((place_of(f"{key}@{i}"), key))
        wrong = None if out.get("F") is None else off(out, i, row)
        if wrong is not None:
            kinds = ("F_T" if wrong[:, :2].any() else "", "F_N" if wrong[:, 2].any() else "")
            found += [(place_of(f"{kind}@{i}"), kind) for kind in kinds if kind]
    return found


@lru_cache
def law_extrapolated(id_: str) -> dict[str, Any]:
    """Return the law's own answer to a run of other integrators."""
    return richardson.ask(NumpyEngine(), next(v for v in layer("LS") if v.id == id_))


def rates_jump(vector: Vector, out: dict[str, Any]) -> bool:
    """Return whether the rates of another integrator change in a time in which the block hardly turns."""
    W, time = np.asarray(vector.inputs["W"], float), 1 / float(vector.inputs["output_rate"])
    size = float(np.linalg.norm(W))
    if vector.layer != "LS" or vector.rule != "I3" or not 0 < size * time <= NO_TURN:
        return False
    try:
        return bool(np.linalg.norm(np.asarray(out["W"], float)[1] - W) > JUMP * size)
    except (KeyError, TypeError, ValueError, IndexError):
        return False


def explained_by_rates(vector: Vector, out: dict[str, Any]) -> bool:
    """Return whether the attitude after a row is off by no more than its time and what its rates are off by explain."""
    right = law_extrapolated(vector.id)
    try:
        pose, W = (np.asarray(out[key], float)[1] for key in ("Lambda", "W"))
    except (KeyError, TypeError, ValueError, IndexError):
        return False
    if not np.all(np.isfinite(pose)) or not np.all(np.isfinite(W)):
        return False
    apart = rotation_vector(right["Lambda"][1].T @ pose)
    return bool(np.linalg.norm(apart) <= np.linalg.norm(W - right["W"][1]) / vector.inputs["output_rate"])
