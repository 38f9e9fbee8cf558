"""The blocks of a page about runs: what is not there is left out."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref.measure.records.notice import Notice
from rockref.measure.signals.impacts import Impacts
from rockref.report.html import blocks
from rockref.report.html.page import Page


def part(page):
    """All of a page's text, and how many figures it has."""
    text = page.html()
    return text, text.count("<figure")


def with_runs(c, **changes):
    """The comparison with the measured features of every run changed."""
    return replace(c, measured=tuple(replace(m, features=replace(m.features, **changes)) for m in c.measured))


@pytest.mark.parametrize("notices", [(), (Notice("W-GAP", "run01.csv", "has a gap", "Record anew."),)])
def test_remarks_about_the_files_stand_with_what_was_measured(short, notices):
    page = Page("t")
    blocks.add_measured(page, replace(short, experiment=replace(short.experiment, notices=notices)))
    text, _ = part(page)
    assert ("Remarks about the files" in text) is bool(notices) and ("has a gap" in text) is bool(notices)
    assert "2 fitted, 1 held out" in text


@pytest.mark.parametrize(
    "times, names",
    [
        ([], []),
        ([0.5], ["first swing", "at the first main impact"]),
        ([0.5, 1.3], ["first swing", "at the first main impact", "between the first two"]),
        ([0.5, 1.3, 2.0, 2.6, 3.1], ["first swing", "at the first main impact", "between the first two", "last arcs"]),
    ],
)
def test_views_are_those_of_the_impacts_that_are_there(times, names):
    views = blocks.named_views(SimpleNamespace(times=np.array(times)), 3.2)
    assert [name for name, _, _ in views] == names
    assert all(0 <= start < end <= 3.2 for _, start, end in views)
    if len(times) == 5:
        # The last two arcs, from their first impact on.
        assert views[-1][1:] == pytest.approx((1.98, 3.12))


def test_rates_of_a_model_that_ended_early_are_in_no_table(short):
    whole = blocks.extremes_table(short, 0)
    results = tuple(
        tuple(replace(r, modelled=np.full_like(r.modelled, np.nan)) for r in runs) for runs in short.results
    )
    gone = blocks.extremes_table(replace(short, results=results), 0)
    assert {row[2] for row in whole.rows} == {"measured", "plain"} and {row[2] for row in gone.rows} == {"measured"}
    assert gone.rows == [row for row in whole.rows if row[2] == "measured"]


def test_energy_is_drawn_where_some_run_has_two_impacts(short):
    page = Page("t")
    blocks.add_energy(page, short)
    assert part(page)[1] == 1
    page, one = Page("t"), np.ones(1)
    blocks.add_energy(page, with_runs(short, impacts=Impacts(one, one, one, one, one)))
    assert part(page)[1] == 0


def test_shapes_need_what_was_measured_and_leave_out_a_model_without_them(short):
    page = Page("t")
    blocks.add_shapes(page, short, 0)
    whole, figures = part(page)
    assert figures == 2
    page = Page("t")
    blocks.add_shapes(page, with_runs(short, envelope=None), 0)
    assert part(page)[1] == 0
    bare = tuple(
        tuple(replace(r, features=replace(r.features, envelope=None, spectrum=None)) for r in runs)
        for runs in short.results
    )
    page = Page("t")
    blocks.add_shapes(page, replace(short, results=bare), 0)
    text, figures = part(page)
    # Its curves are gone: an envelope (upper and lower are one path) and a spectrum about each of two axes.
    assert figures == 2 and whole.count("stroke-width:1.2") - text.count("stroke-width:1.2") == 4
