"""Marks of recorded verdicts, and the table that they make."""

import math

import pytest

from rockref.blind.scoring.marks import gap_closed, mark
from rockref.blind.scoring.sizes import covered, size_error, stated
from rockref.blind.scoring.table import as_text, failures, scores


def truth(kind, *effects, form="catalogue", same_as=(), parameters=None, card=None):
    found = [{"id": id, "size": 1.0, "form": form, "parameters": parameters or {}} for id in effects]
    if card:
        found[0]["card"] = card
    return {"name": "case-001", "kind": kind, "effects": found, "class": list(same_as)}


def said(word, *effects, **more):
    return {"verdict": word, "effects": list(effects), "seconds": 10.0, **more}


@pytest.mark.parametrize(
    ("verdict", "alarm"),
    [
        (said("none"), False),
        (said("not_trustworthy"), False),
        (said("class", "a", "b"), True),
        (said("named", "a"), True),
        (said("something_else"), True),
        ({"verdict": "error"}, False),
    ],
)
def test_controls(verdict, alarm):
    assert mark(truth("control"), verdict)["false_alarm"] is alarm


@pytest.mark.parametrize(
    ("verdict", "first", "in_class", "wrong"),
    [
        (said("named", "adhesion"), True, True, False),
        (said("class", "clock_error", "adhesion"), False, True, False),
        (said("class", "adhesion", "b", "c", "d"), False, False, False),
        (said("indicated", "adhesion"), True, True, False),
        (said("named", "clock_error"), False, False, True),
        (said("pair", "adhesion", "clock_error"), True, True, True),
        (said("none"), False, False, False),
        (said("something_else"), False, False, False),
    ],
)
def test_single_effects(verdict, first, in_class, wrong):
    found = mark(truth("single", "adhesion"), verdict)
    assert (found["first"], found["in_class"], found["wrong_name"]) == (first, in_class, wrong)


@pytest.mark.parametrize(
    ("word", "least", "below"),
    [
        ("none", {"x": 1.8, "y": 1.2}, True),
        ("none", {"x": 1.8, "y": 0.9}, False),
        ("named", {"x": 1.8}, False),
        ("none", {}, False),
    ],
)
def test_nothing_found_where_the_verdict_states_that_it_could_be_unseen(word, least, below):
    limits = {f"adhesion.{name}": {"in_typical_sizes": size} for name, size in least.items()}
    limits |= {"clock_error.rate": {"in_typical_sizes": 0.2}}
    found = mark(truth("single", "adhesion"), said(word, detection_limits=limits))
    assert found["below_limit"] is below


@pytest.mark.parametrize(("now", "earlier"), [("matched", "twin"), ("unlisted", "outsider")])
def test_a_truth_of_an_earlier_format_has_the_marks_of_one_of_today(now, earlier):
    verdict = said("something_else", signature={"axis": "main", "phase": "impacts"})
    card = {"axes": ["x"], "phases": ["impacts"]}
    assert mark(truth(earlier, "gust", card=card), verdict) == mark(truth(now, "gust", card=card), verdict)


def test_a_matched_pair_may_be_called_either_but_nothing_else():
    pair = truth("matched", "plate_tilt", same_as=("plate_tilt", "mass_eccentricity"))
    found = mark(pair, said("class", "mass_eccentricity", "plate_tilt"))
    assert found["as_class"] and found["in_class"] and not found["wrong_name"]
    assert not mark(pair, said("named", "mass_eccentricity"))["wrong_name"]
    assert mark(pair, said("named", "gyro_drift"))["wrong_name"]


@pytest.mark.parametrize(
    ("word", "right"), [("refused", True), ("not_trustworthy", True), ("none", False), ("error", False)]
)
def test_a_faulty_record_is_to_be_refused(word, right):
    assert mark(truth("faulty"), said(word))["refused"] is right


def test_pairs():
    pair = truth("pair", "plate_tilt", "gyro_drift")
    assert mark(pair, said("pair", "gyro_drift", "plate_tilt"))["both"]
    half = mark(pair, said("named", "plate_tilt"))
    assert not half["both"] and half["one"] and not half["wrong_name"]


def test_unlisted_effects_and_their_card():
    case = truth("unlisted", "gust", card={"axes": ["x"], "phases": ["impacts"]})
    right = {"axis": "main", "phase": "impacts"}
    assert mark(case, said("something_else", signature=right))["card"]
    wrong = mark(case, said("something_else", signature=right | {"axis": "transverse"}))
    assert wrong["abstained"] and not wrong["card"]
    assert mark(case, said("named", "clock_error"))["wrong_name"]


def entry(value, low=None, high=None):
    return {"value": value, "low": low, "high": high}


def test_sizes_count_from_the_absence():
    assert size_error("hertzian_contact", {"exponent": 1.5}, {"exponent": entry(1.4)}) == pytest.approx(0.2)
    scale = {"x": 1.03, "y": 1.0, "z": 1.04}
    off = {"x": entry(1.03), "y": entry(1.0), "z": entry(1.05)}
    assert size_error("gyro_scale", scale, off) == pytest.approx(0.2)  # 0.01 of hypot(0.03, 0.04)
    assert size_error("gyro_bandwidth", {"frequency": 40.0}, {"frequency": entry(44.0)}) == pytest.approx(0.1)
    assert size_error("gyro_scale", scale, {"x": entry(1.03)}) is None


def test_a_common_factor_of_the_feet_is_no_error():
    true = {f"foot{i}": f for i, f in enumerate((0.5, 2.0, 1.0, 1.0), 1)}
    same = {k: entry(1.3 * v) for k, v in true.items()}
    assert size_error("uneven_foot_damping", true, same) == pytest.approx(0, abs=1e-12)
    half = {k: entry(math.sqrt(v)) for k, v in true.items()}
    assert size_error("uneven_foot_damping", true, half) == pytest.approx(0.5)


def test_intervals_cover_or_do_not():
    stated = {"k": entry(5.0, 4.5, 5.5)}
    assert covered("cable_restraint", {"k": 5.4}, stated) == [True]
    assert covered("cable_restraint", {"k": 5.6}, stated) == [False]
    assert covered("cable_restraint", {"k": 5.6}, {"k": {"value": 5.0}}) == []


def test_sizes_of_another_form_are_not_compared():
    verdict = said("named", "cable_restraint", amplitudes={"cable_restraint.k": entry(5.0, 4.0, 6.0)})
    case = truth("single", "cable_restraint", parameters={"k": 5.5})
    assert mark(case, verdict)["covered"] == [True]
    assert mark(case, verdict)["size_errors"] == [pytest.approx(0.5 / 5.5)]
    other = truth("single", "cable_restraint", parameters={"k": 5.5}, form="stiffens")
    assert mark(other, verdict)["size_errors"] == []


def test_gap():
    def error(before, after, floor):
        return {"noise_floor": floor, "baseline": {"holdout": before}, "with_effect": {"holdout": after}}

    assert gap_closed(error(0.25, 0.06, 0.05)) == pytest.approx(0.95)
    assert gap_closed(error(0.25, 0.06, {"fit": 0.04, "holdout": 0.05})) == pytest.approx(0.95)
    assert gap_closed(error(0.054, 0.05, 0.05)) is None  # nothing to close
    assert gap_closed({}) is None


def test_table_and_failures():
    marks = [mark(truth("control"), said("none")) for _ in range(23)]
    marks.append(mark(truth("control"), said("named", "adhesion")))
    rows = {row["score"]: row for row in scores(marks)}
    alarms = rows["controls: false alarms"]
    assert (alarms["hits"], alarms["n"], alarms["met"]) == (1, 24, False)
    assert alarms["low"] < 1 / 24 < alarms["high"]
    assert rows["two effects: both named"]["value"] is None and rows["two effects: both named"]["met"] is None
    assert rows["seconds a case, median"]["met"] is True
    (line,) = failures(marks)
    assert "nothing; verdict: named adhesion" in line
    text = as_text({"near": scores(marks), "other": scores([])})
    assert "| controls: false alarms | 1 of 24 (" in text and "<= 0 **missed** |" in text
    assert text.startswith("| score | near | goal |") and "two effects" not in text


def test_the_best_possible_answers_meet_every_goal():
    error = {"noise_floor": 0.05, "baseline": {"holdout": 0.5}, "with_effect": {"holdout": 0.05}}
    amplitudes = {"cable_restraint.k": entry(5.0, 4.9, 5.1)}
    off = {"cable_restraint.k": entry(5.0, 5.05, 5.1)}
    cable = [
        mark(truth("single", "cable_restraint", parameters={"k": 5.0}),
             said("named", "cable_restraint", error=error, amplitudes=amplitudes if i else off))
        for i in range(10)
    ]  # fmt: skip
    card = {"axes": ["x"], "phases": ["release"]}
    rest = [
        mark(truth("control"), said("none")),
        mark(truth("pair", "plate_tilt", "gyro_drift"), said("pair", "plate_tilt", "gyro_drift")),
        mark(truth("faulty"), said("refused")),
        mark(
            truth("unlisted", "gust", card=card), said("something_else", signature={"axis": "main", "phase": "release"})
        ),
    ]
    assert all(row["met"] is not False for row in scores(cable + rest))
    assert sum(row["met"] is True for row in scores(cable + rest)) == sum(bool(row["goal"]) for row in scores([]))


def test_what_is_no_size_is_not_compared():
    feet = {f"foot{i}": f for i, f in enumerate((0.5, 2.0, 1.0, 1.0), 1)}
    assert size_error("cable_restraint", {"k": 5.0}, {"k": entry(math.nan)}) is None
    # A factor below zero has no logarithm.
    assert size_error("uneven_foot_damping", feet, {k: entry(-1.0) for k in feet}) is None


def test_what_a_verdict_says_of_other_effects_or_without_a_number_is_left_out():
    amplitudes = {
        "cable_restraint.k": entry(5.0), "cable_restraint.c": {"value": "unknown"}, "cable_restraint": entry(1.0),
        "plate_tilt.x": entry(2.0), "cable_restraint.d": 3.0,
    }  # fmt: skip
    assert stated(amplitudes, "cable_restraint") == {"k": entry(5.0)}
    assert stated(None, "cable_restraint") == {}


def test_goals_of_other_blocks_are_their_own():
    singles = [mark(truth("single", "adhesion"), said("named", "adhesion" if i else "clock_error")) for i in range(20)]
    met = {b: {r["score"]: r["met"] for r in scores(singles, b)}["single: truth first"] for b in ("near", "other")}
    assert met == {"near": False, "other": True}  # 95 %


@pytest.mark.parametrize(
    ("case", "verdict", "right"),
    [
        (truth("control"), said("none"), True),
        (truth("control"), said("indicated", "adhesion"), False),
        (truth("single", "adhesion"), said("none"), False),
        (truth("single", "adhesion"), said("indicated", "adhesion"), True),
        (truth("single", "adhesion"), said("class", "clock_error", "adhesion"), True),
        (truth("single", "adhesion"), said("pair", "adhesion", "clock_error"), False),
        (truth("matched", "adhesion", same_as=("adhesion", "gyro_drift")), said("named", "gyro_drift"), True),
        (truth("pair", "plate_tilt", "gyro_drift"), said("named", "plate_tilt"), False),
        (truth("pair", "plate_tilt", "gyro_drift"), said("pair", "gyro_drift", "plate_tilt"), True),
        (truth("unlisted", "gust"), said("something_else"), True),
        (truth("faulty"), said("refused"), True),
    ],
)
def test_a_verdict_is_right_as_it_stands(case, verdict, right):
    found = mark(case, verdict | {"probability": 0.9})
    assert found["right"] is right and found["probability"] == 0.9 and found["block"] == "near"


def test_a_case_of_another_block_is_marked_as_such():
    assert mark(truth("control") | {"block": {"family": "other"}}, said("none"))["block"] == "other"
