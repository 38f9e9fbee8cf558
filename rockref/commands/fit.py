"""`rockref fit`: the parameters of the baseline from measured runs."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from rockref.commands._keeping import Fresh
from rockref.commands._results import ExperimentFolder, folder_option, only_for


def fit(
    experiment: ExperimentFolder,
    output: Annotated[Path, typer.Option("--output", "-o", help="Where the model goes, a .toml.")] = Path("model.toml"),
    effect: Annotated[
        list[str] | None,
        typer.Option("--effect", "-e", help="An effect to fit too, id or file.py:Class; may be repeated."),
    ] = None,
    model: Annotated[
        str | None, typer.Option("--model", "-m", help="Start from this model.toml, effects and all.")
    ] = None,
    report: Annotated[
        Path | None, folder_option("--report", help="Folder for the page: the runs before and after the fit.")
    ] = None,
    gates: Annotated[bool, typer.Option("--gates/--no-gates", help="Check the fit; takes as long again.")] = True,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the random restarts.")] = 0,
    workers: Annotated[int | None, typer.Option(min=1, help="Threads; default: one per core.")] = None,
    full: Annotated[bool, typer.Option("--full", help="All tables, not only the answer.")] = False,
    fresh: Fresh = False,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="Every stage and the optimiser's lines.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object instead of tables.")] = False,
) -> None:
    """Fit the baseline to the fit runs of an experiment, check the fit, write the model with its uncertainty.

    No fit sees a held-out run. Exit code 0, also where an effect is missing, which the fit and its model say; 1 if a
    gate (a check of the fit) was not passed: the model is written all the same and says so; 2 if the input cannot be
    used.

    \b
    Example:
      rockref fit data/experiments/mystery-08 -o model.toml
      rockref fit data/experiments/mystery-01 --effect quadratic_drag -o with_drag.toml
      rockref fit data/experiments/mystery-08 --effect examples/my_effect.py:EddyBrake
      rockref fit data/experiments/mystery-08 --json > fit.json

    A folder of tosses is fitted too, with --effect, --model, -o, -v and --json.
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
