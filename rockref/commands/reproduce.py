"""`rockref reproduce`: published studies, made again.

A study is a name in `STUDIES` and a function that makes it in a folder; to add one, write the function and its line.
"""

import json
import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from rockref.commands._options import AsJson, Processes, folder_name
from rockref.commands._results import only_for


def reproduce(
    what: Annotated[
        str, typer.Argument(metavar="STUDY|FOLDER", help="Name of the study; or the folder in which `source` is made.")
    ],
    folder: Annotated[
        Path | None,
        typer.Argument(parser=folder_name, metavar="FOLDER", help="Folder in which the named study is made."),
    ] = None,
    data: Annotated[
        Path | None, typer.Option("--data", help="Measured input of the study. Default: the shipped one.")
    ] = None,
    workers: Processes = None,
    quick: Annotated[bool, typer.Option("--quick", help="Run every part with a tiny budget, to try it.")] = False,
    only: Annotated[
        list[str] | None,
        typer.Option(
            "--only", help="Study source: make only this part, as twins, on a page of its own. May be repeated."
        ),
    ] = None,
    signals: Annotated[
        int | None, typer.Option(min=20, help="Study earthquake: number of signals. Default: 2000.")
    ] = None,
    step: Annotated[float | None, typer.Option(help="Study earthquake: time step in seconds. Default: 1e-5.")] = None,
    as_json: AsJson = False,
) -> None:
    """Reproduce the figures and tables of a published study on one page, beside the published values.

    Studies: source (the eight-point model: response, sensitivity, identification, twins, the models that failed);
    cube (measured tosses of a cube, from --data or the folder that ROCKREF_CUBE_TOSSES names); earthquake (the
    calibrated block beside its symmetric twin under artificial signals).

    `source` and `earthquake` keep finished parts in the folder: after an interruption the same command goes on. With
    the compiled engine `source` takes three minutes of processor time, and `earthquake` a minute or two.

    \b
    Example:
      rockref reproduce reproduced
      rockref reproduce source reproduced
      rockref reproduce source somewhere --quick
      rockref reproduce reproduced --only twins
      rockref reproduce cube explained --data tosses
      rockref reproduce earthquake shaken --signals 500
    """
    from rockref.commands._progress import stages
    from rockref.model.errors import InputError, Interrupted

    name, into = (what, folder) if folder is not None else ("source", folder_name(what))
    if folder is None and what in STUDIES:
        raise InputError("E-KEY", "FOLDER", "is missing", f"rockref reproduce {what} FOLDER")
    if name not in STUDIES:
        raise InputError("E-KEY", "STUDY", f"is {name!r}", f"Use one of {', '.join(STUDIES)}.")
    if name != "earthquake":
        only_for("the study earthquake", signals=signals is not None, step=step is not None)
    started = time.monotonic()
    try:
        with stages(f"reproduce {name}", verbose=not as_json) as say:
            page = STUDIES[name](Request(into, data, workers, quick, say, tuple(only or ()), signals, step))
    except KeyboardInterrupt:
        if name not in KEEPING:
            raise
        raise Interrupted(f"interrupted. What is done is kept in {into}: the same command goes on.") from None
    seconds, computed = time.monotonic() - started, processor_seconds()
    if as_json:
        record = {"study": name, "page": str(page), "seconds": seconds, "processor_seconds": computed}
        typer.echo(json.dumps(record))
    else:
        typer.echo(f"wrote {page} after {seconds:.0f} s ({computed:.0f} s of processor time)")


def processor_seconds() -> float:
    """Return processor time of this process and of its workers that have ended [s]."""
    return sum(os.times()[:4])


@dataclass(frozen=True)
class Request:
    """What a study is asked for: folder, input, workers, whether once through is enough, whom to tell, options."""

    folder: Path
    data: Path | None
    workers: int | None
    quick: bool
    say: Callable[[str], None]
    only: tuple[str, ...] = ()
    signals: int | None = None
    step: float | None = None


def source(asked: Request) -> Path:
    """Reproduce the eight-point model's own studies; `data` is the experiment that is identified (default: the
    control)."""
    from rockref.model.errors import InputError
    from rockref.workflows.demo import find_experiments
    from rockref.workflows.reproduce_source import QUICK, Budget
    from rockref.workflows.reproduce_source import reproduce as make

    experiment = asked.data
    if experiment is None:
        try:
            experiment = find_experiments(None) / "mystery-08"
        except InputError:
            asked.say("no shipped experiments here: the identification is left out (name one with --data)")
    return make(asked.folder, experiment, QUICK if asked.quick else Budget(), asked.workers, asked.say, asked.only)


def cube(asked: Request) -> Path:
    """Compare measured tosses of a cube with models; `data` is their folder (default: what ROCKREF_CUBE_TOSSES
    names)."""
    from rockref.model.errors import InputError
    from rockref.workflows.reproduce_cube import reproduce_cube

    if asked.only:
        raise InputError(
            "E-KEY", "--only", f"is {', '.join(asked.only)}", "Leave it out: the study cube is made as a whole."
        )

    return reproduce_cube(asked.folder, asked.data, asked.quick, asked.say)


def earthquake(asked: Request) -> Path:
    """Simulate the calibrated block and its symmetric twin under artificial bidirectional signals at ten levels."""
    from rockref.workflows.reproduce_earthquake import reproduce_earthquake

    only_for("other studies", only=bool(asked.only), data=asked.data is not None)
    return reproduce_earthquake(asked.folder, asked.signals, asked.step, asked.quick, asked.workers, asked.say)


#: Each study by name: called with what is asked for, gives the path of its page.
STUDIES: dict[str, Callable[[Request], Path]] = {"source": source, "cube": cube, "earthquake": earthquake}
#: Studies that keep their parts, so that an interrupted one goes on.
KEEPING = ("source", "earthquake")
