"""`rockref import`: measured data of others as experiment folders."""

from pathlib import Path
from typing import Annotated

import typer

from rockref.commands._options import folder_name, folder_option


def imports(
    kind: Annotated[str, typer.Argument(help="Which data: contactnets or planardrops.")],
    source: Annotated[
        Path,
        typer.Argument(
            parser=folder_name,
            metavar="SOURCE",
            help="A clone of the repository of the data (contact-nets, ImpactModeling), or its folder of files.",
        ),
    ],
    output: Annotated[Path, folder_option("--output", "-o", help="Folder for the tosses; a new or empty one.")],
) -> None:
    """Make a folder of tosses from a clone of a public repository.

    contactnets: tosses of a cube. The .pt files are read without PyTorch, and nothing in them is run. Tosses that are
    turned copies of others are marked in the column `group`.

    planardrops: drops of a square in a plane, as an experiment of kind toss.

    \b
    Example:
      git clone https://github.com/DAIRLab/contact-nets
      rockref import contactnets contact-nets -o tosses
      rockref compare tosses
      git clone https://github.com/DAIRLab/ImpactModeling
      rockref import planardrops ImpactModeling -o drops
    """
    from rockref.measure.importing.contactnets import import_contactnets
    from rockref.measure.importing.planardrops import import_planardrops
    from rockref.model.errors import InputError

    if kind not in ("contactnets", "planardrops"):
        raise InputError("E-CHOICE", "KIND", f"is {kind!r}", "Use contactnets or planardrops.")
    if kind == "planardrops":
        drops, left = import_planardrops(source, output)
        typer.echo(f"wrote {output}: {drops} drops; {left} were left out, whose tracker jumps")
        return
    tosses, copies = import_contactnets(source, output)
    typer.echo(f"wrote {output}: {tosses} recordings, {copies} of them turned copies of others")
