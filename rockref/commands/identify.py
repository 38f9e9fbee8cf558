"""`rockref identify`: the parameters of the model from measured runs."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from rockref.commands import _options as options
from rockref.commands._results import in_json

# decided: of a hundred thousand runs of 3e5 steps, at 27 million steps a second, a generation takes twenty minutes.
MOST = 100_000


def identify(
    experiment: options.ExperimentFolder,
    output: Annotated[
        Path, options.folder_option("--output", "-o", help="Folder for the result, the model and the checkpoints.")
    ] = Path("identified"),
    model: Annotated[
        str,
        typer.Option(
            "--model", "-m", help="table_3_1 or a model.toml: the block, and the parameters that are not searched."
        ),
    ] = "table_3_1",
    effect: options.OwnEffects = None,
    report: options.PageFolder = None,
    genes: Annotated[int, typer.Option(help="How many parameters are searched: 12 or 54.")] = 12,
    search_runs: Annotated[
        str | None,
        typer.Option("--search-runs", help="Runs that the evolutionary search reads, as 01,06. Default: the first."),
    ] = None,
    generations: Annotated[int, typer.Option(min=1, help="Generations of the search.")] = 250,
    population: Annotated[int, typer.Option(min=4, max=MOST, help="Chromosomes per generation.")] = 40,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the search.")] = 0,
    workers: options.Processes = None,
    dask: options.DaskAddress = None,
    resume: Annotated[bool, typer.Option("--resume", help="Go on from the checkpoints in the output folder.")] = False,
    full: options.Full = False,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="Print a line for every generation.")] = False,
    as_json: options.AsJson = False,
) -> None:
    """Find the parameters of the law from the fit runs: evolutionary search, then least squares on the signals.

    Every run gets a release angle of its own. Held-out runs are looked at only after the parameters are found. After an
    interruption --resume goes on and finds the same numbers. Exit code 1 if the fit is above the noise floor.

    \b
    Example:
      rockref identify data/experiments/mystery-08 -o identified
      rockref identify data/experiments/mystery-08 -o identified --resume
      rockref identify data/experiments/mystery-08 --dask tcp://127.0.0.1:8786
    """
    from rockref.commands._keeping import checkpoints_in
    from rockref.commands._models import named_models, say_left_out, say_other_points
    from rockref.commands._progress import of_search, stages
    from rockref.commands._results import say_remarks, told
    from rockref.identify.from_experiment import answered, question
    from rockref.identify.outcome import files_in
    from rockref.identify.search import Settings
    from rockref.jobs.campaign import campaign
    from rockref.jobs.folder_lock import alone_in
    from rockref.model.storage import write_text
    from rockref.report.output import made_folder, usable_folder
    from rockref.report.terminal.identification_text import print_identification
    from rockref.report.terminal.next_command import after_identification

    (base,) = named_models([model], effect)
    say_left_out(base, model)
    asked = question(experiment, base, genes, search_runs)
    say_other_points(asked.stated, experiment)
    say_remarks(asked.notices)
    page_folder = usable_folder(report)
    folder = made_folder(output)
    resumable = checkpoints_in(folder)
    with resumable, alone_in(folder), stages("identifying", verbose=verbose) as say, campaign(workers, dask) as work:
        settings = Settings(population, generations, seed)
        result, found = answered(asked, settings, work, folder, resume=resume, report=of_search(say))
        files = files_in(folder)
        text = in_json(result)
        write_text(files["result"], text + "\n")
        found.save(files["model"])
    then = partial(after_identification, result, experiment, files["model"])
    with told(as_json, lambda written: text, lambda c: print_identification(c, result, full), then) as written:
        written += files.values()
        if page_folder is not None:
            from rockref.report.views.identification_page import identification_page

            written.append(identification_page(result).write_into(page_folder))
    if not result["least_squares"]["at_noise_floor"]:
        raise typer.Exit(1)
