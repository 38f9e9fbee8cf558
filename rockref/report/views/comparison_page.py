"""The page of `rockref compare`: the story in the order in which a person asks."""

from __future__ import annotations

import math
from pathlib import Path

from rockref.discover.compare.models import Comparison
from rockref.report.charts.block_drawing import block_drawing
from rockref.report.charts.run_panels import write_figures
from rockref.report.html import blocks
from rockref.report.html.curves import Curves
from rockref.report.html.page import MAX_BYTES, Page
from rockref.report.tables import comparison_tables
from rockref.report.terminal.comparison_text import error_lines
from rockref.report.views.comparison_card import card_of_comparison

# decided: room for what comes after the curves: energy, shapes, motion, provenance.
RESERVE = 350_000
# decided: one sample in 16 still shows every clatter of 25 Hz at 1 kHz.
THINNEST = 16


def comparison_page(c: Comparison) -> Page:
    """Return the page of one comparison."""
    models = " and ".join(c.names)
    page = Page(f"{c.experiment.name}: {models} beside the measured runs", lead(c))
    page.set_card(card_of_comparison(c))
    add_comparison(page, c)
    page.add_section("Where the numbers come from")
    page.add_provenance(blocks.provenance(c))
    return page


def lead(c: Comparison) -> str:
    """Return one sentence about the comparison as a whole."""
    runs = f"{len(c.of('fit'))} fit and {len(c.of('holdout'))} holdout runs"
    return (
        f"{len(c.names)} model{'s' if len(c.names) > 1 else ''} beside {runs}. No verdict: it shows where they differ. "
        f"{' '.join(error_lines(c))}"
    )


def add_comparison(page: Page, c: Comparison) -> None:
    """Add the sections of a comparison; the curves of its runs may fill the page."""
    page.add_section("What was measured")
    blocks.add_measured(page, c)
    page.add_figure(block_drawing(), "The block's axes and corners, the block turned, its feet. Not to scale.")
    page.add_section("Where the model fails")
    blocks.add_failures(page, c)
    page.add_section("Run by run")
    add_runs(page, c)
    page.add_section("Energy, envelopes, spectra")
    blocks.add_energy(page, c)
    blocks.add_shapes(page, c, 0)
    page.add_section("In motion")
    blocks.add_motion(page, c)


def add_runs(page: Page, c: Comparison, room: int | None = None) -> list[str]:
    """Add the curves of all runs, thinned such that they have room; name and return those left out all the same.

    Where even thinned curves have no room, unlike releases go before repeats.
    """
    size = page.size()
    limit = MAX_BYTES - RESERVE if room is None else size + room
    runs = range(len(c.measured))
    # The longest run says how much room all of them take at most.
    longest = blocks.run_curves(c, max(runs, key=lambda k: c.results[0][k].modelled.size))
    pictures = len(runs) * len(longest.picture)
    numbers = len(runs) * cost(longest) - pictures
    left, every = limit - size - pictures, 1
    if left < numbers:
        every = min(THINNEST, math.ceil(numbers / max(left, 1)))
    drawn = [blocks.run_curves(c, k, every) for k in runs]
    releases = [(m.run.release_tilt, m.run.block_turned) for m in c.measured]
    left_out = list[str]()
    # The first of each release comes before its repeats.
    for k in sorted(runs, key=lambda k: (releases.index(releases[k]) != k, k)):
        if size + cost(drawn[k]) > limit:
            left_out.append(c.measured[k].run.id)
        else:
            size += cost(drawn[k])
    for k in runs:
        if c.measured[k].run.id in left_out:
            continue
        page.add_curves(drawn[k])
        for model in range(len(c.names)):
            table = comparison_tables.impacts_table(c, model, k)
            page.add_details(f"Main impacts: {c.names[model]}", table)
    if left_out:
        page.add_text(f"Left out, to keep the page small: curves of run {', '.join(left_out)}.")
    return left_out


def cost(drawn: Curves) -> int:
    """Return the bytes that a run takes on a page."""
    panels = drawn.data["panels"]
    lines = sum(len(line["y"]["data"]) for p in panels for line in p.get("lines", ()))
    return len(drawn.picture) + lines + 40 * sum(len(s["on"]) for p in panels for s in p.get("strips", ()))


def write_report(c: Comparison, folder: Path) -> list[Path]:
    """Write ``index.html`` and the figures of the first run; return the paths, page first. Raises InputError.

    The folder is made if it is not there.
    """
    return [comparison_page(c).write_into(folder), *write_figures(c, folder)]
