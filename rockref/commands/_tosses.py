"""What `compare` and `diagnose` do with a folder of tosses."""

import json
from collections.abc import Sequence
from pathlib import Path

import typer


def compare_tosses(path: Path, model: Sequence[str] | None, report: Path | None, as_json: bool) -> None:
    """Print models beside tosses, and write the page where it is wanted."""
    from rockref.commands._models import labels, named_model
    from rockref.commands._stages import console
    from rockref.discover.tosses.compare import compare
    from rockref.measure.tosses import load_tosses
    from rockref.report.toss_text import print_toss_comparison

    tosses = load_tosses(path)
    for notice in tosses.notices:
        typer.echo(f"rockref: {notice}", err=True)
    models, names = ([named_model(m) for m in model], labels(list(model))) if model else (None, None)
    record = compare(tosses, models, names).to_dict()
    written = []
    if report is not None:
        from rockref.report.output import made_folder
        from rockref.report.toss_page import write_toss_comparison

        written.append(write_toss_comparison(record, made_folder(report)))
    if as_json:
        typer.echo(json.dumps(record | {"written": [str(p) for p in written]}, indent=1))
        return
    print_toss_comparison(console(), record)
    for p in written:
        typer.echo(f"wrote {p}")


def diagnose_tosses(
    path: Path, model: str | None, report: Path | None, output: Path | None, save_model: Path | None, verbose: bool,
    as_json: bool,
) -> None:  # fmt: skip
    """Print what is missing in the model of tosses."""
    from rockref.commands._models import named_model
    from rockref.commands._stages import console, stages
    from rockref.discover.tosses.diagnose import diagnose
    from rockref.measure.tosses import load_tosses
    from rockref.model.storage import write_text
    from rockref.report.toss_text import print_toss_diagnosis

    tosses = load_tosses(path)
    given = named_model(model) if model is not None else None
    with stages(f"diagnosing {path}", every_line=verbose) as say:
        found = diagnose(tosses, given, progress=say)
    record = found.to_dict()
    text = json.dumps(record, indent=1)
    written = []
    if report is not None:
        from rockref.report.output import made_folder
        from rockref.report.toss_page import write_toss_diagnosis

        written.append(write_toss_diagnosis(record, made_folder(report)))
    if output is not None:
        write_text(output, text + "\n")
        written.append(output)
    if save_model is not None:
        found.model.save(save_model)
        written.append(save_model)
    if as_json:
        typer.echo(text)
        return
    print_toss_diagnosis(console(), record)
    for p in written:
        typer.echo(f"wrote {p}")
