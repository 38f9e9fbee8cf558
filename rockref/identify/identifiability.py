"""What the data determine: errors and correlations from the Fisher information, and profiles where that is not
believed.

At the end of a least-squares fit with white noise the covariance of the unknowns is chi2 (J^T J)^-1, J the slope of the
residual over the noise (Cramer-Rao; for example S. M. Kay, Fundamentals of Statistical Signal Processing, 1993, ch. 3).
That holds at the bottom of one smooth valley, by slopes that are exact. So what the step of the simulation does to the
slopes, and what the slopes say is left to the bottom, are added to the errors.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rockref.identify.genes import Space
from rockref.identify.polish import Polished
from rockref.identify.refine import COMPARED_STEP, covariance
from rockref.identify.target import Target
from rockref.identify.unknowns import Unknowns, residuals
from rockref.model.parameters import TABLE_3_1

#: Unknowns trade off where their errors correlate by more than this; decided.
TRADE_OFF = 0.9


@dataclass(frozen=True, eq=False)
class Identifiability:
    """names (Z,); values and errors (Z,) one standard deviation, in the genes' units; correlation (Z, Z);
    pairs: (name, name, correlation) of those that trade off; weakest: the combination that the data see least, by
    name; at_floor: whether the residual is the noise. Above the floor the fit stands in the wrong valley, or the model
    is wrong, and the errors say only how sharp that valley is."""

    names: tuple[str, ...]
    values: np.ndarray
    errors: np.ndarray
    correlation: np.ndarray
    pairs: tuple[tuple[str, str, float], ...]
    weakest: dict[str, float]
    at_floor: bool = True

    def digits(self) -> dict[str, float]:
        """Return errors in parts of the last significant digit of Table 3.1, for the unknowns that it has."""
        last = {name: given.precision for name, given in TABLE_3_1.items()}
        owners = [name.split(" of ")[0] for name in self.names]
        return {n: float(e / last[o]) for n, o, e in zip(self.names, owners, self.errors, strict=True) if o in last}

    def determined(self) -> dict[str, bool]:
        """Return whether an unknown is known within half its last digit, two standard deviations; none above the
        floor."""
        return {name: self.at_floor and 2 * error < 0.5 for name, error in self.digits().items()}


def identifiability(space: Space, targets: Sequence[Target], end: Polished) -> Identifiability:
    """Return errors, correlations and trade-offs at the end of a polish."""
    unknowns = Unknowns(space, targets)
    seen = max(1.0, end.chi2) * covariance(end.jacobian, end.doubt) + np.outer(end.remainder, end.remainder)
    sd = np.sqrt(np.diag(seen))
    correlation = seen / np.outer(sd, sd)
    values, slopes = unknowns.in_units(end.z)
    names = unknowns.names
    pairs = [
        (names[i], names[j], float(correlation[i, j]))
        for i in range(len(names))
        for j in range(i + 1, len(names))
        if abs(correlation[i, j]) > TRADE_OFF
    ]
    _, v = np.linalg.eigh(end.jacobian.T @ end.jacobian)
    order = np.argsort(-np.abs(v[:, 0]))
    weakest = {names[i]: float(v[i, 0]) for i in order if abs(v[i, 0]) > 0.1}
    pairs.sort(key=lambda p: -abs(p[2]))
    return Identifiability(names, values, sd * slopes, correlation, tuple(pairs), weakest, end.at_floor)


def profile(
    space: Space, targets: Sequence[Target], end: Polished, name: str, reach: float, points: int = 5
) -> tuple[np.ndarray, np.ndarray]:
    """Return values (P,) of one unknown about its end, up to `reach` in its unit, and the least chi2 (P,) of each by
    one Gauss-Newton step of all others: a valley that stays flat is not determined.

    Raises ValueError for a name that is no unknown.
    """
    unknowns = Unknowns(space, targets)
    i = unknowns.names.index(name)
    values, slopes = unknowns.in_units(end.z)
    shifts = np.linspace(-reach, reach, points)
    J, others = end.jacobian, np.arange(len(end.z)) != i
    r = residuals(space, targets, end.z[None], COMPARED_STEP)[0]
    trials = []
    for shift in shifts:
        z = end.z.copy()
        z[i] += shift / slopes[i]
        answer = np.linalg.lstsq(J[:, others], -(r + J[:, i] * (z[i] - end.z[i])), rcond=1e-10)[0]
        z[others] += answer
        trials.append(np.clip(z, 0.0, 1.0))
    rs = residuals(space, targets, np.array(trials), COMPARED_STEP)
    return values[i] + shifts, np.mean(np.square(rs), axis=1)
