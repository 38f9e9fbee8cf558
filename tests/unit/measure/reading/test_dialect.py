"""Separator lines, quotes and rows of units are told by their looks."""

import pytest

from rockref.measure.reading.dialect import are_units, is_number, separator_line, split_line


@pytest.mark.parametrize(
    ("line", "separator"),
    [("sep=;", ";"), ("SEP=,", ","), ('"sep=\t"', "\t"), ("t_s,wx_deg_s", None), ("separate=1", None)],
)
def test_a_separator_line_names_one_sign(line, separator):
    assert separator_line(line) == separator


def test_quotes_keep_delimiters_inside_of_a_field():
    assert split_line('"a, b", 1 ,"2"', ",") == ["a, b", "1", "2"]
    assert split_line(" 1 , 2", ",") == ["1", "2"]


@pytest.mark.parametrize(
    ("fields", "expected"),
    [
        (["s", "deg/s", "deg/s"], True),
        (["[ms]", "(rad/s)", "[°/s]"], True),
        (["s", "", "dps"], True),
        (["", ""], False),
        (["0.1", "2"], False),
        (["time", "gx"], False),
    ],
)
def test_a_row_of_units_has_units_alone(fields, expected):
    assert are_units(fields) == expected


def test_a_number_has_a_point_and_no_comma():
    assert is_number("-1.5e-3") and is_number(".5")
    assert not is_number("1,5") and not is_number("nan") and not is_number("")
