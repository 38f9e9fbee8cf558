"""A fit that has stopped beside its valley goes on from other sizes of its effects."""

from __future__ import annotations

import numpy as np

from rockref.discover.approach import along_ridge, heights_of, switches
from rockref.discover.families import Family, refit, refit_all, structured
from rockref.discover.fit import Fit, Point
from rockref.discover.search import LITTLE, MISSING, MOST_JUMPS, TRIED, Setup, arrived

#: Factors by which the sizes of effects are changed (decided: a cable's damping, found at three times its value, came
#: down from two thirds, half and a third of that alike).
FACTORS = (0.5, 1.5)
#: Places are gone on from whose objective is at most this many times the fit's own (decided: the right ones of that
#: cable had 1.04 to 1.25 times it); most of them.
AFFORDABLE, PLACES = 1.4, 4
#: Size, in typical sizes, below which half a typical size is looked at as well.
TRIFLE = 0.3


def resized(setup: Setup, family: Family, seed: int) -> Family:
    """The family, gone on from changed sizes of its effects and along the ridge of the feet, as long as that helps.

    Least squares stops where corner impacts change their order; a size that is wrong by a factor holds all the other
    parameters with it. A fit that has arrived at the noise is left as it is, and so is
    one that most windows contradict.
    """
    for _ in range(MOST_JUMPS):
        if arrived(family.fit, family.point) or structured(family) > MISSING:
            break
        begun = [Family(family.effects, family.fit, point) for point in places(family.fit, family.point)]
        best = min([family, *refit_all(setup, begun, TRIED, seed)], key=lambda f: f.point.objective)
        if best.point.objective > (1 - LITTLE / 5) * family.point.objective:
            break
        family = refit(best, 2 * TRIED, seed, relative=LITTLE / 5)
    return family


def places(fit: Fit, point: Point) -> list[Point]:
    """Where to go on from: the cheapest of the changed places, corrections kept."""
    changed = [fit.point(point.z + move, point.corrections)[0] for move in moves(fit, point.z)]
    cheap = [p for p in changed if p.objective < AFFORDABLE * point.objective]
    return sorted(cheap, key=lambda p: p.objective)[:PLACES]


def moves(fit: Fit, z: np.ndarray) -> np.ndarray:
    """Changes of z, (moves, G): each size of an effect by the factors, or to half a size; the ridge of the feet."""
    names = [p.name for p in fit.parameters]
    found = []
    for i in switches(names, heights_of(names)):
        for factor in (*FACTORS, *to_half_a_size(z[i])):
            move = np.zeros(len(z))
            move[i] = (factor - 1) * z[i]
            found.append(move)
    return np.concatenate([np.array(found).reshape(-1, len(z)), along_ridge(fit)])


def to_half_a_size(z: float) -> tuple[float, ...]:
    """The factor that makes half a typical size of a trifle; none for what is no trifle, or nothing."""
    return (0.5 / abs(z),) if 0 < abs(z) < TRIFLE else ()
