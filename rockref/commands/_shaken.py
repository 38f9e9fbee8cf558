"""What `compare` and `plan` do with outcomes on a shake table."""

from collections.abc import Sequence
from pathlib import Path

import typer

from rockref.commands._results import in_json, say_remarks, told, with_files


def compare_shaken(
    path: Path, model: Sequence[str] | None, effects: Sequence[str] | None, report: Path | None, runs: int | None,
    step: float | None, as_json: bool,
) -> None:  # fmt: skip
    """Print predictions beside tests on a shake table, and write the page where it is wanted."""
    from rockref.commands._models import labels, named_models
    from rockref.commands._progress import stages
    from rockref.report.output import usable_folder
    from rockref.report.terminal.shaken_text import print_shaken
    from rockref.shake.comparison import RUNS, compare_shaken
    from rockref.shake.experiment import load_shaken

    folder = usable_folder(report)
    loaded = load_shaken(path)
    models = named_models(model or (), effects)
    names = labels(list(model)) if model else []
    with stages("shaking", verbose=False) as say:
        found = compare_shaken(loaded, models, names, runs=runs or RUNS, step=step or 1e-5, say=say)
    say_remarks(loaded.notices)
    command = f"rockref compare {path} --model table_3_1 --report report"
    then = None if model or loaded.motions is None else lambda: command
    with told(as_json, with_files(found.to_dict), lambda c: print_shaken(c, found.to_dict()), then) as written:
        if folder is not None:
            from rockref.report.views.shaken_page import write_shaken

            written.append(write_shaken(found, folder))


def diagnose_shaken(
    path: Path, model: str | None, output: Path | None, runs: int | None, step: float | None, seed: int,
    workers: int | None, as_json: bool,
) -> None:  # fmt: skip
    """Print which effect the outcomes ask for, the candidates in a table and the answer last."""
    from rockref.commands._models import named_model
    from rockref.commands._progress import stages
    from rockref.commands._results import usable_files
    from rockref.discover.outcomes.diagnose import RUNS, diagnose_outcomes
    from rockref.model.storage import write_text
    from rockref.report.terminal.outcome_text import print_outcomes
    from rockref.shake.experiment import load_shaken

    usable_files(output)
    loaded, chosen = load_shaken(path), named_model(model or "table_3_1")
    with stages("shaking", verbose=False) as say:
        found = diagnose_outcomes(
            loaded, chosen, runs=runs or RUNS, step=step or 1e-5, seed=seed, workers=workers, say=say
        )
    say_remarks(loaded.notices)
    record = found.to_dict()
    with told(as_json, lambda written: in_json(record), lambda c: print_outcomes(c, record)) as written:
        if output is not None:
            write_text(output, in_json(record) + "\n")
            written.append(output)


def plan_outcomes(shares: str, tests: int | None, as_json: bool) -> None:
    """Print how many tests tell two probabilities of falling apart, and what so many tests would tell."""
    from rockref.commands._shaking import numbers
    from rockref.model.errors import InputError
    from rockref.shake.statistics.bands import dkw_half_width
    from rockref.shake.statistics.campaign import least_difference, rough_sample_size, sample_size

    given = numbers(shares, "--outcomes")
    if len(given) != 2:
        raise InputError("E-TYPE", "--outcomes", f"is {shares!r}", "Give two probabilities: --outcomes 0.5,0.6.")
    a, b = given
    n, rough = sample_size(a, b), rough_sample_size(a, b - a)
    count = tests or n
    seen, band = least_difference(a, count), dkw_half_width(count)
    record = {
        "probabilities": [a, b], "power": 0.8, "confidence": 0.95, "tests_a_side": n, "rule_of_thumb": rough,
        "tests": count, "least_difference": seen, "dkw_half_width": band,
    }  # fmt: skip
    if as_json:
        typer.echo(in_json(record))
        return
    typer.echo(f"{count} tests a side see a difference of {seen:.3f} beside {a:g}, and know a whole distribution")
    typer.echo(f"function of maxima to {band:.3f} on either side (DKW, 95 %).")
    typer.echo("Tests of one motion depend on one another: where they agree wholly, count motions in place of tests.")
    typer.echo(
        f"{n} independent tests a side tell {a:g} from {b:g} with 80 % power at 95 % ({rough} by 16 p(1 - p)/d2)."
    )
