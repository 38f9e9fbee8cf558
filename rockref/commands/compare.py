"""`rockref compare`: models beside measured runs."""

from functools import partial
from typing import Annotated

import typer

from rockref.commands._options import AsJson, Engine, ExperimentFolder, Full, OwnEffects, PageFolder, ShakenStep
from rockref.commands._results import only_for


def compare(
    experiment: ExperimentFolder,
    model: Annotated[
        list[str] | None,
        typer.Option(
            "--model", "-m", help="baseline (the default), table_3_1, four_points or a model.toml; may be repeated."
        ),
    ] = None,
    effect: OwnEffects = None,
    report: PageFolder = None,
    engine: Engine = "auto",
    check: Annotated[
        bool,
        typer.Option(
            "--check",
            help="End with exit code 1 if a model leaves the band, or falls over, before the second main impact.",
        ),
    ] = False,
    full: Full = False,
    runs: Annotated[
        int | None, typer.Option(min=1, help="For tests on a shake table: simulated runs of each test; default: 20.")
    ] = None,
    step: ShakenStep = None,
    as_json: AsJson = False,
) -> None:
    """Compare models with measured runs: how large the error is, when it begins, and which feet touch then.

    Fit runs and held-out runs are shown apart. No cause is named; that is what rockref diagnose does. Exit code 0, or 2
    if the input cannot be used; with --check, 1 if a model leaves the band of noise and run-to-run spread before the
    second main impact.

    For a folder of tosses: the errors of position and rotation over the frames, where they grow, and what the tosses
    tell without a contact model; --model, --report and --json apply.

    For tests on a shake table (kind = "shaken"): scores of the predicted probabilities of falling on held-out motions,
    beside the best that repeats allow, and distributions of maxima; --model, --runs, --step, --report and --json apply.

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
