"""Finite starts of effects that show nothing at zero, as their own files declare them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rockref.discover.hypotheses.effects import inner_value
from rockref.effects import catalogue

if TYPE_CHECKING:
    from rockref.discover.fit.problem import FitProblem


def seeds_of(problem: FitProblem, id: str) -> list[np.ndarray]:
    """Return the finite starts of an effect, z of its numbers; none where one step from zero shows it."""
    kind = catalogue.find(id)
    parameters = problem.parameters((id,))[len(problem.parameters()) :]
    found = []
    for values in getattr(kind, "seeds", ()):
        effect = kind(**{**kind.typical().values(), **values})
        z = np.zeros(len(parameters))
        for k, p in enumerate(parameters):
            key = p.name.partition(".")[2]
            if p.run is None and hasattr(effect, key):
                z[k] = p.z_of(inner_value(effect, key, p.name))
        found.append(z)
    return found
