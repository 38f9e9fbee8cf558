"""`rockref diagnose`: which effect is missing."""

from pathlib import Path
from typing import Annotated

import typer

from rockref.commands import _options as options
from rockref.commands._results import only_for


def diagnose(
    experiment: options.ExperimentFolder,
    model: Annotated[
        str | None,
        typer.Option(
            "--model", "-m", help="Model to start from: table_3_1, four_points or a model.toml. Default: the baseline."
        ),
    ] = None,
    effect: Annotated[
        list[str] | None,
        typer.Option("--effect", "-e", help="Try an effect of your own, too: path/to/file.py:Class."),
    ] = None,
    report: options.PageFolder = None,
    output: options.JsonFile = None,
    save_model: Annotated[Path | None, typer.Option("--save-model", help="Write the best model to this file.")] = None,
    seed: options.RestartSeed = 0,
    workers: options.Threads = None,
    full: options.Full = False,
    fresh: options.Fresh = False,
    runs: Annotated[
        int | None, typer.Option(min=3, help="For tests on a shake table: runs of each test at each size; default: 12.")
    ] = None,
    step: options.ShakenStep = None,
    verbose: options.Verbose = False,
    as_json: options.AsJson = False,
) -> None:
    """Say which physical effect the model lacks, how large it is, and how sure that is; or what it could not tell.

    Fits the baseline and the effects of the catalogue to the fit runs, and confirms the best on the held-out runs.
    Takes half a minute on a block like the source's as a rule, up to four where heights of the feet are unknown. An
    unchanged experiment with the same options is answered from the kept verdict; --fresh computes anew. Exit code 0 if
    there is a verdict (that nothing is missing is one), 1 if the fit is not trustworthy, 2 if the input cannot be used.

    For a folder of tosses: effects are added one after the other, each with the fall of the held-out error; effects of
    your own, --seed, --workers, --full and --fresh do not apply.

    For tests on a shake table (kind = "shaken"): which of damping, friction, feet, and faults of the table the outcomes
    point to; --model, --output, --runs, --step, --seed, --workers and --json apply. A test is simulated 40 times as
    often as --runs says.

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
    from rockref.commands._models import check_step, given_and_others, say_idle
    from rockref.commands._progress import stages
    from rockref.commands._results import in_json, keep, say_remarks, told, usable_files
    from rockref.discover import diagnose as engine
    from rockref.discover.diagnosis_record import plain
    from rockref.engines import compiled_ahead
    from rockref.report.output import usable_folder
    from rockref.report.terminal.diagnosis_text import print_diagnosis
    from rockref.report.terminal.next_command import after_diagnosis

    given, candidates = given_and_others(model, effect)
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
