"""`rockref add`: one more effect in a model, and the error before and after."""

from pathlib import Path
from typing import Annotated

import typer

from rockref.commands._keeping import Fresh
from rockref.commands._models import OwnEffects
from rockref.commands._results import ExperimentFolder, folder_option, only_for


def add(
    experiment: ExperimentFolder,
    effect: Annotated[str, typer.Argument(help="Id of the effect, as in `rockref effects`, or file.py:Class.")],
    model: Annotated[
        str | None,
        typer.Option("--model", "-m", help="Model that gets the effect, a model.toml. Default: the baseline."),
    ] = None,
    own: OwnEffects = None,
    output: Annotated[Path, typer.Option("--output", "-o", help="Where the new model goes.")] = Path(
        "with_effect.toml"
    ),
    report: Annotated[Path | None, folder_option("--report", help="Folder for page and figure.")] = None,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the random restarts.")] = 0,
    workers: Annotated[int | None, typer.Option(min=1, help="Threads; default: one per core.")] = None,
    full: Annotated[bool, typer.Option("--full", help="All tables, not only the answer.")] = False,
    fresh: Fresh = False,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="Every stage and the optimiser's lines.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object instead of tables.")] = False,
) -> None:
    """Fit an effect into a model together with all that it has, and show the error before and after.

    On fit and on held-out runs, beside the noise floor; by axis with --full. What rockref diagnose has found is not
    computed again. The new model keeps the history, so that a second effect shows the error fall again. Exit code 0, or
    2 if the input cannot be used.

    \b
    Example:
      rockref add data/experiments/mystery-05 rolling_resistance -o with_rolling.toml
      rockref add data/experiments/mystery-10 cable_restraint -o with_cable.toml
      rockref add data/experiments/mystery-10 gyro_scale --model with_cable.toml -o with_both.toml --report report
      rockref compare data/experiments/mystery-05 --model table_3_1 --model with_rolling.toml

    An effect is added to a model of tosses too, with --model, -o, -v and --json; the page is that of `rockref compare`.
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
    from rockref.commands._models import carried_by, check_step, known_files, named_models, say_idle
    from rockref.commands._progress import stages
    from rockref.commands._results import say_remarks, told, usable_files, with_files
    from rockref.discover import add_effect as engine
    from rockref.discover.fit_baseline import known_effects
    from rockref.report.output import usable_folder
    from rockref.report.terminal.addition_text import print_addition
    from rockref.report.terminal.next_command import after_addition

    known_files([effect])
    given = next(iter(named_models([model] if model else [], own)), None)
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
