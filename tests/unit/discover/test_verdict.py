"""The rules of the verdict, each at the fact that it speaks of."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.discover import window_rules as rules
from rockref.discover.window_rules import Facts, decide, is_detected, ranking, settles


def facts(effects=("quadratic_drag",), gains=None, bad=0.0, held=(0.5, 0.4)) -> Facts:
    gains = {"quadratic_drag": 3000.0, "rolling_resistance": 500.0} if gains is None else gains
    return Facts(effects, {e: 1.0 for e in effects}, gains, bad, 1.0, list(held))


def test_nothing_found_is_none():
    assert decide(facts(effects=())).verdict == "none"


def test_one_effect_that_helps_held_out_runs_is_named():
    found = decide(facts())
    assert (found.verdict, found.effects) == ("named", ("quadratic_drag",))


def test_two_effects_are_a_pair():
    found = decide(facts(effects=("quadratic_drag", "gyro_scale")))
    assert found.verdict == "pair" and set(found.effects) == {"quadratic_drag", "gyro_scale"}


@pytest.mark.parametrize(
    "gain, left, verdict",
    [(1450.0, 589.0, "something_else"), (2253.0, 273.0, "pair"), (277.0, 208.0, "pair")],
)
def test_two_effects_that_leave_a_good_part_of_what_the_second_gains_explain_a_part_of_something_else(
    gain, left, verdict
):
    """A magnet at the release looked in part like other sides, and for the rest like an inertia."""
    effects = ("dimension_deviation", "inertia_deviation")
    found = decide(replace(facts(effects, {effects[1]: gain}), room=left))
    assert found.verdict == verdict and found.effects == (effects if verdict == "pair" else ())


@pytest.mark.parametrize(
    "gain, left, verdict",
    [(2350.0, 1251.0, "something_else"), (2350.0, 930.0, "class"), (860.0, 440.0, "class")],
)
def test_what_explains_alike_and_leaves_a_good_part_explains_a_part_of_something_else(gain, left, verdict):
    """A magnet at the release looked in part like a scale, and in part like sides."""
    effects = ("gyro_scale", "dimension_deviation")
    found = decide(replace(facts(effects[:1], {effects[0]: gain, effects[1]: gain - 20.0}), room=left))
    assert found.verdict == verdict and found.effects == (effects if verdict == "class" else ())
    assert all(e in found.sentence for e in effects)


def test_near_rival_makes_a_class_of_at_most_three():
    gains = {"quadratic_drag": 3000.0} | {id: 2990.0 for id in ("rolling_resistance", "cable_restraint", "adhesion")}
    found = decide(facts(gains=gains))
    assert found.verdict == "class" and found.effects[0] == "quadratic_drag" and len(found.effects) == 3


def test_a_rival_far_above_its_typical_size_is_none():
    for behind, told in ((200.0, "named"), (25.0, "class")):  # unless it ends as near as fits end
        gains = {"gyro_scale": 4336.0, "dimension_deviation": 4336.0 - behind}
        alike = facts(("gyro_scale",), gains)
        assert decide(alike).verdict == "class"
        assert decide(replace(alike, far_fetched=frozenset({"dimension_deviation"}))).verdict == told


def test_one_effect_by_other_numbers_in_each_run_is_something_else():
    """A magnet was named a wire that pulls: it does at one release what a wire does, and at another more."""
    wire = facts(("lingering_wire_pull",), {"lingering_wire_pull": 2415.0})
    assert decide(replace(wire, odds=3.3)).verdict == "named"
    found = decide(replace(wire, odds=5.1))
    assert found.verdict == "something_else" and "lingering_wire_pull" in found.sentence
    # Windows that are out of step throw the run that they are in.
    assert decide(replace(wire, odds=5.1, bad=0.1)).verdict == "named"
    # Of two effects each takes over some of the other's, run by run.
    assert decide(replace(facts(("lingering_wire_pull", "clock_error")), odds=5.1)).verdict == "pair"


def test_windows_that_stay_structured_are_something_else():
    found = decide(facts(bad=rules.UNEXPLAINED + 0.01))
    assert found.verdict == "something_else" and found.effects == ()
    assert "quadratic_drag" in found.sentence  # the nearest candidate


@pytest.mark.parametrize("held, why", [((0.0, 0.0), "show nothing of it"), ((), "no run was held out")])
def test_no_gain_on_held_out_runs_is_only_indicated(held, why):
    found = decide(facts(held=held))
    assert found.verdict == "indicated" and why in found.sentence


@pytest.mark.parametrize("held, verdict", [(0.004, "none"), (0.016, "class")])
def test_what_leaves_more_than_it_gains_has_to_show_on_held_out_runs(held, verdict):
    """A control whose fit had stopped in a side valley: feet gained 462 units, 1024 were left."""
    gains = {"uneven_foot_stiffness": 462.0, "uneven_contact_normals": 185.0}
    unsettled = replace(facts(("uneven_foot_stiffness",), gains, held=(held, held)), room=1024.0)
    assert decide(unsettled).verdict == verdict
    assert decide(replace(unsettled, room=400.0)).verdict == "class"


@pytest.mark.parametrize("left, said", [(1024.0, True), (400.0, False)])
def test_a_class_whose_fits_seem_stuck_asks_for_another_seed(left, said):
    gains = {"uneven_foot_stiffness": 462.0, "uneven_contact_normals": 445.0}
    found = decide(replace(facts(("uneven_foot_stiffness",), gains), room=left))
    assert found.verdict == "class" and ("leaves 1024 above the noise" in found.sentence) == said
    assert ("another seed" in found.sentence) == said


def test_harm_on_held_out_runs_is_not_accepted():
    assert decide(facts(held=(-0.5, -0.5))).verdict == "none"


def test_held_out_runs_that_say_the_opposite_of_each_other_prove_no_harm():
    assert decide(facts(held=(-0.04, 0.014))).verdict == "indicated"


@pytest.mark.parametrize("second", [False, True])
def test_detection_asks_for_gain_and_size(second):
    gain = (rules.SECOND if second else rules.DETECTED) + 1
    size = (rules.SECOND_SIZE if second else rules.LEAST_SIZE) + 0.01
    assert is_detected(gain, size, second)
    assert not is_detected(gain - 2, size, second) and not is_detected(gain, size - 0.02, second)


@pytest.mark.parametrize(
    "held, proven",
    [
        ([0.1, 0.12], True),
        ([0.04, 0.07], True),
        ([0.03, 0.06], False),
        ([0.3, -0.01], False),
        ([0.3, 0.0], False),
        ([], False),
    ],
)
def test_a_second_effect_is_proven_by_every_held_out_run_and_half_of_what_the_fitted_ones_gain(held, proven):
    assert rules.is_proven(0.1, held) == proven


def test_a_rival_is_told_apart_by_a_share_or_by_what_fits_end_short_of():
    assert rules.told_apart(2000.0) == pytest.approx(1880.0)
    assert rules.told_apart(300.0) == 270.0
    assert rules.told_apart(300.0, 100.0) == 200.0
    assert rules.told_apart(20.0) == 0.0


@pytest.mark.parametrize(
    "best, rival, verdict",
    [
        (528.0, 451.0, "class"),  # round feet of four radii, behind sides that were not off
        (860.0, 762.0, "named"),
        (110.0, 50.0, "named"),  # what gains little need not lead by more than half of it
        (110.0, 60.0, "class"),
        (3000.0, 2830.0, "class"),  # six per cent of what gains much
    ],
)
def test_a_name_leads_its_rivals_by_what_an_effect_has_to_gain(best, rival, verdict):
    gains = {"dimension_deviation": best, "rounded_feet": rival}
    found = decide(facts(("dimension_deviation",), gains))
    assert found.verdict == verdict


def test_second_effect_must_settle_the_windows():
    assert settles(0.5, 0.1) and settles(0.04, 0.03)
    assert not settles(0.125, 0.111)


@pytest.mark.parametrize(
    "bad, gain, room, hopeless",
    [
        (0.95, 1700, 3500, True),  # nearly every window contradicts, and the first effect explained less than a half
        (0.92, 3492, 3975, False),  # nearly every one does, and it explained most
        (0.90, 1700, 3500, False),
        (0.83, 431, 3658, True),  # most do, and the first effect explained next to nothing
        (0.85, 2916, 4065, False),  # most do, and it explained much
        (0.40, 431, 3658, False),  # some do
    ],
)
def test_no_second_effect_where_the_first_explains_next_to_nothing(bad, gain, room, hopeless):
    assert rules.is_hopeless(bad, gain, room) is hopeless


def test_weights_add_up_and_follow_the_gains():
    table = ranking({"adhesion": 10.0, "quadratic_drag": 900.0, "clock_error": 400.0})
    assert [row["effect"] for row in table] == ["quadratic_drag", "clock_error", "adhesion"]
    # Weights are rounded to four digits.
    assert sum(row["weight"] for row in table) == pytest.approx(1, abs=2e-4)
    assert np.all(np.diff([row["gain"] for row in table]) <= 0)


@pytest.mark.parametrize(
    "loud, word", [((0, 0), "none"), ((5, 0), "none"), ((1, 3), "none"), ((2, 2), "something_else")]
)
def test_windows_far_above_the_noise_in_fitted_and_held_out_runs_are_something_else(loud, word):
    assert decide(replace(facts(effects=()), loud=loud)).verdict == word


@pytest.mark.parametrize(
    "off, agree, word", [(7.0, False, "something_else"), (7.0, True, "named"), (3.3, False, "named")]
)
def test_a_number_far_off_on_which_the_runs_do_not_agree_is_not_believed(off, agree, word):
    """A magnet was a wire whose pull fell as no wire's does, and run 04 contradicted it."""
    decision = decide(replace(facts(), off=off, agree=agree))
    assert decision.verdict == word
    assert ("7.0 prior deviations" in decision.sentence) is (word == "something_else")


def test_an_effect_that_held_out_runs_do_not_show_does_not_explain_loud_windows():
    """A puff of air was a class of dampers, a push and sides: the dampers gained 102 units where 219 were left."""
    unproven = replace(facts(), held_gain=[0.0004, 0.0007], room=219.0)
    assert decide(replace(unproven, loud=(2, 2))).verdict == "something_else"
    assert decide(replace(unproven, loud=(2, 1))).verdict != "something_else"


def test_a_few_loud_windows_do_not_unsay_an_effect():
    assert decide(replace(facts(), loud=(3, 3))).verdict == "named"


@pytest.mark.parametrize("left, word", [(0.0, "named"), (200.0, "class")])
def test_a_winner_that_has_not_arrived_is_not_told_from_what_it_left_less_far_behind(left, word):
    gains = {"cable_restraint": 253.0, "quadratic_drag": 139.0, "adhesion": 20.0}
    found = decide(replace(facts(("cable_restraint",), gains), room=left))
    assert found.verdict == word and set(found.effects) <= {"cable_restraint", "quadratic_drag"}


@pytest.mark.parametrize(
    "gain, room, word",
    [(1000.0, 2100.0, "something_else"), (2000.0, 1700.0, "named"), (150.0, 400.0, "named"), (4000.0, 0.0, "named")],
)
def test_an_effect_that_leaves_more_than_it_gains_is_not_the_cause(gain, room, word):
    """A weak one that is there may leave more than it gains: below the room for a second effect that says nothing."""
    found = decide(replace(facts(gains={"quadratic_drag": gain}), room=room))
    assert found.verdict == word
    assert word == "named" or ("quadratic_drag" in found.sentence and found.effects == ())


def test_a_rival_that_gained_nothing_is_no_rival():
    found = decide(replace(facts(gains={"quadratic_drag": 150.0, "adhesion": 0.0}), room=500.0))
    assert (found.verdict, found.effects) == ("named", ("quadratic_drag",))


@pytest.mark.parametrize("clipped, word", [(True, "named"), (False, "something_else")])
def test_records_that_are_cut_flat_are_saturated_whatever_the_windows_say(clipped, word):
    found = decide(replace(facts(("gyro_saturation",), {}, bad=0.7), clipped=clipped))
    assert found.verdict == word


@pytest.mark.parametrize(
    "by_run, named",
    [
        ({"01": 0.9}, None),
        ({"01": 0.0, "02": 0.9}, "02"),
        ({"01": 0.5, "02": 0.9}, None),
        ({"01": 0.0, "02": 0.5}, None),
    ],
)
def test_a_run_that_contradicts_all_others_is_named_before_anything_is_said(by_run, named):
    decision = decide(replace(facts(), by_run=by_run))
    assert (decision.verdict == "not_trustworthy") is (named is not None)
    assert named is None or (f"Run {named} contradicts the others: 90%" in decision.sentence and decision.effects == ())


def test_a_small_second_effect_has_to_take_a_part_of_what_was_left():
    assert not rules.is_small(277, 485) and rules.is_small(207, 1388)
    assert not rules.is_small(rules.SMALL, 5000) and rules.is_small(rules.SMALL - 1, 5000)


@pytest.mark.parametrize(
    "gains, left, said",
    [
        pytest.param(
            {"a": 811.0, "b": 789.0, "c": 376.0}, 940.0, "but a or b would gain 811 units where 940", id="two alike"
        ),
        pytest.param({"b": 811.0, "a": 376.0}, 940.0, "but b would gain 811", id="one"),
        pytest.param({"a": rules.SMALL - 1}, 310.0, "", id="little"),
        pytest.param({"a": 500.0, "b": 490.0}, 1500.0, "", id="little of what was left"),
        pytest.param({"a": 343.0}, 164.0, "", id="taken up since"),
        pytest.param({}, 1500.0, "", id="nobody"),
    ],
)
def test_what_a_second_effect_would_take_up_is_said_where_it_is_much(gains, left, said):
    sentence = rules.left_over(gains, left)
    assert said in sentence and bool(sentence) == bool(said)


def test_what_could_be_there_unseen_is_said_with_its_least_size():
    limits = {"a.x": {"in_typical_sizes": 2.5}, "a.y": {"in_typical_sizes": 1.3}, "b.k": {"in_typical_sizes": 0.9}}
    assert rules.least_seen(limits) == {"a": 1.3, "b": 0.9}
    assert "a (seen from 1.3 times it on)." in rules.unseen(limits) and "b" not in rules.unseen(limits).split(":")[1]
    assert rules.unseen({"b.k": {"in_typical_sizes": 0.9}}) == ""
