"""What a command leaves behind beside what it prints: the record, the model, and a line for every file."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from rich.console import Console

    from rockref.api import Model
    from rockref.measure.records.notice import Notice


def only_for(what: str, **given: bool) -> None:
    """Refuse options that were given and mean something for others only (E-ARGUMENT): they would change nothing."""
    from rockref.model.errors import InputError

    for name, is_given in given.items():
        if is_given:
            raise InputError("E-ARGUMENT", f"--{name}", f"means something for {what} only", "Leave it out.")


def usable_files(*paths: Path | None) -> None:
    """Refuse files that could not be written at the end of long work, before it, or would be written over each other.

    Raises InputError E-WRITE.
    """
    import os

    from rockref.model.errors import InputError

    for path in paths:
        if path is None:
            continue
        into = path.absolute().parent
        if path.is_dir():
            raise InputError("E-WRITE", str(path), "is a folder", "Name a file.")
        if not into.is_dir() or not os.access(into, os.W_OK | os.X_OK):
            raise InputError("E-WRITE", str(path), f"{into} is no folder that can be written to", "Name another place.")
    places = [path.resolve() for path in paths if path is not None]
    for k, place in enumerate(places):
        if place in places[:k]:
            raise InputError("E-WRITE", str(place), "is named for two results", "Name a file for each.")


def in_json(record: Any) -> str:
    """Return a record as strict JSON: numbers that are not finite are null, which JSON has no word for."""
    import json

    from rockref.discover.diagnosis_record import plain

    return json.dumps(plain(record), indent=1, allow_nan=False)


def keep(text: str, output: Path | None, model: "Model", save_model: Path | None) -> list[Path]:
    """Write the record and the model where they are wanted; where they are now."""
    from rockref.model.storage import write_text

    if output is not None:
        write_text(output, text + "\n")
    if save_model is not None:
        model.save(save_model)
    return [path for path in (output, save_model) if path is not None]


def write_or_print(text: str, output: Path | None) -> None:
    """Write a text to a file and say so, or print it where no file is named."""
    from rockref.model.storage import write_text

    if output is None:
        typer.echo(text, nl=False)
    else:
        write_text(output, text)
        typer.echo(f"wrote {output}")


def with_files(record: Callable[[], dict[str, Any]]) -> Callable[[list[Path]], str]:
    """Return what makes JSON of the record of a result, and of the files that were written."""
    return lambda written: in_json(record() | {"written": [str(path) for path in written]})


@contextmanager
def told(
    as_json: bool,
    json_of: Callable[[list[Path]], str],
    words: "Callable[[Console], None]",
    then: Callable[[], str] | None = None,
) -> Iterator[list[Path]]:
    """Give the list to which files are added as they are written; then tell what was found, which files, what next.

    It is told even where a file cannot be written: minutes of work are not lost.
    """
    from rockref.commands._terminal import console
    from rockref.report.terminal.text import say_command

    written: list[Path] = []
    try:
        yield written
    finally:
        if as_json:
            typer.echo(json_of(written))
        else:
            words(console())
            say_written(written)
            if then is not None:
                say_command(console(), then())


def say_written(paths: Iterable[Path]) -> None:
    """Print a line for every file that was written."""
    for path in paths:
        typer.echo(f"wrote {path}")


def say_old_spelling(old: str, new: str) -> None:
    """Print a remark on a spelling that still works, on standard error."""
    remark("W-SPELLING", f"rockref {old}", "is an old spelling, which still works", f"Write rockref {new}.")


def remark(code: str, where: str, what: str, cure: str) -> None:
    """Print a remark of the command's own, on standard error."""
    from rockref.measure.records.notice import Notice

    say_remarks([Notice(code, where, what, cure)])


def say_remarks(notices: "Iterable[Notice]") -> None:
    """Print what the reader of the experiment remarked on, on standard error: it went on, and the result may hang on
    it."""
    for notice in notices:
        typer.echo(f"rockref: {notice}", err=True)
