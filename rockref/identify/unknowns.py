"""What the least squares adapt: the genes that all runs share, and a release angle for each run; and the residual."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rockref.identify.candidates import STEP, releases
from rockref.identify.genes import Space
from rockref.identify.target import Target

#: Longest move of an unknown for a slope, in parts of its range, and of one that is searched by its logarithm. Decided:
#: a hundredth is one last digit of the heights and of the diagonal, beyond which the valley bends; a tenth changes a
#: friction by 17 %, which the residual hardly sees.
REACH, REACH_LOGARITHMIC = 0.01, 0.1


@dataclass(frozen=True, eq=False)
class Unknowns:
    """z (Z,) in [0, 1]: shared genes without theta_0, then one release angle for each target, in u of the gene
    theta_0."""

    space: Space
    targets: Sequence[Target]

    @property
    def shared(self) -> list[int]:
        """Return indices of the genes that all targets share."""
        return [i for i, name in enumerate(self.space.names) if name != "theta_0"]

    @property
    def tilt_gene(self) -> int:
        """Return index of the gene theta_0."""
        return self.space.names.index("theta_0")

    @property
    def names(self) -> tuple[str, ...]:
        """Return names of the unknowns."""
        return (*(self.space.names[i] for i in self.shared), *(f"theta_0 of {t.name}" for t in self.targets))

    @property
    def reach(self) -> np.ndarray:
        """Return how far a finite difference moves an unknown at most, (Z,)."""
        logarithmic = {gene.name: gene.logarithmic for gene in self.space.genes}
        return np.array([REACH_LOGARITHMIC if logarithmic.get(name, False) else REACH for name in self.names])

    @property
    def moves(self) -> list[list[tuple[int, slice]]]:
        """Return which unknowns one simulation of each target moves for the slopes, with the rows that they change.

        Each shared gene alone, all release angles together: a target has rows of its own (A. R. Curtis, M. J. D. Powell
        and J. K. Reid, On the estimation of sparse Jacobian matrices, IMA J. Appl. Math. 13, 117-119, 1974).
        """
        edges = np.cumsum([0, *(3 * int(np.searchsorted(t.t, t.until)) for t in self.targets)])
        n, rows = len(self.shared), map(slice, edges[:-1], edges[1:])
        return [[(i, slice(None))] for i in range(n)] + [[(n + k, own) for k, own in enumerate(rows)]]

    def chromosome(self, z: np.ndarray, k: int) -> np.ndarray:
        """Return the chromosome (G,) of target k."""
        u = np.empty(len(self.space.genes))
        u[self.shared] = z[: len(self.shared)]
        u[self.tilt_gene] = z[len(self.shared) + k]
        return u

    def z(self, u: np.ndarray) -> np.ndarray:
        """Return the unknowns of a chromosome (G,): every target has its release angle."""
        return np.concatenate((u[self.shared], np.full(len(self.targets), u[self.tilt_gene])))

    def in_units(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return values of the unknowns and d(value)/dz, (Z,) each, in the genes' units."""
        n = len(self.shared)
        slopes, values = np.empty(len(z)), np.empty(len(z))
        for k in range(len(self.targets)):
            u = self.chromosome(z, k)
            s, v = self.space.slopes(u), self.space.values(u)
            slopes[:n], values[:n] = s[self.shared], v[self.shared]
            slopes[n + k], values[n + k] = s[self.tilt_gene], v[self.tilt_gene]
        return values, slopes


def residuals(
    space: Space, targets: Sequence[Target], zs: np.ndarray, step: float = STEP, workers: int | None = None
) -> np.ndarray:
    """Return (B, M) simulated minus recorded crv over the noise, up to the second main impact, for unknowns zs (B, Z).

    Target by target, axis by axis; NaN where a run is lost. Rows that differ in the release angle of another target
    alone are one simulation of this one.
    """
    unknowns, columns = Unknowns(space, targets), []
    every = [np.array([unknowns.chromosome(z, k) for z in zs]) for k in range(len(targets))]
    distinct, which = zip(*(np.unique(u, axis=0, return_inverse=True) for u in every), strict=True)
    runs = releases(space, targets, [list(u) for u in distinct], step, workers, [t.residual_duration for t in targets])
    for target, (t, crv), rows in zip(targets, runs, which, strict=True):
        n = int(np.searchsorted(target.t, target.until))
        seen = np.stack([[np.interp(target.t[:n], t, run[:, j]) for j in range(3)] for run in crv])
        columns.append(((seen - target.crv[:n].T) / target.gyro.noise).reshape(len(crv), -1)[rows.ravel()])
    return np.concatenate(columns, axis=-1)


def mean_squares(r: np.ndarray) -> np.ndarray:
    """Return mean square (B,) of residuals (B, M); infinite where a run is lost."""
    return np.nan_to_num(np.mean(np.square(r), axis=1), nan=np.inf)


def signal_costs(space: Space, targets: Sequence[Target], step: float, zs: Sequence[np.ndarray]) -> list[float]:
    """Return mean square of the residual over the noise, (B,) of unknowns zs (B, Z); lost runs count as very wrong
    ones."""
    costs = mean_squares(residuals(space, targets, np.asarray(zs), step, workers=1))
    return [float(c) for c in np.minimum(costs, 1e12)]
