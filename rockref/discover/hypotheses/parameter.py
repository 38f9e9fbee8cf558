"""One number of a model that a fit finds: how it is set, and its prior."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.special import ndtr, ndtri

from rockref.api import Model

#: Deviations beyond which a bounded number comes no nearer to its bounds; decided: 99.95 % of the prior lies within.
FARTHEST = 3.5


@dataclass(frozen=True)
class Parameter:
    """One number to be found, counted in prior deviations z: each z has a standard normal prior.

    scale : linear, centre + spread z;  log, centre exp(spread z);  uniform and log_uniform,
        every value (or logarithm) between low and high is alike a priori; the normal distribution
        function of z gives the share of the way.
    set(model, value) -> model, for run `run` or for all (None).  typical : z of one typical size of an effect, else 0.
    low, high : hard limits.  moves_target : whether the number changes what the run listens to.  by_ratio : whether it
    is one of an effect's factors that only act by their ratios.  drawn : values between which starts over the whole
    prior draw a number of an effect, if they do.  reach : by how much farther than others a step may take it: of a
    number that is typically none the prior is narrow.  form : whether it turns one form of a law into another one.
    """

    name: str
    set: Callable[[Model, float], Model]
    centre: float
    spread: float = 1.0
    scale: str = "linear"
    run: int | None = None
    low: float = -np.inf
    high: float = np.inf
    typical: float = 0.0
    one_sided: bool = False
    unit: str = ""
    moves_target: bool = False
    by_ratio: bool = False
    drawn: tuple[float, float] | None = None
    reach: float = 1.0
    form: bool = False

    @property
    def effect(self) -> str:
        """Return the id of the effect that the number belongs to; empty for the law's own."""
        head, dot, _ = self.name.partition(".")
        return head if dot else ""

    @property
    def kind(self) -> str:
        """Return the name without the run: numbers of one kind stand in as many runs."""
        return self.name.partition("[")[0]

    def value(self, z: float) -> float:
        """Return the number at z."""
        if self.scale == "linear":
            v = self.centre + self.spread * z
        elif self.scale == "log":
            v = self.centre * np.exp(np.clip(self.spread * z, -50.0, 50.0))
        else:
            share = float(ndtr(min(max(z, -FARTHEST), FARTHEST)))
            if self.scale == "uniform":
                return float(self.low + (self.high - self.low) * share)
            return float(self.low * (self.high / self.low) ** share)
        return float(min(max(v, self.low), self.high))

    def z_of(self, value: float) -> float:
        """Return the z at which the number has this value."""
        if self.scale == "linear":
            return float((value - self.centre) / self.spread)
        if self.scale == "log":
            return float(np.log(max(value, 1e-300) / self.centre) / self.spread)
        if self.scale == "uniform":
            share = (value - self.low) / (self.high - self.low)
        else:
            share = np.log(max(value, 1e-300) / self.low) / np.log(self.high / self.low)
        edge = float(ndtr(-FARTHEST))
        return float(ndtri(min(max(share, edge), 1 - edge)))

    @cached_property
    def most(self) -> float:
        """Return z above which nothing changes."""
        return FARTHEST if "uniform" in self.scale else self.z_of(self.high) if np.isfinite(self.high) else np.inf

    @cached_property
    def least(self) -> float:
        """Return z below which nothing changes."""
        if "uniform" in self.scale:
            return -FARTHEST
        if not np.isfinite(self.low) or (self.scale == "log" and self.low <= 0):
            return -np.inf
        return self.z_of(self.low)


def centring(parameters: Sequence[Parameter]) -> np.ndarray:
    """Return the matrix (G, G) that takes the mean off the z of an effect's factors that only act by their ratios.

    These share a scale and a spread: the mean of their z at zero holds their geometric mean at one.
    """
    matrix = np.eye(len(parameters))
    for effect in dict.fromkeys(p.effect for p in parameters if p.by_ratio):
        rows = [k for k, p in enumerate(parameters) if p.by_ratio and p.effect == effect]
        matrix[np.ix_(rows, rows)] -= 1 / len(rows)
    return matrix
