"""Levenberg-Marquardt on rough ground.

The residual as a function of the parameters is smooth between small jumps: where the order in which two feet land
changes, the response jumps by some 0.01 deg/s. So the slopes are taken over steps that change the response by about
the noise.

The step of the simulation leaves a mark of half the noise, which a slightly different block would cancel. It is taken
out by defect correction (H. J. Stetter, The defect correction principle and discretization methods, Numerische
Mathematik 29, 425-443, 1978): what the step does to the response is computed at one place with a finer step, and taken
off everywhere near it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from rockref.identify.candidates import STEP
from rockref.identify.unknowns import Unknowns, mean_squares, residuals

#: Change of the response that a finite difference makes, in parts of the noise (quadratic mean): first large, to see
#: over the jumps, then small. Decided: a jump is a third of the noise of 0.05 deg/s.
CHANGES = (3.0, 1.0, 0.3)
#: Least and largest finite-difference step in z, and the first one; decided: below, jumps only; above, not a slope.
SMALLEST, LARGEST, FIRST = 2e-4, 0.04, 1e-3
#: Levenberg-Marquardt: first damping, factors that are tried, most steps of one descent, least relative gain (decided).
DAMPING, FACTORS, STEPS, LEAST_GAIN = 1e-2, (0.04, 0.2, 1.0, 5.0, 25.0), 12, 1e-3
#: Moves and walks go on while the mean square is above this and each gains. Decided: 1 is the noise, which scatters by
#: 2 %; what lies twice as far above it is a dent that a move can leave.
NEARLY = 1.05
#: Part of the step with which its mark is computed. Decided: at eight places about Table 3.1 the mark is 0.06 to 0.6 of
#: the noise; half the step gives it to 0.5, a quarter to 0.2, for both bring other orders of landings.
FINER = 8
#: Largest mark, quadratic mean in parts of the noise, that is taken off. Decided: a twin whose walk began at a place
#: with a mark of 1.4 could not come below 3.7 times the noise; near the truth it is half as large.
LARGEST_DEFECT = 1.0
#: Factor from one row of dampings to the next one, beginning one factor above its end.
BEYOND_ALL = FACTORS[-1] * 5.0 / FACTORS[0]


@dataclass(frozen=True, eq=False)
class Place:
    """Where a descent stands: unknowns, residual, mean square."""

    z: np.ndarray
    r: np.ndarray
    chi2: float


class Descent:
    """The functions that a polish shares: residuals and slopes of one problem."""

    def __init__(
        self,
        unknowns: Unknowns,
        step: float = STEP,
        workers: int | None = None,
        report: Callable[[float], None] | None = None,
        steps: int = STEPS,
    ):
        self.unknowns, self.step, self.workers, self.steps = unknowns, step, workers, steps
        self.report = report or (lambda chi2: None)
        self.defect: np.ndarray | float = 0.0

    def residuals(self, zs: np.ndarray) -> np.ndarray:
        return self.with_step(zs, self.step) + self.defect

    def correct(self, z: np.ndarray) -> bool:
        """Take off all residuals from here on what the step does at z (Z,).

        Where that is too much, it holds at z alone: nothing is taken off, and False returned.
        """
        whole, finer = (self.with_step(z[None], step)[0] for step in (self.step, self.step / FINER))
        # The scheme is of first order where points land: what is left at a part of the step is that part of it.
        defect = (finer - whole) * FINER / (FINER - 1)
        holds = bool(np.sqrt(np.mean(np.square(defect))) < LARGEST_DEFECT)
        self.defect = defect if holds else 0.0
        return holds

    def with_step(self, zs: np.ndarray, step: float) -> np.ndarray:
        """Return residuals (B, M) of zs (B, Z) by simulations with another step [s], nothing taken off."""
        return residuals(self.unknowns.space, self.unknowns.targets, zs, step, self.workers)

    def place(self, z: np.ndarray) -> Place:
        r = self.residuals(z[None])
        return Place(z, r[0], float(mean_squares(r)[0]))

    def jacobian(self, at: Place, h: np.ndarray) -> np.ndarray:
        """Return (M, Z) by central differences over h (Z,), one-sided at the end of a range."""
        z = at.z
        up, down = np.minimum(z + h, 1.0), np.maximum(z - h, 0.0)
        ups, downs = np.split(self.residuals(np.concatenate([self._moved(z, up), self._moved(z, down)])), 2)
        J = np.zeros((len(z), len(at.r)))
        for move, change in zip(self.unknowns.moves, ups - downs, strict=True):
            for i, rows in move:
                J[i, rows] = change[rows] / (up[i] - down[i])
        return np.nan_to_num(J).T

    def _moved(self, z: np.ndarray, to: np.ndarray) -> np.ndarray:
        """Return z (Z,) once for each move of the unknowns, with what it moves at its place in `to` (Z,)."""
        trials = np.repeat(z[None], len(self.unknowns.moves), axis=0)
        for trial, move in zip(trials, self.unknowns.moves, strict=True):
            for i, _ in move:
                trial[i] += to[i] - z[i]
        return trials

    def slopes(self, at: Place, change: float, h: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
        """Return Jacobian (M, Z) over steps that change the response by `change`, and those steps (Z,)."""
        if h is None:
            h = np.full(len(at.z), FIRST)
            h = _steps(self.jacobian(at, h), change)
        J = self.jacobian(at, h)
        return J, _steps(J, change)

    def descend(self, at: Place, change: float, steps: int | None = None) -> Place:
        """Return Levenberg-Marquardt from `at`, five dampings a step side by side."""
        damping, J, h = DAMPING, None, None
        for _ in range(self.steps if steps is None else steps):
            if J is None:
                J, h = self.slopes(at, change, h)
            trials = damped_steps(J, at.r, at.z, [damping * f for f in FACTORS])
            rs = self.residuals(trials)
            chi2 = mean_squares(rs)
            k = int(np.argmin(chi2))
            if not chi2[k] < at.chi2:
                if damping > 1e4:
                    break
                # The same slopes with dampings that are all larger than those that were tried.
                damping *= BEYOND_ALL
                continue
            gain = 1 - chi2[k] / at.chi2
            damping = max(1e-9, 0.3 * damping * FACTORS[k])
            at, J = Place(trials[k], rs[k], float(chi2[k])), None
            self.report(at.chi2)
            if gain < LEAST_GAIN:
                break
        return at


def _steps(J: np.ndarray, change: float) -> np.ndarray:
    size = np.sqrt(np.mean(np.square(J), axis=0))
    return np.clip(change / np.where(size > 0, size, 1e-30), SMALLEST, LARGEST)


def damped_steps(
    J: np.ndarray, r: np.ndarray, z: np.ndarray, dampings: Sequence[float], metric: np.ndarray | None = None
) -> np.ndarray:
    """Return where damped steps lead, (D, Z), along free directions only: an unknown that would leave its range stays
    at the end of it.

    metric : (Z, Z) what a damping multiplies, by default the diagonal of the information.
    """
    A, b = J.T @ J, -J.T @ r
    scale = np.diag(np.diag(A)) if metric is None else metric
    return np.array([np.clip(z + _damped(A, b, z, damping * scale), 0.0, 1.0) for damping in dampings])


def _damped(A: np.ndarray, b: np.ndarray, z: np.ndarray, damping: np.ndarray) -> np.ndarray:
    """Return one step (Z,) by normal equations A (Z, Z), b (Z,), of the unknowns that stay in their ranges."""
    free = np.ones(len(z), bool)
    d = np.zeros(len(z))
    for _ in range(len(z)):
        part = np.ix_(free, free)
        d = np.zeros(len(z))
        d[free] = np.linalg.solve(A[part] + damping[part] + ridge(A[part]), b[free])
        out = ((z + d < 0) & (z <= 0)) | ((z + d > 1) & (z >= 1))
        if not np.any(out & free):
            break
        free &= ~out
    return d


def ridge(A: np.ndarray) -> np.ndarray:
    """Return what keeps the solution of A x = b finite where an unknown does nothing."""
    return (1e-12 * np.trace(A) + 1e-30) * np.eye(len(A))
