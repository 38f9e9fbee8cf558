"""The same Problem, solved by the engine of one's choice."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from rockref.model import simulate as law
from rockref.model.errors import InputError
from rockref.model.problem import Problem, precision
from rockref.model.response import Response

ENGINES = ("numpy", "numba", "auto")


def has_numba() -> bool:
    """Return whether the extra `fast` is installed."""
    return importlib.util.find_spec("numba") is not None


def chosen(problem: Problem, engine: str, dtype=None) -> str:
    """Return engine that will run: "auto" takes numba where it is installed, knows every effect, and float64 is wanted.

    Raises
    ------
    InputError
        E-ENGINE, for an unknown name or where numba is asked for and not installed; E-TYPE, for another dtype than
        float32, float64 and longdouble.
    """
    if engine not in ENGINES:
        raise InputError("E-ENGINE", "engine", f"is {engine!r}", f"Use one of {', '.join(ENGINES)}.")
    double = precision(problem, dtype) == np.float64
    if engine == "numba":
        if not has_numba():
            raise InputError(
                "E-ENGINE", "engine", "numba is not installed", "pip install 'rockref[fast]', or use numpy."
            )
        if not double:
            raise InputError("E-ENGINE", "dtype", "the compiled engine computes in float64", 'Use engine="numpy".')
    if engine != "auto":
        return engine
    if not has_numba() or not double:
        return "numpy"
    from rockref.engines.compiled.pack import has_twin

    return "numba" if has_twin(problem) else "numpy"


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


@contextmanager
def compiled_ahead() -> Iterator[None]:
    """Compile in a process of its own, while the block of a `with` runs, what the compiled engine has not kept on disk.

    For what needs effects of every kind: the first time on a machine it would wait for all of them, one after another.
    """
    if not has_numba() or (os.cpu_count() or 1) < 2:
        yield
        return
    from rockref.engines.compiled import ahead

    if not ahead.missing():
        yield
        return
    none = subprocess.DEVNULL
    process = subprocess.Popen([sys.executable, "-m", ahead.__name__], stdin=none, stdout=none, stderr=none)
    try:
        yield
    finally:
        process.terminate()  # what it has not ended is compiled the next time: numba keeps whole files only
        process.wait()
