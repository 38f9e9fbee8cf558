"""Least squares on the signals: from where the search ended to the least error, with the Fisher information of the end.

The residual is the difference of the recorded and the simulated crv, up to the second main impact, over the noise of a
sample. Every target has a release angle of its own, since the wire lets go a little differently each time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rockref.identify.candidates import STEP, releases
from rockref.identify.genes import Space
from rockref.identify.target import Target

#: Finite-difference step in u. Decided: the response has small jumps (0.01 deg/s) where the order of two landings
#: changes; a step of 1/2000 of the range, some tenths of the last digit of Table 3.1, sees the slope across them.
DIFFERENCE = 5e-4
#: Levenberg-Marquardt: first damping, factors down and up, most steps, least relative gain (all decided; usual values).
DAMPING, DOWN, UP, STEPS, LEAST_GAIN = 1e-2, 0.2, 5.0, 40, 1e-5


@dataclass(frozen=True, eq=False)
class Polished:
    """The end of a polish.

    u : (G,) genes, theta_0 the mean over the targets;  tilts : (R,) release angle of each target [rad]
    rms : (R, 3) [rad/s] residual per target and axis up to the second main impact
    chi2 : mean square of the residual over the noise (1: at the noise floor)
    z : (Z,) the unknowns in [0, 1];  jacobian : (M, Z) of the scaled residual there;  names : of its columns
    steps : made
    """

    u: np.ndarray
    tilts: np.ndarray
    rms: np.ndarray
    chi2: float
    z: np.ndarray
    jacobian: np.ndarray
    names: tuple[str, ...]
    steps: int


@dataclass(frozen=True, eq=False)
class Unknowns:
    """z = shared genes without theta_0, then one release angle for each target, in u of the gene theta_0."""

    space: Space
    targets: Sequence[Target]

    @property
    def shared(self) -> list[int]:
        return [i for i, name in enumerate(self.space.names) if name != "theta_0"]

    @property
    def tilt_gene(self) -> int:
        return self.space.names.index("theta_0")

    @property
    def names(self) -> tuple[str, ...]:
        return (*(self.space.names[i] for i in self.shared), *(f"theta_0 of {t.name}" for t in self.targets))

    def chromosome(self, z: np.ndarray, k: int) -> np.ndarray:
        u = np.empty(len(self.space.genes))
        u[self.shared] = z[: len(self.shared)]
        u[self.tilt_gene] = z[len(self.shared) + k]
        return u

    def z(self, u: np.ndarray) -> np.ndarray:
        """The unknowns of a chromosome: every target has its release angle."""
        return np.concatenate((u[self.shared], np.full(len(self.targets), u[self.tilt_gene])))


def residuals(
    space: Space, targets: Sequence[Target], zs: np.ndarray, step: float = STEP, workers: int | None = None
) -> np.ndarray:
    """(B, M) difference of simulated and recorded crv over the noise, for unknowns zs (B, Z); NaN: a run is lost."""
    unknowns, columns = Unknowns(space, targets), []
    for k, target in enumerate(targets):
        t, crv = releases(space, target, [unknowns.chromosome(z, k) for z in zs], step, workers)
        n = int(np.searchsorted(target.t, target.until))
        seen = np.stack([[np.interp(target.t[:n], t, crv[b, :, j]) for j in range(3)] for b in range(len(zs))])
        columns.append(((seen - target.crv[:n].T) / target.gyro.noise).reshape(len(zs), -1))
    return np.concatenate(columns, axis=-1)


def signal_costs(space: Space, targets: Sequence[Target], step: float, zs: Sequence[np.ndarray]) -> list[float]:
    """Mean square of the residual over the noise, (B,) of unknowns zs (B, Z); lost runs count as very wrong ones."""
    r = residuals(space, targets, np.asarray(zs), step, workers=1)
    return [float(c) for c in np.nan_to_num(np.einsum("bm,bm->b", r, r) / r.shape[1], nan=1e12)]


def polish(
    space: Space,
    targets: Sequence[Target],
    u: np.ndarray,
    step: float = STEP,
    workers: int | None = None,
    report: Callable[[int, float], None] | None = None,
    steps: int = STEPS,
    z: bool = False,
) -> Polished:
    """Levenberg-Marquardt within the ranges, from the chromosome u (G,), or with `z` from the unknowns u (Z,).

    report : called with (step, chi2) after each step.
    """
    unknowns = Unknowns(space, targets)
    start = np.asarray(u, float) if z else unknowns.z(np.asarray(u, float))
    return _fitted(unknowns, start, step, workers, report, steps)


def _fitted(unknowns: Unknowns, z: np.ndarray, step: float, workers: int | None, report, steps: int) -> Polished:
    space, targets = unknowns.space, unknowns.targets
    r = residuals(space, targets, z[None], step, workers)[0]
    cost, damping, made = float(r @ r), DAMPING, 0
    J = _jacobian(space, targets, z, step, workers)
    while made < steps:
        made += 1
        trials = [_step(J, r, z, damping * UP**k) for k in (-1, 0, 1, 2)]
        rs = residuals(space, targets, np.array(trials), step, workers)
        costs = np.nan_to_num(np.einsum("bm,bm->b", rs, rs), nan=np.inf)
        best = int(np.argmin(costs))
        if not costs[best] < cost:
            if damping > 1e6:
                break
            damping *= UP**3
            continue
        gain = 1 - costs[best] / cost
        z, r, cost = trials[best], rs[best], float(costs[best])
        damping = max(1e-9, damping * UP ** (best - 1) * DOWN)
        J = _jacobian(space, targets, z, step, workers)
        if report is not None:
            report(made, cost / len(r))
        if gain < LEAST_GAIN:
            break
    return _result(unknowns, z, r, J, made)


def _jacobian(space: Space, targets: Sequence[Target], z: np.ndarray, step: float, workers: int | None) -> np.ndarray:
    """(M, Z) by central differences, one-sided at the end of a range."""
    up, down = np.minimum(z + DIFFERENCE, 1.0), np.maximum(z - DIFFERENCE, 0.0)
    zs = np.concatenate([z + np.diag(up - z), z - np.diag(z - down)])
    rs = residuals(space, targets, zs, step, workers)
    return np.nan_to_num((rs[: len(z)] - rs[len(z) :]) / (up - down)[:, None]).T


def _step(J: np.ndarray, r: np.ndarray, z: np.ndarray, damping: float) -> np.ndarray:
    """The damped step, along free directions only: an unknown that would leave its range stays at the end of it."""
    free = np.ones(len(z), bool)
    for _ in range(len(z)):
        A = J[:, free].T @ J[:, free]
        d = np.zeros(len(z))
        d[free] = np.linalg.solve(A + damping * np.diag(np.diag(A) + 1e-12 * np.trace(A) + 1e-30), -J[:, free].T @ r)
        out = ((z + d < 0) & (z <= 0)) | ((z + d > 1) & (z >= 1))
        if not np.any(out & free):
            break
        free &= ~out
    return np.clip(z + d, 0.0, 1.0)


def _result(unknowns: Unknowns, z: np.ndarray, r: np.ndarray, J: np.ndarray, made: int) -> Polished:
    space, targets = unknowns.space, unknowns.targets
    rms, at = [], 0
    for target in targets:
        n = 3 * int(np.searchsorted(target.t, target.until))
        rms.append(np.sqrt(np.mean(np.square(r[at : at + n].reshape(3, -1)), axis=1)) * target.gyro.noise)
        at += n
    values = np.array([space.values(unknowns.chromosome(z, k))[unknowns.tilt_gene] for k in range(len(targets))])
    tilts = np.array([t.tilt for t in targets]) + values - space.model.parameters.theta_0
    u = unknowns.chromosome(z, 0)
    u[unknowns.tilt_gene] = np.mean(z[len(unknowns.shared) :])
    return Polished(u, tilts, np.array(rms), float(r @ r) / len(r), z, J, unknowns.names, made)


def with_genes(space: Space, polished: Polished) -> dict[str, float]:
    """Values of the polished genes by name, in their units; theta_0 is the mean over the targets."""
    return dict(zip(space.names, map(float, space.values(polished.u)), strict=True))


def narrowed(space: Space, u: np.ndarray, share: float) -> Space:
    """The same genes with ranges of `share` of the width about u, inside the old ones."""
    genes = []
    for i, g in enumerate(space.genes):
        low, high = (float(space.values(np.clip(u + s * share / 2, 0, 1))[i]) for s in (-1, 1))
        genes.append(replace(g, low=low, high=high))
    return replace(space, genes=tuple(genes))
