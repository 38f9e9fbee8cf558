"""`rockref add`: one more effect in a model, and the error before and after."""

from pathlib import Path
from typing import Annotated

import typer

from rockref.commands import _options as options
from rockref.commands._results import only_for


def add(
    experiment: options.ExperimentFolder,
    effect: Annotated[str, typer.Argument(help="Id of the effect, as in `rockref effects`, or file.py:Class.")],
    model: Annotated[
        str | None,
        typer.Option("--model", "-m", help="Model to which the effect is added, a model.toml. Default: the baseline."),
    ] = None,
    own: options.OwnEffects = None,
    output: Annotated[Path, typer.Option("--output", "-o", help="File for the new model, a .toml.")] = Path(
        "with_effect.toml"
    ),
    report: options.PageFolder = None,
    seed: options.RestartSeed = 0,
    workers: options.Threads = None,
    full: options.Full = False,
    fresh: options.Fresh = False,
    verbose: options.Verbose = False,
    as_json: options.AsJson = False,
) -> None:
    """Add an effect to a model, fit all its numbers together, and show the error before and after.

    The error is that of the fit runs and of the held-out runs, beside the noise floor; --full shows it by axis. A fit
    that rockref diagnose has kept is not computed again. The new model file keeps the history of the errors. Exit code
    0, or 2 if the input cannot be used.

    \b
    Example:
      rockref add data/experiments/mystery-05 rolling_resistance -o with_rolling.toml
      rockref add data/experiments/mystery-10 cable_restraint -o with_cable.toml
      rockref add data/experiments/mystery-10 gyro_scale --model with_cable.toml -o with_both.toml --report report
      rockref compare data/experiments/mystery-05 --model table_3_1 --model with_rolling.toml

    For a folder of tosses, --model, --effect, -o, --report, -v and --json apply; the page is that of `rockref compare`.
    """
    from rockref.commands._results import say_old_spelling
    from rockref.measure.tosses.load import is_toss_folder

    if not experiment.exists() and Path(effect).is_dir():
        experiment, effect = Path(effect), str(experiment)
        say_old_spelling("add EFFECT EXPERIMENT", "add EXPERIMENT EFFECT")
    if is_toss_folder(experiment):
        from rockref.commands._tosses import add_to_model_of_tosses

        only_for("releases", seed=seed != 0, workers=workers is not None, full=full, fresh=fresh)
        return add_to_model_of_tosses(effect, experiment, model, own, output, report, verbose, as_json)
    from rockref.commands._keeping import keeping, kept
    from rockref.commands._models import carried_by, check_step, given_model, known_files, say_idle
    from rockref.commands._progress import stages
    from rockref.commands._results import say_remarks, told, usable_files, with_files
    from rockref.discover import add_effect as engine
    from rockref.discover.fit_baseline import known_effects
    from rockref.report.output import usable_folder
    from rockref.report.terminal.addition_text import print_addition
    from rockref.report.terminal.next_command import after_addition

    known_files([effect])
    given = given_model(model, own)
    check_step(given, model)
    say_idle(given, model)
    folder = usable_folder(report)
    usable_files(output)

    def fitted() -> list[set[str]]:
        return [carried_by(given), {*carried_by(given), *known_effects((effect,))}]

    with keeping(fresh, fitted) as store, stages(f"adding {effect}", verbose=verbose) as say:
        found = engine.add_effect(effect, experiment, given, seed, workers, progress=say, store=store)
    say_remarks(found.experiment.notices)
    words, then = lambda c: print_addition(c, found, full), lambda: after_addition(found, experiment, output, model)
    with kept(store), told(as_json, with_files(found.to_dict), words, then) as written:
        found.model.save(output)
        written.append(output)
        if folder is not None:
            from rockref.report.views.addition_page import addition_page

            written.append(addition_page(found).write_into(folder))
