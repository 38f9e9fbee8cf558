"""Main impacts at given instants, as tests of what is made of them ask for."""

from __future__ import annotations

import numpy as np

from rockref.measure.signals.impacts import Impacts


def struck(*times: float, sign: int = 1) -> Impacts:
    """Impacts at these times, to and fro, of which nothing else is known."""
    nothing = np.zeros(len(times))
    signs = sign * (-1) ** np.arange(len(times))
    return Impacts(np.array(times, float), signs, nothing, nothing, nothing.astype(int))
