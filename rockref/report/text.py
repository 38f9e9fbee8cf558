"""A comparison on the terminal: what was measured, the errors, run by run, and the sentences."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rockref.discover.compare import Comparison
from rockref.discover.sentences import findings
from rockref.report import tables
from rockref.report.page import Table

if TYPE_CHECKING:
    from rich.console import Console


def print_comparison(console: Console, c: Comparison) -> None:
    """Print a comparison with rich tables, plain where the output is no terminal."""
    print_table(console, tables.runs_table(c))
    for k in range(len(c.names)):
        print_table(console, tables.errors_table(c, k))
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
    """Print one table."""
    from rich import box
    from rich.table import Table as RichTable
    from rich.text import Text

    drawn = RichTable(title=Text(table.caption), title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for k, column in enumerate(table.columns):
        drawn.add_column(Text(column), justify="left" if k == 0 or table.prose else "right", no_wrap=k == 0)
    for row in table.rows:
        drawn.add_row(*(Text(cell) for cell in row))
    console.print(drawn)
    if table.note:
        console.print(Text(table.note, style="dim"))
