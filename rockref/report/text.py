"""A comparison on the terminal: what was measured, the errors, run by run, and the sentences."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rockref.discover.compare.models import Comparison
from rockref.discover.compare.sentences import findings
from rockref.report import tables
from rockref.report.page import Table

if TYPE_CHECKING:
    from rich.console import Console

#: Characters between two columns.
GAP = 2


def print_comparison(console: Console, c: Comparison) -> None:
    """Print a comparison with rich tables, plain where the output is no terminal."""
    print_table(console, tables.runs_table(c))
    for k in range(len(c.names)):
        for use in ("fit", "holdout"):
            if c.of(use):
                print_table(console, tables.errors_table(c, k, use))
        print_table(console, tables.departures_table(c, k))
    print_table(console, tables.energy_table(c))
    found = findings(c)
    for name in (*c.names, None):
        texts = [f.text for f in found if f.model == name]
        if texts:
            console.print(f"\n{name or 'Side by side'}:", style="bold", markup=False, highlight=False)
        for text in texts:
            console.print(f"  - {text}", markup=False, highlight=False, soft_wrap=True)


def print_table(console: Console, table: Table) -> None:
    """Print one table, every cell whole: words wrap at spaces only, and numbers never.

    A table of numbers takes the width that it needs where the output is no terminal, and on one that is narrower than
    its longest words; the terminal then breaks the lines.
    """
    from rich import box
    from rich.table import Table as RichTable
    from rich.text import Text

    title = Text(table.caption)
    narrow: Any = {"pad_edge": False, "show_edge": False, "collapse_padding": True}
    drawn = RichTable(title=title, title_justify="left", box=box.SIMPLE_HEAD, **narrow)
    # In a pipe a row of numbers is a line, however long.
    room = console.width if table.prose or console.is_terminal else None
    taken = widths(table, room)
    for k, (column, width) in enumerate(zip(table.columns, taken, strict=True)):
        drawn.add_column(Text(column), justify="left" if k == 0 or table.prose else "right", width=width)
    for row in table.rows:
        drawn.add_row(*(Text(cell) for cell in row))
    drawn.width = sum(taken) + GAP * (len(taken) - 1)
    console.print(drawn, crop=False, no_wrap=True, overflow="ignore")
    console.print()
    if table.note:
        console.print(Text(table.note, style="dim"))


def widths(table: Table, room: int | None) -> list[int]:
    """The width of every column, in characters, of a table that has `room` (None: as much as it wants).

    At least such that no word is broken, even where that is more than the room; the first column, which names the
    row, in one line. What room is left goes to the narrowest column that wraps, cells first, then headings.
    """
    cells = [[row[k] for row in table.rows] for k in range(len(table.columns))]
    words = [column if k == 0 else [word for cell in column for word in cell.split()] for k, column in enumerate(cells)]
    found = [max(map(len, [*w, *name.split()]), default=0) for w, name in zip(words, table.columns, strict=True)]
    of_cells = [max(map(len, column), default=0) for column in cells]
    whole = [max(most, len(name)) for most, name in zip(of_cells, table.columns, strict=True)]
    if room is None:
        return whole
    rest = room - sum(found) - GAP * (len(found) - 1)
    for wanted in (of_cells, whole):
        while rest > 0 and (narrow := [k for k, width in enumerate(found) if width < wanted[k]]):
            found[min(narrow, key=found.__getitem__)] += 1
            rest -= 1
    return found
