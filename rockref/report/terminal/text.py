"""Words and tables on the terminal: nothing breaks within a word, whatever the width."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from rockref.report.tables.table import Table

if TYPE_CHECKING:
    from rich.console import Console

#: Characters between two columns.
GAP = 2


def say(console: Console, text: str, style: str | None = None) -> None:
    """Print a line, on a terminal broken between words and continued below its first word; elsewhere as it is."""
    if not console.is_terminal:
        console.print(text, style=style, markup=False, highlight=False, soft_wrap=True)
        return
    for line in broken(text, console.width):
        console.print(line, style=style, markup=False, highlight=False, no_wrap=True, overflow="ignore", crop=False)


def say_all(console: Console, lines: Sequence[str], last: str | None = "bold") -> None:
    """Print lines, the last of them, which is the answer, in bold, or in another style."""
    for k, line in enumerate(lines, 1):
        say(console, line, last if k == len(lines) else None)


def say_command(console: Console, command: str) -> None:
    """Print a command to be typed; one that is wider than the terminal is continued with a backslash, as a shell is."""
    lead, room = "Next: ", console.width
    if not console.is_terminal or len(lead + command) <= room:
        console.print(lead + command, markup=False, highlight=False, soft_wrap=True)
        return
    words = [word if word == "&&" else shlex.quote(word) for word in shlex.split(command)]
    lines = [words[0]]
    for word in words[1:]:
        if len(lines[-1]) + 1 + len(word) <= room - 4:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    told = [lead.rstrip(), *(f"  {line} \\" for line in lines[:-1]), f"  {lines[-1]}"]
    for line in told:
        console.print(line, markup=False, highlight=False, no_wrap=True, overflow="ignore", crop=False)


def broken(text: str, width: int) -> list[str]:
    """Return a text in lines of at most so many characters, broken at spaces; a longer word has a line of its own."""
    import textwrap

    indent = text[: len(text) - len(text.lstrip())]
    return textwrap.wrap(
        text.strip(), max(width, 8), initial_indent=indent, subsequent_indent=indent,
        break_long_words=False, break_on_hyphens=False,
    ) or [""]  # fmt: skip


def print_table(console: Console, table: Table) -> None:
    """Print one table, every cell whole: words wrap at spaces only, and numbers never.

    A table of numbers takes the width that it needs where the output is no terminal. On a terminal that is narrower
    than its longest words every row is a list.
    """
    from rich import box
    from rich.table import Table as RichTable
    from rich.text import Text

    # In a pipe a row of numbers is a line, however long.
    room = console.width if table.prose or console.is_terminal else None
    taken = widths(table, room)
    total = sum(taken) + GAP * (len(taken) - 1)
    if console.is_terminal and total > console.width:
        print_list(console, table)
        return
    title = Text(table.caption)
    narrow: Any = {"pad_edge": False, "show_edge": False, "collapse_padding": True}
    drawn = RichTable(title=title, title_justify="left", box=box.SIMPLE_HEAD, **narrow)
    for k, (column, width) in enumerate(zip(table.columns, taken, strict=True)):
        drawn.add_column(Text(column), justify="left" if k == 0 or table.prose else "right", width=width)
    for row in table.rows:
        drawn.add_row(*(Text(cell) for cell in row))
    drawn.width = total
    console.print(drawn, crop=False, no_wrap=True, overflow="ignore")
    console.print()
    if table.note:
        say(console, table.note, "dim")


def print_list(console: Console, table: Table) -> None:
    """Print one table as a list: each row's first cell, and below it a line for each of the others."""
    say(console, table.caption, "italic")
    for row in table.rows:
        say(console, row[0], "bold")
        for column, cell in zip(table.columns[1:], row[1:], strict=True):
            if cell:
                say(console, f"  {column}: {cell}" if column else f"  {cell}")
    console.print()
    if table.note:
        say(console, table.note, "dim")


def widths(table: Table, room: int | None) -> list[int]:
    """Return the width of every column, in characters, of a table that has `room` (None: as much as it wants).

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
