"""Least squares on the signals: from where the search ended to the least error.

The residual as a function of the parameters is smooth between small jumps: where the order in which two feet land
changes, the response jumps by some 0.01 deg/s. So the slopes are taken over steps that change the response by about
the noise, and where the descent ends in a dent between two jumps, each parameter is moved a long way, the others
following, and the descent begins again from the best of these places.

What is wrong early is wrong by much more later: the residual over the whole time has its valley only where everything
is nearly right. So the first descents look at the record up to the first main impact, and then further and further.
The last of these ends in a valley that only the end of the record cuts across; it is walked (`identify.valley`), and
again beside an end that long moves have found. The last descent takes finer steps (`identify.refine`): most dents are
made by the step.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from rockref.identify.candidates import STEP
from rockref.identify.descent import CHANGES, NEARLY, STEPS, Descent, Place, ridge
from rockref.identify.genes import Space
from rockref.identify.refine import Bottom, refine
from rockref.identify.target import Target, seen_until
from rockref.identify.unknowns import Unknowns, mean_squares
from rockref.identify.valley import along, beside

#: Shifts of one unknown in a long move, how many of the best places are descended from and with how many steps, and
#: most rounds of moves. Decided: a twentieth of a range is beyond a dent, two fifths reach anywhere in three rounds.
SHIFTS, PLACES, SHORT, MOVES = (-0.4, -0.2, -0.1, -0.05, 0.05, 0.1, 0.2, 0.4), 4, 5, 4
#: Most rounds of walks along the valley; decided.
WALKS = 3
#: How far beyond the first main impact the first descents look [s]. Decided: the impact itself, a tooth of the saw,
#: two, four, eight; each window is then some standard errors from the end of the one before, not some hundred.
WINDOWS = (0.0, 0.06, 0.15, 0.35, 0.6)
#: Long moves within a window, at most, and in which windows [s]. Decided: in the first ones moves are cheap, in the
#: later ones a place is taken over that fits already.
WINDOW_MOVES, CHEAP_WINDOW = 3, 0.1
#: A window that ends above this mean square is started again from where everything began. Decided: the first window
#: sees little and can lead astray, to damping at the ends of its range; the next window then ends at 3 to 5.
ASTRAY = 1.25
#: A fit is at the noise floor below this mean square of the residual over the noise. Decided: 1 is the floor of white
#: noise, and that of the 4000 numbers of one run scatters by 0.022, of which this is three; an end above it has heights
#: that are off by some last digits.
FLOOR = 1.07
#: Moves end where a round gains less than this share; decided: 4000 samples of noise scatter the mean square by 2 %.
LEAST_ROUND_GAIN = 5e-3
#: Moves within a window end where a round gains less than this share; decided: the scatter of the noise.
LEAST_WINDOW_GAIN = 0.02


@dataclass(frozen=True)
class Effort:
    """How hard the least squares try: windows, ends of the first descents after the first main impact [s] (none, where
    the start is near); at most: steps of one descent, rounds of walks along the valley, rounds of long moves."""

    windows: tuple[float, ...] = WINDOWS
    steps: int = STEPS
    moves: int = MOVES
    walks: int = WALKS


@dataclass(frozen=True, eq=False)
class Polished:
    """The end of a polish.

    u : (G,) genes, theta_0 the mean over the targets;  tilts : (R,) release angle of each target [rad]
    rms : (R, 3) [rad/s] residual per target and axis up to the second main impact
    chi2 : mean square of the residual over the noise (1: at the noise floor)
    z : (Z,) the unknowns in [0, 1];  jacobian : (M, Z) of the scaled residual there;  names : of its columns
    doubt : (Z, Z) what the step adds to the information of the slopes
    remainder : (Z,) from z to where the slopes say that the bottom of the valley is
    """

    u: np.ndarray
    tilts: np.ndarray
    rms: np.ndarray
    chi2: float
    z: np.ndarray
    jacobian: np.ndarray
    names: tuple[str, ...]
    doubt: np.ndarray
    remainder: np.ndarray

    @property
    def at_floor(self) -> bool:
        """Return whether the residual is the noise."""
        return self.chi2 < FLOOR


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
    """Fit by least squares within the ranges, from the chromosome u (G,), or with `z` from the unknowns u (Z,).

    report : called with the mean square after each gain.
    """
    unknowns = Unknowns(space, targets)
    given = start = np.clip(np.asarray(u, float) if z else unknowns.z(np.asarray(u, float)), 0.0, 1.0)
    descent = Descent(unknowns, step, workers, report, effort.steps)
    short = None
    for after in effort.windows:
        seen = [seen_until(t, after) for t in targets]
        short = Descent(Unknowns(space, seen), step, workers, report, effort.steps)
        started = after if effort.moves else CHEAP_WINDOW
        at = _in_window(short, start, started)
        if at.chi2 > ASTRAY:
            at = min(at, _in_window(short, given, started), key=lambda p: p.chi2)
        start = at.z
    if short is not None and effort.walks:
        at = along(short, descent, start, effort.walks)
    else:
        at = _corrected(descent, start)
        for change in CHANGES:
            at = descent.descend(at, change)
        at = beside(descent, at) if effort.walks else at
    end = _refined(descent, at)
    for _ in range(effort.moves):
        if end.place.chi2 < NEARLY:
            break
        at = descent.descend(_long_moves(descent, _corrected(descent, end.place.z)), CHANGES[2])
        again = _refined(descent, beside(descent, at) if effort.walks else at)
        gained = again.place.chi2 < (1 - LEAST_ROUND_GAIN) * end.place.chi2
        end = min(end, again, key=lambda e: e.place.chi2)
        if not gained:
            break
    return _result(unknowns, end)


def _corrected(descent: Descent, z: np.ndarray) -> Place:
    """Return the place at z (Z,), from which on what the step does there is taken off."""
    descent.correct(z)
    return descent.place(z)


def _refined(descent: Descent, at: Place) -> Bottom:
    return refine(descent, at, descent.slopes(at, CHANGES[1])[0])


def _long_moves(descent: Descent, at: Place) -> Place:
    """Return each unknown moved a long way, alone and with the others following; a short descent from the best
    places."""
    J, _ = descent.slopes(at, CHANGES[1])
    trials = np.array([z for i in range(len(at.z)) for shift in SHIFTS for z in _moved(J, at, i, shift)])
    chi2 = mean_squares(descent.residuals(trials))
    best = at
    for k in np.argsort(chi2)[:PLACES]:
        end = descent.descend(descent.place(trials[k]), CHANGES[1], SHORT)
        best = end if end.chi2 < best.chi2 else best
    return best


def _in_window(descent: Descent, z: np.ndarray, after: float) -> Place:
    """Return the end of the descents that look no further than `after` [s] beyond the first main impact."""
    at = descent.place(z)
    for change in CHANGES[:2]:
        at = descent.descend(at, change)
    for _ in range(WINDOW_MOVES if after < CHEAP_WINDOW else 0):
        before = at.chi2
        if before < NEARLY:
            break
        at = descent.descend(_long_moves(descent, at), CHANGES[1])
        if at.chi2 > (1 - LEAST_WINDOW_GAIN) * before:
            break
    return at


def _moved(J: np.ndarray, at: Place, i: int, shift: float) -> list[np.ndarray]:
    """Return z with unknown i shifted: alone, and with the others where the slopes say that they follow (at most a
    tenth)."""
    alone = at.z.copy()
    alone[i] = np.clip(alone[i] + shift, 0.0, 1.0)
    others = np.arange(len(at.z)) != i
    A = J[:, others].T @ J[:, others]
    follow = np.linalg.solve(
        A + 1e-4 * np.diag(np.diag(A)) + ridge(A), -J[:, others].T @ (at.r + J[:, i] * (alone[i] - at.z[i]))
    )
    together = alone.copy()
    together[others] = np.clip(together[others] + np.clip(follow, -0.1, 0.1), 0.0, 1.0)
    return [alone, together]


def _result(unknowns: Unknowns, end: Bottom) -> Polished:
    space, targets, at = unknowns.space, unknowns.targets, end.place
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
    return Polished(u, tilts, np.array(rms), at.chi2, at.z, end.jacobian, unknowns.names, end.doubt, end.remainder)
