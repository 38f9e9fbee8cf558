"""A bar for what takes longer than two seconds; on a terminal only, and never on standard output."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

# decided: what is done by then needs no bar.
PATIENCE = 2.0
COMPILING = "compiling the engine (once: up to a minute; later runs load it)"


@contextmanager
def progress(text: str, wanted: bool = True) -> Iterator[Callable[[float], None] | None]:
    """Give a function that takes the fraction done, or None where nobody looks."""
    if not (wanted and sys.stderr.isatty()):
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    from rockref.engines import compile_watchers

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.percentage:>3.0f} %"),
        TimeRemainingColumn(),
    )
    bar = Progress(*columns, console=Console(stderr=True), transient=True)
    task = bar.add_task(text, total=1.0)
    began, shown, told = time.monotonic(), False, False

    def compiling() -> None:
        nonlocal told
        if not told:
            told = True
            bar.console.print(COMPILING, highlight=False)

    def report(fraction: float) -> None:
        nonlocal shown
        if not shown and time.monotonic() - began > PATIENCE:
            shown = True
            bar.start()
        bar.update(task, completed=fraction)

    compile_watchers.append(compiling)
    try:
        yield report
    finally:
        compile_watchers.remove(compiling)
        if shown:
            bar.stop()
