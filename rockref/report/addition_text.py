"""An effect added, on the terminal: the error before and after, and the history of the model."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rockref.discover.add import Addition, State
from rockref.discover.compare.stretches import AXES
from rockref.discover.fit.errors import STRETCH_WORDS, STRETCHES
from rockref.report import tables
from rockref.report.fit_text import estimates_table
from rockref.report.page import Table
from rockref.report.text import print_table

if TYPE_CHECKING:
    from rich.console import Console


def print_addition(console: Console, a: Addition) -> None:
    """Print what an effect brings."""
    for line in lines(a):
        console.print(line, markup=False, highlight=False, soft_wrap=True)
    print_table(console, estimates_table([e for e in a.estimates if e.of_effect and e.of_run is None]))
    print_table(console, cells_table(a))
    print_table(console, history_table(a))


def lines(a: Addition) -> list[str]:
    """The error before and after in sentences."""
    found = []
    for use, words in (("fit", "Fit runs"), ("holdout", "Held-out runs")):
        before, after = getattr(a.before, use), getattr(a.after, use)
        if before is None or after is None:
            continue
        closed = a.closed(use)
        tail = "" if closed is None else f"; {100 * closed:.0f} % of the gap to the noise floor closed"
        found.append(f"{words}: {before.total:.4f} to {after.total:.4f} deg/s RMS with {a.effect}{tail}.")
    return found


def cells_table(a: Addition) -> Table:
    """The error by stretch and axis, before and after, fit and held-out runs."""
    columns, pairs = ["stretch", "axis"], []
    for use, words in (("fit", "fit"), ("holdout", "held-out")):
        before, after = getattr(a.before, use), getattr(a.after, use)
        if before is not None and after is not None:
            columns += [f"{words}, before", "after"]
            pairs.append((before.table, after.table))
    columns += ["noise floor", "two repeats differ by"]
    rows = []
    for i, stretch in enumerate(STRETCHES):
        for j, axis in enumerate(AXES):
            row = [STRETCH_WORDS[stretch], axis]
            row += [tables.number(float(t[i, j]), 3) for pair in pairs for t in pair]
            spread = None if a.spread is None else float(a.spread[j])
            rows.append([*row, tables.number(a.noise, 3), tables.number(spread, 3)])
    return Table(
        "Error, deg/s RMS", columns, rows, "Windows restarted from the measured state; the worst tenth left out."
    )


def history_table(a: Addition) -> Table:
    """The error of the model as it grew."""
    rows = []
    for entry in a.history:
        name = " + ".join(entry["effects"]) or "baseline"
        rows.append([name, *(tables.number(entry.get(f"{use}_deg_s"), 4) for use in ("fit", "holdout"))])
    return Table("The model as it grew", ("effects", "fit (deg/s)", "held-out (deg/s)"), rows)


def cells(state: State, use: str) -> np.ndarray | None:
    """The nine errors of a state on the runs of one use, or None."""
    errors = getattr(state, use)
    return None if errors is None else np.asarray(errors.table).ravel()
