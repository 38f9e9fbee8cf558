"""`rockref compare`: models beside measured runs."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from rockref.commands._models import OwnEffects
from rockref.commands._results import ExperimentFolder, folder_option, only_for


def compare(
    experiment: ExperimentFolder,
    model: Annotated[
        list[str] | None,
        typer.Option(
            "--model", "-m", help="baseline (the default), table_3_1, four_points or a model.toml; may be repeated."
        ),
    ] = None,
    effect: OwnEffects = None,
    report: Annotated[
        Path | None, folder_option("--report", help="Folder for the page and the figures; made if it is not there.")
    ] = None,
    engine: Annotated[str, typer.Option(help="auto, numpy (the law itself) or numba (compiled).")] = "auto",
    check: Annotated[
        bool,
        typer.Option(
            "--check", help="End with 1 if a model leaves the band, or falls over, before the second main impact."
        ),
    ] = False,
    full: Annotated[bool, typer.Option("--full", help="All tables and sentences, not only the answer.")] = False,
    runs: Annotated[int | None, typer.Option(min=1, help="Of tests on a shake table: runs of each; 20.")] = None,
    step: Annotated[float | None, typer.Option(help="Of tests on a shake table: time step in seconds; 1e-5.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object instead of words.")] = False,
) -> None:
    """Show how far models are from measured runs, from when on, and with which feet on the plate.

    Shows fit and held-out runs and says which is which; names no cause. Exit code 0, or 2 if the input cannot
    be used; with --check, 1 if a model leaves the band of noise and run-to-run spread before the second main impact.

    Of a folder of tosses: errors of position and rotation over the frames, where they grow, and what needs no contact
    model; with --model, --report and --json.

    Of tests on a shake table (kind = "shaken"): scores of predicted probabilities, held out by motion, beside the
    best that repeats allow, and distributions of maxima; with --model, --runs, --step, --report and --json.

    \b
    Example:
      rockref compare data/experiments/mystery-01
      rockref compare data/experiments/mystery-01 --model table_3_1 --model mine.toml --report report
      rockref compare data/experiments/mystery-01 --json > comparison.json
      rockref compare my_table --model table_3_1 --runs 20 --report report
    """
    from rockref.measure.tosses.load import is_toss_folder
    from rockref.shake.experiment import is_shaken_folder

    if is_shaken_folder(experiment):
        from rockref.commands._shaken import compare_shaken

        only_for("releases", engine=engine != "auto", check=check, full=full)
        return compare_shaken(experiment, model, effect, report, runs, step, as_json)
    only_for("tests on a shake table", runs=runs is not None, step=step is not None)
    if is_toss_folder(experiment):
        from rockref.commands._tosses import compare_tosses

        only_for("releases", engine=engine != "auto", check=check, full=full)
        return compare_tosses(experiment, model, effect, report, as_json)
    from rockref.commands._models import labels, named_models
    from rockref.commands._progress import stages
    from rockref.commands._results import say_remarks, told, with_files
    from rockref.discover.compare.models import baseline_model
    from rockref.discover.compare.models import compare as run_comparison
    from rockref.discover.compare.record import to_dict
    from rockref.measure import load_experiment
    from rockref.report.output import usable_folder
    from rockref.report.terminal.comparison_text import print_comparison
    from rockref.report.terminal.next_command import BASELINE, after_comparison
    from rockref.report.views.comparison_page import write_report

    loaded = load_experiment(experiment)
    files = iter(named_models([text for text in model or () if text != BASELINE], effect))
    models = [baseline_model(loaded) if text == BASELINE else next(files) for text in model or [BASELINE]]
    names = labels(model) if model else [f"baseline ({loaded.baseline})"]
    folder = usable_folder(report)
    with stages("simulating the runs") as say:
        comparison = run_comparison(loaded, models, names, engine=engine, progress=say)
    say_remarks(loaded.notices)
    record = partial(to_dict, comparison)
    then = partial(after_comparison, experiment, model or [BASELINE], models)
    with told(as_json, with_files(record), lambda c: print_comparison(c, comparison, full), then) as written:
        if folder is not None:
            written += write_report(comparison, folder)
    if check and not comparison.holds_to_second_impact():
        raise typer.Exit(1)
