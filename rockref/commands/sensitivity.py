"""`rockref sensitivity`: how the response depends on time step, last digits and release angle."""

from pathlib import Path
from typing import Annotated

import typer

from rockref.commands._models import OwnEffects
from rockref.commands._results import folder_option, in_json, say_written

# decided: the rates of a thousand runs of 6 s at 2 kHz fill 0.3 GB, and a standard deviation is known to 2 %.
MOST = 1_000


def sensitivity(
    output: Annotated[
        Path, folder_option("--output", "-o", help="Folder for the figures and the result; made if it is not there.")
    ] = Path("sensitivity"),
    model: Annotated[str, typer.Option("--model", "-m", help="table_3_1 or a model.toml.")] = "table_3_1",
    effect: OwnEffects = None,
    step: Annotated[
        list[float] | None,
        typer.Option("--step", help="A time step in s; may be repeated. Default: 1e-5, 3e-6, 1e-6, 3e-7."),
    ] = None,
    duration: Annotated[float, typer.Option(min=1.6, help="Length of the runs in s.")] = 6.0,
    trials: Annotated[int, typer.Option(min=2, max=MOST, help="Chromosomes with changed last digits.")] = 10,
    seed: Annotated[int, typer.Option(min=0, help="Seed of what is drawn.")] = 0,
    workers: Annotated[int | None, typer.Option(min=1, help="Threads; default: one per core.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as one JSON object.")] = False,
) -> None:
    """Show how far responses agree when the time step, the last digits or the release angle change a little.

    Writes the figures in the manner of the source's 3.5 to 3.7, until when responses agree, the significant digits of
    Table 3.1 by their definition, and by how much a small difference grows from one main impact to the next.

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
