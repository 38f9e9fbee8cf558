"""rockref: the reference implementation of the eight-point rocking-block model."""

from importlib import import_module
from typing import Any

from rockref.api import Model, simulate
from rockref.model.errors import InputError, NumericalError, RockrefError
from rockref.model.problem import Block, ContactPoints, Problem, State
from rockref.model.response import Response
from rockref.model.shown import draw_with

__version__ = "0.1.0"
__all__ = [
    "Block",
    "ContactPoints",
    "InputError",
    "Model",
    "NumericalError",
    "Problem",
    "Response",
    "RockrefError",
    "State",
    "__version__",
    "add",
    "compare",
    "conform",
    "diagnose",
    "fit",
    "load",
    "plan",
    "simulate",
]
_VERBS = ("add", "compare", "conform", "diagnose", "fit", "load", "plan")


def __getattr__(name: str) -> Any:
    """Return a verb when it is first asked for: what it needs is loaded then, and NumPy alone before."""
    if name not in _VERBS:
        raise AttributeError(f"module 'rockref' has no attribute {name!r}")
    # By its name: the verbs import every folder, and every folder may ask this module for its version.
    return getattr(import_module("rockref.verbs"), name)


def _drawn(thing: Any) -> Any:
    """Return the picture of a thing; what draws is loaded now, and no folder of the house asks for it."""
    return import_module("rockref.report.charts.pictures").picture(thing)


draw_with(_drawn)


def __dir__() -> list[str]:
    """Return the public names."""
    return sorted(__all__)
