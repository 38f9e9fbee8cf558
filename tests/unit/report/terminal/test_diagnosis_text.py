"""A diagnosis in words says what its record says, and nothing of what it has not."""

import pytest

from rockref.discover.diagnosis_record import plain
from rockref.discover.evidence.parity import PARITIES
from rockref.report.terminal import diagnosis_text
from tests.printed import printed
from tests.unit.discover import fakes


@pytest.fixture(scope="module")
def record():
    return plain(fakes.diagnosis("named").to_dict())


def said(record):
    return printed(diagnosis_text.print_diagnosis, record, True)


LIMITS = {"gyro_scale.x": {"value": 0.0123, "unit": "1"}, "adhesion.force": {"value": 4.5, "unit": "N"}}
CONFUSION = {"adhesion": {"adhesion": 1.0, "gyro_scale": 0.97, "plate_tilt": 0.5}, "gyro_scale": {"adhesion": 0.97}}


def test_what_could_have_stayed_unseen_and_what_is_alike_are_told_where_they_are_known(record):
    text = said(record)
    assert "Would be detected above" not in text and "Hardly told apart" not in text
    text = said(record | {"detection_limits": LIMITS, "confusion": CONFUSION})
    rows = {line.split()[0]: line.split() for line in text.splitlines() if line.strip()}
    assert rows["adhesion.force"][1:] == ["4.5", "N"] and rows["gyro_scale.x"][1:] == ["0.0123"]
    # Each pair once, and none that is well told apart.
    assert text.count("0.970") == 1 and "plate_tilt" not in text


@pytest.mark.parametrize("verdict", ["none", "something_else"])
def test_without_an_effect_there_is_no_size_and_no_gap(record, verdict):
    text = said(plain(fakes.diagnosis(verdict).to_dict()) | {"ranking": []})
    assert "How large" not in text and "gap to the noise closed" not in text and "Alternatives" not in text
    assert "To be sure" not in text and "baseline" in text


def test_with_one_the_share_of_the_gap_that_it_closes_is_told(record):
    text = said(record)
    (row,) = [line.split() for line in text.splitlines() if line.startswith("gap to")]
    # (0.25 - 0.06) of (0.25 - 0.05); (0.35 - 0.08) of (0.35 - 0.05).
    assert row[-4:] == ["95", "%", "90", "%"]
    bare = record["error"] | {"baseline": {"fit": 0.25, "holdout": None}, "with_effect": {"fit": 0.06, "holdout": None}}
    (row,) = [line.split() for line in said(record | {"error": bare}).splitlines() if line.startswith("gap to")]
    assert row[-3:] == ["95", "%", "–"]


LOOKS = {
    "axis": "main", "stretch_shares": {"free_arc": 0.9, "impact": 0.1}, "parity": "odd_in_side", "locked_to": "release",
}  # fmt: skip


@pytest.mark.parametrize(
    "changes, sentence",
    [
        ({}, "about the main axis, in free arcs, righting the block or pushing it over, again with every release."),
        ({"parity": None, "locked_to": "clock"}, "about the main axis, in free arcs, going on by the clock."),
        ({"stretch_shares": {"free_arc": 0.2, "impact": 0.8}, "parity": None, "locked_to": "neither"},
         "about the main axis, at main impacts."),
        ({"axis": "transverse", "stretch_shares": {}, "parity": "even", "locked_to": None},
         "about the transverse axis, pulling to the same side all the while."),
    ],
)  # fmt: skip
def test_of_something_else_it_is_told_what_it_looks_like(record, changes, sentence):
    unknown = plain(fakes.diagnosis("something_else").to_dict()) | {"signature": LOOKS | changes}
    assert f"The misfit is largest {sentence}" in said(unknown)
    assert "The misfit is largest" not in said(record)


def test_every_parity_has_its_words():
    assert set(diagnosis_text.PARITY_WORDS) == set(PARITIES)


def test_a_gate_that_was_not_passed_is_told_with_care(record):
    gate = {"name": "step_small", "passed": False, "sentence": "Half the step changes much."}
    text = said(record | {"gates": record["gates"] | {"step_small": gate}})
    assert "With care: Half the step changes much." in text and "With care" not in said(record)
    # That of the bounds stands with the sizes, where there are any.
    bounds = {"name": "off_bounds", "passed": False, "sentence": "K_N is far off."}
    text = said(record | {"gates": record["gates"] | {"off_bounds": bounds}})
    assert "With care" not in text and "Take them with care: K_N is far off." in text


def test_of_several_numbers_the_answer_says_those_that_are_determined(record):
    size = {"value": 0.4, "low": 0.3, "high": 0.5, "unit": "N m s2"}
    unknown = {"value": 0.3, "low": 0.0, "high": 1.6, "unit": "N s2/m2"}
    two = record | {"amplitudes": {"quadratic_drag.c": size, "quadratic_drag.c_v": unknown}}
    assert diagnosis_text.answer(two).endswith("Its size: c 0.4 N m s² (90 %: 0.3 to 0.5).")


@pytest.mark.parametrize("before, after, gone", [(0.0510, 0.0501, "–"), (0.15, 0.10, "50 %"), (0.15, 0.04, "100 %")])
def test_a_share_of_the_excess_is_said_where_there_is_one_to_be_taken(before, after, gone):
    error = {"baseline": {"fit": before}, "with_effect": {"fit": after}}
    assert diagnosis_text.closed(error, "fit", 0.05) == gone
