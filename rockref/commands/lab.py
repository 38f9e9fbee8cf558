"""`rockref lab`: a page on which the law runs, measured runs beside it."""

from pathlib import Path
from typing import Annotated

import typer


def lab(
    experiment: Annotated[
        Path | None, typer.Argument(help="Folder with experiment.toml. Default: simulated runs with a hidden effect.")
    ] = None,
    model: Annotated[
        str | None, typer.Option("--model", "-m", help="table_3_1, four_points or a model.toml. Default: the baseline.")
    ] = None,
    output: Annotated[Path, typer.Option("--output", "-o", help="File for the page.")] = Path("lab.html"),
) -> None:
    """Write an interactive page on which the model runs, with sliders, effects, measured runs and a fit.

    The page is one file that needs neither network nor server. The model in it runs in WebAssembly with the bits of the
    NumPy code; a click on the page proves it again.

    \b
    Example:
      rockref lab data/experiments/mystery-04 --output lab.html
      rockref lab --model mine.toml
    """
    from rockref.commands._models import named_model
    from rockref.commands._results import say_remarks, say_written
    from rockref.discover.compare.models import baseline_model
    from rockref.lab.page import write_page
    from rockref.measure import load_experiment

    given = None if model is None else named_model(model)
    if experiment is None:
        say_written([write_page(output, given or named_model("table_3_1"))])
        return
    loaded = load_experiment(experiment)
    say_remarks(loaded.notices)
    say_written([write_page(output, given or baseline_model(loaded), loaded)])
