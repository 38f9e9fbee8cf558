"""How far long work is, on standard error: one line that changes on a terminal, one line a stage elsewhere.

The work reports stages as data (`rockref.discover.progress`); they are drawn here and nowhere else.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from rockref.discover.progress import StageReport, in_words

if TYPE_CHECKING:
    from rockref.identify.genes import Space
    from rockref.identify.search import Progress

# decided: what is done by then needs no bar.
PATIENCE = 2.0
COMPILING = "compiling the engine (once: up to a minute; later runs load it)"
#: Genes shown of the best chromosome; decided: what fits a line.
SHOWN = 4

#: What a command tells: a stage as data, or a line of a study that does not count its stages.
Tell = Callable[[StageReport | str], None]


@contextmanager
def stages(title: str, wanted: bool = True, verbose: bool = False) -> Iterator[Tell]:
    """Give a function that takes reports of stages.

    On a terminal the present stage is shown with the time so far and the time left. Elsewhere, and with `verbose`, each
    stage has a line; with `verbose` each line of the optimiser has one, too.
    """
    if not wanted:
        yield lambda report: None
        return
    show = _lines(verbose) if verbose or not sys.stderr.isatty() else None
    if show is not None:
        with _compiling_told(lambda: print(COMPILING, file=sys.stderr, flush=True)):
            yield show
        return
    with _one_line(title) as show:
        yield show


def _report_of(said: StageReport | str) -> StageReport:
    """Return a report; an indented line is one of an optimiser, any other names a stage."""
    if isinstance(said, StageReport):
        return said
    return StageReport(0, 0, said.strip(), line=said.strip() if said.startswith(" ") else "")


def _lines(verbose: bool) -> Tell:
    """Return what prints a line for every new stage, and with `verbose` for all that is reported in it."""
    started, last = time.monotonic(), (0, "")

    def show(said: StageReport | str) -> None:
        nonlocal last
        report = _report_of(said)
        if report.line and not verbose:
            return
        if report.line:
            words = f"    {report.line.strip()}"
        elif report.key == last:
            return
        else:
            last, words = report.key, in_words(report, report.seconds_left)
        seconds = f"{time.monotonic() - started:6.0f} s  " if verbose else ""
        print(f"{seconds}{words}", file=sys.stderr, flush=True)

    return show


@contextmanager
def _one_line(title: str) -> Iterator[Tell]:
    """Give what shows the present stage in one line of the terminal, gone with the work."""
    from rich.console import Console
    from rich.progress import Progress, ProgressColumn, SpinnerColumn, TimeElapsedColumn
    from rich.table import Column
    from rich.text import Text

    shown, told = StageReport(0, 0, title), time.monotonic()

    class Words(ProgressColumn):
        """The stage; the seconds left go down between two reports."""

        def render(self, task: object) -> Text:
            left = shown.seconds_left
            return Text(in_words(shown, None if left is None else left - (time.monotonic() - told)))

    room = Column(ratio=1, no_wrap=True, overflow="ellipsis")
    columns = (SpinnerColumn(), TimeElapsedColumn(), Words(table_column=room))
    with Progress(*columns, console=Console(stderr=True), transient=True, expand=True) as bar:
        task = bar.add_task(title, total=None)

        def show(said: StageReport | str) -> None:
            nonlocal shown, told
            report = _report_of(said)
            if report.step or not report.line:
                shown, told = report, time.monotonic()
                bar.update(task)

        with _compiling_told(lambda: bar.console.print(COMPILING, highlight=False)):
            yield show


@contextmanager
def _compiling_told(tell: Callable[[], None]) -> Iterator[None]:
    """Have it told once that the engine is being compiled, where that happens meanwhile."""
    from rockref.engines.watchers import compile_watchers

    told = False

    def compiling() -> None:
        nonlocal told
        if not told:
            told = True
            tell()

    compile_watchers.append(compiling)
    try:
        yield
    finally:
        compile_watchers.remove(compiling)


@contextmanager
def progress(text: str, wanted: bool = True) -> Iterator[Callable[[float], None] | None]:
    """Give a function that takes the fraction done, or None where nobody looks: a bar for work of one stage."""
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

    with _compiling_told(lambda: bar.console.print(COMPILING, highlight=False)):
        try:
            yield report
        finally:
            if shown:
                bar.stop()


def of_search(tell: Tell) -> Callable[[Space, str, Progress], None]:
    """Return what takes (space, stage, progress) after every generation of a search, and tells it as a stage."""

    def report(space: Space, stage: str, p: Progress) -> None:
        round_ = int(stage.partition("_")[2] or 0)
        name = f"searching on the signals, round {round_}" if round_ else "searching on features of the runs"
        best = f"cost {p.cost:.4f} at generation {p.generation} of {p.generations}"
        tell(StageReport(1 + round_, 0, name, best, p.seconds_left))
        tell(StageReport(1 + round_, 0, name, best, p.seconds_left, f"{stage} {_generation(space, p)}"))

    return report


def _generation(space: Space, p: Progress) -> str:
    """Return a generation in a line: cost, the first numbers of the best chromosome, seconds left."""
    best = ""
    if len(p.u) >= len(space.genes):
        values = space.values(p.u[: len(space.genes)])
        best = ", ".join(f"{n} {v:.3g}" for n, v in list(zip(space.names, values, strict=True))[:SHOWN]) + ", .."
    return f"cost {p.cost:.4f}  {best}  {p.seconds_left:.0f} s left"
