"""`rockref shake`: many runs of a block on shaken plates, as a table."""

from pathlib import Path
from typing import Annotated

import typer

from rockref.commands._options import AddedEffects, AsJson, DaskAddress, PageFolder, Threads, folder_option


def shake(
    model: Annotated[str, typer.Argument(metavar="MODEL", help="table_3_1, four_points, or a model.toml.")],
    records: Annotated[
        list[str],
        typer.Argument(
            metavar="RECORDS", help="Files of ground motion; + joins the components of one motion, as x.AT2+y.AT2."
        ),
    ],
    output: Annotated[
        Path,
        folder_option("--output", "-o", help="Folder for the table; after an interruption the same command goes on."),
    ],
    runs: Annotated[int, typer.Option(min=1, help="Number of runs.")] = 1000,
    scale: Annotated[str, typer.Option(help="Factors on the records, separated by commas.")] = "1",
    rotate: Annotated[float, typer.Option(help="Turn of the records about z, from x to y, in degrees.")] = 0.0,
    heading: Annotated[
        float,
        typer.Option(min=0, help="Random heading of the block: at most this turn to either side, uniform, in degrees."),
    ] = 0.0,
    feet: Annotated[float, typer.Option(min=0, help="Random heights of the feet: standard deviation in metres.")] = 0.0,
    friction: Annotated[float, typer.Option(min=0, help="Random friction: standard deviation of its logarithm.")] = 0.0,
    step: Annotated[str, typer.Option(help="Time step in seconds, or several, separated by commas.")] = "1e-5",
    after: Annotated[
        float, typer.Option(min=0, help="Seconds that a run goes on after the record, unless the block comes to rest.")
    ] = 10.0,
    seed: Annotated[int, typer.Option(min=0, help="Seed of all random draws.")] = 0,
    workers: Threads = None,
    dask: DaskAddress = None,
    report: PageFolder = None,
    effect: AddedEffects = None,
    as_json: AsJson = False,
) -> None:
    """Run a block many times on a shaken plate and write the outcome of each run.

    Every run starts at rest. Records and factors are taken in turn; heading, feet and friction are drawn for each run.
    The same seed gives the same table, whatever the workers and the interruptions. The table has a row for each run:
    whether the block fell, largest tilt, slide and twist, first uplift, impacts, and the displacement at the end. The
    page of --report shows fragility, overturning maps, distributions of maxima, and a replay of chosen runs.

    \b
    Example:
      rockref shake table_3_1 record.csv --runs 200 --scale 0.5,1,2 --heading 180 --feet 5e-5 -o shaken
      rockref shake model.toml a.AT2+b.AT2 c.AT2+d.AT2 --runs 1000 --friction 0.1 -o shaken --workers 2
      rockref shake table_3_1 record.csv --runs 200 --step 1e-5,2e-5 -o shaken --report report
    """
    from rockref.commands._models import model_with, of_file
    from rockref.commands._progress import progress
    from rockref.commands._results import in_json
    from rockref.commands._shaking import motion, numbers
    from rockref.jobs.campaign import campaign
    from rockref.model.errors import Interrupted
    from rockref.report.output import usable_folder
    from rockref.shake.ensemble import BLOCK, Draws, Ensemble, run_ensemble
    from rockref.shake.ensemble_store import EnsembleFolder

    page = usable_folder(report)
    chosen = model_with(model, effect)
    motions = tuple(motion(record, rotate=rotate) for record in records)
    factors = tuple(numbers(scale, "--scale"))
    steps = tuple(numbers(step, "--step"))
    ensemble = Ensemble(chosen, motions, factors, Draws(heading, feet, friction), steps, after, seed)
    folder, last = EnsembleFolder(output, ensemble), max(1, -(-runs // BLOCK))
    try:
        # Threads of this process share the compiled loop; a cluster has an executor of its own.
        with campaign(1, dask) as work, progress("shaking") as ahead, of_file(model):

            def keep(block: int, rows: list) -> None:
                folder.keep(block, rows)
                if ahead is not None:
                    ahead((block + 1) / last)

            rows = run_ensemble(ensemble, runs, workers, keep, folder.known, work.executor)
    except KeyboardInterrupt:
        raise Interrupted(f"interrupted. What is done is kept in {output}: the same command goes on.") from None
    files = folder.write_table(rows)
    if page is not None:
        from rockref.report.views.ensemble_page import write_ensemble

        files.append(write_ensemble(rows, chosen, page, ensemble))
    facts = summary(rows)
    if as_json:
        typer.echo(in_json({"runs": runs, "levels": facts, "files": [str(path) for path in files]}))
        return
    print_levels(facts)
    for path in files:
        typer.echo(f"wrote {path}: {len(rows)} runs")


def print_levels(facts: list[dict]) -> None:
    """Print a line for each factor and step."""
    head = f"{'factor':>8} {'step (s)':>9} {'PGA (m/s2)':>11} {'runs':>6} {'fell':>6}  {'share, 95 %':>14}"
    typer.echo(f"{head}  median tilt (deg)")
    for row in facts:
        share = f"{row['low']:.3f} to {row['high']:.3f}"
        typer.echo(
            f"{row['factor']:8g} {row['step_s']:9g} {row['pga_m_s2']:11.3f} {row['runs']:6d} {row['fell']:6d}  "
            f"{share:>14}  {row['median_tilt_deg']:.4f}"
        )


def summary(rows: list[dict]) -> list[dict]:
    """Return, by factor and step, how many runs fell, the share's Wilson interval, and the median tilt."""
    import math
    from statistics import mean, median

    from rockref.shake.statistics.bands import wilson_interval

    found = []
    for factor, step in sorted({(row["factor"], row["step_s"]) for row in rows}):
        own = [row for row in rows if (row["factor"], row["step_s"]) == (factor, step)]
        fell = sum(bool(row["fell"]) for row in own)
        low, high = wilson_interval(fell, len(own))
        tilt = math.degrees(median(row["tilt_rad"] for row in own))
        pga = mean(row["pga_m_s2"] for row in own)
        found.append(
            {"factor": factor, "step_s": step, "pga_m_s2": pga, "runs": len(own), "fell": fell, "low": low,
             "high": high, "median_tilt_deg": tilt}
        )  # fmt: skip
    return found
