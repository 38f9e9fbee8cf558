"""How an identified model does on each run, those that were kept out included.

A holdout run is looked at only when the parameters are fixed. Its release angle is not known better than the wire's
scatter, so it is the one thing that may be adapted to it; the error with the angle as stated is given beside.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rockref.identify.candidates import STEP
from rockref.identify.genes import Space
from rockref.identify.polish import Polished
from rockref.identify.refine import COMPARED_STEP
from rockref.identify.target import Target
from rockref.identify.unknowns import residuals

#: Release angles that are tried over the range of the gene, and how often with the step of the search, about the best
#: one. Decided: 41 over 0.16 degrees are 0.004 degrees apart, a fifth of the wire's scatter.
ANGLES, REFINEMENTS = 41, 2
#: Release angles that are tried at last with the fine step of the least squares. Decided: they are 1.4 micro-radian
#: apart, which changes the response by 0.03 of the noise.
LAST_ANGLES = 21


@dataclass(frozen=True, eq=False)
class RunError:
    """One run: name; use, "fit" or "holdout"; tilt, its release angle by least squares [rad]; rms (3,) [rad/s] of the
    difference up to the second main impact with that angle; rms_stated (3,), with the angle as stated and the mean
    offset of the fitted runs; noise of a sample [rad/s]."""

    name: str
    use: str
    tilt: float
    rms: np.ndarray
    rms_stated: np.ndarray
    noise: float

    @property
    def over_noise(self) -> float:
        """Return quadratic mean of the difference over the noise; 1 is the noise floor."""
        return float(np.sqrt(np.mean(np.square(self.rms))) / self.noise)

    @property
    def over_noise_stated(self) -> float:
        """Return the same with the release angle as stated."""
        return float(np.sqrt(np.mean(np.square(self.rms_stated))) / self.noise)


def run_error(space: Space, end: Polished, target: Target, use: str) -> RunError:
    """Return error of the model at the end of a polish on one run."""
    tilt_gene = space.names.index("theta_0")
    shared = np.delete(end.u, tilt_gene)

    def rms(tilts: np.ndarray, step: float) -> np.ndarray:
        zs = np.array([np.append(shared, x) for x in tilts])
        r = residuals(space, [target], zs, step).reshape(len(tilts), 3, -1)
        return np.sqrt(np.mean(np.square(r), axis=2)) * target.gyro.noise

    low, high = 0.0, 1.0
    for _ in range(REFINEMENTS):
        grid = np.linspace(low, high, ANGLES)
        width = 2 * (high - low) / (ANGLES - 1)
        best = grid[_least(rms(grid, STEP))]
        low, high = max(0.0, best - width), min(1.0, best + width)
    grid = np.append(np.linspace(low, high, LAST_ANGLES), end.u[tilt_gene])
    errors = rms(grid, COMPARED_STEP)
    k = _least(errors)
    best, found, stated = float(grid[k]), errors[k], errors[-1]
    u = end.u.copy()
    u[tilt_gene] = best
    offset = float(space.values(u)[tilt_gene]) - space.model.parameters.theta_0
    return RunError(target.name, use, target.tilt + offset, found, stated, target.gyro.noise)


def _least(errors: np.ndarray) -> int:
    """Return which of the errors (B, 3) is least; a run that is lost is not."""
    return int(np.argmin(np.nan_to_num(np.sum(np.square(errors), axis=1), nan=np.inf)))


def run_errors(space: Space, end: Polished, fitted: Sequence[Target], holdout: Sequence[Target] = ()) -> list[RunError]:
    """Return the table of all runs, fitted ones first."""
    return [run_error(space, end, t, use) for use, ts in (("fit", fitted), ("holdout", holdout)) for t in ts]
