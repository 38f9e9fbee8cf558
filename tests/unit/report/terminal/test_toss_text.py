"""Tosses in words and tables say what their records say."""

import pytest

from rockref.discover.tosses.compare import PUBLISHED
from rockref.report.terminal import toss_text
from tests.printed import printed
from tests.unit.report import toss_records as made


def cells(table, head):
    """The row of a table that begins so."""
    (row,) = [row for row in table.rows if row[0].startswith(head)]
    return row


@pytest.mark.parametrize("value, se, text", [(0.15891, 0.0046, "0.1589 ± 0.0046"), (9.627, 0.013, "9.627 ± 0.013"),
                                             (512.3, 40.0, "512 ± 40"), (0.5, 0.0, "0.500 ± 0.000")])  # fmt: skip
def test_a_value_is_given_to_two_digits_of_its_error(value, se, text):
    assert toss_text.with_error(value, se) == text


class TestComparison:
    def test_every_row_and_every_published_one(self):
        table = toss_text.errors_table(made.comparison())
        assert len(table.rows) == 8 + len(PUBLISHED)
        assert ("plain, holdout", "flight", "20", "12.3 ± 6.2", "9.8 (7.4 to 17.2)") == table.rows[4][:5]
        assert cells(table, "Drake")[1:4] == ("raw", "550", "13.5 ± 8.2")

    def test_stretches_say_where_it_grows_and_what_is_lost(self):
        table = toss_text.stretches_table(made.comparison()["rows"][0])
        assert cells(table, "first impact") == (
            "first impact", "20", "25", "5.5", "+6.4", "6.5", "-6.4", "54.1", "55.6", "2",
        )  # fmt: skip

    def test_a_speed_that_only_one_side_has_is_left_open_on_the_other(self):
        rows = [r for r in made.comparison()["rows"] if (r["use"], r["start"]) == ("holdout", "flight")]
        table = toss_text.sliding_table(rows)
        assert table.columns == ("speed", "measured", "plain", "explained")
        assert cells(table, "0.1 to") == ("0.1 to 0.2 m/s", "0.2100 ± 0.0010", "", "")
        assert cells(table, "0.3 to") == ("0.3 to 0.4 m/s", "", "0.1400 ± 0.0020", "0.1400 ± 0.0020")

    def test_what_needs_no_contact_model(self):
        table = toss_text.measured_table(made.measured())
        assert cells(table, "flight arcs: gravity, x (x against")[1:] == ("0.110 ± 0.020", "m/s2")
        assert cells(table, "flight arcs: centre of mass, z")[1:] == ("5.70 ± 0.20", "mm")
        assert cells(table, "flight arcs: drag")[1:] == ("0.050 ± 0.020", "1/s")
        assert cells(table, "measured centre: inertia xx")[1:] == ("1.07", "g m2")
        assert cells(table, "stated centre: impacts that gain")[1] == "3 of 51"
        assert cells(table, "tosses that gain energy at the first")[1] == "22 of 222"
        assert cells(table, "tosses that gain energy from three frames")[1] == "4 of 222"

    def test_nothing_measured_is_an_empty_table(self):
        assert toss_text.measured_table({}).rows == ()

    def test_printed_whole_with_the_copies(self):
        text = printed(toss_text.print_toss_comparison, made.comparison())
        assert "1 turned copies of other tosses were set aside." in text
        assert text.count("Where: ") == 4 and "Friction of a face that slides flat" in text
        without = printed(toss_text.print_toss_comparison, made.comparison() | {"copies": []})
        assert "copies" not in without


class TestDiagnosis:
    def test_the_staircase_goes_from_the_stated_values_to_the_last_rung(self):
        table = toss_text.staircase_table(made.diagnosis())
        assert [row[0] for row in table.rows] == ["stated values", "the law, its contact fitted", "mass_eccentricity",
                                                  "rounded_corners"]  # fmt: skip
        assert table.rows[2] == ("mass_eccentricity", "named", "9.0 (7.2)", "10.7 (8.6)", "3.85 (2.05 to 5.76)",
                                 "11.0 (8.8)", "12.7 (10.2)")  # fmt: skip
        assert "A true model would have 2.1 % and 1.8 deg (medians 1.6, 0.8)" in table.note
        assert table.note.endswith("not needed: adhesion.")

    def test_where_all_were_needed_nothing_is_said_of_it(self):
        assert "not needed" not in toss_text.staircase_table(made.diagnosis() | {"not_needed": []}).note

    def test_two_ways_in_units_of_the_hand(self):
        table = toss_text.agreement_table(made.diagnosis())
        assert cells(table, "centre") == ("centre of mass, z", "5.71", "5.68 ± 0.20", "mm", "flight arcs")
        assert cells(table, "friction")[1:4] == ("0.164", "0.1590 ± 0.0050", "1")

    def test_printed_with_verdict_gates_and_confusion(self):
        text = printed(toss_text.print_toss_diagnosis, made.diagnosis("not_trustworthy"))
        assert text.startswith("not_trustworthy: Missing: mass_eccentricity and then rounded_corners.")
        assert "gate step_small: passed (0.013, limit 0.02)" in text
        assert "gate off_bounds: NOT PASSED (0.013, limit 0.02)" in text
        assert "0.953" in text and "612 s" in text
        assert "0.953" not in printed(toss_text.print_toss_diagnosis, made.diagnosis() | {"confusion": {}})

    def test_gates_as_a_table(self):
        table = toss_text.gates_table(made.diagnosis("not_trustworthy"))
        assert [row[3] for row in table.rows] == ["passed", "not passed"]


def test_a_fit_in_words():
    text = printed(toss_text.print_toss_fit, made.fit(passed=False))
    assert "90123" in text and "7.7 ± 3.9" in text and "NOT PASSED" in text


@pytest.mark.parametrize("held_out", [True, False])
def test_an_addition_in_words(held_out):
    text = printed(toss_text.print_toss_addition, made.addition(held_out))
    assert "Without and with mass_eccentricity" in text and "11.2 ± 5.6" in text and "9.0 ± 4.5" in text
    assert ("falls by 4.96 (2.71 to 7.53, 90%)" in text) is held_out
