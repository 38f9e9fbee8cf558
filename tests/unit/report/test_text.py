"""A comparison and a fit on the terminal: tables of what there is, and no others."""

import io
from dataclasses import replace

import pytest
from rich.console import Console

from rockref.discover.story import Journey
from rockref.report.demo import Story, the_error, the_missing_effect
from rockref.report.fit_text import print_fit
from rockref.report.page import Page
from rockref.report.text import print_comparison
from tests.unit.discover import fakes


def said(show, what):
    out = io.StringIO()
    show(Console(file=out, width=220), what)
    return out.getvalue()


def test_held_out_runs_have_a_table_where_there_are_some(short):
    assert said(print_comparison, short).count("holdout runs") > 0
    fit = short.of("fit")
    alone = replace(
        short,
        measured=tuple(short.measured[k] for k in fit),
        results=tuple(tuple(runs[k] for k in fit) for runs in short.results),
    )
    text = said(print_comparison, alone)
    assert "fit runs" in text and "holdout runs" not in text


@pytest.mark.parametrize("gates", [True, False])
def test_gates_that_nobody_asked_for_are_not_printed(gates):
    found = fakes.fitted("not_trustworthy")
    found = found if gates else replace(found, gates=[], outcome="not_checked")
    text = said(lambda console, f: print_fit(console, f, full=True), found)
    assert ("Not trustworthy" in text) is gates and ("FAILED" in text) is gates and "5.900e+07" in text


def test_a_demonstration_tells_the_verdict_the_size_and_both_errors(tmp_path):
    d = fakes.diagnosis("named")
    story = Story(Journey(d, fakes.addition(d.experiment), None), tmp_path, "auto", Page("A story"))
    the_missing_effect(story)
    the_error(story)
    verdict, size, fit, held_out = story.lines
    assert verdict == "synthetic: quadratic_drag is missing."
    assert size == "Size of quadratic_drag, with 90 % intervals: c 0.41 (0.38 to 0.44) N m s2."
    assert fit.startswith("Fit runs: error 0.2500 to 0.0700") and held_out.startswith("Held-out runs: error 0.3500 to")
    assert [s.title for s in story.page.sections] == ["The missing effect", "The error falls"]


def test_a_demonstration_without_an_effect_adds_nothing(tmp_path):
    story = Story(Journey(fakes.diagnosis("none"), None, None), tmp_path, "auto", Page("A story"))
    the_missing_effect(story)
    the_error(story)
    assert story.lines == ["synthetic: A sentence."] and len(story.page.sections) == 1
