"""The same Problem, solved by the engine of one's choice."""

from __future__ import annotations

from rockref.model import simulate as law
from rockref.model.errors import InputError
from rockref.model.problem import Problem
from rockref.model.response import Response

ENGINES = ("numpy", "numba", "auto")


def run(problem: Problem, engine: str = "numpy", progress=None, dtype=None) -> Response:
    """Solve a problem; `engine` is "numpy", "numba" or "auto". Raises InputError (E-ENGINE) for another name."""
    if engine not in ENGINES:
        raise InputError("E-ENGINE", "engine", f"is {engine!r}", f"Use one of {', '.join(ENGINES)}.")
    return law.simulate(problem, progress=progress, dtype=dtype)
