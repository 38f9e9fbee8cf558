"""`rockref diagnose`: which effect is missing."""

from pathlib import Path
from typing import Annotated

import typer

from rockref.commands._keeping import Fresh
from rockref.commands._results import ExperimentFolder, PageFolder, only_for


def diagnose(
    experiment: ExperimentFolder,
    model: Annotated[
        str | None,
        typer.Option(
            "--model", "-m", help="What to start from: table_3_1, four_points or a model.toml. Default: the baseline."
        ),
    ] = None,
    effect: Annotated[
        list[str] | None,
        typer.Option("--effect", "-e", help="An effect of your own, path/to/file.py:Class, to be tried, too."),
    ] = None,
    report: PageFolder = None,
    output: Annotated[Path | None, typer.Option("--output", "-o", help="Write the JSON object there too.")] = None,
    save_model: Annotated[Path | None, typer.Option("--save-model", help="Write the best model there.")] = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the random restarts.")] = 0,
    workers: Annotated[int | None, typer.Option(min=1, help="Threads; default: one per core.")] = None,
    full: Annotated[bool, typer.Option("--full", help="All tables, not only the answer.")] = False,
    fresh: Fresh = False,
    runs: Annotated[
        int | None, typer.Option(min=3, help="Of tests on a shake table: runs of each at each size; 12.")
    ] = None,
    step: Annotated[float | None, typer.Option(help="Of tests on a shake table: time step in seconds; 1e-5.")] = None,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="Every stage and the optimiser's lines.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object instead of words.")] = False,
) -> None:
    """Say which physical effect the model lacks, how large it is, and how sure that is; or what it could not tell.

    Fits the baseline and every candidate of the catalogue to the fit runs, confirms on the held-out runs. Takes a
    minute on a block like the source's, up to five where nobody knows the feet. An unchanged experiment with the same
    options is answered from what was kept; --fresh computes anew. Exit code 0 if there is a verdict (that nothing is
    missing is one), 1 if the fit is not trustworthy, 2 if the input cannot be used.

    Of a folder of tosses: effects added one after the other, each with what it takes off the held-out error; without
    effects of your own, --seed and --workers.

    Of tests on a shake table (kind = "shaken"): which of damping, friction, feet, and faults of the table the outcomes
    ask for; with --model, --output, --runs, --step, --seed, --workers and --json. A test is simulated 40 times as often
    as --runs says.

    \b
    Example:
      rockref diagnose data/experiments/mystery-05
      rockref diagnose data/experiments/mystery-05 --report report
      rockref diagnose data/experiments/mystery-05 --effect examples/my_effect.py:EddyBrake
      rockref diagnose data/experiments/mystery-05 --json > verdict.json
      rockref diagnose my_table --model model.toml --runs 8 --step 4e-5
    """
    from rockref.measure.tosses.load import is_toss_folder

    if is_toss_folder(experiment):
        from rockref.commands._tosses import diagnose_tosses

        only_for("releases", seed=seed != 0, workers=workers is not None, full=full, fresh=fresh)
        return diagnose_tosses(experiment, model, effect, report, output, save_model, verbose, as_json)
    from rockref.shake.experiment import is_shaken_folder

    if is_shaken_folder(experiment):
        from rockref.commands._shaken import diagnose_shaken

        other = {"report": report is not None, "effect": bool(effect), "save-model": save_model is not None}
        only_for("releases", **other, full=full, fresh=fresh)
        return diagnose_shaken(experiment, model, output, runs, step, seed, workers, as_json)
    only_for("tests on a shake table", runs=runs is not None, step=step is not None)
    from rockref.commands._keeping import keeping, kept
    from rockref.commands._models import check_step, models_and_others, say_idle
    from rockref.commands._progress import stages
    from rockref.commands._results import in_json, keep, say_remarks, told, usable_files
    from rockref.discover import diagnose as engine
    from rockref.discover.diagnosis_record import plain
    from rockref.engines import compiled_ahead
    from rockref.report.output import usable_folder
    from rockref.report.terminal.diagnosis_text import print_diagnosis
    from rockref.report.terminal.next_command import after_diagnosis

    models, candidates = models_and_others([model] if model else [], effect)
    given = models[0] if models else None
    check_step(given, model)
    say_idle(given, model)
    folder = usable_folder(report)
    usable_files(output, save_model)
    with keeping(fresh) as store, compiled_ahead(), stages(f"diagnosing {experiment}", verbose=verbose) as say:
        found = engine.diagnose(experiment, given, seed, workers, progress=say, own=candidates, store=store)
    record = plain(found.to_dict())
    text = in_json(record)
    say_remarks(found.experiment.notices)
    following = after_diagnosis(record, experiment, model, given, page=folder is not None)
    words, then = lambda c: print_diagnosis(c, record, full), lambda: following
    with kept(store), told(as_json, lambda written: text, words, then) as written:
        written += keep(text, output, found.model, save_model)
        if folder is not None:
            from rockref.report.views.diagnosis_page import diagnosis_page

            with stages("the page"):
                written.append(diagnosis_page(found).write_into(folder))
    if record["verdict"] == "not_trustworthy":
        raise typer.Exit(1)
