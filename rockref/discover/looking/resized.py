"""A fit that has stopped beside its valley goes on from other sizes of its effects."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rockref.discover import window_rules as rules
from rockref.discover.fit.approach import BESIDE, along_ridge, heights_of, higher, pitching, ringing_alike, switches
from rockref.discover.fit.coarse import coarse_to_fine
from rockref.discover.fit.families import Family, mean_loss, refit, refit_all, room, structured
from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.fit.search import LITTLE, MISSING, TRIED, Setup
from rockref.discover.hypotheses.candidates import FORMS
from rockref.discover.looking.ringing import COMPLIANCE, PITCH, PLATE

#: Factors by which the sizes of effects are changed (decided: a cable's damping, found at three times its value, came
#: down from two thirds, half and a third of that alike).
FACTORS = (0.5, 1.5)
#: The same for the compliance of a plate that rings, whose valley is narrow (decided: begun a tenth off a fit was back
#: after three iterations, begun at half of it, it stayed there).
NEAR_TONES = (0.92, 1.08)
#: Places are tried for one iteration whose objective is at most this many times the fit's own (decided: the right ones
#: of that cable had 1.04 to 1.25 times it, half the height at which a centre of mass had stopped that has none 1.69
#: times, and 0.95 times after three iterations); most of them, the cheapest first, and most that are gone on from.
AFFORDABLE, TRIED_ONCE, PLACES = 2.0, 8, 4
#: Most times that a fit goes on, and most iterations that take it to its end.
ROUNDS, LAST = 4, 12
#: Mean loss below which it goes on from averages alone. Decided: from 0.99 drag of a practice experiment came down by
#: 0.2 % in four rounds of all ways; from 1.006 another fit came down by 2.8 %, and 0.97 is noise. Where more units are
#: left above the noise than rivals are forgiven (rules.UNFINISHED), it goes on in all ways from there too: half a cable
#: had stopped at 0.99 with 416 units left, and its runs asked for different numbers of it; begun at its true size it
#: leaves none.
AT_NOISE = 1.0
#: Units that such a round has to take off. Decided: of eight right effects that had come down to the noise, from 101
#: units above it to 245 below, the first round took off 28 to 238; three rounds more took off 41, 49 and 6 of a clock
#: whose rate came from 0.81 to 0.96 %, where 0.95 is true.
WORTHWHILE = 20.0
#: Share of structured windows above which the heights are changed, too (decided: with fewer they led nowhere).
UNSETTLED = 0.05
#: Size, in typical sizes, below which half a typical size is looked at as well.
TRIFLE = 0.3


def resized(setup: Setup, family: Family, seed: int, ahead: Family | None = None) -> Family:
    """The family, gone on from averages, from changed sizes and along the feet's heights, as long as that helps.

    Least squares stops where corner impacts change their order; a size that is wrong by a factor holds all the other
    parameters with it. A fit that has arrived at the noise goes on from averages alone, and one that most windows
    contradict is left as it is. ahead : a family at its end; where the rounds that are left, each as good as the last
    one, would not bring this one level with it, it does not go on.
    """
    if structured(family) > MISSING:
        return family
    for left in reversed(range(ROUNDS)):
        if ahead is not None and has_arrived(family) and room(family) - room(ahead) > rules.UNFINISHED:
            break
        further = next((f for way in ways(family) if is_lower(f := way(setup, family, seed), family)), None)
        if further is None:
            break
        fell, family = room(family) - room(further), further
        if ahead is not None and room(family) - room(ahead) > left * fell:
            break
    return refit(family, LAST, seed)


def ways(family: Family) -> tuple[Callable[[Setup, Family, int], Family], ...]:
    """In what order a family goes on: one with a plate, whose mass small steps hardly move, from changed places first
    (decided: of one such fit averages took off 3 to 8 per cent of what was left in each of three rounds, places 31 and
    60 per cent in two); one that has arrived from averages alone."""
    if has_arrived(family):
        return (averaged,)
    return (moved, averaged) if PLATE in family.effects else (averaged, moved)


def has_arrived(family: Family) -> bool:
    """Whether a family has come down to the noise, and leaves little above it."""
    return mean_loss(family) < AT_NOISE and room(family) <= rules.UNFINISHED


def is_lower(found: Family, family: Family) -> bool:
    """Whether a family ended lower by more than a trifle, which is less for one that had arrived."""
    trifle = WORTHWHILE if has_arrived(family) else LITTLE / 5 * family.point.objective
    return found.point.objective < family.point.objective - trifle


def averaged(setup: Setup, family: Family, seed: int) -> Family:
    """Where a family ends that sees averages first."""
    point = coarse_to_fine(family.fit, family.point, seed)
    return refit(Family(family.effects, family.fit, point), 2 * TRIED, seed)


def moved(setup: Setup, family: Family, seed: int) -> Family:
    """Where a family ends that goes on from the best of the changed places: one iteration shows which these are.

    Other masses of a plate are gone on from whatever they cost: the right one may look worst at first.
    """
    fit, point = family.fit, family.point
    begun = at_places(family, cheapest(point, placed_at(fit, point, moves(fit, point.z))))
    begun = sorted(refit_all(setup, begun, 1, seed), key=lambda f: f.point.objective)[:PLACES]
    begun += at_places(family, placed_at(fit, point, ringing_alike(fit, point.z, BESIDE)))
    if structured(family) > UNSETTLED:
        begun += at_places(family, placed_at(fit, point, higher(fit)))
    best = min([family, *refit_all(setup, begun, TRIED, seed)], key=lambda f: f.point.objective)
    return refit(best, 2 * TRIED, seed, relative=LITTLE / 5) if is_lower(best, family) else family


def placed_at(fit: Fit, point: Point, changes: np.ndarray) -> list[Point]:
    """The points that changes of z lead to; corrections kept."""
    return [fit.point(point.z + change, point.corrections)[0] for change in changes]


def cheapest(point: Point, places: list[Point]) -> list[Point]:
    """The cheapest of the places, if they can be afforded."""
    cheap = sorted((p for p in places if p.objective < AFFORDABLE * point.objective), key=lambda p: p.objective)
    return cheap[:TRIED_ONCE]


def at_places(family: Family, places: list[Point]) -> list[Family]:
    """The family at each of these places."""
    return [Family(family.effects, family.fit, place) for place in places]


def moves(fit: Fit, z: np.ndarray) -> np.ndarray:
    """Changes of z, (moves, G): each size of an effect by the factors, or to half a size; each form of a law into the
    others; the pitches of a plate; the ridge of the feet."""
    names = [p.name for p in fit.parameters]
    found = [*pitching(names, z)] if PITCH in names else []
    forms = [i for i, name in enumerate(names) if tuple(name.split(".")) in FORMS and name != PITCH]
    found += [move for i in forms for move in other_forms(z, i)]
    for i in switches(names, heights_of(names)):
        for factor in NEAR_TONES if names[i] == COMPLIANCE else (*FACTORS, *to_half_a_size(z[i])):
            move = np.zeros(len(z))
            move[i] = (factor - 1) * z[i]
            found.append(move)
    return np.concatenate([np.array(found).reshape(-1, len(z)), along_ridge(fit)])


def other_forms(z: np.ndarray, i: int) -> list[np.ndarray]:
    """The changes that make each pure form of a law, share i none and all of it, of what is not that form already."""
    found = []
    for share in [pure for pure in (0.0, 1.0) if pure != z[i]]:
        move = np.zeros(len(z))
        move[i] = share - z[i]
        found.append(move)
    return found


def to_half_a_size(z: float) -> tuple[float, ...]:
    """The factor that makes half a typical size of a trifle; none for what is no trifle, or nothing."""
    return (0.5 / abs(z),) if 0 < abs(z) < TRIFLE else ()
