"""Figures and tables of a sensitivity study, from made-up responses."""

from dataclasses import replace

import pytest

from rockref.model.parameters import TABLE_3_1
from rockref.report.charts.figures import rendered
from rockref.report.charts.sensitivity_figures import sensitivity_figures
from rockref.report.terminal.sensitivity_text import digits_table, horizons_table, print_sensitivity, sentences
from rockref.studies.sensitivity import Digits
from rockref.studies.sensitivity_study import record
from tests.printed import printed
from tests.unit.report import made_up


@pytest.fixture(scope="module")
def study():
    return made_up.study()


def test_four_figures_with_the_same_bytes_every_time(study):
    figures = sensitivity_figures(study)
    assert len(figures) == 4
    name = "growth_of_differences"
    assert rendered(figures[name], "svg") == rendered(sensitivity_figures(study)[name], "svg")
    assert rendered(figures["figure_3_5_time_step"], "png").startswith(b"\x89PNG")


def test_words_and_tables(study):
    result = record(study)
    assert "10 times" in sentences(result)[0] and "1.00 decimal digits" in sentences(result)[0]
    assert horizons_table(result).rows[0][2].startswith("1.9")  # averaged over 0.1 s, seen just before 2 s
    assert horizons_table(result).rows[1][2] == "beyond 3.0"
    assert digits_table(result).rows == [["K_N", "6e+07", "1", "30 %", "2", "4.0 %"]]


def test_a_block_in_its_plane_is_said_to_say_nothing_of_digits(study):
    result = record(study)
    assert "in its plane" not in " ".join(sentences(result))
    still = result | {"significant_digits": [d | {"change_stated": 0} for d in result["significant_digits"]]}
    assert sentences(still)[-1].startswith("The block stays in its plane")
    endless = result | {"significant_digits": [d | {"change": None} for d in result["significant_digits"]]}
    assert digits_table(endless).rows[0][5] == "∞" and "∞: about an axis" in digits_table(endless).note


def test_parameters_without_digits_are_named(study):
    said = sentences(record(study))
    assert said[1].startswith("Without digits") and "theta_0" in said[1] and "K_N" not in said[1]
    digits = tuple(Digits(name, 1.0, 1, 2, 0.04, 0.3) for name in TABLE_3_1)
    assert len(sentences(record(replace(study, digits=digits)))) == 1


def test_a_study_is_printed_whole(study):
    text = printed(print_sensitivity, record(study))
    assert "A small difference grows 10 times" in text and "beyond 3.0" in text
    (row,) = [line.split() for line in text.splitlines() if line.startswith("K_N")]
    assert row == ["K_N", "6e+07", "1", "30", "%", "2", "4.0", "%"]
