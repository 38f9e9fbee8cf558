"""`rockref simulate`: the block, released and computed, as a table."""

from pathlib import Path
from typing import Annotated, Any

import typer

from rockref.commands._options import AddedEffects, AsJson, Engine, PageFolder, StartModel
from rockref.commands._results import in_json

# decided: with 50 rows a second the main impacts of the block of Table 3.1 are off by 1e-4 s, with 20 by 7e-4 s, and
# with one they are others.
LEAST_RATE = 50.0


def simulate(
    given: Annotated[str | None, typer.Argument(metavar="MODEL", hidden=True)] = None,
    model: StartModel = "table_3_1",
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Table to write, .csv or .csv.gz. Without it only the summary is printed."),
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", hidden=True)] = None,
    report: PageFolder = None,
    duration: Annotated[
        float | None,
        typer.Option(help="Seconds to simulate. Default: 1.5; with --base, the record and 10 s more."),
    ] = None,
    step: Annotated[float, typer.Option(help="Time step in seconds; the source's is 1e-5.")] = 1e-5,
    rate: Annotated[float, typer.Option(help="Rows of the table per second.")] = 2000.0,
    engine: Engine = "auto",
    effect: AddedEffects = None,
    base: Annotated[
        list[str] | None,
        typer.Option(
            "--base", help="File of the motion of the plate on which the block stands; repeat it to join components."
        ),
    ] = None,
    scale: Annotated[float, typer.Option(help="Factor on the record.")] = 1.0,
    rotate: Annotated[float, typer.Option(help="Turn of the record about z, from x to y, in degrees.")] = 0.0,
    turned: Annotated[bool, typer.Option("--turned", help="Turn the block by 180 degrees before the release.")] = False,
    as_json: AsJson = False,
) -> None:
    """Simulate a release and write time, body rates, pose, point forces and contacts.

    The names of the columns carry the units. Rates are those of an ideal gyroscope, unless the model has sensor
    effects. A block that overturns is no error: the summary says so.

    With --base the block stands on a plate that moves. The summary then gives the extremes of the run. The run ends
    when the block has fallen, or rests after the record; the rows of --output go on for the whole duration.

    \b
    Example:
      rockref simulate -o response.csv
      rockref simulate --duration 5 --effect quadratic_drag:c=0.4 -o dragged.csv.gz --report dragged
      rockref simulate --model model.toml --turned --json
      rockref simulate --base record.AT2 --scale 0.5 --rotate 30
    """
    if base:
        from rockref.commands._shaking import simulate_shaken

        options = {"engine": engine, "report": report, "turned": turned, "out": out, "MODEL": given}
        rows = {"output": output, "rate": rate, "duration": duration, "step": step}
        return simulate_shaken(model, "+".join(base), scale, rotate, effect or [], rows, options, as_json)
    duration = 1.5 if duration is None else duration
    from rockref import api
    from rockref.commands._models import model_with, of_file
    from rockref.commands._progress import progress
    from rockref.report.output import usable_folder
    from rockref.report.tables.response_table import as_measured, check_name, overturned_at, write_response
    from rockref.report.views.response_page import write_response_page

    model, output = _old_spellings(given, model, out, output)
    if output is not None:
        check_name(output)
    folder = usable_folder(report)
    chosen = model_with(model, effect)
    with progress("simulating") as ahead, of_file(model):
        response = api.simulate(
            chosen, duration=duration, step=step, output_rate=rate, engine=engine, progress=ahead, turned=turned
        )
    if rate < LEAST_RATE:
        say_sparse(rate)
    fell = overturned_at(response)
    written = write_response(response, output) if output is not None else None
    page = write_response_page(response, chosen, folder) if folder is not None else None
    facts: dict[str, Any] = {
        "model": model,
        "effects": {e.id: e.values() for e in chosen.active_effects()},
        "engine": engine,
        "turned": turned,
        "duration_s": duration,
        "step_s": step,
        "output_rate_hz": rate,
        "main_impacts_s": [float(t) for t in response.main_impacts() if fell is None or t < fell],
        "largest_rates_deg_s": [float(v) for v in abs(as_measured(response).crv).max(axis=0)],
        "overturned": response.overturned,
        "overturned_at_s": fell,
        "output": written,
        "report": None if page is None else str(page),
    }
    if as_json:
        typer.echo(in_json(facts))
        return
    impacts = ", ".join(f"{t:.4f}" for t in facts["main_impacts_s"]) or "none"
    largest = ", ".join(f"{axis} {v:.2f}" for axis, v in zip("XYZ", facts["largest_rates_deg_s"], strict=True))
    typer.echo(f"main impacts (s)      {impacts}")
    typer.echo(f"largest rates (deg/s) {largest}")
    if fell is not None:
        typer.echo(f"The block overturned: beyond 45 degrees at {fell:.4f} s.")
    if written is not None:
        typer.echo(f"wrote {written['path']}: {written['rows']} rows, {written['columns']} columns")
    if page is not None:
        typer.echo(f"wrote {page}")


def _old_spellings(given: str | None, model: str, out: Path | None, output: Path | None) -> tuple[str, Path | None]:
    """Return model and output, as stated in today's spelling or in the old one, which gets a remark."""
    from rockref.commands._results import say_old_spelling

    if given is not None:
        say_old_spelling("simulate MODEL", "simulate --model MODEL")
        model = given
    if out is not None:
        say_old_spelling("simulate --out", "simulate --output")
        output = out
    return model, output


def say_sparse(rate: float) -> None:
    """Print a remark on standard error where main impacts and largest rates are taken from few rows a second."""
    from rockref.commands._results import say_remarks
    from rockref.measure.records.notice import Notice

    what = f"{rate:g} rows a second: main impacts and largest rates are taken from the rows, and may be off or missing"
    say_remarks([Notice("W-ROWS", "--rate", what, f"Ask for {LEAST_RATE:g} or more.")])
