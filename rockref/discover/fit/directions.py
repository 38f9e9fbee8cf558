"""Differences along the directions of the posterior, in which numbers that trade with each other move together.

Wide differences of single numbers leave the valley: what they see of each number bends, and numbers that undo each
other's change (a factor that all feet share, and the common damping) no longer cancel. The valley then looks narrower
than it is, and a fit stops on its slope. Differences along directions in which the posterior's covariance falls apart,
as long as the valley is wide in each, stay in it, and learn its directions anew each time. A number with a flat prior
moves by its share of the prior's range: so the valley of factors that undo each other is straight.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.special import ndtr, ndtri

from rockref.discover.fit.differences import Residuals
from rockref.discover.fit.objective import weight
from rockref.discover.hypotheses.parameter import FARTHEST, Parameter

#: Nats by which the objective is expected to rise at the ends of a difference; decided: valleys bend, and fits by
#: differences that rise by 20, 8 or 3 nats stop up to 140 nats higher, and know less of a valley's width. Across the
#: roughness of the objective, one or two nats at the longest memory, all of them see.
RISE = 56.0
#: Nats of the likelihood that count as one for the length of a direction, beside the prior, and its longest component
#: in prior deviations (decided: where the data say little, the prior keeps it short).
SOFTENED, LONGEST_END = 7.0, 1.5
#: Factor by which the width of a number may grow and the valley count as known (decided: widths are told to a fifth).
KNOWN = 1.2


@dataclass(frozen=True)
class Spread:
    """How innovations change about a fit: r (R, n, 3) there, J (G, R, n, 3) along G directions.

    moves : (G, G), the change of z that belongs to one unit of each direction, in its columns; see `moved`
    """

    moves: np.ndarray
    J: np.ndarray
    r: np.ndarray

    def information(self) -> np.ndarray:
        """Return the Gauss-Newton matrix of the data along the directions, (G, G)."""
        J = self.J.reshape(len(self.J), -1)
        return (J * weight(self.r).ravel()) @ J.T

    def prior(self) -> np.ndarray:
        """Return the matrix of the prior along the directions, (G, G)."""
        return self.moves.T @ self.moves

    def covariance(self, temperature: float) -> np.ndarray:
        """Return the covariance of z, (G, G), where the likelihood counts 1/temperature."""
        inverse = np.linalg.inv(self.information() / temperature + self.prior())
        return self.moves @ inverse @ self.moves.T

    def matrix(self) -> np.ndarray:
        """Return the Gauss-Newton matrix of the objective in z, with the prior, (G, G)."""
        back = np.linalg.inv(self.moves)
        return back.T @ self.information() @ back + np.eye(len(back))


def softened(H: np.ndarray) -> np.ndarray:
    """Return the covariance of z by a Gauss-Newton matrix with its prior, where the likelihood is softened."""
    one = np.eye(len(H))
    return np.linalg.inv((H - one) / SOFTENED + one)


def wider(covariance: np.ndarray, before: np.ndarray) -> bool:
    """Return whether some number is less certain by a covariance than it was before."""
    return bool((np.diag(covariance) > KNOWN**2 * np.diag(before)).any())


def spread_about(
    residuals: Residuals, parameters: Sequence[Parameter], z: np.ndarray, r: np.ndarray, covariance: np.ndarray
) -> Spread:
    """Return how innovations change about z (G,), where they are r, along the directions of a softened covariance."""
    together: dict[tuple[bool, int], list[Axis]] = {}
    for axis in axes(parameters, covariance):
        together.setdefault((axis.run is None, axis.rank), []).append(axis)
    ends = [np.sum([axis.end for axis in some], axis=0) for some in together.values()]
    up = [moved(parameters, z, end) for end in ends]
    down = [moved(parameters, z, -end) for end in ends]
    there = residuals.coarsely_at(parameters, [*up, *down])
    moves: list[np.ndarray] = []
    J = np.zeros((len(z), *r.shape))
    for k, some in enumerate(together.values()):
        difference, length = there[k] - there[len(ends) + k], way(parameters, z, up[k]) - way(parameters, z, down[k])
        for axis in some:
            rows = slice(None) if axis.run is None else axis.run
            J[len(moves)][rows] = difference[rows]
            moves.append(np.where(axis.end != 0.0, length, 0.0))
    return Spread(np.array(moves).T, J, r)


class Axis(NamedTuple):
    """A direction: the change of z (G,) at its end, the run whose numbers alone it moves or None, its rank among
    those."""

    end: np.ndarray
    run: int | None
    rank: int


def axes(parameters: Sequence[Parameter], covariance: np.ndarray) -> list[Axis]:
    """Return G directions along which a covariance (G, G) falls apart, as long as the valley is wide.

    Numbers of a run depend on those of another one by what all runs share alone. So the shared numbers move along the
    eigenvectors of their own covariance, and the others follow; then those of a run move along the eigenvectors of what
    is left of theirs, in all runs at once.
    """
    G, own = len(parameters), np.array([-1 if p.run is None else p.run for p in parameters])
    shared = np.flatnonzero(own < 0)
    follow = np.zeros((G, len(shared)))
    if len(shared):
        follow = np.linalg.solve(covariance[np.ix_(shared, shared)], covariance[shared]).T
    found = [Axis(shortened(follow @ v), None, k) for k, v in enumerate(along(covariance[np.ix_(shared, shared)]))]
    left = covariance - follow @ covariance[shared]
    for run in np.unique(own[own >= 0]):
        rows = np.flatnonzero(own == run)
        for k, v in enumerate(along(left[np.ix_(rows, rows)])):
            end = np.zeros(G)
            end[rows] = v
            found.append(Axis(shortened(end), int(run), k))
    return found


def along(covariance: np.ndarray) -> np.ndarray:
    """Return the ends of the directions of a covariance, in rows; none is shorter than rounding lets its length be
    known."""
    lengths, directions = np.linalg.eigh(covariance)
    least = np.finfo(float).eps * lengths.max()
    return (directions * np.sqrt(np.maximum(lengths, least) * 2 * RISE / SOFTENED)).T


def shortened(end: np.ndarray) -> np.ndarray:
    """Return an end whose longest component is no longer than LONGEST_END."""
    return end * min(1.0, LONGEST_END / np.abs(end).max())


def moved(parameters: Sequence[Parameter], z: np.ndarray, d: np.ndarray) -> np.ndarray:
    """Return z (G,) after a move d, within its limits: straight in z, and in the share of the range of a flat prior."""
    least, most = np.array([p.least for p in parameters]), np.array([p.most for p in parameters])
    flat = np.array(["uniform" in p.scale for p in parameters])
    share = np.clip(ndtr(z) + density(z) * d, ndtr(-FARTHEST), ndtr(FARTHEST))
    return np.clip(np.where(flat, ndtri(share), z + d), least, most)


def way(parameters: Sequence[Parameter], z: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Return the move d (G,) that leads from z to `end`: the inverse of `moved`."""
    flat = np.array(["uniform" in p.scale for p in parameters])
    return np.where(flat, (ndtr(end) - ndtr(z)) / density(z), end - z)


def density(z: np.ndarray) -> np.ndarray:
    """Return the standard normal density."""
    return np.exp(-0.5 * z**2) / math.sqrt(2 * math.pi)
