"""Short runs of other integrators (LS): each is asked for twice, with the step and with half of it, and extrapolated.

What is left after that is of second order in the step, whatever the scheme (Richardson 1911); the converged solution is
expected, and the bars are those of five integrators.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.asking import as_mapping
from rockref.conformance.vectors import Vector, problem_of
from rockref.model.problem import Problem

#: What is extrapolated of a row.
SHOWN = ("W", "x", "Lambda")


def halved(problem: Problem) -> Problem:
    """Return the same run with half the step."""
    return replace(problem, step=problem.step / 2)


def extrapolated(coarse: dict[str, Any], fine: dict[str, Any]) -> dict[str, Any]:
    """Return rows for a step of nothing, from rows with a step and with half of it; the forces as they are, which tells
    that they are shown. Raises ValueError where shapes differ."""
    out: dict[str, Any] = {"t": coarse.get("t"), "F": coarse.get("F")}
    for key in SHOWN:
        if coarse.get(key) is not None and fine.get(key) is not None:
            a, b = np.asarray(coarse[key], float), np.asarray(fine[key], float)
            if a.shape != b.shape:
                raise ValueError(f"{key} has shape {a.shape}, and with half the step {b.shape}")
            out[key] = 2 * b - a
    return out


def ask(backend: Any, vector: Vector) -> dict[str, Any]:
    """Return the extrapolated answer of a backend to a vector of LS. What the backend raises goes through."""
    problem = problem_of(vector.inputs)
    answers = [as_mapping(backend.simulate(p), "simulate") for p in (problem, halved(problem))]
    return extrapolated(*answers)
