"""Two effects at once, where the best single one leaves too much: every pair by one step, the best of them raced.

An effect that is fitted while another one is missing bends until it stands for both (a scale of the gyroscope came out
three times too large where a foot resisted spin, too), and what is added to it then finds no place. One step from the
baseline, not yet bent, sees both; all pairs cost little more than all single effects, whose derivatives are joined.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from rockref.discover import window_rules as rules
from rockref.discover.fit.beside import side_by_side
from rockref.discover.fit.families import Family, mean_loss, refit, refit_all, room, size_of, structured
from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.fit.search import Setup
from rockref.discover.looking.far import (
    FAR,
    FAR_OFF,
    LOOKS,
    begun_beside,
    in_full,
    nearest_of_each,
    nominal_beside,
    without_plate,
)
from rockref.discover.looking.look import Look, candidates_beside, look_further, ranked
from rockref.discover.looking.ringing import PLATE, at_its_tone
from rockref.discover.looking.screen import SHARES, own_columns, with_priors
from rockref.effects.base import Effect

#: Pairs that are raced on the short windows. Decided: of five experiments with a sensor and another effect the right
#: pair was among the first four, and won the race, in each.
RACED = 4
#: Share of the best pair's mean loss within which another one with the same first effect is fitted in full, too, and
#: most that are. Decided: beside a scale of the gyroscope rolling resistance and drag ended the race at 1.01 both, the
#: next at 1.04; in full the right one gained 3590 units, drag 1928.
TIED, FINALISTS = 1.02, 2
#: Leaders of a look beside which an effect is searched for that no derivative shows (decided: where a plate rang under
#: feet that resisted spin, the spin led; the pair left 1.17 on the short windows, begun by one step 2.91).
LEADERS = 3


@dataclass(frozen=True)
class Promise:
    """Two effects, what one step of everything promises to gain with them, and its changes of z (theirs the last)."""

    effects: tuple[str, str]
    gain: float
    dz: np.ndarray


def leaves_too_much(look: Look, found: Family) -> bool:
    """Whether a first effect leaves so many windows structured that it was found in the place of two, and some hope."""
    left = structured(found)
    return left > FAR and not rules.is_hopeless(left, look.gains[found.effects[-1]], room(found))


def settled_by_two(setup: Setup, look: Look, found: Family, seed: int, say: Callable[[str], None]) -> Look | None:
    """A look whose pair settles the windows of which its first effect, not yet taken to its end, leaves too many.

    One step sees little of an effect that has to be there for its derivative to show (beside uneven dampers, a contact
    stiffer with depth came twentieth of 27, and uneven friction first). Where a pair leaves some windows structured,
    what is found on top of its first effect alone may take its place.
    """
    pair = two_at_once(setup, look, found, say)
    if pair is None or not settles(pair, found):
        return None
    if structured(pair.order[0]) <= rules.FEW_LEFT:
        return pair
    other = look_further(setup, pair.kept, seed, say)
    better = bool(other.order) and mean_loss(other.order[0]) < mean_loss(pair.order[0])
    return other if better and settles(other, found) else pair


def settles(pair: Look, found: Family) -> bool:
    """Whether the pair that leads a look is there, both of it, and explains most of what `found` left structured."""
    best = pair.order[0]
    first, second = best.effects
    sizes = size_of(best, first), size_of(best, second)
    # What this is counted over was not taken to its end.
    there = pair.gains[second] > rules.PLAIN_SECOND and min(sizes) > rules.SECOND_SIZE
    return there and rules.settles(structured(found), structured(best))


def two_at_once(setup: Setup, first: Look, start: Family, say: Callable[[str], None]) -> Look | None:
    """The best pair, fitted in full, as a look on top of one of its effects; None where no pair comes near the runs.

    first : the look that found `start` on top of the plain baseline. One effect of the pair, at least, led somewhere in
    it; what the pair gains is counted over that one alone.
    """
    alone = {f.effects[-1]: f for f in first.order} | {start.effects[-1]: start}
    plain = nominal_beside(setup, first.kept)
    begun = plain.fit.run(plain.point, LOOKS, np.random.default_rng(setup.seed))
    leading = [start.effects[-1], *(f.effects[-1] for f in first.order if f.effects != start.effects)]
    offered = candidates_beside(setup, ())
    found = promises(setup, plain.fit, begun, offered, leading)
    tried = side_by_side(setup, lambda own, p: stepped_along(own, plain.fit, begun, p), found[:RACED])
    tried += beside_leaders(setup, alone, leading, offered)
    raced = sorted(nearest_of_each(refit_all(setup, tried, LOOKS, setup.seed)), key=mean_loss)
    for f in raced:
        say(f"  two at once: {' + '.join(f.effects)} {mean_loss(f):.2f}")
    if mean_loss(raced[0]) > FAR_OFF:
        return None
    tied = [f for f in raced if f.effects[0] == raced[0].effects[0] and mean_loss(f) <= TIED * mean_loss(raced[0])]
    ended = side_by_side(setup, in_full, tied[:FINALISTS])
    return ranked(alone[raced[0].effects[0]], ended, say, in_full=True)


def promises(
    setup: Setup, fit: Fit, point: Point, kinds: Sequence[type[Effect]], leading: Sequence[str]
) -> list[Promise]:
    """Every pair with one of the effects `leading`, who stands first in it, by what one step promises; best first."""
    z, c = point.z, point.corrections
    r = fit.residual(z, c)
    Js = fit.state_jacobian(z, c, r)
    Jg, w = fit.parameter_jacobian(z, c, r, Js), fit.weights(r)

    def own(setup: Setup, id: str) -> tuple[np.ndarray, np.ndarray]:
        wide = setup.fit(fit.series.twin(), (id,))
        _, columns = own_columns(wide, point, id, r, Js)
        return columns, wide.prior[len(point.z) :]

    ids = [kind.id for kind in kinds]
    columns, priors = zip(*side_by_side(setup, own, ids), strict=True)
    G = len(point.z)
    ends = G + np.cumsum([len(p) for p in priors])
    mine = {id: list(range(end - len(p), end)) for id, p, end in zip(ids, priors, ends, strict=True)}
    prior = np.concatenate([fit.prior, *priors])
    z = np.concatenate([z, np.zeros(len(prior) - G)])
    H, g, _ = fit.reduced(r, Js, [Jg, *columns], w, c)
    H, g = with_priors(H, g, prior, z)
    order = {id: i for i, id in enumerate(leading)}
    found = []
    for pair in combinations(ids, 2):
        if order.keys() & set(pair):
            a, b = sorted(pair, key=lambda id: order.get(id, len(order)))
            at = [*range(G), *mine[a], *mine[b]]
            dz = np.clip(-np.linalg.solve(H[np.ix_(at, at)], g[at]), -3, 3)
            found.append(Promise((a, b), float(-(g[at] @ dz) / 2), dz))
    return sorted(found, key=lambda p: -p.gain)


def beside_leaders(
    setup: Setup, alone: dict[str, Family], leading: Sequence[str], offered: Sequence[type[Effect]]
) -> list[Family]:
    """Pairs on short windows with leaders of a look as they were found: a plate, if it is offered, at its tone beside
    those that led more than it; the others, by one step and by a look, beside the first, and beside a plate that led.

    While a plate is rigid no derivative shows it. A step promises nothing, either, of what has to be there for its
    derivative to show: of feet that resist spin beside a plate, of rolling resistance beside a scale of the gyroscope.

    alone : where each effect that led somewhere ended by itself.
    """
    others = without_plate(offered)
    ahead = leading[: leading.index(PLATE)] if PLATE in leading else leading
    ringing = ahead[:LEADERS] if len(others) < len(offered) else []
    looked = [id for i, id in enumerate(leading) if i == 0 or id == PLATE]

    def begun(own: Setup, id: str) -> list[Family]:
        plain = nominal_beside(own, alone[id])
        as_far = refit(plain, LOOKS, own.seed)
        found = at_its_tone(own, plain, as_far) if id in ringing else []
        if id in looked:
            found += begun_beside(own, [kind for kind in others if kind.id != id], plain, as_far)
        return found

    leaders = [id for id in leading if id in ringing or id in looked]
    return [family for families in side_by_side(setup, begun, leaders) for family in families]


def stepped_along(setup: Setup, fit: Fit, point: Point, promise: Promise) -> Family:
    """The pair at the better of two shares of its step, each window's corrections improved by themselves."""
    wide = setup.fit(fit.series.twin(), promise.effects)
    z = np.concatenate([point.z, np.zeros(len(promise.dz) - len(point.z))])
    places = [wide.relax_states(wide.point(z + share * promise.dz, point.corrections)[0]) for share in SHARES]
    return Family(promise.effects, wide, min(places, key=lambda p: p.objective))
