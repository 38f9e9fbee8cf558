"""What `compare`, `diagnose`, `fit` and `add` do with a folder of tosses."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from rockref.commands._results import in_json, keep, say_remarks, told, usable_files, with_files

if TYPE_CHECKING:
    from rockref.measure.records.toss import Tosses


def read(path: Path) -> "Tosses":
    """Return the tosses of a folder; what the reader remarked on is said."""
    from rockref.measure.tosses.load import load_tosses

    tosses = load_tosses(path)
    say_remarks(tosses.notices)
    return tosses


def compare_tosses(
    path: Path, model: Sequence[str] | None, effects: Sequence[str] | None, report: Path | None, as_json: bool
) -> None:
    """Print models beside tosses, and write the page where it is wanted."""
    from rockref.commands._models import labels, named_models
    from rockref.discover.tosses.compare import compare
    from rockref.report.output import usable_folder
    from rockref.report.terminal.toss_text import print_toss_comparison

    folder = usable_folder(report)
    tosses = read(path)
    given = named_models(model or (), effects)
    models, names = (given, labels(list(model))) if model else (None, None)
    found = compare(tosses, models, names)
    with told(as_json, with_files(found.to_dict), lambda c: print_toss_comparison(c, found.to_dict())) as written:
        if folder is not None:
            from rockref.report.views.toss_page import write_toss_comparison

            written.append(write_toss_comparison(found.to_dict(), folder))


def diagnose_tosses(
    path: Path, model: str | None, effects: Sequence[str] | None, report: Path | None, output: Path | None,
    save_model: Path | None, verbose: bool, as_json: bool,
) -> None:  # fmt: skip
    """Print what is missing in the model of tosses; exit code 1 if a gate fails."""
    from rockref.commands._models import given_and_others
    from rockref.commands._progress import stages
    from rockref.discover.tosses.diagnose import diagnose
    from rockref.model.errors import InputError
    from rockref.report.output import usable_folder
    from rockref.report.terminal.toss_text import print_toss_diagnosis

    usable_files(output, save_model)
    folder = usable_folder(report)
    tosses = read(path)
    given, others = given_and_others(model, effects)
    if others:
        raise InputError("E-EFFECT", "--effect", "of tosses only the catalogue is tried", "Leave it out.")
    with stages(f"diagnosing {path}", verbose=verbose) as say:
        found = diagnose(tosses, given, progress=say)
    record = found.to_dict()
    text = in_json(record)
    with told(as_json, lambda written: text, lambda console: print_toss_diagnosis(console, record)) as written:
        written += keep(text, output, found.model, save_model)
        if folder is not None:
            from rockref.report.views.toss_page import write_toss_diagnosis

            written.append(write_toss_diagnosis(record, folder))
    if record["verdict"] == "not_trustworthy":
        raise typer.Exit(1)


def fit_to_tosses(
    path: Path, output: Path, effects: Sequence[str], model: str | None, verbose: bool, as_json: bool
) -> None:
    """Fit the law and effects to the fit tosses, print the numbers, write the model; exit code 1 if a gate fails."""
    from rockref.commands._models import given_and_others
    from rockref.commands._progress import stages
    from rockref.discover.tosses.fitting import fit_tosses
    from rockref.report.terminal.toss_text import print_toss_fit

    usable_files(output)
    tosses = read(path)
    given, more = given_and_others(model, effects)
    with stages(f"fitting {path}", verbose=verbose) as say:
        found = fit_tosses(tosses, tuple(more), given, progress=say)
    with told(as_json, with_files(found.to_dict), lambda c: print_toss_fit(c, found.to_dict())) as written:
        found.model.save(output)
        written.append(output)
    if not found.passed:
        raise typer.Exit(1)


def add_to_model_of_tosses(
    effect: str,
    path: Path,
    model: str | None,
    own: Sequence[str] | None,
    output: Path,
    report: Path | None,
    verbose: bool,
    as_json: bool,
) -> None:
    """Fit an effect into a model of tosses, print the errors before and after, write the model."""
    from rockref.commands._models import given_model, known_files
    from rockref.commands._progress import stages
    from rockref.discover.tosses.fitting import add_to_tosses
    from rockref.report.output import usable_folder
    from rockref.report.terminal.toss_text import print_toss_addition

    usable_files(output)
    folder = usable_folder(report)
    tosses = read(path)
    known_files([effect])
    given = given_model(model, own)
    with stages(f"adding {effect}", verbose=verbose) as say:
        found = add_to_tosses(effect, tosses, given, progress=say)
    with told(as_json, with_files(found.to_dict), lambda c: print_toss_addition(c, found.to_dict())) as written:
        found.after.model.save(output)
        written.append(output)
        if folder is not None:
            from rockref.discover.tosses.compare import compare
            from rockref.report.views.toss_page import write_toss_comparison

            models, names = [found.before.model, found.after.model], [f"without {effect}", f"with {effect}"]
            written.append(write_toss_comparison(compare(tosses, models, names).to_dict(), folder))
