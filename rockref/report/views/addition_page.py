"""The page of `rockref add`: the error before and after, and the history of the model."""

from __future__ import annotations

from rockref.discover.add_effect import Addition
from rockref.discover.compare.models import Comparison, compare
from rockref.effects import catalogue
from rockref.report.html.falling import add_falling, history_figure
from rockref.report.html.page import Page
from rockref.report.terminal.addition_text import axes_table, history_table, lines
from rockref.report.terminal.fit_text import estimates_table
from rockref.report.views.card import card_of_addition
from rockref.report.views.comparison_page import add_runs
from rockref.report.views.diagnosis_page import ROOM, without_notes


def addition_page(a: Addition) -> Page:
    """Return the page."""
    page = Page(f"{a.experiment.name}: {a.effect} added", " ".join(lines(a)))
    c = compared(a)
    page.set_card(card_of_addition(a, c))
    page.add_section("What was added", catalogue.find(a.effect).sentence)
    page.add_table(estimates_table(a.own_numbers))
    add_errors(page, a)
    page.add_section("Run by run")
    add_runs(page, c, ROOM)
    page.add_section("All numbers of the model")
    page.add_table(estimates_table(a.numbers))
    page.add_section("Where the numbers come from")
    page.add_provenance({k: v for k, v in a.model.origin.items() if k != "history"})
    return page


def compared(a: Addition) -> Comparison:
    """Return the model before and after, beside all runs from the release on."""
    before = a.model.replace(effects=tuple(e for e in a.model.effects if e.id != a.effect))
    models = [without_notes(before if a.without is None else a.without), without_notes(a.model)]
    names = ["before", f"with {a.effect}"]
    return compare(a.experiment, models, names, releases={})


def add_errors(page: Page, a: Addition, title: str = "The error before and after") -> None:
    """Add a section about the error: before and after, and the history of the model."""
    page.add_section(title, lines(a))
    before = " + ".join(a.before.effects) or "baseline"
    for use, words in (("fit", "fit runs"), ("holdout", "held-out runs")):
        pair = [(name, getattr(state, use)) for name, state in ((before, a.before), (f"with {a.effect}", a.after))]
        states = [(name, errors) for name, errors in pair if errors is not None]
        if states:
            add_falling(page, f"Error on the {words}", states, a.noise, a.spread)
    page.add_table(axes_table(a))
    svg, keys = history_figure(a.history, a.noise)
    page.add_figure(
        svg, "Root mean square of the innovations, state by state.", history_table(a), "History of the model", keys
    )
