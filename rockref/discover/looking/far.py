"""Candidates fitted anew, from the nominal parameters: where small steps lead nowhere, and before a name is given."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

import numpy as np

from rockref.discover import window_rules as rules
from rockref.discover.fit.approach import approached, approached_beside
from rockref.discover.fit.beside import side_by_side
from rockref.discover.fit.families import (
    Family,
    gain_between,
    leaves_nothing,
    mean_loss,
    refit,
    refit_all,
    room,
    structured,
)
from rockref.discover.fit.least_squares import Fit
from rockref.discover.fit.search import (
    FIRST_STAGE,
    FRESH,
    LITTLE,
    SHORT,
    Setup,
    baseline,
    early,
    late,
    nominal,
    onward,
    windows,
)
from rockref.discover.looking.ringing import PLATE, at_its_tone
from rockref.discover.looking.screen import screen
from rockref.effects import catalogue
from rockref.effects.base import Effect

#: Candidates that are raced on the short windows, the first ones of each list, with so many iterations; and how many
#: are then fitted in full. Decided: of sixteen effects that left 0.1 to 0.99 of the windows structured, each was among
#: the first four of the first steps (thirteen were the first) or of the first looks (nine were the first); thirteen
#: were raced, and after three iterations twelve of them led.
LOOKED_AT, LOOKS, FITTED = 4, 3, 3
#: Share of what the family without a candidate leaves above the noise, up to which a candidate comes nearer than it;
#: and iterations of all of them where none does. Decided: in fourteen experiments whose effect was raced it left 0.57
#: at most after three iterations; where it was not raced, or in no list, the best left 0.93 and more. There friction
#: that was uneven at the outer points alone stood at 1.38 after three, as all others did, and at 1.04 after six.
NEARER, FURTHER = 0.9, 6
#: Most iterations of a fit that is begun where another one ended; after the first of them it is left where it is, if
#: it does not reach this share of the other's gain (decided: of three true effects, begun where drag, a cable and
#: viscous friction had ended, each was past the wrong one after one iteration).
SWAPPED, TRIED_FIRST, LEFT_BEHIND = 6, 2, 0.5
#: Share of the way from the best loss to the middle one within which a candidate is fitted in full (decided: in the
#: runs of a spinning foot, of 28 candidates only the right one was there); and the share of the best loss that short
#: windows do not tell apart (drag, a cable and rolling ended at 1.02, 1.02 and 1.03; sides that were off under the
#: stated inertia at 1.13, where a scale of the gyroscope had 1.10 and got the name; others at 1.06, where it had 0.98;
#: feet rounded by half of what is typical at 1.14, where a scale had 1.00. It costs a fit in twenty of those in full).
AHEAD, ALIKE = 0.4, 1.15
#: Looks of which the best leaves so large a mean loss, and such a share of the middle one's, lead nowhere: one of them
#: is fitted in full (decided: where nothing of the catalogue was missing the best left 0.94 to 0.99 of the middle, at
#: 2.7 to 6.7; a right one that began as far off left 0.6). Of pairs that are raced none is fitted in full that leaves
#: as much (decided: five right ones left 1.1 to 1.5, the best where a gyroscope had soft stops 5.5).
FAR_OFF, ALL_THE_SAME = 2.0, 0.9
#: Share of structured windows above which small steps lead nowhere and candidates are looked for from nominal
#: parameters first (decided: from a baseline with 0.39 no small step led on; with 0.18 one did), and above which
#: another effect is missing beside the best one. Up to it, where the best of those that were fitted in full leaves more
#: than it gains, as many of the next are fitted, too. Decided: a plate that tilts was the last of six within 1.12 of
#: the best on the short windows; a cable ahead of it gained 961 to 1044 units, and the tilt, fitted in full, left
#: nothing above the noise.
FAR = 0.2
#: Mean loss of a first look up to which its start needs no second search (decided: 1 is noise; where friction fell
#: with speed, the right look ended at 1.04, wrong ones at 1.55 and more).
NEAR = 1.1


def from_far(
    setup: Setup,
    kinds: Sequence[type[Effect]],
    kept: Family,
    say: Callable[[str], None],
    leaders: Sequence[Family] = (),
) -> list[Family]:
    """Candidates beside the family `kept`, from nominal parameters: looked at, raced on short windows; who comes
    nearest, in full.

    leaders : who led so far; the first of them is fitted in full wherever it stands, but for the last rule below.

    Where most windows are out of step, a small step along an effect changes little, and the parameters of the family
    `kept` have bent so far that an effect added to them cannot unbend them. One step from a baseline that is not yet
    bent shows what changes every impact, a search along the effect itself what changes the order of the impacts. A
    second effect that comes no nearer than the first one alone, taken as far, is not fitted in full. Where nobody comes
    plainly nearer one at most is, after all of them were taken further beside a baseline that is near.
    """
    plain, sure = nominal_beside(setup, kept), leaders[0].effects if leaders else ()
    as_far = refit(plain, LOOKS, setup.seed)
    raced = raced_beside(setup, kinds, plain, as_far, sure)
    say(f"  from nominal: {' + '.join(kept.effects) or 'nothing more'} {mean_loss(as_far):.2f}")
    for f in raced:
        say(f"  from nominal: {f.effects[-1]} {mean_loss(f):.2f}")
    if raced and nobody_nearer(raced, as_far) and not kept.effects and mean_loss(as_far) <= FAR_OFF:
        as_far, *raced = taken_further(setup, kinds, plain, as_far)
        say(f"  from nominal, all of them further: {raced[0].effects[-1]} {mean_loss(raced[0]):.2f}")
    nearer = [f for f in raced if not kept.effects or mean_loss(f) < mean_loss(as_far)]
    if nobody_nearer(raced, as_far):
        best = min(nearer, key=mean_loss, default=None)
        nearer = [f for f in nearer if f is best or f.effects == sure]
    return nearest_in_full(setup, nearer, kept, sure) if nearer else []


def raced_beside(
    setup: Setup, kinds: Sequence[type[Effect]], plain: Family, as_far: Family, sure: tuple[str, ...]
) -> list[Family]:
    """The first candidates beside the family `plain`, and a plate at its tone, after the iterations of a race."""
    others = without_plate(kinds)
    begun = begun_beside(setup, others, plain, as_far, sure)
    if len(others) < len(kinds):
        begun += at_its_tone(setup, plain, as_far, sure[-1:] == (PLATE,))
    tried = refit_all(setup, begun, LOOKS, setup.seed)
    # What windows hand on settles by one window an iteration: a plate of 89 Hz stood at 1.80 after three, and fell.
    tried += refit_all(setup, [f for f in tried if f.effects[-1] == PLATE], LOOKS, setup.seed)
    return nearest_of_each(tried)


def nobody_nearer(raced: list[Family], as_far: Family) -> bool:
    """Whether no candidate comes plainly nearer to the noise than the family without one, taken as far."""
    best = min(map(mean_loss, raced), default=np.inf)
    return best - rules.NOISE > NEARER * (mean_loss(as_far) - rules.NOISE)


def taken_further(setup: Setup, kinds: Sequence[type[Effect]], plain: Family, as_far: Family) -> list[Family]:
    """The family without a candidate, and all of them from their looks, fitted twice as far; these best first.

    Where few windows are far off, and only where a foot slips, three iterations move nobody.
    """
    looks = first_looks(setup, without_plate(kinds), plain)
    further = sorted(refit_all(setup, looks, FURTHER, setup.seed), key=mean_loss)
    return [refit(as_far, FURTHER - LOOKS, setup.seed), *further]


def without_plate(kinds: Sequence[type[Effect]]) -> list[type[Effect]]:
    """The candidates that are looked at: no look shows a plate that rings."""
    return [kind for kind in kinds if kind.id != PLATE]


def begun_beside(
    setup: Setup, kinds: Sequence[type[Effect]], plain: Family, as_far: Family, sure: tuple[str, ...] = ()
) -> list[Family]:
    """The first candidates beside the family `plain` by one step, and by a look; and the set that is sure, too.

    as_far : that family, fitted as far as a race goes; the steps are taken from there.
    """
    looks = sorted(first_looks(setup, kinds, plain), key=lambda f: f.point.objective)
    if plain.effects and leads_nowhere(sorted(looks, key=mean_loss)):
        looks = outlasting(setup, looks)
    lists = (first_steps(setup, kinds, as_far), looks)
    return [f for found in lists for i, f in enumerate(found) if i < LOOKED_AT or f.effects == sure]


def fitted_anew(
    setup: Setup,
    begun: dict,
    kept: Family,
    say: Callable[[str], None],
    sure: tuple[str, ...] = (),
    patient: bool = True,
    most: float = np.inf,
) -> list[Family]:
    """Sets of effects, each with the z of its last one, fitted from nominal parameters; who comes nearest, in full.

    sure : the set that is fitted in full wherever it stands; patient : whether the next ones get their turn, too, where
    none of the nearest arrives; most : mean loss on the short windows above which nobody is.
    """

    def look(own: Setup, effects: tuple[str, ...]) -> Family:
        z = np.concatenate([nominal(kept.fit.parameters, kept.point.z), begun[effects]])
        family = Family(effects, *early(own, effects, z, LOOKS))
        say(f"  from nominal: {effects[-1]} {mean_loss(family):.2f}")
        return family

    looked = [f for f in side_by_side(setup, look, begun) if mean_loss(f) <= most]
    return nearest_in_full(setup, looked, kept, sure, patient) if looked else []


def nearest_in_full(
    setup: Setup, looked: list[Family], kept: Family, sure: tuple[str, ...], patient: bool = True
) -> list[Family]:
    """Of families on the short windows those that come nearest, and the set that is sure, through both stages.

    The nearest goes first. Once one that gains much leaves nothing those that follow begin where it ended: nobody can
    gain much more, and who does as well on the same records does so near there. Where none of them arrives the next
    ones get their turn: in a side valley the right one looks like the others. kept : the family over which they gain.
    """
    looked = sorted(looked, key=mean_loss)
    best, middle = best_and_middle(looked)
    most = max(best + AHEAD * (middle - best), ALIKE * best)
    near = [f for f in looked if mean_loss(f) <= most][: 1 if leads_nowhere(looked) else 2 * FITTED]
    ahead = near[:FITTED] + [f for f in looked if f.effects == sure and all(f is not other for other in near[:FITTED])]
    ended: list[Family] = []
    for batch in (ahead[:1], ahead[1:FITTED], ahead[FITTED:]):
        ended += side_by_side(setup, in_full, batch)
        nearest = min(ended, key=mean_loss)
        if leaves_nothing(nearest, kept):
            return [*ended, *in_the_valley_of(setup, nearest, [f.effects for f in ahead[len(ended) :]], kept)]
    if patient and nobody_arrives(nearest, kept):
        ended += side_by_side(setup, in_full, [f for f in near[FITTED:] if f.effects != sure])
    return ended


def nearest_of_each(families: Iterable[Family]) -> list[Family]:
    """Of each set of effects the family that comes nearest, in the order in which the sets first stand."""
    found: dict[tuple[str, ...], Family] = {}
    for f in families:
        found[f.effects] = min(found.get(f.effects, f), f, key=mean_loss)
    return list(found.values())


def best_and_middle(looked: list[Family]) -> tuple[float, float]:
    """The least and the middle mean loss of families that stand in their order."""
    return mean_loss(looked[0]), mean_loss(looked[len(looked) // 2])


def leads_nowhere(looked: list[Family]) -> bool:
    """Whether families that stand in their order, best first, are all far off, and nobody is ahead."""
    best, middle = best_and_middle(looked)
    return best > max(FAR_OFF, ALL_THE_SAME * middle)


def outlasting(setup: Setup, looks: list[Family]) -> list[Family]:
    """Looks that are all alike, fitted an iteration at a time, the better half of them further; best first.

    Beside another effect a look, which fits nothing else, may tell nobody apart: beside a scale of the gyroscope
    rolling resistance was the 22nd of 27, all at 3.4 to 3.5, and beside a plate that rang the spin of the feet the
    third; one iteration of everything brought both to the front, and two more did not take them from it.
    """
    while len(looks) > LOOKED_AT:
        looks = sorted(refit_all(setup, looks, 1, setup.seed), key=mean_loss)
        looks = looks[: max(LOOKED_AT, len(looks) // 2)]
    return looks


def nobody_arrives(nearest: Family, kept: Family) -> bool:
    """Whether the nearest of some families leaves much, and more than it gains, where not too much is structured."""
    left = room(nearest)
    return left > rules.UNFINISHED and structured(nearest) <= FAR and left > gain_between(kept, nearest)


def in_full(setup: Setup, looked: Family) -> Family:
    """A first look fitted through both stages: on from where it is, if it is near its valley, else begun once more."""
    rest = (FRESH[0] - LOOKS, FRESH[1])
    if mean_loss(looked) > NEAR:
        return Family(looked.effects, *baseline(setup, looked.effects, looked.point.z, iterations=rest))
    point = onward(setup, looked.fit, looked.point, rest[0])
    return Family(looked.effects, *late(setup, looked.effects, point.z, rest[1]))


def kin(id: str) -> list[str]:
    """The effects that are most easily taken for this one: its confounder, who has it as theirs, and who shares it."""
    own = catalogue.find(id).confounder
    near = [own, *(k for k, e in catalogue.EFFECTS.items() if e.confounder in (id, own))]
    return [k for k in dict.fromkeys(near) if k and k != id]


def in_the_valley_of(setup: Setup, winner: Family, others: Iterable[tuple[str, ...]], kept: Family) -> list[Family]:
    """Other sets of effects, begun where the winner ended, less its effect: by one step of everything, then fitted.

    A fit that stopped in a side valley lies some hundred units too high; in one valley, and on the winner's windows,
    effects are compared, not valleys. kept : the family over which all of them gain.
    """
    plain = cut_back(setup, winner, winner.effects[:-1])
    begun = first_steps(setup, [catalogue.find(other[-1]) for other in others], plain)
    tried = refit_all(setup, begun, TRIED_FIRST, setup.seed)
    gain = gain_between(kept, winner)
    near: list[Family] = []
    behind: list[Family] = []
    for f in tried:
        (near if gain_between(kept, f) > LEFT_BEHIND * gain else behind).append(f)
    return [*refit_all(setup, near, SWAPPED - TRIED_FIRST, setup.seed, relative=LITTLE / 5), *behind]


def cut_back(setup: Setup, ended: Family, effects: tuple[str, ...]) -> Family:
    """A family where it ended, on its windows, with no more than these first ones of its effects."""
    fit = setup.fit(ended.fit.series, effects)
    point, _ = fit.point(ended.point.z[: len(fit.parameters)], ended.point.corrections)
    return Family(effects, fit, point)


def own_z(setup: Setup, effects: tuple[str, ...]) -> np.ndarray:
    """The z of the last of these effects where it is absent."""
    return np.zeros(len(setup.parameters(effects)) - len(setup.parameters(effects[:-1])))


def nominal_beside(setup: Setup, kept: Family) -> Family:
    """The nominal baseline in its valley on the short windows, with what the family `kept` holds of effects."""
    short = windows(replace(setup, end=min(setup.end, FIRST_STAGE)), SHORT, kept.fit.models(kept.point.z)[0][0])
    plain = Fit(short, setup.base, setup.parameters(kept.effects))
    return Family(kept.effects, plain, approached(plain, nominal(kept.fit.parameters, kept.point.z)))


def first_looks(setup: Setup, kinds: Sequence[type[Effect]], plain: Family) -> list[Family]:
    """Each candidate beside the nominal baseline in its valley: moved along, nothing fitted."""

    def look(own: Setup, id: str) -> Family:
        effects = (*plain.effects, id)
        fit = own.fit(plain.fit.series.twin(), effects)
        start = plain.point.z
        z = np.concatenate([start, np.zeros(len(fit.parameters) - len(start))])
        point = approached_beside(fit, z, len(start))
        fit.series = plain.fit.series  # what the twin has kept is not needed any more
        return Family(effects, fit, point)

    return side_by_side(setup, look, [kind.id for kind in kinds])


def first_steps(setup: Setup, kinds: Sequence[type[Effect]], plain: Family) -> list[Family]:
    """Each candidate by one step of everything from where the family `plain` is, best first."""
    return [Family(t.effects, t.fit, t.point) for t in screen(plain.fit, plain.point, kinds, setup, plain.effects)]
