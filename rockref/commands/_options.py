"""Arguments and options that several commands take, each with its help written once."""

from pathlib import Path
from typing import Annotated, Any

import typer


def folder_name(text: str | Path) -> Path:
    """Return the folder that an argument names; an empty word, which would be the current folder, is refused."""
    if not str(text).strip():
        raise typer.BadParameter("is empty; name a folder, or . for the current one.")
    return Path(text)


def folder_option(*names: str, help: str) -> Any:
    """Return the option for a folder that a command writes into."""
    return typer.Option(*names, parser=folder_name, metavar="FOLDER", help=help)


ExperimentFolder = Annotated[
    Path,
    typer.Argument(
        parser=folder_name, metavar="EXPERIMENT", help="Folder with experiment.toml and the tables of the runs."
    ),
]
PageFolder = Annotated[
    Path | None, folder_option("--report", help="Folder for the page (index.html); made if it is not there.")
]
StartModel = Annotated[str, typer.Option("--model", "-m", help="table_3_1, four_points or a model.toml.")]
AddedEffects = Annotated[
    list[str] | None, typer.Option("--effect", "-e", help="Add an effect: id:key=value,key=value. May be repeated.")
]
#: Where a command that reads a model file adds no effect.
OwnEffects = Annotated[
    list[str] | None,
    typer.Option("--effect", "-e", help="An effect of your own that the model has, path/to/file.py:Class."),
]
Engine = Annotated[str, typer.Option("--engine", help="auto, numpy (the law itself, slow) or numba (compiled).")]
RestartSeed = Annotated[int, typer.Option("--seed", min=0, help="Seed of the random restarts.")]
Threads = Annotated[int | None, typer.Option("--workers", min=1, help="Threads; default: one per core.")]
Processes = Annotated[int | None, typer.Option("--workers", min=1, help="Local processes; default: one per core.")]
DaskAddress = Annotated[
    str | None, typer.Option("--dask", help="Address of a Dask scheduler instead (extra `distributed`).")
]
SharedDaskAddress = Annotated[
    str | None, typer.Option("--dask", help="Address of a Dask scheduler whose workers see the folder.")
]
ShakenStep = Annotated[
    float | None, typer.Option("--step", help="For tests on a shake table: time step in seconds; default: 1e-5.")
]
JsonFile = Annotated[Path | None, typer.Option("--output", "-o", help="Write the JSON object to this file, too.")]
Full = Annotated[bool, typer.Option("--full", help="Print all tables and sentences, not only the answer.")]
Fresh = Annotated[bool, typer.Option("--fresh", help="Compute anew; use nothing that an earlier command has kept.")]
Verbose = Annotated[bool, typer.Option("--verbose", "-v", help="Print every stage and the optimiser's lines.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object instead of words.")]
