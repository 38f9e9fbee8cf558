"""Who wins a look, on bowls in place of fits: trifles, rivals that had not arrived, and effects that are none."""

from dataclasses import dataclass

import numpy as np
import pytest

from rockref.discover import window_rules as rules
from rockref.discover.fit.families import gain_over
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.looking import winning
from rockref.discover.looking.look import Look
from rockref.discover.looking.winning import (
    CONTENDS,
    all_finished,
    exchanged,
    finished,
    to_the_end,
    upheld,
)
from rockref.effects.friction.rolling_resistance import RollingResistance
from rockref.effects.loads.quadratic_drag import QuadraticDrag
from rockref.effects.sensor.gyro_scale import GyroScale
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from rockref.effects.shape.rounded_feet import RoundedFeet
from tests.unit.discover.bowls import ALONE, Bowl, family

ROLLING, DRAG = ("rolling_resistance",), ("quadratic_drag",)


def quiet(line):
    pass


def looked(kept, *order):
    """A look whose gains are those of its families over the one that was kept."""
    return Look(kept, list(order), {f.effects[-1]: gain_over(kept, f) for f in order})


def test_a_trifle_that_gains_most_gives_way_to_an_effect_with_a_size():
    kept = family((), Bowl(np.zeros(1), floor=1.2, stuck=True), np.zeros(1))
    trifle = family(ROLLING, Bowl(np.array([0.0, 0.1]), floor=1.0), np.array([0.0, 0.1]))
    whole = family(DRAG, Bowl(np.array([0.0, 0.0, 0.8]), floor=1.05), np.array([0.0, 0.0, 0.8]))
    look = looked(kept, trifle, whole)
    assert look.gains["rolling_resistance"] > look.gains["quadratic_drag"] > rules.DETECTED
    assert upheld(look, trifle, False, 0, quiet) is whole
    # Alone, the trifle is no effect; nor is a whole size that gains nothing.
    assert upheld(looked(kept, trifle), trifle, False, 0, quiet) is None
    idle = family(DRAG, Bowl(np.array([0.0, 0.0, 0.8]), floor=1.195), np.array([0.0, 0.0, 0.8]))
    assert upheld(looked(kept, trifle, idle), trifle, False, 0, quiet) is None


def test_a_baseline_that_does_as_well_from_there_leaves_no_effect():
    kept = family((), Bowl(np.array([0.5]), floor=1.0), np.array([-0.4]))
    wider = family(ROLLING, Bowl(np.array([0.5, 0.0]), floor=1.0), np.array([0.5, 0.4]))
    look = looked(kept, wider)
    assert look.gains["rolling_resistance"] > rules.DETECTED
    assert upheld(look, wider, False, 0, quiet) is None


def test_what_is_finished_has_arrived():
    halfway = family(ROLLING, Bowl(np.array([0.2, 0.5])), np.array([0.0, 0.25]))
    np.testing.assert_allclose(finished(ALONE, halfway, 0).point.z, [0.2, 0.5], atol=1e-3)


def test_a_rival_that_had_not_arrived_overtakes():
    kept = family((), Bowl(np.zeros(1), floor=1.2, stuck=True), np.zeros(1))
    winner = family(ROLLING, Bowl(np.array([0.0, 0.5]), floor=1.04), np.array([0.0, 0.5]))
    rival = family(DRAG, Bowl(np.array([0.0, 0.0, 1.0]), floor=1.0), np.array([0.0, 0.0, 0.77]))
    look = looked(kept, winner, rival)
    assert CONTENDS < look.gains["quadratic_drag"] / look.gains["rolling_resistance"] < 1
    best = to_the_end(ALONE, look, winner, False, 0, quiet)
    assert best.effects == DRAG
    assert [f.effects for f in look.order] == [DRAG, ROLLING]
    assert look.gains["quadratic_drag"] > look.gains["rolling_resistance"]


@pytest.mark.parametrize("noise, gap, ahead", [(1.0, 0.4, False), (2.0, 0.35, True)], ids=["far behind", "hopeless"])
def test_rivals_that_cannot_win_are_not_fitted_on(noise, gap, ahead):
    """One that gains too little; and one beside a winner that most windows contradict: another effect is missing."""
    kept = family((), Bowl(np.zeros(1), floor=noise + 0.2 + 0.1 * ahead, stuck=True), np.zeros(1))
    winner = family(ROLLING, Bowl(np.array([0.0, 0.5]), floor=noise + 0.1 * ahead), np.array([0.0, 0.5]))
    rival = family(DRAG, Bowl(np.array([0.0, 0.0, 1.0]), floor=noise), np.array([0.0, 0.0, 1.0 - gap]))
    look = looked(kept, winner, rival)
    assert (look.gains["quadratic_drag"] > CONTENDS * look.gains["rolling_resistance"]) is ahead
    assert to_the_end(ALONE, look, winner, False, 0, quiet).effects == ROLLING
    assert rival.fit.iterations == 0


@pytest.mark.parametrize("floor, taken", [(1.05, [ROLLING, DRAG]), (1.2, [ROLLING])], ids=["near", "far behind"])
def test_a_rival_that_is_far_behind_once_polished_is_not_taken_to_its_end(monkeypatch, floor, taken):
    winner = family(ROLLING, Bowl(np.array([0.0, 0.5])), np.array([0.0, 0.4]))
    rival = family(DRAG, Bowl(np.array([0.0, 0.0, 1.0]), floor=floor), np.array([0.0, 0.0, 0.9]))
    ended = []
    monkeypatch.setattr(winning, "completed", lambda setup, f, seed, ahead: (ended.append(f.effects), f)[1])
    found = all_finished(ALONE, [rival, winner], 0)
    assert ended == taken and [f.effects for f in found] == [ROLLING, DRAG]
    np.testing.assert_allclose(found[1].point.z, [0.0, 0.0, 1.0], atol=1e-3)


@pytest.mark.parametrize("reached, taken", [(0.99, True), (0.9, False), (None, True)])
def test_who_comes_late_is_taken_to_its_end_if_it_is_near_what_another_has_reached(monkeypatch, reached, taken):
    """It is told who is ahead."""
    late = family(DRAG, Bowl(np.array([0.0, 0.0, 1.0]), floor=1.05), np.array([0.0, 0.0, 0.9]))
    at = np.array([0.0, 0.5])
    ahead = None if reached is None else family(ROLLING, Bowl(at, floor=reached), at)
    told = []
    monkeypatch.setattr(winning, "completed", lambda setup, f, seed, ahead: (told.append(ahead), f)[1])
    assert [f.effects for f in all_finished(ALONE, [late], 0, ahead)] == [DRAG]
    assert told == ([ahead] if taken else [])


def test_what_ends_as_a_trifle_wins_only_if_nothing_else_is_there(monkeypatch):
    """Its kin is asked, though it leaves nothing: one of them may have a size."""
    asked = []
    monkeypatch.setattr(winning, "with_kin", lambda setup, ended, seed, say: asked.append(ended.order[0]) or ended)
    kept = family((), Bowl(np.zeros(1), floor=1.2, stuck=True), np.zeros(1))
    winner = family(ROLLING, Bowl(np.array([0.0, 0.5]), floor=1.03), np.array([0.0, 0.5]))
    trifle = family(DRAG, Bowl(np.array([0.0, 0.0, 0.1]), floor=1.0), np.array([0.0, 0.0, 0.1]))
    look = looked(kept, winner, trifle)
    assert to_the_end(ALONE, look, winner, False, 0, quiet).effects == ROLLING
    assert [f.effects for f in asked] == [DRAG]


@pytest.mark.parametrize(
    "left, kin_at, afresh_at, best",
    [(0.15, 0.0, None, DRAG), (0.15, 0.14, None, ROLLING), (-0.01, 0.0, None, ROLLING), (0.15, 0.14, 0.0, DRAG)],
    ids=["ahead", "far behind", "nothing is left", "in another valley"],
)
def test_kin_are_tried_where_a_winner_ended_and_left_something(monkeypatch, left, kin_at, afresh_at, best):
    """Decided by what they gain over the plain baseline; one that falls behind there is not fitted on."""
    kept = family((), Bowl(np.zeros(1), floor=1.3, stuck=True), np.zeros(1))
    winner = family(ROLLING, Bowl(np.array([0.0, 0.5]), floor=1.0 + left), np.array([0.0, 0.5]))
    kin = family(DRAG, Bowl(np.array([0.0, 0.0, 1.0]), floor=1.0 + kin_at), np.array([0.0, 0.0, 0.6]))
    asked = []

    def valley(setup, ended, others, over):
        asked.append((ended.effects, others, over))
        return [kin]

    monkeypatch.setattr(winning, "in_the_valley_of", valley)
    begun = []

    def afresh(setup, z, over, say, most):
        begun.append((z, over))
        assert most == pytest.approx(winning.KIN_BEHIND * (1.0 + left), rel=1e-3)
        end = np.array([0.0, 0.0, 1.0])
        return [] if afresh_at is None else [family(DRAG, Bowl(end, floor=1.0 + afresh_at), end)]

    monkeypatch.setattr(winning, "from_near", lambda *a: [])
    monkeypatch.setattr(winning, "leaves_a_large_part", lambda ended: False)
    monkeypatch.setattr(winning, "own_z", lambda setup, effects: "absent")
    monkeypatch.setattr(winning, "fitted_anew", afresh)
    monkeypatch.setattr(winning, "candidates_beside", lambda setup, effects: (QuadraticDrag, GyroScale))
    look = looked(kept, winner)
    assert to_the_end(ALONE, look, winner, False, 0, quiet).effects == best
    assert asked == ([] if left < 0 else [(ROLLING, [DRAG], kept)])
    assert begun == ([] if left < 0 else [({DRAG: "absent"}, kept)])
    assert (kin.fit.iterations > 0) is (best == DRAG and afresh_at is None)
    if best == DRAG:
        assert look.gains["quadratic_drag"] > look.gains["rolling_resistance"] > rules.DETECTED


@dataclass
class Named(Bowl):
    """A bowl whose parameters have the names that are given."""

    names: tuple[str, ...] = ()

    @property
    def parameters(self):
        return tuple(Parameter(n, lambda model, value: model, 0.0, 1.0) for n in self.names)


SIDES, SCALE, LEVER = ("sides.width", "sides.depth"), ("scale.x",), ("lever.m",)


def at_its_bottom(effects, names, floor=1.0):
    """A family of the baseline's one parameter and these, at the bottom of its bowl."""
    bowl = Named(np.arange(1.0 + len(names)), floor=floor, names=("K_N", *names))
    return family(effects, bowl, bowl.bottom)


# A pair's loss of 0.01 is 36 units, more than what is CLOSE; one of 0.005 is less.
@pytest.mark.parametrize(
    "first, other, behind, floor, taken",
    [
        (SIDES, SCALE, 0.0, 1.0, True),
        (SIDES, SCALE, 0.0, 1.005, True),
        (SIDES, SCALE, 0.0, 1.01, False),
        (SCALE, SIDES, 0.0, 0.995, False),
        (SCALE, SIDES, 0.0, 0.99, True),
        (SIDES, SCALE, 0.1, 1.0, False),
    ],
    ids=["alike and simpler", "nearly", "worse", "a little better, more flexible", "better", "no rival"],
)
def test_of_a_pair_the_first_effect_is_held_against_its_rivals(monkeypatch, first, other, behind, floor, taken):
    """It won its look while the second was missing; `behind`: the share by which its rival was behind there."""
    asked = []

    def baseline(setup, effects, z):
        asked.append((effects, list(z)))
        end = at_its_bottom(effects, (*other, *LEVER), floor)
        return end.fit, end.point

    monkeypatch.setattr(winning, "baseline", baseline)
    pair = at_its_bottom(("first", "lever"), (*first, *LEVER))
    rival = at_its_bottom(("other",), other)
    look = Look(at_its_bottom((), ()), [rival], {"first": 4000.0, "other": 4000.0 * (1 - behind)})
    best = exchanged(ALONE, look, pair, 0, quiet)
    assert best.effects == (("other", "lever") if taken else ("first", "lever"))
    # Begun where the rival had ended, with the second effect as large as in the pair.
    begun = (("other", "lever"), [*rival.point.z, pair.point.z[-1]])
    assert asked == ([] if behind else [begun])


def test_a_plain_gain_needs_no_challenge(monkeypatch):
    monkeypatch.setattr(winning, "challenge", lambda *a: pytest.fail("challenged"))
    kept = family((), Bowl(np.zeros(1), floor=1.2), np.zeros(1))
    winner = family(ROLLING, Bowl(np.array([0.0, 0.5])), np.array([0.0, 0.5]))
    look = Look(kept, [winner], {"rolling_resistance": 2 * winning.PLAIN})
    assert upheld(look, winner, False, 0, quiet) is winner


@pytest.mark.parametrize("size, behind, first", [(0.0, 0.99, ["quadratic_drag"]), (0.0, 0.9, []), (0.3, 0.99, [])])
def test_a_trifle_that_does_as_well_as_a_plain_winner_is_challenged(monkeypatch, size, behind, first):
    """Round feet of no radius did what an eccentric mass did: neither was needed where they had ended."""
    challenged = []

    def challenge(look, wider, seed, say):
        challenged.append(wider.effects[-1])
        look.gains = {id: gain - 2 * winning.PLAIN for id, gain in look.gains.items()}

    monkeypatch.setattr(winning, "challenge", challenge)
    kept = family((), Bowl(np.zeros(1), floor=1.2), np.zeros(1))
    winner = family(ROLLING, Bowl(np.array([0.0, 0.5])), np.array([0.0, 0.5]))
    rival = family(DRAG, Bowl(np.array([0.0, 0.0, size])), np.array([0.0, 0.0, size]))
    gains = {"rolling_resistance": 2 * winning.PLAIN, "quadratic_drag": 2 * winning.PLAIN * behind}
    found = upheld(Look(kept, [winner, rival], gains), winner, False, 0, quiet)
    assert challenged[:1] == first and found is (None if first else winner)


def test_where_a_duel_left_nobody_any_gain_nothing_is_upheld():
    kept = family((), Bowl(np.zeros(1), floor=1.2, stuck=True), np.zeros(1))
    none = family(ROLLING, Bowl(np.array([0.0, 0.0]), floor=1.2, stuck=True), np.array([0.0, 0.0]))
    look = Look(kept, [none], {"rolling_resistance": 0.0})
    assert upheld(look, none, False, 0, quiet) is None


@pytest.mark.parametrize("gain, left, tried", [(1000.0, 160.0, True), (1000.0, 140.0, False), (2500.0, 200.0, False)])
def test_a_winner_that_leaves_little_of_what_it_gains_stands_in_for_nobody(gain, left, tried):
    at = np.array([0.0, 0.5])
    per_unit = 2 / float(np.sum(Bowl(at).series.count))
    winner = family(ROLLING, Bowl(at, floor=rules.NOISE + left * per_unit), at)
    assert winning.may_stand_in(Look(winner, [winner], {"rolling_resistance": gain})) is tried


@pytest.mark.parametrize("second, part, best", [(False, 0.5, DRAG), (False, 0.2, ROLLING), (True, 0.5, ROLLING)])
def test_where_a_first_effect_leaves_a_large_part_everyone_is_fitted_afresh(monkeypatch, second, part, best):
    """Drag stood in for sides that were off, which no look had fitted from nominal parameters."""
    at, gain = np.array([0.0, 0.5]), 600.0
    per_unit = 2 / float(np.sum(Bowl(at).series.count))
    winner = family(ROLLING, Bowl(at, floor=rules.NOISE + part * gain * per_unit), at)
    kept = family((), Bowl(np.zeros(1), floor=rules.NOISE + (1 + part) * gain * per_unit, stuck=True), np.zeros(1))
    there = np.array([0.0, 0.0, 1.0])
    asked = []

    def afresh(setup, begun, over, say, patient):
        asked.extend(begun)
        return [family(DRAG, Bowl(there, floor=rules.NOISE), there)]

    monkeypatch.setattr(winning, "may_stand_in", lambda ended: False)
    monkeypatch.setattr(winning, "candidates_beside", lambda setup, effects: (QuadraticDrag, RollingResistance))
    monkeypatch.setattr(winning, "own_z", lambda setup, effects: np.zeros(1))
    monkeypatch.setattr(winning, "fitted_anew", afresh)
    look = looked(kept, winner)
    assert look.gains["rolling_resistance"] == pytest.approx(gain)
    assert to_the_end(ALONE, look, winner, second, 0, quiet).effects == best
    assert asked == ([DRAG] if best == DRAG else [])


@pytest.mark.parametrize(
    "left, arrives, size, second, stands_in",
    [
        (400.0, True, 0.5, False, False),
        (400.0, False, 0.5, False, True),
        (400.0, True, 0.1, False, True),
        (250.0, True, 0.5, False, True),
        (400.0, True, 0.5, True, True),
    ],
    ids=["both arrive", "still above", "a trifle", "little is left", "a second one"],
)
def test_nobody_stands_in_for_an_effect_beside_which_another_leaves_nothing(
    monkeypatch, left, arrives, size, second, stands_in
):
    at, beside = np.array([0.0, 0.5]), np.array([0.0, 0.5, size])
    per_unit = 2 / float(np.sum(Bowl(at).series.count))
    winner = family(ROLLING, Bowl(at, floor=rules.NOISE + left * per_unit), at)
    kept = family((), Bowl(np.zeros(1), floor=rules.NOISE + 3 * left * per_unit, stuck=True), np.zeros(1))
    floor = rules.NOISE + (0.05 if arrives else 0.15) * left * per_unit
    pair = family((*ROLLING, *DRAG), Bowl(beside, floor=floor), beside)
    asked, lines = [], []
    monkeypatch.setattr(winning, "from_near", lambda *a: [pair])
    monkeypatch.setattr(winning, "candidates_beside", lambda *a: ())
    monkeypatch.setattr(winning, "with_kin", lambda setup, ended, seed, say: asked.append("kin") or ended)
    monkeypatch.setattr(winning, "with_everyone", lambda setup, ended, seed, say: asked.append("everyone") or ended)
    to_the_end(ALONE, looked(kept, winner), winner, second, 0, lines.append)
    assert asked == (["kin"] if second else ["kin", "everyone"] if stands_in else [])
    assert any("quadratic_drag beside rolling_resistance leaves" in line for line in lines) != stands_in


def test_where_the_baseline_is_far_from_the_windows_everyone_has_been_looked_at_afresh():
    at = np.array([0.0, 0.5])
    winner = family(ROLLING, Bowl(at, floor=1.1), at)
    ended = looked(family((), Bowl(np.zeros(1), floor=1.4, stuck=True), np.zeros(1)), winner)
    assert winning.leaves_a_large_part(ended)
    ended.kept = family((), Bowl(np.zeros(1), floor=3.0, stuck=True), np.zeros(1))
    assert winning.structured(ended.kept) == 1.0 and not winning.leaves_a_large_part(ended)


def test_a_winner_whose_kin_were_all_tried_stays_as_it_is(monkeypatch):
    monkeypatch.setattr(winning, "candidates_beside", lambda setup, effects: (GyroScale,))
    monkeypatch.setattr(winning, "in_the_valley_of", lambda *a: pytest.fail("tried again"))
    kept = family((), Bowl(np.zeros(1), floor=1.3), np.zeros(1))
    ended = looked(kept, family(ROLLING, Bowl(np.array([0.0, 0.5]), floor=1.1), np.array([0.0, 0.5])))
    assert winning.with_kin(ALONE, ended, 0, quiet) is ended


def test_kin_of_all_who_come_near_the_front_are_tried(monkeypatch):
    """A centre of mass is kin of the tilt of a plate, which was second, and had been left too far off."""
    offered = (RoundedFeet, MassEccentricity, GyroScale)
    asked = []
    monkeypatch.setattr(winning, "candidates_beside", lambda setup, effects: offered)
    monkeypatch.setattr(winning, "own_z", lambda setup, effects: np.zeros(1))
    monkeypatch.setattr(winning, "in_the_valley_of", lambda setup, winner, others, kept: asked.extend(others) or [])
    monkeypatch.setattr(winning, "fitted_anew", lambda setup, begun, *a, **b: asked.extend(begun) or [])
    kept = family((), Bowl(np.zeros(1), floor=1.3), np.zeros(1))
    first, near, far = (
        family((id,), Bowl(np.array([0.0, 0.5]), floor=floor), np.array([0.0, 0.5]))
        for id, floor in (("inertia_deviation", 1.1), ("plate_tilt", 1.12), ("rounded_feet", 1.28))
    )
    winning.with_kin(ALONE, looked(kept, first, near, far), 0, quiet)
    # The scale is kin of the inertia; round feet, whose kin it is, too, were fitted already.
    assert set(asked) == {("gyro_scale",), ("mass_eccentricity",)}
