"""Least squares on the signals: from where the search ended to the least error.

The residual as a function of the parameters is smooth between small jumps: where the order in which two feet land
changes, the response jumps by some 0.01 deg/s. So the slopes are taken over steps that change the response by about
the noise, and where the descent ends in a dent between two jumps, each parameter is moved a long way, the others
following, and the descent begins again from the best of these places.

What is wrong early is wrong by much more later: the residual over the whole time has its valley only where everything
is nearly right. So the first descents look at the record up to the first main impact, and then further and further.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rockref.identify.candidates import STEP
from rockref.identify.genes import Space
from rockref.identify.target import Target, seen_until
from rockref.identify.unknowns import Unknowns, mean_squares, residuals

#: Change of the response that a finite difference makes, in parts of the noise (quadratic mean): first large, to see
#: over the jumps, then small. Decided: a jump is a third of the noise of 0.05 deg/s.
CHANGES = (3.0, 1.0, 0.3)
#: Least and largest finite-difference step in z, and the first one; decided: below, jumps only; above, not a slope.
SMALLEST, LARGEST, FIRST = 2e-4, 0.04, 1e-3
#: Levenberg-Marquardt: first damping, factors that are tried, most steps of one descent, least relative gain (decided).
DAMPING, FACTORS, STEPS, LEAST_GAIN = 1e-2, (0.04, 0.2, 1.0, 5.0, 25.0), 12, 1e-3
#: Factor from one row of dampings to the next one, beginning one factor above its end.
BEYOND_ALL = FACTORS[-1] * 5.0 / FACTORS[0]
#: Shifts of one unknown in a long move, how many of the best places are descended from and with how many steps, and
#: most rounds of moves. Decided: a twentieth of a range is beyond a dent, two fifths reach anywhere in three rounds.
SHIFTS, PLACES, SHORT, MOVES = (-0.4, -0.2, -0.1, -0.05, 0.05, 0.1, 0.2, 0.4), 4, 5, 4
#: How far beyond the first main impact the first descents look [s]. Decided: the impact itself, a tooth of the saw,
#: two, four, eight; each window is then some standard errors from the end of the one before, not some hundred.
WINDOWS = (0.0, 0.06, 0.15, 0.35, 0.6)
#: Long moves while the mean square is above this and each gains; within a window at most so many. Decided: 1 is the
#: noise, and a twin that was left at 1.08 ended at 1.02 so; in the first windows moves are cheap, in the later ones a
#: place is taken over that fits already.
NEARLY, WINDOW_MOVES, CHEAP_WINDOW = 1.05, 3, 0.1
#: A fit is at the noise floor below this mean square of the residual over the noise. Decided: 1 is the floor of white
#: noise; the step of 1e-5 s adds some hundredths to it, a wrong order of landings some units.
FLOOR = 1.1
#: Moves end where a round gains less than this share; decided: 4000 samples of noise scatter the mean square by 2 %.
LEAST_ROUND_GAIN = 5e-3
#: Two ends are as good as each other where their mean squares differ by less than this share; decided: that scatter.
ALIKE = 0.02


@dataclass(frozen=True)
class Effort:
    """How hard the least squares try: windows, ends of the first descents after the first main impact [s] (none, where
    the start is near); steps of one descent and rounds of long moves, at most."""

    windows: tuple[float, ...] = WINDOWS
    steps: int = STEPS
    moves: int = MOVES


@dataclass(frozen=True, eq=False)
class Polished:
    """The end of a polish.

    u : (G,) genes, theta_0 the mean over the targets;  tilts : (R,) release angle of each target [rad]
    rms : (R, 3) [rad/s] residual per target and axis up to the second main impact
    chi2 : mean square of the residual over the noise (1: at the noise floor)
    z : (Z,) the unknowns in [0, 1];  jacobian : (M, Z) of the scaled residual there;  names : of its columns
    alike : (K, Z) where other descents ended that are as good but for `ALIKE`: dents that the data do not tell apart
    """

    u: np.ndarray
    tilts: np.ndarray
    rms: np.ndarray
    chi2: float
    z: np.ndarray
    jacobian: np.ndarray
    names: tuple[str, ...]
    alike: np.ndarray

    @property
    def at_floor(self) -> bool:
        """Whether the residual is the noise."""
        return self.chi2 < FLOOR


@dataclass(frozen=True, eq=False)
class _Place:
    """Where a descent stands: unknowns, residual, mean square."""

    z: np.ndarray
    r: np.ndarray
    chi2: float


class _Descent:
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
        self.ends: list[_Place] = []

    def residuals(self, zs: np.ndarray) -> np.ndarray:
        return residuals(self.unknowns.space, self.unknowns.targets, zs, self.step, self.workers)

    def place(self, z: np.ndarray) -> _Place:
        r = self.residuals(z[None])
        return _Place(z, r[0], float(mean_squares(r)[0]))

    def jacobian(self, z: np.ndarray, h: np.ndarray) -> np.ndarray:
        """(M, Z) by central differences over h (Z,), one-sided at the end of a range."""
        up, down = np.minimum(z + h, 1.0), np.maximum(z - h, 0.0)
        rs = self.residuals(np.concatenate([z + np.diag(up - z), z - np.diag(z - down)]))
        return np.nan_to_num((rs[: len(z)] - rs[len(z) :]) / (up - down)[:, None]).T

    def slopes(self, z: np.ndarray, change: float, h: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
        """Jacobian (M, Z) over steps that change the response by `change`, and those steps (Z,)."""
        if h is None:
            h = np.full(len(z), FIRST)
            h = _steps(self.jacobian(z, h), change)
        J = self.jacobian(z, h)
        return J, _steps(J, change)

    def descend(self, at: _Place, change: float, steps: int | None = None) -> _Place:
        """Levenberg-Marquardt from `at`, five dampings a step side by side."""
        damping, J, h = DAMPING, None, None
        for _ in range(self.steps if steps is None else steps):
            if J is None:
                J, h = self.slopes(at.z, change, h)
            trials = np.array([damped_step(J, at.r, at.z, damping * f) for f in FACTORS])
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
            at, J = _Place(trials[k], rs[k], float(chi2[k])), None
            self.report(at.chi2)
            if gain < LEAST_GAIN:
                break
        self.ends.append(at)
        return at

    def long_moves(self, at: _Place) -> _Place:
        """Each unknown moved a long way, alone and with the others following; a short descent from the best places."""
        J, _ = self.slopes(at.z, CHANGES[1])
        trials = np.array([z for i in range(len(at.z)) for shift in SHIFTS for z in _moved(J, at, i, shift)])
        chi2 = mean_squares(self.residuals(trials))
        best = at
        for k in np.argsort(chi2)[:PLACES]:
            end = self.descend(self.place(trials[k]), CHANGES[1], SHORT)
            best = end if end.chi2 < best.chi2 else best
        return best


def polish(
    space: Space,
    targets: Sequence[Target],
    u: np.ndarray,
    step: float = STEP,
    workers: int | None = None,
    report: Callable[[float], None] | None = None,
    z: bool = False,
    effort: Effort = Effort(),  # noqa: B008 - frozen
) -> Polished:
    """Least squares within the ranges, from the chromosome u (G,), or with `z` from the unknowns u (Z,).

    report : called with the mean square after each gain.
    """
    unknowns = Unknowns(space, targets)
    start = np.clip(np.asarray(u, float) if z else unknowns.z(np.asarray(u, float)), 0.0, 1.0)
    for after in effort.windows:
        seen = [seen_until(t, after) for t in targets]
        short = _Descent(Unknowns(space, seen), step, workers, report, effort.steps)
        start = _in_window(short, start, after if effort.moves else CHEAP_WINDOW).z
    descent = _Descent(unknowns, step, workers, report, effort.steps)
    at = descent.place(start)
    for change in CHANGES:
        at = descent.descend(at, change)
    for _ in range(effort.moves):
        before = at.chi2
        if before < NEARLY:
            break
        at = descent.descend(descent.long_moves(at), CHANGES[2])
        if at.chi2 > (1 - LEAST_ROUND_GAIN) * before:
            break
    alike = [end.z for end in descent.ends if end.chi2 < (1 + ALIKE) * at.chi2]
    return _result(unknowns, at, descent.slopes(at.z, CHANGES[1])[0], np.array(alike))


def _in_window(descent: _Descent, z: np.ndarray, after: float) -> _Place:
    """The end of the descents that look no further than `after` [s] beyond the first main impact."""
    at = descent.place(z)
    for change in CHANGES[:2]:
        at = descent.descend(at, change)
    for _ in range(WINDOW_MOVES if after < CHEAP_WINDOW else 0):
        before = at.chi2
        if before < NEARLY:
            break
        at = descent.descend(descent.long_moves(at), CHANGES[1])
        if at.chi2 > (1 - ALIKE) * before:
            break
    return at


def _steps(J: np.ndarray, change: float) -> np.ndarray:
    size = np.sqrt(np.mean(np.square(J), axis=0))
    return np.clip(change / np.where(size > 0, size, 1e-30), SMALLEST, LARGEST)


def damped_step(J: np.ndarray, r: np.ndarray, z: np.ndarray, damping: float) -> np.ndarray:
    """The damped step, along free directions only: an unknown that would leave its range stays at the end of it."""
    free = np.ones(len(z), bool)
    d = np.zeros(len(z))
    for _ in range(len(z)):
        A = J[:, free].T @ J[:, free]
        d = np.zeros(len(z))
        d[free] = np.linalg.solve(A + damping * np.diag(np.diag(A)) + _ridge(A), -J[:, free].T @ r)
        out = ((z + d < 0) & (z <= 0)) | ((z + d > 1) & (z >= 1))
        if not np.any(out & free):
            break
        free &= ~out
    return np.clip(z + d, 0.0, 1.0)


def _moved(J: np.ndarray, at: _Place, i: int, shift: float) -> list[np.ndarray]:
    """z with unknown i shifted: alone, and with the others where the slopes say that they follow (at most a tenth)."""
    alone = at.z.copy()
    alone[i] = np.clip(alone[i] + shift, 0.0, 1.0)
    others = np.arange(len(at.z)) != i
    A = J[:, others].T @ J[:, others]
    follow = np.linalg.solve(
        A + 1e-4 * np.diag(np.diag(A)) + _ridge(A), -J[:, others].T @ (at.r + J[:, i] * (alone[i] - at.z[i]))
    )
    together = alone.copy()
    together[others] = np.clip(together[others] + np.clip(follow, -0.1, 0.1), 0.0, 1.0)
    return [alone, together]


def _ridge(A: np.ndarray) -> np.ndarray:
    """What keeps the solution of A x = b finite where an unknown does nothing."""
    return (1e-12 * np.trace(A) + 1e-30) * np.eye(len(A))


def _result(unknowns: Unknowns, at: _Place, J: np.ndarray, alike: np.ndarray) -> Polished:
    space, targets = unknowns.space, unknowns.targets
    rms, first = [], 0
    for target in targets:
        n = 3 * int(np.searchsorted(target.t, target.until))
        part = at.r[first : first + n].reshape(3, -1)
        rms.append(np.sqrt(np.mean(np.square(part), axis=1)) * target.gyro.noise)
        first += n
    values = unknowns.in_units(at.z)[0][len(unknowns.shared) :]
    tilts = np.array([t.tilt for t in targets]) + values - space.model.parameters.theta_0
    u = unknowns.chromosome(at.z, 0)
    u[unknowns.tilt_gene] = np.mean(at.z[len(unknowns.shared) :])
    return Polished(u, tilts, np.array(rms), at.chi2, at.z, J, unknowns.names, alike)


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
