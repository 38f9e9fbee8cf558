"""Which foot a contact point belongs to: "2ext" and "2int" are foot 2."""

from __future__ import annotations

import numpy as np

from rockref.model.errors import InputError
from rockref.model.problem import ContactPoints


def foot_numbers(points: ContactPoints, effect: str) -> np.ndarray:
    """Return foot of every point, 0 to 3, (n,). Raises InputError (E-FEET) for a name that does not begin with 1 to
    4."""
    for name in points.names:
        if name[:1] not in ("1", "2", "3", "4"):
            raise InputError(
                "E-FEET",
                f"effect {effect}",
                f"contact point {name!r} belongs to no foot",
                'Names of points begin with the number of their foot, as in "1ext" and "3int".',
            )
    return np.array([int(name[0]) - 1 for name in points.names])


def over_mean(factors) -> np.ndarray:
    """Return four factors, one a foot, over their geometric mean, (4,); ones stay ones to the last bit."""
    return np.divide(factors, np.exp(np.mean(np.log(factors))))


def of_foot(points: ContactPoints, values, effect: str) -> np.ndarray:
    """Return four values, one a foot, spread over the points: (n,), in the points' dtype."""
    return np.array(values, points.K_N.dtype)[foot_numbers(points, effect)]
