"""Two effects at once: both are seen in one step from a baseline that is not yet bent."""

import numpy as np
import pytest

from rockref import Model
from rockref.discover import diagnose
from rockref.discover.fit.families import Family
from rockref.discover.fit.search import SHORT, Setup, windows
from rockref.discover.looking import two
from rockref.discover.looking.far import LOOKS, nominal_beside
from rockref.discover.looking.look import Look
from rockref.discover.looking.screen import screen
from rockref.discover.looking.two import promises, stepped_along, two_at_once
from rockref.effects import catalogue
from rockref.effects.catalogue import parse
from tests.unit.discover.bowls import ALONE, WINDOWS, Bowl, family
from tests.unit.discover.looking.test_look import left
from tests.unit.discover.synthetic import experiment

KINDS = [catalogue.find(id) for id in ("quadratic_drag", "spin_friction", "gyro_scale", "adhesion", "plate_tilt")]

SUPPORT = catalogue.find("compliant_support")


@pytest.fixture(scope="module")
def hidden():
    """Setup, fit and point after a few iterations of the nominal baseline, where a foot resists spin and the gyroscope
    shows too little."""
    effects = (parse("spin_friction:radius=0.003"), parse("gyro_scale:x=0.96,y=0.97,z=0.98"))
    truth = Model.table_3_1().replace(effects=effects)
    e = experiment(truth, [{}, {"turned": True}], duration=1.2, noisy=True)
    setup = Setup(e, e.runs, Model.table_3_1(), end=1.2, workers=1)
    fit = setup.fit(windows(setup, SHORT))
    plain = nominal_beside(setup, Family((), fit, fit.begin()))
    return setup, plain.fit, plain.fit.run(plain.point, LOOKS, np.random.default_rng(0))


def test_the_right_pair_promises_most(hidden):
    found = promises(*hidden, KINDS, ["gyro_scale", "quadratic_drag"])
    assert found[0].effects == ("gyro_scale", "spin_friction")
    # Four others beside each of the two that led, less the pair of them that would be counted twice.
    assert len(found) == 7 and all(p.effects[0] in ("gyro_scale", "quadratic_drag") for p in found)
    gains = [p.gain for p in found]
    assert gains == sorted(gains, reverse=True) and gains[0] > 1.1 * gains[1]


def test_the_step_of_a_pair_leads_lower_than_those_of_its_effects(hidden):
    setup, fit, point = hidden
    best = promises(*hidden, KINDS, ["gyro_scale"])[0]
    found = stepped_along(setup, fit, point, best)
    names = [p.name for p in found.fit.parameters]
    assert found.effects == best.effects == ("gyro_scale", "spin_friction")
    alone = screen(fit, point, [k for k in KINDS if k.id in found.effects], setup)
    assert found.point.objective < min(t.point.objective for t in alone) < point.objective
    # What a step promises of its own is less than all of it by what the step without the candidate promises.
    without = [t.predicted - t.own for t in alone]
    assert 0 < without[0] < min(t.predicted for t in alone) and without == pytest.approx(without[:1] * len(alone))
    # The columns stand in the order of the effects: the step of the scale moves the scale.
    assert found.point.z[names.index("gyro_scale.x")] < 0 < found.point.z[names.index("spin_friction.radius")]


def test_the_best_of_the_race_is_fitted_in_full_on_top_of_the_one_that_led(monkeypatch):
    """Of five pairs four are raced; the winner holds no effect that was found, so its first one counts as alone."""
    start, other = left(("gyro_scale",), 0.6), left(("adhesion",), 0.9)
    bowls = {id: Bowl(np.zeros(3), floor=1.4) for id in "abd"} | {"adhesion": Bowl(np.zeros(3))}
    pairs = [two.Promise((id, "plate_tilt"), gain, np.zeros(3)) for gain, id in enumerate("edcba", 5)][::-1]
    pairs[2] = two.Promise(("adhesion", "plate_tilt"), 7, np.zeros(3))
    asked = {}

    def promised(setup, fit, point, kinds, leading):
        asked["leading"] = list(leading)
        return pairs

    monkeypatch.setattr(two, "nominal_beside", lambda setup, kept: kept)
    monkeypatch.setattr(two, "candidates_beside", lambda setup, effects: (SUPPORT,))
    monkeypatch.setattr(two, "promises", promised)
    monkeypatch.setattr(
        two, "stepped_along", lambda setup, fit, point, p: family(p.effects, bowls[p.effects[0]], np.zeros(3))
    )
    unseen = [("gyro_scale", "compliant_support"), ("adhesion", "compliant_support")]
    begun = 2 * [family(pair, bowls["a"], np.zeros(3)) for pair in unseen]
    monkeypatch.setattr(two, "beside_leaders", lambda setup, alone, *_: asked.update(alone=alone) or begun)
    monkeypatch.setattr(two, "in_full", lambda setup, looked: looked)
    lines: list[str] = []
    look = two_at_once(ALONE, Look(left((), 0.9), [start, other], {}), start, lines.append)
    assert asked["leading"] == ["gyro_scale", "adhesion"] and asked["alone"] == {"gyro_scale": start, "adhesion": other}
    assert look.kept is other and look.in_full
    assert [f.effects for f in look.order] == [("adhesion", "plate_tilt")] and look.gains["plate_tilt"] > 0
    raced = [tuple(line.split()[3:6:2]) for line in lines[:6]]
    assert raced[0] == ("adhesion", "plate_tilt") and {a for a, _ in raced} == {"adhesion", "a", "b", "d", "gyro_scale"}
    assert all(pair in raced for pair in unseen)


@pytest.mark.parametrize(
    "leading, at_tone, looked",
    [
        (["spin_friction", "compliant_support", "adhesion"], ["spin_friction"], ["spin_friction", "compliant_support"]),
        (["compliant_support", "spin_friction"], [], ["compliant_support"]),
        (
            ["adhesion", "spin_friction", "gyro_scale", "plate_tilt"],
            ["adhesion", "spin_friction", "gyro_scale"],
            ["adhesion"],
        ),
    ],
)
def test_a_plate_stands_at_its_tone_beside_those_that_led_more_and_others_beside_the_first_and_a_plate(
    monkeypatch, leading, at_tone, looked
):
    """Three leaders at most get a plate, and none where the model has it already; each leader is begun at once only."""
    begun = []
    monkeypatch.setattr(two, "nominal_beside", lambda setup, kept: begun.append(kept.effects[0]) or kept)
    monkeypatch.setattr(two, "at_its_tone", lambda setup, plain, as_far: [(*plain.effects, "compliant_support")])
    monkeypatch.setattr(
        two, "begun_beside", lambda setup, kinds, plain, as_far: [(*plain.effects, kind.id) for kind in kinds]
    )
    alone = {id: left((id,), 0.9) for id in leading}
    found = two.beside_leaders(ALONE, alone, leading, [*KINDS, SUPPORT])
    plates = {(id, "compliant_support") for id in at_tone}
    others = {(id, kind.id) for id in looked for kind in KINDS if kind.id != id}
    assert len(found) == len(plates | others) and set(found) == plates | others
    assert sorted(begun) == sorted({*at_tone, *looked})
    assert not any("compliant_support" in pair[1:] for pair in two.beside_leaders(ALONE, alone, leading, KINDS))


def test_a_pair_that_only_a_look_beside_the_leader_shows_wins_the_race(monkeypatch):
    start, far_off = left(("gyro_scale",), 0.8), Bowl(np.zeros(3), floor=2.1)
    rolling = family(("gyro_scale", "rolling_resistance"), Bowl(np.zeros(3)), np.zeros(3))
    monkeypatch.setattr(two, "nominal_beside", lambda setup, kept: kept)
    monkeypatch.setattr(two, "candidates_beside", lambda setup, effects: ())
    monkeypatch.setattr(two, "promises", lambda *_: [two.Promise(("gyro_scale", "adhesion"), 1.0, np.zeros(3))])
    monkeypatch.setattr(two, "stepped_along", lambda setup, fit, point, p: family(p.effects, far_off, np.zeros(3)))
    monkeypatch.setattr(two, "begun_beside", lambda setup, kinds, plain, as_far: [rolling])
    monkeypatch.setattr(two, "in_full", lambda setup, looked: looked)
    look = two_at_once(ALONE, Look(left((), 0.9), [start], {}), start, lambda line: None)
    assert [f.effects for f in look.order] == [("gyro_scale", "rolling_resistance")]


def test_a_pair_whose_second_has_no_derivative_wins_the_race_by_its_tone(monkeypatch):
    """One step sees nothing of a plate that rings; an iteration at each tone does."""
    start, far_off = left(("spin_friction",), 0.8), Bowl(np.zeros(3), floor=2.1)
    monkeypatch.setattr(two, "nominal_beside", lambda setup, kept: kept)
    monkeypatch.setattr(two, "candidates_beside", lambda setup, effects: (SUPPORT,))
    monkeypatch.setattr(two, "promises", lambda *_: [two.Promise(("spin_friction", "adhesion"), 1.0, np.zeros(3))])
    monkeypatch.setattr(two, "stepped_along", lambda setup, fit, point, p: family(p.effects, far_off, np.zeros(3)))
    ringing = family(("spin_friction", "compliant_support"), Bowl(np.zeros(3)), np.zeros(3))
    monkeypatch.setattr(two, "beside_leaders", lambda *_: [ringing])
    monkeypatch.setattr(two, "in_full", lambda setup, looked: looked)
    look = two_at_once(ALONE, Look(left((), 0.9), [start], {}), start, lambda line: None)
    assert look.kept is start and [f.effects for f in look.order] == [("spin_friction", "compliant_support")]


def test_pairs_that_the_race_does_not_tell_apart_are_both_fitted_in_full(monkeypatch):
    """Drag is a trifle ahead of rolling resistance on the short windows, and behind it in full."""
    start = left(("gyro_scale",), 0.6)
    floors = {"quadratic_drag": 1.0, "rolling_resistance": 1.01, "cable_restraint": 1.015, "adhesion": 1.04}
    asked = []

    def in_full(setup, looked):
        asked.append(looked.effects[1])
        return family(looked.effects, Bowl(np.zeros(3), floor=2.0 - floors[looked.effects[1]]), np.zeros(3))

    monkeypatch.setattr(two, "nominal_beside", lambda setup, kept: kept)
    monkeypatch.setattr(two, "candidates_beside", lambda setup, effects: ())
    monkeypatch.setattr(
        two, "promises", lambda *_: [two.Promise(("gyro_scale", id), 1.0, np.zeros(3)) for id in floors]
    )
    monkeypatch.setattr(
        two,
        "stepped_along",
        lambda setup, fit, point, p: family(p.effects, Bowl(np.zeros(3), floor=floors[p.effects[1]]), np.zeros(3)),
    )
    monkeypatch.setattr(two, "beside_leaders", lambda *_: [])
    monkeypatch.setattr(two, "in_full", in_full)
    look = two_at_once(ALONE, Look(left((), 0.9), [start], {}), start, lambda line: None)
    assert asked == ["quadratic_drag", "rolling_resistance"]
    assert look.order[0].effects == ("gyro_scale", "rolling_resistance")


def test_pairs_that_are_all_far_off_are_left_there(monkeypatch):
    start, far_off = left(("gyro_scale",), 0.6), Bowl(np.zeros(3), floor=2.1)
    monkeypatch.setattr(two, "nominal_beside", lambda setup, kept: kept)
    monkeypatch.setattr(two, "candidates_beside", lambda setup, effects: ())
    monkeypatch.setattr(two, "promises", lambda *_: [two.Promise(("gyro_scale", "adhesion"), 1.0, np.zeros(3))])
    monkeypatch.setattr(two, "stepped_along", lambda setup, fit, point, p: family(p.effects, far_off, np.zeros(3)))
    monkeypatch.setattr(two, "beside_leaders", lambda *_: [])
    monkeypatch.setattr(two, "in_full", lambda setup, looked: pytest.fail("fitted in full"))
    assert two_at_once(ALONE, Look(left((), 0.9), [start], {}), start, lambda line: None) is None


@pytest.mark.parametrize(
    "alone, gain, expected",
    [(0.6, 3000.0, True), (0.1, 3000.0, False), (0.6, 100.0, False), (0.95, 3000.0, True), (0.95, 1000.0, False)],
)
def test_two_are_looked_for_where_one_leaves_too_much(monkeypatch, alone, gain, expected):
    """It explains most windows, or next to nothing; where nearly all are left, less than half will not do."""
    monkeypatch.setattr(two, "room", lambda family: 3000.0)
    look = Look(left((), 0.9), [], {"rolling_resistance": gain})
    assert two.leaves_too_much(look, left(("rolling_resistance",), alone)) == expected


@pytest.mark.parametrize(
    "pair, sizes, gain, taken",
    [
        pytest.param(0.0, (1.0, 1.0), 2000.0, True, id="they settle what one leaves"),
        pytest.param(0.5, (1.0, 1.0), 2000.0, False, id="they do not"),
        pytest.param(0.0, (1.0, 0.1), 2000.0, False, id="one of them is a trifle"),
        pytest.param(0.0, (1.0, 1.0), 500.0, False, id="the second gains little"),
        pytest.param(None, (1.0, 1.0), 2000.0, False, id="no pair comes near"),
    ],
)
def test_a_pair_is_taken_if_it_settles_what_one_leaves(monkeypatch, pair, sizes, gain, taken):
    effects = ("rolling_resistance", "quadratic_drag")
    both = family(effects, Bowl(np.array([0.0, *sizes])), [0.0, *sizes])
    both.point.loss[: round((pair or 0) * WINDOWS)] *= 4.0
    found = Look(left(effects[:1], 0.6), [both], {effects[1]: gain}, in_full=True)
    monkeypatch.setattr(two, "two_at_once", lambda *_: None if pair is None else found)
    look = two.settled_by_two(ALONE, Look(left((), 0.9), [], {}), left(effects[:1], 0.6), 0, lambda line: None)
    assert look is (found if taken else None)


@pytest.mark.parametrize(
    "other, size, taken",
    [
        pytest.param(0.0, 1.0, True, id="it settles more"),
        pytest.param(0.15, 1.0, False, id="it settles less"),
        pytest.param(0.0, 0.1, False, id="it is a trifle"),
        pytest.param(None, 1.0, False, id="nothing is found"),
    ],
)
def test_where_a_pair_leaves_some_windows_one_more_look_on_top_of_its_first_may_win(monkeypatch, other, size, taken):
    """One step of two effects does not see what has no derivative where it is absent."""

    effects = ("rolling_resistance", "quadratic_drag")

    def pair(share, size=1.0):
        found = family(effects, Bowl(np.array([0.0, 1.0, size])), [0.0, 1.0, size])
        found.point.loss[: round(share * WINDOWS)] *= 4.0
        return Look(left(effects[:1], 0.6), [found], {effects[1]: 2000.0}, in_full=True)

    raced = pair(0.1)
    looked = pair(other, size) if other is not None else Look(raced.kept, [], {})
    asked = []
    monkeypatch.setattr(two, "two_at_once", lambda *_: raced)
    monkeypatch.setattr(two, "look_further", lambda setup, start, *_: asked.append(start) or looked)
    found = two.settled_by_two(ALONE, Look(left((), 0.9), [], {}), raced.kept, 0, lambda line: None)
    assert found is (looked if taken else raced) and asked == [raced.kept]


@pytest.mark.parametrize("alone, looked", [(0.6, ["one", "two"]), (0.4, ["one", "two", "one"]), (0.1, ["one", "one"])])
def test_where_two_settle_nothing_most_windows_are_left_alone(monkeypatch, alone, looked):
    """One more is looked for on top of a first effect that explains at least half of the windows."""
    first, seen = left(("rolling_resistance",), alone), []

    def one(setup, start, seed, say):
        seen.append("one")
        return Look(left((), 0.9), [] if start.effects else [first], {"rolling_resistance": 3000.0}, in_full=True)

    monkeypatch.setattr(diagnose, "look_further", one)
    monkeypatch.setattr(diagnose, "upheld", lambda look, wider, *_: wider)
    monkeypatch.setattr(diagnose, "settled_by_two", lambda *_: seen.append("two"))
    monkeypatch.setattr(diagnose, "to_the_end", lambda setup, look, found, *_: found)
    monkeypatch.setattr(diagnose, "room", lambda family: 3000.0)
    start, looks = diagnose.grown(ALONE, left((), 0.9), 0, lambda line: None)
    assert start is first and seen == looked
