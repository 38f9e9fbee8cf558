"""LE: effects of the catalogue that a backend claims to have, each put to it by one small vector.

A backend that has effects shows `effect(problem, effect, parameters)`, a run of a problem of the plain law with one
effect added, rows as of `simulate`; and `sensor(effect, parameters, t, crv_deg_s)`, what the gyroscope makes of rates.
What it gives None for, it does not claim.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from rockref.conformance.backends.call import ANYTHING, as_mapping, has, raised
from rockref.conformance.judge.compare_answer import grade_of, weighed_in_bars
from rockref.conformance.judge.negligible import size_and_unit
from rockref.conformance.vectors import as_shipped, problem_of, read_bytes, value_of
from rockref.conformance.vectors.claim import Claim

PIECES = ("effect", "sensor")
ROWS = ("W", "x", "Lambda")


@dataclass(frozen=True)
class ClaimCheck:
    """One effect, judged by one vector: grade, deviation in bars, note."""

    effect: str
    grade: str
    worst: float = 0.0
    note: str = ""
    vector: str = ""

    @property
    def failed(self) -> bool:
        """Return whether the claim does not hold."""
        return self.grade == "outside"


@lru_cache
def claims() -> tuple[Claim, ...]:
    """Return all vectors of effects. Raises InputError (E-VECTORS)."""
    with as_shipped("LE.json"):
        document = json.loads(read_bytes("LE.json"))
        return tuple(claim_of(entry, document["sets"]) for entry in document["vectors"])


def claim_of(entry: dict[str, Any], sets: dict[str, Any]) -> Claim:
    """Return a vector from its stored form; `sets` holds the inputs, which many share."""
    inputs = {k: value_of(v) for k, v in sets[entry["set"]].items()}
    facts = (entry["id"], entry["effect"], entry["piece"], entry["parameters"])
    return Claim(*facts, inputs, expected_of(entry), entry["resolving"]["absent"], entry["branch"])


def ask(backend: Any, claim: Claim) -> dict[str, Any] | None:
    """Return the backend's answer; None where it does not claim the effect."""
    if claim.piece == "effect":
        answer = backend.effect(problem_of(claim.inputs), claim.effect, dict(claim.parameters))
        return None if answer is None else as_mapping(answer, "simulate")
    answer = backend.sensor(claim.effect, dict(claim.parameters), claim.inputs["t"], claim.inputs["crv_deg_s"])
    return None if answer is None else as_mapping(answer, "channel")


def judge_claims(backend: Any) -> list[ClaimCheck]:
    """Return every effect that the backend claims; it claims none where it shows neither piece."""
    return [judge_claim(backend, claim) for claim in claims() if has(backend, claim.piece)]


def judge_claim(backend: Any, claim: Claim) -> ClaimCheck:
    """Return one effect of a backend that shows its piece."""
    try:
        answer = ask(backend, claim)
        check = ClaimCheck(claim.effect, "not shown") if answer is None else explained(claim, answer)
    except ANYTHING as e:  # the backend is a stranger's
        check = ClaimCheck(claim.effect, "outside", float("inf"), raised(e))
    return replace(check, vector=claim.id)


def explained(claim: Claim, answer: dict[str, Any]) -> ClaimCheck:
    """Compare one answer with its vector; one that is outside with the mistake that gives it, where one is known."""
    from rockref.conformance.judge.causes.wrong_effects import likely

    check = compare(claim.effect, claim.expect, answer)
    words = likely(claim, answer) if check.failed and not check.note else ""
    return replace(check, note=f"{check.worst:.3g} bars off, {words}") if words else check


def expected_of(entry: dict[str, Any]) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Return expected results of a stored vector, each with its bar, which is one number for all of it."""
    values = {k: np.asarray(value_of(v)) for k, v in entry["expect"].items()}
    return {k: (v, np.full(v.shape, float(entry["expect"][k]["bar"]))) for k, v in values.items()}


def compare(claimed: str, expect: dict[str, tuple[np.ndarray, np.ndarray]], answer: dict[str, Any]) -> ClaimCheck:
    """Compare one answer with expected results and bars; of what is claimed, by name. Of a run, W alone is a must."""
    worst, negligible = 0.0, False
    for name, (right, bar) in expect.items():
        got = answer.get(name)
        if got is None and name not in ("W", "crv_deg_s"):
            continue
        shape = None if got is None else np.shape(got)
        if shape != right.shape:
            note = f"{name} has shape {shape}, not {right.shape}"
            return ClaimCheck(claimed, "outside", float("inf"), note)
        ratio, small = weighed_in_bars(np.asarray(got), right, bar, size_and_unit(name)[0])
        worst, negligible = max(worst, float(np.max(ratio))), negligible or bool(np.any(small))
    return ClaimCheck(claimed, grade_of(worst, negligible), worst)
