"""`rockref import`: measured data of others as experiment folders."""

from pathlib import Path
from typing import Annotated

import typer

from rockref.commands._results import folder_name, folder_option


def register(app: typer.Typer) -> None:
    """Add ``import`` to `app`."""
    app.command("import")(import_)


def import_(
    kind: Annotated[str, typer.Argument(help="What is imported: contactnets.")],
    source: Annotated[
        Path,
        typer.Argument(
            parser=folder_name,
            metavar="SOURCE",
            help="A clone of github.com/DAIRLab/contact-nets, or its .pt files.",
        ),
    ],
    output: Annotated[Path, folder_option("--output", "-o", help="Folder for the tosses; a new or empty one.")],
) -> None:
    """Make a folder of tosses from a clone of a public repository.

    The .pt files are read without PyTorch, and nothing in them is run. Tosses that are turned copies of others are
    marked in the column `group`.

    \b
    Example:
      git clone https://github.com/DAIRLab/contact-nets
      rockref import contactnets contact-nets -o tosses
      rockref compare tosses
    """
    from rockref.measure.contactnets import import_contactnets
    from rockref.model.errors import InputError

    if kind != "contactnets":
        raise InputError("E-CHOICE", "KIND", f"is {kind!r}", "Use contactnets.")
    tosses, copies = import_contactnets(source, output)
    typer.echo(f"wrote {output}: {tosses} recordings, {copies} of them turned copies of others")
