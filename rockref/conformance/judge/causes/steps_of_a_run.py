"""Whether a backend's own step is wrong at the states of a run that is outside, where the steps it was asked were not.

The vectors of steps (L4) hold the patterns of contact of the source's block. A run may come by states that none of
them has: then the step is to blame, and not the loop that calls it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.backends.call import ANYTHING, as_mapping
from rockref.conformance.judge.causes.rows_of_the_law import SAME, WRONG
from rockref.conformance.vectors import Vector, problem_of
from rockref.model.integrator import first_evaluation, prepared_inertia, step


def step_is_wrong(backend: Any, vector: Vector) -> bool:
    """Return whether the piece `step` gives another state than the law from some state of a short run."""
    problem = problem_of(vector.inputs)
    with np.errstate(all="ignore"):
        state, inertia = first_evaluation(problem), prepared_inertia(problem.block)
        for _ in range(round(problem.duration / problem.step)):
            right = step(problem, state, inertia)
            asked = replace(problem, start=state, duration=problem.step, output_rate=1 / problem.step)
            try:
                out = as_mapping(backend.step(asked), "step")
                if any(differs(out, key, getattr(right, key)) for key in ("x", "Lambda", "F")):
                    return True
            except ANYTHING:  # the backend is a stranger's
                return False
            state = right
    return False


def differs(out: dict[str, Any], key: str, right: np.ndarray) -> bool:
    """Return whether a result of a step that is shown is another one than the law's."""
    if out.get(key) is None:
        return False
    got, share = np.asarray(out[key], float), WRONG if key == "F" else SAME
    return got.shape != right.shape or bool(np.max(np.abs(got - right)) > share * max(1.0, np.max(np.abs(right))))
