"""An effect added, on the terminal: its size, and the error before and after."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rockref.discover.add_effect import Addition
from rockref.discover.compare.stretches import AXES
from rockref.report.tables.table import Table, number
from rockref.report.terminal.diagnosis_text import GAP
from rockref.report.terminal.fit_text import effect_lines, estimates_table
from rockref.report.terminal.text import print_table, say, say_all

if TYPE_CHECKING:
    from rich.console import Console

NOTE = (
    "Innovations of a model that listens to the record with a memory of 40 ms, the worst tenth of blocks of 50 ms left "
    "out. Two repeated runs are compared whole, and differ by more than one run and its model."
)


def print_addition(console: Console, a: Addition, full: bool = False) -> None:
    """Print what an effect brings, the error last; with the tables of axes and history where `full`."""
    kept = ", from a kept fit" if a.from_store else ""
    say(console, f"{a.experiment.name}: {a.effect} added, {a.seconds:.0f} s{kept}.")
    if full:
        print_table(console, estimates_table(a.numbers))
        print_table(console, axes_table(a))
        print_table(console, history_table(a))
    say_all(console, [*effect_lines(a.own_numbers), *lines(a)])


def lines(a: Addition) -> list[str]:
    """Return the error before and after in sentences, the held-out runs last."""
    found = []
    for use, words in (("fit", "Fit runs"), ("holdout", "Held-out runs")):
        before, after = getattr(a.before, use), getattr(a.after, use)
        if before is None or after is None:
            continue
        # Of a gap within what is known of the noise no share is said.
        closed = a.gap_closed(use) if before["total"] >= GAP * a.noise else None
        tail = "" if closed is None else f"; {100 * min(closed, 1.0):.0f} % of the excess above it gone"
        found.append(
            f"{words}: error {before['total']:.4f} to {after['total']:.4f} deg/s RMS, noise floor {a.noise:.4f}{tail}."
        )
    return found


def axes_table(a: Addition) -> Table:
    """Return the error by axis, before and after, on fit and held-out runs."""
    columns, pairs = ["axis"], []
    for use, words in (("fit", "fit"), ("holdout", "held-out")):
        before, after = getattr(a.before, use), getattr(a.after, use)
        if before is not None and after is not None:
            columns += [f"{words}, before", "after"]
            pairs.append((before, after))
    columns += ["noise floor", "two repeats differ by"]
    rows = []
    for j, axis in enumerate((*AXES, "total")):
        row = [axis, *(number(errors[axis], 4) for pair in pairs for errors in pair)]
        spread = None if a.spread is None or axis == "total" else float(a.spread[j])
        rows.append([*row, number(a.noise, 4), number(spread, 3)])
    return Table("Error, deg/s RMS", columns, rows, NOTE)


def history_table(a: Addition) -> Table:
    """Return the error of the model as effects were added."""
    rows = []
    for entry in a.history:
        name = " + ".join(entry["effects"]) or "baseline"
        rows.append([name, *(number(entry.get(f"{use}_deg_s"), 4) for use in ("fit", "holdout"))])
    return Table("History of the model", ("effects", "fit (deg/s)", "held-out (deg/s)"), rows)
