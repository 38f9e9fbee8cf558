"""All lists of this folder, found by their names: `list_01.py`, `list_02.py` and so on.

A list is a module with MISTAKES. It may have IN_PYTHON and IN_C, correct variants; SCHEMES, other integrators as lines
of the function that makes a step; OF_STEPS, mistakes in these integrators; IN_STEPS, the mistakes that are planted in
them, by default all; OF_THE_STEP, what dwindles with the step and is left out of these; INTO, other integrators than
its own to plant them in; FORMATS, rows of too few digits.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from strangers import controls, controls_c


def modules() -> dict[str, ModuleType]:
    """Return the modules of the lists by number, in order."""
    paths = sorted(Path(__file__).parent.glob("list_*.py"))
    return {path.stem.removeprefix("list_").lstrip("0"): import_module(f"strangers.{path.stem}") for path in paths}


def gathered(name: str) -> tuple[Any, ...]:
    """Return what lists have by a name, one after the other."""
    return tuple(item for module in MODULES.values() for item in getattr(module, name, ()))


MODULES = modules()
#: Mistakes by list.
LISTS = {number: module.MISTAKES for number, module in MODULES.items()}
#: Other integrators, as lines of the function that makes a step.
STEPS = {name: step for module in MODULES.values() for name, step in getattr(module, "SCHEMES", {}).items()}
#: Lists whose mistakes are planted in other integrators: those that have some, or name them.
WITH_SCHEMES = {n: m for n, m in MODULES.items() if hasattr(m, "OF_STEPS") or hasattr(m, "INTO")}
#: Correct variants: in Python, in C.
IN_PYTHON = (*controls.IN_PYTHON, *gathered("IN_PYTHON"))
IN_C = (*controls_c.IN_C, *gathered("IN_C"))
#: Rows of too few digits.
FORMATS = gathered("FORMATS")
