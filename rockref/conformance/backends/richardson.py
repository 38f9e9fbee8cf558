"""Short runs of other integrators (LS): each is asked for with the step, half and a quarter of it, and extrapolated.

What is left after that is of third order in the step, whatever the scheme (Richardson 1911), so that one whose first
step is a poorer one is not to blame for it; the converged solution is expected, and the bars are those of eight
integrators.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.backends.call import as_mapping
from rockref.conformance.vectors import Vector, problem_of
from rockref.model.problem import Problem

#: What is extrapolated of a row.
SHOWN = ("W", "x", "Lambda")
#: Parts of the step, and how much of each answer the extrapolation takes: errors of first and second order cancel.
PARTS, WEIGHTS = (1, 2, 4), (1 / 3, -2.0, 8 / 3)


def refined(problem: Problem, parts: int) -> Problem:
    """Return the same run with a part of the step."""
    return replace(problem, step=problem.step / parts)


def extrapolated(answers: list[dict[str, Any]]) -> dict[str, Any]:
    """Return rows for a step of nothing, from rows with the parts of a step; the forces as they are, which tells that
    they are shown. Raises ValueError where shapes differ."""
    coarse = answers[0]
    out: dict[str, Any] = {"t": coarse.get("t"), "F": coarse.get("F")}
    for key in SHOWN:
        rows = [answer.get(key) for answer in answers]
        if any(r is None for r in rows):
            continue
        first, *finer = [np.asarray(r) for r in rows]
        if any(r.shape != first.shape for r in finer):
            shapes = ", ".join(str(r.shape) for r in finer)
            raise ValueError(f"{key} has shape {first.shape}, and with smaller steps {shapes}")
        # By differences, so that what does not depend on the step stays as it is.
        out[key] = first + (1 - WEIGHTS[0]) * (finer[0] - first) + WEIGHTS[2] * (finer[1] - finer[0])
    return out


def parts_of(vector: Vector) -> tuple[int, ...]:
    """Return with which parts of its step a run is asked. What nothing pulls drifts evenly in every integrator, with
    every step (S2): that is looked at as it is, or a step that is too short once would be extrapolated away."""
    return PARTS[:1] if vector.rule == "S2" else PARTS


def ask(backend: Any, vector: Vector, finer: int = 1) -> dict[str, Any]:
    """Return the extrapolated answer of a backend to a vector of LS. What the backend raises goes through.

    finer : into how many parts each of its steps is divided
    """
    problem = problem_of(vector.inputs)
    answers = [as_mapping(backend.simulate(refined(problem, finer * k)), "simulate") for k in parts_of(vector)]
    return extrapolated(answers) if len(answers) > 1 else answers[0]
