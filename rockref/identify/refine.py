"""The last descent: with finer steps of the simulation, along what the data see.

Two models along the valley differ by less than what the step of 1e-5 s does to a response, which differs from place to
place: a descent with that step ends in a dent of the step's own making, many standard errors from the bottom. What the
step does falls with its square in the mean square of the residual; with a fine step the valley has no dents.

Finite differences are limited from both sides: by what the step does, which has to be small beside the change of the
response, and by the bend of the valley. Parameter by parameter no length serves both, for the parameters of the valley
cancel one another to a part in a hundred. So slopes are taken along the principal axes of the information, each over a
length that changes the response by about the noise, and damped in those axes (J. J. More, The Levenberg-Marquardt
algorithm: implementation and theory, Lecture Notes in Mathematics 630, 105-116, 1978: steps are bounded in a scaled
norm).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockref.identify.candidates import STEP
from rockref.identify.descent import FACTORS, LEAST_GAIN, Descent, Place, damped_steps, ridge
from rockref.identify.unknowns import Unknowns, mean_squares

#: Parts of the step with which slopes are taken, residuals compared, and the end is judged. Decided: at 24 places about
#: Table 3.1 the step changes the response by 0.42 of the noise (mean square), a fourth of it by 0.019, an eighth by
#: 0.004, a sixteenth by 0.0006; the truth and what is twelve standard errors from it differ by 0.03.
SLOPES, RESIDUALS, JUDGED = 4, 8, 32
#: Steps with which places are compared and judged after a descent with the step of the search [s].
COMPARED_STEP, JUDGED_STEP = STEP / RESIDUALS, STEP / JUDGED
#: Change of the response along an axis, in parts of the noise (quadratic mean), one after the other where no step
#: gains. Decided: a fourth of the step does 0.14; above 1 the bend shows.
CHANGES = (1.0, 0.5, 0.3)
#: How often slopes are taken at one place, at most. Decided: each change twice.
TRIES = 6
#: Mean square of the error of a slope over the length of its axis, in parts of the noise: half of what `SLOPES` does to
#: a response, of which a central difference has two. Least squares with slopes that err so are damped as much.
ERROR = 0.01
#: First damping; least and largest one (decided).
DAMPING, LEAST, MOST = ERROR, 1e-9, 1e2


@dataclass(frozen=True, eq=False)
class Bottom:
    """Where the last descent stands.

    place : judged with the finest step;  jacobian : (M, Z) of the residual there
    doubt : (Z, Z) what the step adds to the information J^T J of the slopes
    remainder : (Z,) the step to where the slopes say that the bottom is
    """

    place: Place
    jacobian: np.ndarray
    doubt: np.ndarray
    remainder: np.ndarray


def refine(descent: Descent, at: Place, J: np.ndarray) -> Bottom:
    """Return the bottom of the valley beside `at`, with slopes J (M, Z) there; finer steps than that of `descent`."""
    at = _place(descent, at.z, RESIDUALS)
    damping, taken = DAMPING, list[np.ndarray]()
    for _ in range(descent.steps):
        change = CHANGES[len(taken) % len(CHANGES)]
        taken.append(slopes(descent, at.z, axes(descent.unknowns, J, change)))
        # At one place all slopes are of the same thing, and what the step does to them averages out.
        J = np.mean(taken, axis=0)
        along = axes(descent.unknowns, J, change)
        best, factor = _best_step(descent, J, at, damping, along)
        gain = 1 - best.chi2 / at.chi2
        if gain > 0:
            at = best
            descent.report(at.chi2)
        if gain >= LEAST_GAIN:
            damping = float(np.clip(0.5 * damping * factor, LEAST, MOST))
            doubt, taken = _doubt(taken, along), []
            continue
        damping, doubt = DAMPING, _doubt(taken, along)
        if len(taken) == TRIES or (len(taken) > 1 and _promise(J, at) < J.shape[1] / len(J)):
            break
    end = _place(descent, at.z, JUDGED)
    return Bottom(end, J, doubt, -covariance(J, doubt) @ (J.T @ end.r))


def covariance(J: np.ndarray, doubt: np.ndarray) -> np.ndarray:
    """Return the covariance (Z, Z) of the unknowns for residuals of unit variance.

    Slopes J (M, Z) with errors show more than there is: information J^T J less `doubt` (Z, Z), inverted to first order
    in it (W. A. Fuller, Measurement Error Models, 1987, ch. 1: attenuation by errors of the regressors).
    """
    # A direction that the data do not see at all has no information; the pseudo-inverse would call it certain.
    w, v = np.linalg.eigh(J.T @ J)
    inverse = (v / np.maximum(w, 1e-12 * w[-1])) @ v.T
    return inverse + inverse @ doubt @ inverse


def _doubt(taken: list[np.ndarray], along: np.ndarray) -> np.ndarray:
    """Return what the step adds to the information of the mean of slopes (M, Z), axis by axis, (Z, Z)."""
    lengths = np.linalg.pinv(along)
    return len(taken[0]) * ERROR / len(taken) * lengths @ lengths.T


def _promise(J: np.ndarray, at: Place) -> float:
    """Return the share of the mean square that slopes J (M, Z) say can be gained."""
    A = J.T @ J
    return 1 - float(np.mean(np.square(at.r + J @ np.linalg.solve(A + ridge(A), -J.T @ at.r)))) / at.chi2


def axes(unknowns: Unknowns, J: np.ndarray, change: float) -> np.ndarray:
    """Return principal axes of the information of slopes J (M, Z), (Z, Z), a row each.

    Shared unknowns first, release angles following; then the release angles. Each as long as changes the response by
    `change`, at most as far as the reach of the unknowns.
    """
    own = np.array([i for i, _ in unknowns.moves[-1]])
    shared = np.setdiff1d(np.arange(J.shape[1]), own)
    scaled = J * unknowns.reach
    A = scaled.T @ scaled / len(J)
    alone = np.maximum(np.diag(A)[own], 1e-30)
    # The information of release angles is diagonal: a target has rows of its own.
    follow = -A[np.ix_(own, shared)] / alone[:, None]
    w, v = np.linalg.eigh(A[np.ix_(shared, shared)] + A[np.ix_(shared, own)] @ follow)
    found = np.zeros_like(A)
    n = len(shared)
    found[:n, shared] = (v * np.minimum(change / np.sqrt(np.maximum(w, 1e-30)), 1.0)).T
    found[:n, own] = found[:n, shared] @ follow.T
    found[n:, own] = np.diag(np.minimum(change / np.sqrt(alone), 1.0))
    return found * unknowns.reach


def slopes(descent: Descent, z: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Return the Jacobian (M, Z) at z (Z,) by central differences along axes (Z, Z), all release angles at once."""
    own = descent.unknowns.moves[-1]
    shared = np.setdiff1d(np.arange(len(z)), [i for i, _ in own])
    moves = np.vstack([along[: len(shared)], along[len(shared) :].sum(axis=0)])
    ups, downs = np.clip(z + moves, 0.0, 1.0), np.clip(z - moves, 0.0, 1.0)
    r = descent.with_step(np.concatenate([ups, downs]), descent.step / SLOPES)
    changes = r[: len(ups)] - r[len(ups) :]
    J = np.zeros((len(z), r.shape[1]))
    for i, rows in own:
        columns = np.append(shared, i)
        J[columns, rows] = np.linalg.pinv((ups - downs)[:, columns]) @ changes[:, rows]
    return np.nan_to_num(J).T


def _best_step(descent: Descent, J: np.ndarray, at: Place, damping: float, along: np.ndarray) -> tuple[Place, float]:
    """Return the best of some damped steps, and the factor of its damping."""
    metric = len(J) * np.linalg.pinv(along.T @ along)
    trials = damped_steps(J, at.r, at.z, [damping * f for f in FACTORS], metric)
    rs = descent.with_step(trials, descent.step / RESIDUALS)
    chi2 = mean_squares(rs)
    k = int(np.argmin(chi2))
    return Place(trials[k], rs[k], float(chi2[k])), FACTORS[k]


def _place(descent: Descent, z: np.ndarray, parts: int) -> Place:
    r = descent.with_step(z[None], descent.step / parts)
    return Place(z, r[0], float(mean_squares(r)[0]))
