"""A comparison and a fit on the terminal: tables of what there is, and no others."""

import io
from dataclasses import replace

import pytest
from rich.console import Console

from rockref.discover.story import Journey
from rockref.report.demo import in_three_lines
from rockref.report.fit_text import print_fit
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
    found = fakes.fitted(False)
    text = said(print_fit, found if gates else replace(found, gates=[]))
    assert ("Not trustworthy" in text) is gates and ("Gates" in text) is gates and "5.900e+07" in text


def test_a_demonstration_tells_the_verdict_the_size_and_both_errors():
    d = fakes.diagnosis("named")
    verdict, size, errors = in_three_lines(Journey(d, fakes.addition(d.experiment), None))
    assert verdict == "synthetic: quadratic_drag is missing."
    assert size == "Its size, with 90 % intervals: c 0.41 N m s2 (0.38 to 0.44)."
    assert "on the fit runs from 0.250 to 0.070 and on the held-out runs from 0.350 to 0.150 deg/s RMS" in errors
    assert in_three_lines(Journey(d, None, None)) == [verdict]
