"""rockref: the reference implementation of the eight-point rocking-block model."""

from rockref.api import Model, simulate
from rockref.model.errors import InputError, NumericalError, RockrefError
from rockref.model.problem import Block, ContactPoints, Problem, State
from rockref.model.response import Response

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
    "simulate",
]
