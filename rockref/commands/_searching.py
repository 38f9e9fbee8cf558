"""Progress of a search on standard error: cost, best chromosome, time left; a bar on a terminal, lines with
--verbose."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rockref.identify.genes import Space
    from rockref.identify.search import Progress

#: Genes shown beside the bar; decided: what fits a line.
SHOWN = 4


@contextmanager
def searching(every_line: bool = False) -> Iterator[Callable[[Space, str, Progress], None]]:
    """Give a function that takes (space, stage, progress) after every generation."""
    if every_line:
        yield lambda space, stage, p: print(f"{stage} {_line(space, p)}", file=sys.stderr, flush=True)
        return
    if not sys.stderr.isatty():
        yield lambda space, stage, p: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn
    from rich.progress import Progress as Bar

    columns = (
        TextColumn("{task.fields[stage]}"),
        BarColumn(bar_width=24),
        MofNCompleteColumn(),
        TextColumn("{task.description}", markup=False),
    )
    with Bar(*columns, console=Console(stderr=True), transient=True) as bar:
        tasks: dict[str, Any] = {}

        def show(space: Space, stage: str, p: Progress) -> None:
            if stage not in tasks:
                tasks[stage] = bar.add_task("", total=p.generations, stage=stage)
            bar.update(tasks[stage], completed=p.generation, description=_line(space, p))

        yield show


def _line(space: Space, p: Progress) -> str:
    best = ""
    if len(p.u) >= len(space.genes):
        values = space.values(p.u[: len(space.genes)])
        best = ", ".join(f"{n} {v:.3g}" for n, v in list(zip(space.names, values, strict=True))[:SHOWN]) + ", .."
    return f"cost {p.cost:.4f}  {best}  {p.seconds_left:.0f} s left"
