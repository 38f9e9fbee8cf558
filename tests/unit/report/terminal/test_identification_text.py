"""An identification in words and tables says what its record says."""

import copy

import pytest

from rockref.report.terminal.identification_text import print_identification
from tests.printed import printed
from tests.unit.report.made_up import IDENTIFICATION as RECORD


def said(record):
    return printed(print_identification, record, True)


def row(text, start):
    (found,) = [line.split() for line in text.splitlines() if line.startswith(start)]
    return found


def test_at_the_floor_what_is_not_determined_is_named():
    text = said(RECORD)
    assert "10000 simulations brought the cost to 0.1234." in text
    # The root of 1.02 is 1.01.
    assert text.endswith("its error is 1 % above the noise, at most 1 % on a held-out run.\n")
    assert "Not determined within half the last digit of Table 3.1: K_N." in text
    assert "Numbers that trade off: K_N and beta_ext (correlation -0.91)." in text


def test_above_the_floor_nothing_is_determined():
    record = copy.deepcopy(RECORD)
    record["least_squares"]["at_noise_floor"] = False
    text = said(record)
    assert "Nothing is determined" in text and "Not determined within" not in text


def test_errors_are_shown_in_last_digits_and_that_of_the_tilt_is_its_largest():
    """K_N is stated to 1e7, theta_0 to 1e-4."""
    text = said(RECORD)
    assert row(text, "K_N  ") == ["K_N", "6.1e+07", "5e+06", "0.5", "6e+07", "N/m"]
    assert row(text, "theta_0") == ["theta_0", "0.1171", "3e-05", "0.3", "0.117", "rad"]


@pytest.mark.parametrize(
    "start, wanted",
    [
        ("main impacts", ["main", "impacts", "2", "0.05", "0.07"]),
        ("03", ["03", "holdout", "0.11712", "0.050", "0.060", "0.070", "1.01", "2.50"]),
    ],
)
def test_terms_and_runs_have_a_row_each(start, wanted):
    assert row(said(RECORD), start) == wanted


def test_where_all_is_determined_nothing_is_named():
    record = copy.deepcopy(RECORD)
    record["least_squares"]["determined"]["K_N"] = True
    text = said(record)
    assert "at the noise floor" in text and "determined" not in text


@pytest.mark.parametrize("floor", [True, False])
def test_the_page_says_at_a_glance_whether_the_model_came_down(floor):
    from rockref.report.views.identification_page import identification_page
    from tests.unit.report.page_checks import faults_of

    record = copy.deepcopy(RECORD)
    record["least_squares"]["at_noise_floor"] = floor
    page = identification_page(record)
    assert faults_of(page.html()) == [] and page.card["card"].name.startswith("at" if floor else "above")
    assert "1.01 times the noise" in page.html() and "1 of 2" in page.html()
