"""The moves of a diagnosis, on bowls in place of fits: where it begins, and the pruning of a pair."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover import diagnose
from rockref.discover.diagnose import beginning, ranked_by
from rockref.discover.fit.evidence import Losses
from rockref.discover.looking import fewer, two
from rockref.discover.looking.look import Look
from rockref.effects import catalogue
from tests.unit.discover.bowls import WINDOWS, Bowl, family, series


@pytest.mark.parametrize(
    "sensor, plain, builds_on",
    [
        (1.0, 4.0, ("gyro_scale",)),  # it explains what follows, too
        (1.6, 2.9, ()),  # it leaves all windows structured, and the baseline's own turn ends less than twice above
        (1.6, 3.5, ("gyro_scale",)),  # the baseline is far worse
        (1.0, 1.001, ()),  # hardly better than the baseline
    ],
)
def test_what_the_release_suggested_is_built_on_if_it_explains_what_follows(monkeypatch, sensor, plain, builds_on):
    asked = []

    def baseline(setup, effects=(), z=None, iterations=None):
        asked.append(effects)
        bowl = Bowl(np.zeros(1 + len(effects)), floor=sensor if effects else plain)
        return bowl, bowl.point(np.zeros(1 + len(effects)), np.zeros((WINDOWS, 5)))[0]

    monkeypatch.setattr(diagnose, "baseline", baseline)
    own = SimpleNamespace(prior=1.0)
    setup = SimpleNamespace(workers=1, parameters=lambda effects: [own] * (1 + len(effects)))
    seen = {"loss": 1.0, "z": np.zeros(1), "starts": {("gyro_scale",): np.zeros(2)}}
    null, start, aside = beginning(setup, [(), ("gyro_scale",)], seen)
    assert (null.effects, start.effects) == ((), builds_on)
    assert (aside is None) if builds_on else (aside.effects == ("gyro_scale",))
    assert asked == [(), ("gyro_scale",)] + [()] * (sensor > 1.5)


def test_the_first_of_a_pair_is_ranked_by_what_both_gain():
    """It may have a small gain of its own in the last look, as a second effect beside the one whose place it took."""
    null = family((), Bowl(np.zeros(1), floor=1.5), np.zeros(1))
    pair = family(("rolling_resistance", "quadratic_drag"), Bowl(np.array([0.1, 0.5, 1.0])), [0.1, 0.5, 1.0])
    gains = ranked_by(null, pair, Look(null, [], {"rolling_resistance": 5.0, "quadratic_drag": 300.0, "adhesion": 7.0}))
    assert gains["rolling_resistance"] > 100 and gains["quadratic_drag"] == 300.0 and gains["adhesion"] == 7.0
    # What the release named was in no look.
    alone = family(("rolling_resistance",), Bowl(np.array([0.1, 0.5])), [0.1, 0.5])
    assert ranked_by(null, alone, Look(alone, [], {}))["rolling_resistance"] > 100


def test_the_flat_top_of_the_records_decides_for_the_stops_of_the_gyroscope(monkeypatch):
    def baseline(setup, effects=(), z=None, iterations=None):
        bowl = Bowl(np.zeros(1 + len(effects)), floor=3.0 if effects else 1.0)
        return bowl, bowl.point(np.zeros(1 + len(effects)), np.zeros((WINDOWS, 5)))[0]

    monkeypatch.setattr(diagnose, "baseline", baseline)
    setup = SimpleNamespace(workers=1, parameters=lambda effects: [SimpleNamespace(prior=1.0)] * (1 + len(effects)))
    seen = {"loss": 1.0, "z": np.zeros(1), "flat_top": 0.5}
    null, start, aside = beginning(setup, [(), ("gyro_saturation",)], seen)
    assert (null.effects, start.effects) == ((), ("gyro_saturation",)), "though the baseline fits better"
    assert aside is None


@pytest.mark.parametrize("floor, builds_on", [(1.2, ("gyro_scale",)), (1.05, ())])
def test_a_suspect_with_windows_of_its_own_has_to_fit_clearly_better(monkeypatch, floor, builds_on):
    """A gain cannot be counted where the windows are cut elsewhere: mean losses are set side by side."""

    def baseline(setup, effects=(), z=None, iterations=None):
        bowl = Bowl(np.zeros(1 + len(effects)), 1.0 if effects else floor, series=series(7 if effects else 0))
        return bowl, bowl.point(np.zeros(1 + len(effects)), np.zeros((WINDOWS, 5)))[0]

    monkeypatch.setattr(diagnose, "baseline", baseline)
    setup = SimpleNamespace(workers=1, parameters=lambda effects: [SimpleNamespace(prior=1.0)] * (1 + len(effects)))
    seen = {"loss": 1.0, "z": np.zeros(1), "starts": {("gyro_scale",): np.zeros(2)}}
    assert beginning(setup, [(), ("gyro_scale",)], seen)[1].effects == builds_on


def left(effects, share, room=0.0):
    """A family that leaves this share of its windows structured, and this much to be gained on the others."""
    z = [0.0, 1.0, 1.0][: len(effects) + 1]
    found = family(effects, Bowl(np.array(z)), z)
    found.point.loss[:] *= 1 + room
    found.point.loss[: round(share * len(found.point.loss))] *= 4.0
    return found


LEVER, BOTH = ("rolling_resistance",), ("rolling_resistance", "quadratic_drag")


@pytest.fixture
def course(monkeypatch):
    """The looks of a diagnosis as a script: each a family and what it gains; what was asked comes back."""
    asked = SimpleNamespace(looks=[], duels=0, pair=None)

    def look_further(setup, start, seed, say):
        found, gain, in_full = asked.looks.pop(0)
        return Look(start, [found] if found else [], {found.effects[-1]: gain} if found else {}, in_full)

    def duel(setup, look, say):
        asked.duels += 1
        return look.order[0]

    # Forty windows have less room than the runs of an experiment.
    monkeypatch.setattr(diagnose.rules, "SECOND_ROOM", 500.0)
    monkeypatch.setattr(diagnose, "look_further", look_further)
    monkeypatch.setattr(diagnose, "duel", duel)
    monkeypatch.setattr(diagnose, "upheld", lambda look, wider, *a: None if wider.effects == ("adhesion",) else wider)
    monkeypatch.setattr(two, "two_at_once", lambda setup, look, found, say: asked.pair)
    monkeypatch.setattr(diagnose, "to_the_end", lambda setup, look, winner, *a: winner)
    return asked


def grow(course, *looks):
    course.looks = list(looks)
    start, seen = diagnose.grown(None, left((), 0.9), 0, lambda line: None)
    return start.effects, len(seen), course.duels


def test_where_nothing_gains_nothing_is_added(course):
    assert grow(course, (None, 0.0, False)) == ((), 1, 0)
    assert grow(course, (left(LEVER, 0.5), 50.0, False)) == ((), 1, 0)


def test_a_winner_of_a_first_step_has_to_stand_in_a_duel_and_one_fitted_in_full_has_stood(course):
    assert grow(course, (left(LEVER, 0.0), 5000.0, False)) == (LEVER, 1, 1)
    assert grow(course, (left(LEVER, 0.0), 5000.0, True)) == (LEVER, 1, 1)


def test_a_winner_that_is_not_upheld_is_no_effect(course):
    assert grow(course, (left(("adhesion",), 0.0), 5000.0, True)) == ((), 1, 0)


def test_a_first_effect_that_was_begun_anew_stays_where_that_led(course, monkeypatch):
    """A rival that was a trifle led out of a side valley, and the first effect alone is as good there."""
    side, better = left(LEVER, 0.28, room=0.3), left(LEVER, 0.0)

    def upheld(look, wider, second, *_):
        if second:
            look.kept = better
        return None if second else wider

    monkeypatch.setattr(diagnose, "upheld", upheld)
    course.looks = [(side, 5000.0, True), (left(BOTH, 0.0), 2000.0, True)]
    assert diagnose.grown(None, left((), 0.9), 0, lambda line: None)[0] is better


@pytest.mark.parametrize("rest, grown", [(0.0, BOTH), (0.15, LEVER)])
def test_a_second_effect_has_to_settle_what_the_first_left(course, rest, grown):
    first = left(LEVER, 0.18, room=0.3)
    assert grow(course, (first, 5000.0, True), (left(BOTH, rest), 2000.0, True))[:2] == (grown, 2)


def test_two_at_once_take_the_place_of_a_first_that_leaves_too_much(course):
    first, pair = left(LEVER, 0.7, room=0.3), left(BOTH, 0.0)
    course.pair = Look(left(LEVER, 0.7), [pair], {"quadratic_drag": 3000.0})
    assert grow(course, (first, 5000.0, True)) == (BOTH, 2, 0)


def test_without_such_a_pair_a_first_that_leaves_most_windows_is_the_last(course):
    assert grow(course, (left(LEVER, 0.7, room=0.3), 5000.0, True)) == (LEVER, 1, 0)


@pytest.mark.parametrize(
    "gains, held, ends",
    [
        ({"quadratic_drag": 950.0}, 0.0, BOTH),  # it gains enough
        ({"quadratic_drag": 950.0, "adhesion": 860.0}, 0.0, BOTH),
        ({"quadratic_drag": 950.0, "adhesion": 930.0}, 0.3, LEVER),  # but a rival gains as much
        ({"quadratic_drag": 500.0}, 0.3, BOTH),  # the held-out runs show it
        ({"quadratic_drag": 500.0}, 0.1, LEVER),  # they show little of it
        ({"quadratic_drag": 500.0, "adhesion": 480.0}, 0.3, LEVER),  # a rival does as well
        ({"quadratic_drag": 500.0, "adhesion": 440.0, "rolling_resistance": 490.0}, 0.3, BOTH),
    ],
)
def test_a_second_effect_that_gains_little_has_to_be_shown_by_the_held_out_runs(monkeypatch, gains, held, ends):
    alone, pair = left(LEVER, 0.0, room=0.4), left(BOTH, 0.0)

    def held_out(setup, fit, point, experiment, effects):
        loss = 1.5 - (held if effects == BOTH else 0.0)
        return Losses(np.full(8, loss * 50), np.full(8, 100), np.repeat([0, 1], 4))

    monkeypatch.setattr(diagnose, "held_out", held_out)
    look = Look(alone, [pair], gains)
    assert diagnose.proven(None, None, pair, [look], lambda line: None).effects == ends


@pytest.mark.parametrize("left_by_both, ends", [(2405.0, LEVER), (1200.0, BOTH), (1450.0, BOTH)])
def test_a_second_effect_that_leaves_more_than_it_gains_is_not_the_cause(monkeypatch, left_by_both, ends):
    """Uneven friction gained 1305 units and left 2405, where the contact was another one."""
    alone, pair = left(LEVER, 0.3), left(BOTH, 0.1)
    monkeypatch.setattr(diagnose, "room", lambda family: left_by_both)
    look = Look(alone, [pair], {"quadratic_drag": 1305.0})
    assert diagnose.proven(None, None, pair, [look], lambda line: None).effects == ends


def test_effects_that_the_release_shows_need_no_other_proof():
    pair = left(BOTH, 0.0)
    assert diagnose.proven(None, None, pair, [], lambda line: None) is pair
    assert diagnose.proven(None, None, pair, [Look(pair, [], {})], lambda line: None) is pair


@pytest.fixture
def whole(monkeypatch):
    """A diagnosis whose every step is made up; returns the null, the end, and what was done between."""

    def prepare(start, looks, null=None, begun=None, alone=None):
        done = []
        null = null or left((), 0.9)

        def noted(name, result):
            return lambda *a, **k: (done.append(name), result(*a))[1]

        monkeypatch.setattr(diagnose, "opened", lambda path: (SimpleNamespace(fit_runs=lambda: ()), None))
        monkeypatch.setattr(diagnose, "baseline_model", lambda experiment, model: None)
        monkeypatch.setattr(diagnose, "suspects", lambda setup: (setup, [()], {}))
        monkeypatch.setattr(diagnose, "beginning", lambda setup, sets, seen: (null, begun or null, None))
        monkeypatch.setattr(diagnose, "grown", lambda setup, begun, seed, say: (start or begun, looks))
        monkeypatch.setattr(diagnose, "finished", noted("finished", lambda setup, f, seed: f))
        monkeypatch.setattr(fewer, "without", noted("without", lambda setup, f, effect: left((effect,), 0.1)))
        monkeypatch.setattr(fewer, "both_needed", noted("both needed", lambda setup, pair, *a: pair))
        monkeypatch.setattr(fewer, "one_for_both", noted("one for both", lambda setup, look, pair, *a: alone))
        monkeypatch.setattr(fewer, "exchanged", noted("exchanged", lambda setup, look, pair, *a: pair))
        monkeypatch.setattr(diagnose, "refit", noted("refit", lambda f, iterations, seed: left((), 0.05)))
        monkeypatch.setattr(diagnose, "conclude", lambda setup, held, null, final, *a: (null, final))
        return (*diagnose.diagnose("folder"), done)

    return prepare


def test_what_the_release_named_and_no_look_added_to_is_fitted_to_its_end(whole):
    named = left(LEVER, 0.0)
    for looks in ([], [Look(named, [], {})]):
        null, final, done = whole(named, looks, begun=named)
        assert (null.effects, final.effects, done) == ((), LEVER, ["finished"])
    # What a look has found was fitted to its end there.
    assert whole(left(LEVER, 0.0), [Look(named, [], {})])[2] == []


def test_of_a_pair_what_came_to_nothing_is_left_out_and_a_rival_of_the_first_is_tried(whole):
    kept = left((), 0.8)
    looks = [Look(kept, [], {})]
    pair = left(BOTH, 0.0)
    null, final, done = whole(pair, looks)
    assert null is kept and final is pair and done == ["one for both", "exchanged"]
    # Both were found on top of each other: what the second explains the first may have stood in for.
    assert whole(pair, [Look(kept, [], {}), Look(left(LEVER, 0.3), [], {"quadratic_drag": 5e3})])[2] == [
        "both needed",
        "one for both",
        "exchanged",
    ]
    pair = left(BOTH, 0.0)
    pair.point.z[2] = 0.01
    _, final, done = whole(pair, looks)
    assert final.effects == ("quadratic_drag",) and done == ["without"]


def test_one_effect_that_explains_as_much_as_two_takes_their_place_and_is_looked_at_last(whole):
    looks = [Look(left((), 0.8), [], {})]
    alone = Look(looks[0].kept, [left(("mass_eccentricity",), 0.0)], {"mass_eccentricity": 1171.0})
    null, final, done = whole(left(BOTH, 0.0), looks, alone=alone)
    assert (null, final, done) == (looks[0].kept, alone.order[0], ["one for both"]) and looks[-1] is alone
    # Where the releases had named an effect before any look, nobody is asked.
    named = [Look(left(LEVER, 0.3), [], {"quadratic_drag": 5e3})]
    assert whole(left(BOTH, 0.0), named, alone=alone)[2] == ["both needed"]


@pytest.mark.parametrize("room, taken", [(0.0, BOTH), (0.2, LEVER)])
def test_of_two_courses_the_one_that_explains_more_is_taken(room, taken):
    course, other = (left(LEVER, 0.0, room=0.2), []), (left(BOTH, 0.0, room=room), [])
    assert diagnose.better_course(*course, *other, lambda line: None)[0].effects == taken


@pytest.mark.parametrize("rest, courses, ends", [(0.3, [(), LEVER], BOTH), (0.0, [()], ("adhesion",))])
def test_a_suspect_that_was_set_aside_gets_its_course_where_much_is_left(monkeypatch, whole, rest, courses, ends):
    begun = []

    def grown(setup, start, seed, say):
        begun.append(start.effects)
        return (left(BOTH, 0.0), []) if start.effects else (left(("adhesion",), 0.0, room=rest), [])

    whole(None, [])
    monkeypatch.setattr(diagnose, "grown", grown)
    monkeypatch.setattr(diagnose, "beginning", lambda *a: (left((), 0.9), left((), 0.9), left(LEVER, 0.5)))
    monkeypatch.setattr(diagnose, "proven", lambda setup, held, start, looks, say: start)
    _, final = diagnose.diagnose("folder")
    assert begun == courses and final.effects == ends


def test_before_nothing_is_said_to_be_missing_the_baseline_goes_as_far_as_it_can(whole):
    null, final, done = whole(None, [Look(left((), 0.9), [], {})])
    assert null is final and null.effects == () and done == ["refit"]


@pytest.mark.parametrize(
    "verdict, found, asked", [("class", "Turn it.", "Turn it."), ("class", "", None), ("named", "Turn it.", None)]
)
def test_a_class_is_told_apart_by_a_run_that_was_simulated_for_it(monkeypatch, verdict, found, asked):
    monkeypatch.setattr(diagnose, "separating_run", lambda setup, model, effects, size: found)
    final = left(("quadratic_drag",), 0.0)
    final.fit.models = lambda z: [["model"]]
    decision = SimpleNamespace(verdict=verdict, effects=("quadratic_drag", "rolling_resistance"))
    said = diagnose.to_be_sure(None, final, final, decision)
    assert said == (asked or catalogue.find("quadratic_drag").experiment)


def flat(held):
    """An experiment whose held-out records are cut at this rate."""
    gyro = SimpleNamespace(resolution=0.01, sample_rate=1000.0)
    return SimpleNamespace(path="folder", gyro=gyro, holdout_runs=lambda: held)


@pytest.mark.parametrize("held, same", [(0.505, True), (0.55, False), (None, False)])
def test_held_out_records_cut_at_the_same_rate_are_the_same_gyroscope_s(monkeypatch, held, same):
    monkeypatch.setattr(diagnose, "flat_tops", lambda experiment, runs: runs)
    assert diagnose.clipped(flat(held), {"flat_top": 0.5}) is same
    assert diagnose.clipped(flat(held), {}) is False


@pytest.mark.parametrize("share, flat, looked", [(0.5, True, False), (0.1, True, True), (0.5, False, True)])
def test_records_cut_to_pieces_are_searched_for_no_second_effect(share, flat, looked):
    """Windows without a state to start from would be structured with any other effect, too."""
    seen = {"flat_top": 0.5} if flat else {}
    assert diagnose.blinded(seen, left(("gyro_saturation",), share)) is not looked
