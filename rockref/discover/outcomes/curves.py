"""The likelihood over the size of each candidate: a curve through noisy values at the sizes that were run."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from rockref.discover.outcomes.candidates import Candidate
from rockref.discover.outcomes.likelihood import Likelihood

#: Nats below the best size by which a size loses half its weight in the shared curve, and from which it is left out of
#: a local one; decided: at `TEMPERATURE` a size is then out by three standard deviations.
FAR = 10.0
#: Nats by which the best size must beat the baseline for a curve of its own; decided: twice what the luck of few runs
#: gained at most, at the best of forty sizes, where nothing was hidden.
STRONG = 32.0
#: Sizes through which a local curve goes at least: those that determine a parabola.
LEAST = 3


@dataclass(frozen=True, eq=False)
class Profile:
    """A candidate at its sizes: z (k,) in typical sizes, rising, without zero, and the likelihood at each."""

    candidate: Candidate
    z: np.ndarray
    at: tuple[Likelihood, ...]


class Tried(NamedTuple):
    """A candidate at all its sizes: z (k,) with zero, rising, the likelihood at each, their sums (k,) [nat]."""

    z: np.ndarray
    at: tuple[Likelihood, ...]
    level: np.ndarray

    @property
    def best(self) -> int:
        """Return the position of the most probable size."""
        return int(np.argmax(self.level))

    def near(self) -> slice:
        """Return the sizes about the best one down to `FAR` nats, without gaps; at least `LEAST`, where there are."""
        first = last = self.best
        inside = self.level > self.level[self.best] - FAR
        while first > 0 and inside[first - 1]:
            first -= 1
        while last < len(self.z) - 1 and inside[last + 1]:
            last += 1
        if last - first + 1 < LEAST:
            first = min(max(self.best - 1, 0), max(len(self.z) - LEAST, 0))
            last = min(first + LEAST, len(self.z)) - 1
        return slice(first, last + 1)


@dataclass(frozen=True, eq=False)
class Curves:
    """Parabolas over the sizes of all candidates.

    Few runs estimate each likelihood with an error of some nats, and the largest of many would be an error. So one
    least-squares fit goes through all sizes of all candidates, with one value at zero, the baseline; a size at which
    the outcomes are by `FAR` nats less probable than at the best one counts half.

    A likelihood that changes by more than `STRONG` nats is no parabola from zero to its best size. Such a candidate has
    a parabola of its own, through the sizes about its best one (`Tried.near`), and says nothing about the others.

    fitted : (n,) which tests say what sizes are near, for held-out tests as well
    """

    null: Likelihood
    profiles: tuple[Profile, ...]
    fitted: np.ndarray

    def tried(self, k: int) -> Tried:
        """Return candidate k at all its sizes."""
        p = self.profiles[k]
        order = np.argsort([0.0, *p.z])
        z, at = np.array([0.0, *p.z])[order], tuple((self.null, *p.at)[i] for i in order)
        return Tried(z, at, self._level(at))

    @cached_property
    def strong(self) -> frozenset[int]:
        """Return the candidates whose best size beats the baseline by more than `STRONG` nats."""
        zero = self._level((self.null,))[0]
        return frozenset(k for k in range(len(self.profiles)) if self.tried(k).level.max() > zero + STRONG)

    def reach(self, k: int) -> tuple[float, float]:
        """Return the sizes between which candidate k may lie: a strong one by those next to the near ones; else all."""
        z, _, _ = tried = self.tried(k)
        near = tried.near() if k in self.strong else slice(0, len(z))
        return float(z[max(near.start - 1, 0)]), float(z[min(near.stop, len(z) - 1)])

    def sums(self, part: str, tests: np.ndarray, k: int | None, z: Any) -> np.ndarray:
        """Return the sums over some tests of one part of the likelihood, (q, ...), of candidate k at sizes z."""
        found = self._local(part, tests, k) if k in self.strong else self._shared(part, tests, k)
        sizes = np.asarray(z)[..., None]
        return np.moveaxis(found[0] + sizes * found[1] + sizes**2 * found[2], -1, 0)

    def _level(self, at: tuple[Likelihood, ...]) -> np.ndarray:
        return np.array([one.measured[:, self.fitted].sum() for one in at])

    def _local(self, part: str, tests: np.ndarray, k: int | None) -> np.ndarray:
        """Return the coefficients (3, q) of candidate k, strong, from constant to square."""
        assert k is not None  # the baseline is never strong
        tried = self.tried(k)
        near = tried.near()
        known = np.array([getattr(one, part)[:, tests].sum(axis=1) for one in tried.at[near]])
        design = np.vander(tried.z[near], LEAST, increasing=True)
        return np.linalg.lstsq(design, known, rcond=None)[0]

    def _shared(self, part: str, tests: np.ndarray, k: int | None) -> np.ndarray:
        """Return the coefficients (3, q) of candidate k, not strong, or of the baseline (None)."""
        quiet = [c for c in range(len(self.profiles)) if c not in self.strong]
        rows = [(self.null, 0, 0.0), *((one, c, x) for c, i in enumerate(quiet)
                for one, x in zip(self.profiles[i].at, self.profiles[i].z, strict=True))]  # fmt: skip
        known = np.array([getattr(one, part)[:, tests].sum(axis=1) for one, _, _ in rows])
        level = self._level(tuple(one for one, _, _ in rows))
        root = 1.0 / np.sqrt(1.0 + ((level.max() - level) / FAR) ** 2)[:, None]
        design = np.zeros((len(rows), 1 + 2 * len(quiet)))
        design[:, 0] = 1.0
        for row, (_, c, x) in zip(design, rows, strict=True):
            row[1 + 2 * c : 3 + 2 * c] = x, x * x
        found = np.linalg.lstsq(root * design, root * known, rcond=None)[0]
        if k is None:
            return np.array([found[0], 0 * found[0], 0 * found[0]])
        c = quiet.index(k)
        return found[[0, 1 + 2 * c, 2 + 2 * c]]
