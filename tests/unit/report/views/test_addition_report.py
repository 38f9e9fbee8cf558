"""An addition in words and on its page, with and without held-out runs."""

from dataclasses import replace

import pytest

from rockref.discover.add_effect import State
from rockref.report.html.falling import falling_figure, history_figure
from rockref.report.terminal.addition_text import axes_table, lines, print_addition
from rockref.report.views.addition_page import addition_page
from tests.printed import printed
from tests.unit.discover import fakes
from tests.unit.report.page_checks import faults_of


@pytest.fixture(scope="module")
def whole():
    return fakes.addition()


@pytest.fixture(scope="module")
def bare(whole):
    """The same without held-out and without repeated runs."""
    before, after = (State(s.effects, s.fit, None) for s in (whole.before, whole.after))
    return replace(whole, before=before, after=after, history=[before.to_dict(), after.to_dict()], spread=None)


def test_held_out_runs_are_in_lines_and_columns_where_there_are_some(whole, bare):
    assert [line.split(":")[0] for line in lines(whole)] == ["Fit runs", "Held-out runs"]
    assert [line.split(":")[0] for line in lines(bare)] == ["Fit runs"]
    assert "held-out, before" in axes_table(whole).columns and "held-out, before" not in axes_table(bare).columns
    assert [len(row) for row in axes_table(bare).rows] == [5] * 4
    # Two repeats differ by 0.2, 0.3 and 0.4 about the three axes, by nothing that is known without repeats.
    assert [row[-1] for row in axes_table(whole).rows[:3]] == ["0.200", "0.300", "0.400"]
    assert {row[-1] for row in axes_table(bare).rows} == {"–"}


def test_a_gap_that_was_none_is_not_said_to_be_closed(whole):
    at_noise = replace(whole, before=State((), fakes.errors(whole.noise), whole.before.holdout))
    assert lines(at_noise)[0].endswith("noise floor 0.0500.") and "% of the excess" in lines(at_noise)[1]


def test_the_page_has_a_figure_for_each_kind_of_runs_and_the_history(whole, bare):
    for a, figures in ((whole, 3), (bare, 2)):
        text = addition_page(a).html()
        # The card has one, and each of the three runs.
        assert faults_of(text) == [] and text.count("<figure") == figures + 4
        assert ("Error on the held-out runs" in text) is (figures == 3)


def test_printed_it_has_the_size_of_the_effect_and_no_number_of_the_baseline(whole):
    text = printed(print_addition, whole)
    assert "quadratic_drag.c = 0.41 N m s² (90 %: 0.38 to 0.44)" in text and "K_N" not in text
    assert text.splitlines()[-1].startswith("Held-out runs")


def test_the_spread_of_repeats_is_drawn_where_it_is_known(whole):
    states = [("baseline", fakes.errors(1.0)), ("with", fakes.errors(0.5))]
    for spread, named in ((whole.spread, True), (None, False)):
        svg, keys = falling_figure("Title", states, 0.05, spread)
        assert ("two repeated runs" in keys) is named and "noise floor" in keys and "Title" in svg


def test_a_history_without_any_number_is_still_a_figure():
    svg, keys = history_figure([{"effects": []}], float("nan"))
    assert "baseline" in svg and "held-out runs" in keys


def test_no_share_is_said_of_a_gap_within_the_noise():
    a = fakes.addition()
    near = replace(a, before=State((), fakes.errors(1.01 * a.noise), fakes.errors(2.0 * a.noise)))
    fit, held = lines(near)
    assert "of the excess" not in fit and "of the excess" in held
