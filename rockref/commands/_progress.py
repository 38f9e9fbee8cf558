"""A bar for what takes longer than two seconds; on a terminal only, and never on standard output."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

# decided: what is done by then needs no bar.
PATIENCE = 2.0


@contextmanager
def progress(text: str, wanted: bool = True) -> Iterator[Callable[[float], None] | None]:
    """Give a function that takes the fraction done, or None where nobody looks."""
    if not (wanted and sys.stderr.isatty()):
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.percentage:>3.0f} %"),
        TimeRemainingColumn(),
    )
    bar = Progress(*columns, console=Console(stderr=True), transient=True)
    task = bar.add_task(text, total=1.0)
    began, shown = time.monotonic(), False

    def report(fraction: float) -> None:
        nonlocal shown
        if not shown and time.monotonic() - began > PATIENCE:
            shown = True
            bar.start()
        bar.update(task, completed=fraction)

    try:
        yield report
    finally:
        if shown:
            bar.stop()
