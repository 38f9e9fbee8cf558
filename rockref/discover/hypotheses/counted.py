"""One number of a model that is to be found: how it is set, its prior, its bounds, and the step of its derivative."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rockref.api import Model


@dataclass(frozen=True)
class Parameter:
    """One number to be found. z = 0 is its centre, z = +-1 one prior standard deviation away.

    set(model, value) -> model, for run `run` or for all (None); value = centre * exp(spread z) if `log`, else
    centre + spread z. step: of the finite difference, in z. prior: standard deviation in z (inf for none).
    """

    name: str
    set: Callable[[Model, float], Model]
    centre: float
    spread: float
    log: bool = False
    run: int | None = None
    step: float = 0.05
    prior: float = 1.0
    low: float = -np.inf
    high: float = np.inf
    unit: str = ""

    def value(self, z: float) -> float:
        """Return the number at z."""
        v = self.centre * np.exp(self.spread * z) if self.log else self.centre + self.spread * z
        return float(min(max(v, self.low), self.high))

    @property
    def most(self) -> float:
        """Return z at which the upper bound is reached; further up nothing changes, and a derivative sees nothing."""
        ratio = self.high / self.centre if self.log else self.high - self.centre
        return float((np.log(ratio) if self.log else ratio) / self.spread)

    @property
    def least(self) -> float:
        """Return z at which the lower bound is reached; further down nothing changes."""
        if self.log:
            return float(np.log(self.low / self.centre) / self.spread) if self.low > 0 else -np.inf
        return (self.low - self.centre) / self.spread
