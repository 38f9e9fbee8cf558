"""The page of `rockref add`: the error before and after, and the model as it grew."""

from __future__ import annotations

from pathlib import Path

from rockref.discover.add import Addition
from rockref.effects import catalogue
from rockref.report.addition_text import cells, cells_table, history_table, lines
from rockref.report.falling import add_falling, history_figure
from rockref.report.fit_text import estimates_table
from rockref.report.page import Page


def addition_page(a: Addition) -> Page:
    """Return the page."""
    page = Page(f"{a.experiment.name}: {a.effect} added", " ".join(lines(a)))
    page.add_section("What was added", catalogue.find(a.effect).sentence)
    page.add_table(estimates_table([e for e in a.estimates if e.of_effect and e.of_run is None]))
    add_errors(page, a)
    page.add_section("All numbers of the model")
    page.add_table(estimates_table(a.estimates))
    page.add_section("Where the numbers come from")
    page.add_provenance({k: v for k, v in a.model.origin.items() if k != "history"})
    return page


def add_errors(page: Page, a: Addition) -> None:
    """Add the sections about the error: before and after, and the history."""
    page.add_section("The error before and after", lines(a))
    before = " + ".join(a.before.effects) or "baseline"
    for use, words in (("fit", "fit runs"), ("holdout", "held-out runs")):
        pair = [(name, cells(state, use)) for name, state in ((before, a.before), (f"with {a.effect}", a.after))]
        states = [(name, values) for name, values in pair if values is not None]
        if states:
            add_falling(page, f"Error on the {words}", states, a.noise, a.spread)
    page.add_table(cells_table(a))
    page.add_section("The model as it grew")
    svg, keys = history_figure(a.history, a.noise)
    page.add_figure(svg, "Quadratic mean over all windows and axes, state by state.", history_table(a), "", keys)


def write_addition(a: Addition, folder: Path) -> Path:
    """Write ``index.html`` into the folder and return its path. Raises InputError (E-WRITE)."""
    return addition_page(a).write(folder / "index.html")
