"""`rockref sensitivity`: how the response depends on time step, last digits and release angle."""

from pathlib import Path
from typing import Annotated

import typer

from rockref.commands._options import AsJson, OwnEffects, StartModel, Threads, folder_option
from rockref.commands._results import in_json, say_written

# decided: the rates of a thousand runs of 6 s at 2 kHz fill 0.3 GB, and a standard deviation is known to 2 %.
MOST = 1_000


def sensitivity(
    output: Annotated[
        Path, folder_option("--output", "-o", help="Folder for the figures and the result; made if it is not there.")
    ] = Path("sensitivity"),
    model: StartModel = "table_3_1",
    effect: OwnEffects = None,
    step: Annotated[
        list[float] | None,
        typer.Option("--step", help="A time step in seconds; may be repeated. Default: 1e-5, 3e-6, 1e-6, 3e-7."),
    ] = None,
    duration: Annotated[float, typer.Option(min=1.6, help="Length of the runs in seconds.")] = 6.0,
    trials: Annotated[int, typer.Option(min=2, max=MOST, help="Parameter sets with changed last digits.")] = 10,
    seed: Annotated[int, typer.Option(min=0, help="Seed of all random draws.")] = 0,
    workers: Threads = None,
    as_json: AsJson = False,
) -> None:
    """Show how long responses agree when the time step, a last digit or the release angle changes a little.

    Writes figures like the source's 3.5 to 3.7, the times until which responses agree, the significant digits of Table
    3.1, and the factor by which a small difference grows from one main impact to the next.

    \b
    Example:
      rockref sensitivity -o sensitivity
      rockref sensitivity --model identified/model.toml --step 1e-5 --step 1e-6 --json
    """
    from rockref.commands._models import named_models
    from rockref.commands._progress import stages
    from rockref.commands._terminal import console
    from rockref.model.storage import write_bytes, write_text
    from rockref.report.charts.figures import rendered
    from rockref.report.charts.sensitivity_figures import sensitivity_figures
    from rockref.report.output import made_folder, usable_folder
    from rockref.report.terminal.sensitivity_text import print_sensitivity
    from rockref.studies.sensitivity import STEPS
    from rockref.studies.sensitivity_study import record, study

    (base,) = named_models([model], effect)
    usable_folder(output)
    with stages("sensitivity", not as_json) as say:
        found = study(base, seed, duration, tuple(step) if step else STEPS, trials, workers, say)
        say("figures")
        folder = made_folder(output)
        written = []
        for name, figure in sensitivity_figures(found).items():
            for kind in ("png", "svg"):
                written.append(folder / f"{name}.{kind}")
                write_bytes(written[-1], rendered(figure, kind))
    result = record(found) | {"model": model}
    text = in_json(result)
    written.append(folder / "sensitivity.json")
    write_text(written[-1], text + "\n")
    if as_json:
        typer.echo(text)
        return
    print_sensitivity(console(), result)
    say_written(written)
