"""LB: runs on a plate that moves, put to a backend that says it can make them.

Such a backend shows `shaken(problem)`: a run of a problem that has `problem.base` (t_0, dt, a), rows as of `simulate`.
What it gives None for, it does not claim.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from rockref.conformance.backends.call import ANYTHING, as_mapping, has, raised
from rockref.conformance.judge.claims import ClaimCheck, compare, expected_of
from rockref.conformance.vectors import as_shipped, problem_of, read_bytes, value_of
from rockref.model.problem import Problem

PIECE, FILE = "shaken", "LB.json"
ROWS = ("W", "x", "Lambda")


@dataclass(frozen=True)
class ShakenVector:
    """One vector: a problem with a base motion, expected rows with bars, and by how many bars each mistake is off."""

    id: str
    title: str
    problem: Problem
    expect: dict[str, tuple[np.ndarray, np.ndarray]]
    resolving: dict[str, float]
    branch: dict[str, Any]


@lru_cache
def shaken_vectors() -> tuple[ShakenVector, ...]:
    """Return all vectors of a plate that moves. Raises InputError (E-VECTORS)."""
    with as_shipped(FILE):
        return tuple(_vector(entry) for entry in json.loads(read_bytes(FILE))["vectors"])


def _vector(entry: dict[str, Any]) -> ShakenVector:
    inputs = {k: value_of(v) for k, v in entry["inputs"].items()}
    inputs["base"] = {k: value_of(v) for k, v in entry["base"].items()}
    problem, expect = problem_of(inputs), expected_of(entry)
    return ShakenVector(entry["id"], entry["title"], problem, expect, entry["resolving"], entry["branch"])


def judge_shaken(backend: Any) -> list[ClaimCheck]:
    """Return every run on a plate that moves; none where the backend does not show the piece."""
    return [judge_vector(backend, v) for v in shaken_vectors()] if has(backend, PIECE) else []


def judge_vector(backend: Any, vector: ShakenVector) -> ClaimCheck:
    """Return one vector; an answer that is outside with the mistake that gives it, where one is known."""
    try:
        answer = getattr(backend, PIECE)(vector.problem)
        if answer is None:
            return ClaimCheck("base motion", "not shown", vector=vector.id)
        rows = as_mapping(answer, "simulate")
        check = compare("base motion", vector.expect, rows)
        words = as_if(vector, rows) if check.failed and not check.note else ""
    except ANYTHING as e:  # the backend is a stranger's
        return ClaimCheck("base motion", "outside", float("inf"), raised(e), vector.id)
    note = f"{check.worst:.3g} bars off, as if: {words}" if words else check.note
    return replace(check, vector=vector.id, note=note)


def as_if(vector: ShakenVector, answer: dict[str, Any]) -> str:
    """Return the mistake that gives this answer within ten bars, in words; "" where none that is known does."""
    from rockref.conformance.judge.causes.wrong_base_motion import OF_BASE, planted
    from rockref.conformance.judge.causes.wrong_effects import gives
    from rockref.engines import run

    with np.errstate(all="ignore"):
        for mistake in OF_BASE:
            made = run(planted(vector.problem, mistake.load), engine="numpy")
            if gives({name: getattr(made, name) for name in vector.expect}, answer, vector.expect):
                return mistake.says
    return ""
