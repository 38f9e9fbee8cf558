"""The same Problem, solved by the engine of one's choice."""

from __future__ import annotations

import importlib.util

from rockref.model import simulate as law
from rockref.model.errors import InputError
from rockref.model.problem import Problem
from rockref.model.response import Response

ENGINES = ("numpy", "numba", "auto")


def has_numba() -> bool:
    """Whether the extra `fast` is installed."""
    return importlib.util.find_spec("numba") is not None


def chosen(problem: Problem, engine: str, dtype=None) -> str:
    """The engine that will run: "auto" takes numba where it is installed, knows all effects, and float64 is wanted.

    Raises
    ------
    InputError
        E-ENGINE, for an unknown name or where numba is asked for and not installed.
    """
    if engine not in ENGINES:
        raise InputError("E-ENGINE", "engine", f"is {engine!r}", f"Use one of {', '.join(ENGINES)}.")
    if engine == "numba":
        if not has_numba():
            raise InputError(
                "E-ENGINE", "engine", "numba is not installed", "pip install 'rockref[fast]', or use numpy."
            )
        if dtype is not None and dtype != float:
            raise InputError("E-ENGINE", "dtype", "the compiled engine computes in float64 only", 'Use engine="numpy".')
    if engine != "auto":
        return engine
    if not has_numba() or (dtype is not None and dtype != float):
        return "numpy"
    from rockref.engines.compiled.pack import knows

    return "numba" if all(knows(effect) for effect in problem.effects) else "numpy"


def run(problem: Problem, engine: str = "auto", progress=None, dtype=None) -> Response:
    """Solve a problem; `engine` is "numpy" (the law), "numba" (compiled) or "auto" (the faster one that can).

    Raises
    ------
    InputError, NumericalError
        as `rockref.model.simulate.simulate`; E-ENGINE for an engine that is not there.
    """
    if chosen(problem, engine, dtype) == "numpy":
        return law.simulate(problem, progress=progress, dtype=dtype)
    from rockref.engines.compiled.engine import simulate

    return simulate(problem, progress=progress)
