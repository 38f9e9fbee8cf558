"""`rockref fit`: the parameters of the baseline from measured runs."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from rockref.commands import _options as options
from rockref.commands._results import only_for


def fit(
    experiment: options.ExperimentFolder,
    output: Annotated[Path, typer.Option("--output", "-o", help="File for the model, a .toml.")] = Path("model.toml"),
    effect: Annotated[
        list[str] | None,
        typer.Option("--effect", "-e", help="Fit this effect, too: id or file.py:Class. May be repeated."),
    ] = None,
    model: Annotated[
        str | None, typer.Option("--model", "-m", help="Start from this model.toml, its effects included.")
    ] = None,
    report: Annotated[
        Path | None, options.folder_option("--report", help="Folder for the page: the runs before and after the fit.")
    ] = None,
    gates: Annotated[
        bool, typer.Option("--gates/--no-gates", help="Check the fit by its gates; this takes as long as the fit.")
    ] = True,
    seed: options.RestartSeed = 0,
    workers: options.Threads = None,
    full: options.Full = False,
    fresh: options.Fresh = False,
    verbose: options.Verbose = False,
    as_json: options.AsJson = False,
) -> None:
    """Fit the baseline to the fit runs of an experiment, check the fit, write the model with its uncertainty.

    No fit sees a held-out run. Exit code 0 if every gate (a check of the fit) is passed, also where an effect is
    missing; 1 if a gate is not passed: the model is written all the same, and says so; 2 if the input cannot be used.

    \b
    Example:
      rockref fit data/experiments/mystery-08 -o model.toml
      rockref fit data/experiments/mystery-01 --effect quadratic_drag -o with_drag.toml
      rockref fit data/experiments/mystery-08 --effect examples/my_effect.py:EddyBrake
      rockref fit data/experiments/mystery-08 --json > fit.json

    For a folder of tosses, --effect, --model, -o, -v and --json apply.
    """
    from rockref.measure.tosses.load import is_toss_folder

    if is_toss_folder(experiment):
        from rockref.commands._tosses import fit_to_tosses

        only_for(
            "releases",
            seed=seed != 0,
            workers=workers is not None,
            report=report is not None,
            full=full,
            fresh=fresh,
            **{"no-gates": not gates},
        )
        return fit_to_tosses(experiment, output, effect or (), model, verbose, as_json)
    from rockref.commands._keeping import keeping, kept
    from rockref.commands._models import carried_by, check_step, known_files, named_model, say_idle
    from rockref.commands._progress import stages
    from rockref.commands._results import say_remarks, told, usable_files, with_files
    from rockref.discover import fit_baseline as engine
    from rockref.report.output import usable_folder
    from rockref.report.terminal.fit_text import print_fit
    from rockref.report.terminal.next_command import after_fit

    usable_files(output)
    folder = usable_folder(report)
    known_files(effect)
    given = named_model(model) if model is not None else None
    check_step(given, model)
    say_idle(given, model)

    def fitted() -> list[set[str]]:
        return [{*carried_by(given), *engine.known_effects(tuple(effect or ()))}]

    with keeping(fresh, fitted) as store, stages("fitting", verbose=verbose) as say:
        found = engine.fit_baseline(
            experiment, tuple(effect or ()), given, seed, workers, check=gates, progress=say, store=store
        )
    say_remarks(found.experiment.notices)
    then = partial(after_fit, found, experiment, output, model, given)
    with kept(store), told(as_json, with_files(found.to_dict), lambda c: print_fit(c, found, full), then) as written:
        found.model.save(output)
        written.append(output)
        if folder is not None:
            from rockref.discover.compare.models import baseline_model
            from rockref.verbs import compare

            before = given if given is not None else baseline_model(found.experiment)
            written.append(compare(experiment, [before, found.model], names=["before", "after"]).save_page(folder))
    if not found.passed:
        raise typer.Exit(1)
