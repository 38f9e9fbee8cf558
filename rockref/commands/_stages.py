"""Stages of a long computation on standard error: one line that changes on a terminal, none elsewhere unless asked."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console

# decided: where no terminal sets a width, tables of seven columns fit without being cut.
WIDE = 120


def console() -> Console:
    """Return where words and tables go: standard output, as wide as the terminal, or WIDE where there is none."""
    from rich.console import Console

    return Console() if sys.stdout.isatty() else Console(width=WIDE)


@contextmanager
def stages(title: str, wanted: bool = True, every_line: bool = False) -> Iterator[Callable[[str], None]]:
    """Give a function that takes a line at every stage; on a terminal the last one is shown with the time so far.

    With `every_line` each line is printed to standard error, with the seconds so far.
    """
    begun = time.monotonic()
    if every_line:
        yield lambda line: print(f"{time.monotonic() - begun:6.0f} s  {line.strip()}", file=sys.stderr, flush=True)
        return
    if not (wanted and sys.stderr.isatty()):
        yield lambda line: None
        return
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TimeElapsedColumn(), TextColumn("{task.description}", markup=False))
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(title, total=None)
        yield lambda line: bar.update(task, description=line.strip())
