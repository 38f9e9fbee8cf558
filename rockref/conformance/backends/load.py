"""Ways in: an engine by name, a Python class by file or package, an entry point.

A backend is any object with `simulate(problem)`; the other pieces (`rules.PIECES`) are used if they are there.
"""

from __future__ import annotations

import importlib
import importlib.util
import re
import sys
from importlib.metadata import entry_points
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol

from rockref.conformance.backends.call import ANYTHING
from rockref.model.errors import InputError
from rockref.model.problem import Problem

GROUP = "rockref.backends"
ENGINES = ("numpy", "numba", "float32", "longdouble", "scheme")


class Backend(Protocol):
    """The one mandatory piece.

    simulate(problem) -> an object, or a dict, with t (N,) [s], W (N, 3) [rad/s], x (N, 3) [m], Lambda (N, 3, 3), and,
    where it can, F (N, n, 3) [N] and anchored (N, n).
    Optional attributes: name, version, language, precision ("float64" or "float32").
    """

    def simulate(self, problem: Problem) -> Any:
        """Run a problem."""


def engine(name: str) -> Any:
    """Return one of rockref's own: "numpy", "numba", the law in "float32" or "longdouble", or the other integrator,
    "scheme"."""
    import numpy as np

    from rockref.conformance.backends.law import NumbaEngine, NumpyEngine

    if name == "numba":
        from rockref.engines import has_numba

        if not has_numba():
            raise InputError("E-ENGINE", "numba", "is not installed", "pip install 'rockref[fast]'.")
        return NumbaEngine()
    if name == "scheme":
        from rockref.conformance.backends.other_scheme import KickAndDrift

        return KickAndDrift()
    return NumpyEngine({"numpy": np.float64, "float32": np.float32, "longdouble": np.longdouble}[name])


def from_file(path: Path) -> ModuleType:
    """Return the module in a file. Raises InputError (E-BACKEND) where it cannot be run."""
    if not path.is_file():
        raise InputError("E-BACKEND", str(path), "is not there", "Give path/to/file.py:Class.")
    spec = importlib.util.spec_from_file_location(f"rockref_backend_{path.stem}", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    try:
        spec.loader.exec_module(module)
    except ANYTHING as e:
        raise InputError("E-BACKEND", str(path), f"cannot be run ({type(e).__name__}: {e})", "Mend the file.") from e
    return module


def from_package(name: str) -> ModuleType:
    """Return an installed module. Raises InputError (E-BACKEND) where there is none."""
    try:
        return importlib.import_module(name)
    except ANYTHING as e:
        raise InputError(
            "E-BACKEND",
            name,
            f"cannot be imported ({type(e).__name__}: {e})",
            "Install it, or give a file: path/to/file.py:Class.",
        ) from e


def named(target: str) -> Any:
    """Return a backend registered in the entry-point group `rockref.backends`, made; None where there is none of that
    name."""
    for point in entry_points(group=GROUP):
        if point.name == target:
            return made(loaded(point), target)
    return None


def loaded(point: Any) -> Any:
    """Return what an entry point names. Raises InputError (E-BACKEND) where it cannot be imported."""
    try:
        return point.load()
    except ANYTHING as e:
        what = f"cannot be imported from {point.value} ({type(e).__name__}: {e})"
        raise InputError("E-BACKEND", point.name, what, "Mend the package that registers it.") from e


def made(thing: Any, target: str) -> Any:
    """Return an instance of a class, or the thing itself. Raises InputError (E-BACKEND) where it cannot be made."""
    if not isinstance(thing, type):
        return thing
    try:
        return thing()
    except ANYTHING as e:
        what = f"cannot be made without arguments ({type(e).__name__}: {e})"
        raise InputError("E-BACKEND", target, what, "Give a class that can be called without arguments.") from e


def class_cure(path: Path) -> str:
    """Return what to write in the place of a file: the file with each of its classes, read and not run."""
    if not path.is_file():
        return "The file is not there; give path/to/file.py:Class."
    classes = re.findall(r"^class +(\w+)", path.read_text(encoding="utf-8", errors="replace"), re.MULTILINE)
    listed = " or ".join(f"{path}:{name}" for name in classes)
    return f"Write {listed}." if classes else "There is no class in it; write one with simulate(problem)."


def load(target: str) -> Any:
    """Return the backend that a target names: "numpy", "numba", "path/to/file.py:Class", "package.module:Class", or an
    entry point.

    Raises
    ------
    InputError
        E-BACKEND: what cannot be found, imported or made, and what to do.
    """
    if target in ENGINES:
        return engine(target)
    place, colon, name = target.rpartition(":")
    if not colon:
        found = named(target)
        if found is not None:
            return found
        if target.endswith(".py"):
            raise InputError("E-BACKEND", target, "names no class", class_cure(Path(target)))
        if Path(target).is_file():
            cure = f"A program that speaks JSON lines is judged by: rockref conform exe {target}"
            raise InputError("E-BACKEND", target, "is a file, and no Python", cure)
        known = [*ENGINES, *(p.name for p in entry_points(group=GROUP))]
        cure = f"Use one of {', '.join(known)}, path/to/file.py:Class, or package.module:Class."
        raise InputError("E-BACKEND", target, "is no backend", cure)
    module = from_file(Path(place)) if place.endswith(".py") else from_package(place)
    if not hasattr(module, name):
        classes = [k for k, v in vars(module).items() if isinstance(v, type) and hasattr(v, "simulate")]
        raise InputError(
            "E-BACKEND", target, f"has no {name!r}", f"There is: {', '.join(classes) or 'no class with simulate'}."
        )
    return made(getattr(module, name), target)
