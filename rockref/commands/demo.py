"""`rockref demo`: the block rocks, measured runs beside it, and where the model fails."""

import time
from pathlib import Path
from typing import Annotated

import typer

from rockref.commands._options import Engine, folder_name, folder_option


def demo(
    output: Annotated[Path, folder_option("--output", "-o", help="Folder for the page and the figures.")] = Path(
        "demo_out"
    ),
    old: Annotated[Path | None, typer.Option("--out", parser=folder_name, hidden=True)] = None,
    data: Annotated[
        Path | None,
        typer.Option("--data", help="Folder of the shipped experiments, where the command does not find them."),
    ] = None,
    engine: Engine = "auto",
) -> None:
    """Find the effect that a model of a shipped experiment lacks, and show the error fall.

    Writes one page, and prints its main lines and its place. Takes about a minute and a half; the first time, compiling
    the engine takes a minute more.

    \b
    Example:
      rockref demo
      rockref demo --output somewhere
    """
    from rockref.api import Model
    from rockref.commands._progress import stages
    from rockref.commands._results import say_old_spelling
    from rockref.discover.compare.models import baseline_model
    from rockref.engines import chosen, compiled_ahead
    from rockref.lab.page import write_page
    from rockref.measure import load_experiment
    from rockref.report.output import made_folder
    from rockref.workflows.demo import EXPERIMENTS, find_experiments, tell

    began = time.monotonic()
    if old is not None:
        say_old_spelling("demo --out", "demo --output")
        output = old
    chosen(Model.table_3_1().problem(), engine)  # refused before the folder is made
    folder = find_experiments(data)
    made_folder(output)
    with compiled_ahead(), stages("the demonstration") as report:
        story = tell(folder, output, engine, report)
    experiment = load_experiment(folder / EXPERIMENTS[0])
    lab = write_page(output / "lab.html", baseline_model(experiment), experiment)
    for line in story.lines:
        typer.echo(f"- {line}")
    typer.echo(f"\nThe page: {story.written[0].resolve()}")
    typer.echo(f"{len(story.written) - 1} figures beside it; {time.monotonic() - began:.0f} s.")
    typer.echo(f"The lab, to find it yourself: {lab.resolve()}")
