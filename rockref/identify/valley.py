"""Along the valley in which the heights of the feet and the place of the inner points trade off.

A record that ends before the second main impact is fitted to the noise by a whole line of heights and diagonals, each
a dent of its own; only the last moments before that impact, where the inner points take over again, tell them apart,
and there a descent does not see across the dents. So the line is walked: the diagonal moved by a stride, all others
fitted again to the record without its end, and every place on the way judged by the whole record. Twins that a
descent left ten last digits away, at 1.4 times the noise, were led to the noise floor so.
"""

from __future__ import annotations

import numpy as np

from rockref.identify.descent import CHANGES, FACTORS, NEARLY, Descent, Place, damped_steps, ridge
from rockref.identify.unknowns import mean_squares

#: The unknown that is moved, and by how much of its range at a time. Decided: a hundredth, 0.11 mm, one last digit of
#: Table 3.1; twice that lost the valley.
WALKED, STRIDE = "delta_diag", 0.01
#: A walk ends where the record without its end is fitted worse than at the start by the first factor (the whole record,
#: when that is walked: by the second), where so many strides brought nothing by the whole record, or after so many
#: strides (decided: 0.3 of the range).
LEFT, LEFT_WHOLE, PATIENCE, MOST = 1.25, 1.05, 4, 30
#: Least squares after each stride: steps, most steps where the fit is lost (fewer, where one gains less than
#: `LEAST_GAIN`), and what multiplies `FACTORS`; decided: with two a walk left the valley at a dent, and stopped eight
#: last digits short.
REFITS, MOST_REFITS, DAMPING = 2, 6, 1e-3
#: How many of the best places on the way are descended from, and the share that a round of walks must gain for another
#: one, or a refit of what is lost. Decided: noise scatters the mean square by 2 %.
PLACES, LEAST_GAIN = 2, 0.02


def along(short: Descent, whole: Descent, z: np.ndarray, rounds: int) -> Place:
    """Return best place of `whole` along the valley of `short`, which looks at the record without its end, from z (Z,).

    Then the whole record is walked in half strides, both ways.
    """
    at = whole.place(z)
    for _ in range(rounds):
        short.correct(at.z)
        corrected = whole.correct(at.z)
        at = whole.place(at.z)
        before = at.chi2
        at = _best_end(whole, [at, *_both_ways(short, whole, at.z, STRIDE, LEFT)], CHANGES)
        if corrected and (at.chi2 < NEARLY or at.chi2 > (1 - LEAST_GAIN) * before):
            break
    return beside(whole, at)


def beside(whole: Descent, at: Place) -> Place:
    """Return the best place beside an end: the whole record walked in half strides, both ways."""
    near = _both_ways(whole, whole, at.z, STRIDE / 2, LEFT_WHOLE)
    return _best_end(whole, [at, *near], CHANGES[1:])


def _both_ways(short: Descent, whole: Descent, z: np.ndarray, stride: float, left: float) -> list[Place]:
    return [place for s in (-stride, stride) for place in walk(short, whole, z, s, left)]


def _best_end(whole: Descent, places: list[Place], changes: tuple[float, ...]) -> Place:
    """Return the best of the places and of the ends of descents from the best few."""
    best = min(places, key=lambda p: p.chi2)
    for at in sorted(places, key=lambda p: p.chi2)[:PLACES]:
        for change in changes:
            at = whole.descend(at, change)
        best = min(best, at, key=lambda p: p.chi2)
    return best


def walk(short: Descent, whole: Descent, z: np.ndarray, stride: float, left: float = LEFT) -> list[Place]:
    """Return places of `whole` along the valley of `short` from z (Z,) on, `stride` by `stride`, until it is left."""
    if WALKED not in short.unknowns.names:
        return []
    i, at, best, since = short.unknowns.names.index(WALKED), short.place(z), np.inf, 0
    limit, path = left * at.chi2, list[Place]()
    J, h = short.slopes(at, CHANGES[1])
    while len(path) < MOST and since < PATIENCE and 0.0 <= at.z[i] + stride <= 1.0:
        at = short.place(_moved(J, at, i, stride))
        gain = np.inf
        for k in range(MOST_REFITS):
            if k >= REFITS and (at.chi2 < limit or gain < LEAST_GAIN * at.chi2):
                break
            before, (J, h) = at.chi2, short.slopes(at, CHANGES[1], h)
            at = _refitted(short, J, at, i)
            gain = before - at.chi2
        if not at.chi2 < limit:
            break
        path.append(at if short is whole else whole.place(at.z))
        since = 0 if path[-1].chi2 < best else since + 1
        best = min(best, path[-1].chi2)
    return path


def _moved(J: np.ndarray, at: Place, i: int, stride: float) -> np.ndarray:
    """Return z (Z,) with unknown i moved, the others where the slopes J (M, Z) say that they follow."""
    others = np.arange(len(at.z)) != i
    A = J[:, others].T @ J[:, others]
    z = at.z.copy()
    z[i] += stride
    z[others] += np.linalg.solve(A + 1e-6 * np.diag(np.diag(A)) + ridge(A), -J[:, others].T @ (at.r + J[:, i] * stride))
    return np.clip(z, 0.0, 1.0)


def _refitted(short: Descent, J: np.ndarray, at: Place, i: int) -> Place:
    """Return one step of least squares of all unknowns but i."""
    held = J.copy()
    held[:, i] = 0.0
    trials = damped_steps(held, at.r, at.z, [DAMPING * f for f in FACTORS])
    rs = short.residuals(trials)
    chi2 = mean_squares(rs)
    k = int(np.argmin(chi2))
    return Place(trials[k], rs[k], float(chi2[k])) if chi2[k] < at.chi2 else at
