"""`rockref blind make`, `score` and `judge`: verdicts on hidden effects, tested without knowing them."""

import json
from pathlib import Path
from typing import Annotated

import typer

from rockref.commands._help import FullHelp
from rockref.commands._options import AsJson, SharedDaskAddress, folder_name

HELP = """Test rockref diagnose on experiments whose hidden effects are sealed until it has answered.

\b
Example:
  rockref blind make blind --seed 7 --cases 12
  rockref blind score blind
  rockref blind judge blind
"""


def make(
    folder: Annotated[
        Path,
        typer.Argument(
            parser=folder_name, metavar="FOLDER", help="Folder to make; after an interruption the same command goes on."
        ),
    ],
    seed: Annotated[int, typer.Option(min=0, help="Seed of the plan and of every case.")],
    cases: Annotated[int, typer.Option(min=1, help="Number of cases, a third of them with other blocks.")] = 120,
    near: Annotated[
        int | None, typer.Option(min=0, help="Instead of --cases: number of cases near the source's block.")
    ] = None,
    other: Annotated[
        int | None, typer.Option(min=0, help="Instead of --cases: number of cases with other blocks.")
    ] = None,
    effects: Annotated[
        str | None,
        typer.Option(help='The cases to make: "none,gyro_scale:2,plate_tilt+gyro_drift,wrapped", or "each:0.5".'),
    ] = None,
    workers: Annotated[int | None, typer.Option(min=1, help="Processes; default: one per core.")] = None,
    dask: SharedDaskAddress = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the manifest, as JSON.")] = False,
) -> None:
    """Make experiments with hidden effects, by a simulator that shares no code with the model, and seal the truth.

    A fifth of the cases are controls with nothing hidden. Half have one effect, at half, once or twice its typical
    size. The others have two effects, effects that are in no list, matched pairs that the runs cannot tell apart, or
    faulty records. A third of all cases have blocks of any mass, size, feet, stiffness and friction. MANIFEST.json
    holds the digest of the truth. A case takes some seconds with numba, an hour without.

    \b
    Example:
      rockref blind make blind --seed 7
      rockref blind make small --seed 1 --effects none,cable_restraint,stribeck_friction,gyro_scale,loose_mass_y
      rockref blind make half --seed 2 --near 60 --other 60 --effects each:0.5
    """
    from rockref.blind.cases import making, plan
    from rockref.commands._progress import progress
    from rockref.model.errors import InputError
    from rockref.report.output import usable_folder

    given = near is not None or other is not None
    numbers = (near or 0, other or 0) if given else plan.shared(cases)
    if sum(numbers) == 0:
        raise InputError("E-RANGE", "--near, --other", "ask for no case", "Give one of them a number above zero.")
    chosen = _chosen(seed, effects, numbers if given else None) if effects is not None else None
    usable_folder(folder)
    with progress("making cases") as ahead:
        manifest = making.make(folder, seed, *numbers, cases=chosen, workers=workers, dask=dask, progress=ahead)
    if as_json:
        typer.echo(json.dumps(manifest, indent=1))
    else:
        typer.echo(f"{len(manifest['cases'])} cases in {folder}; truth sealed, SHA-256 {manifest['truth_sha256']}")


def _chosen(seed: int, effects: str, numbers: tuple[int, int] | None) -> list:
    """Return cases of the words of --effects; with numbers, so many near the source and of other blocks."""
    from rockref.blind.cases import plan, unlisted
    from rockref.model.errors import InputError

    words = [word.strip() for word in effects.split(",") if word.strip()]
    try:
        chosen = plan.listed(seed, words, *(numbers or ()))
    except ValueError as error:
        known = ", ".join(["none", plan.EACH, *plan.EFFECTS, *unlisted.EFFECTS, *plan.FAULTS])
        cure = f"Write id or id:size, a size of 2 being twice the typical one. Known are {known}."
        raise InputError("E-EFFECT", "--effects", f"does not understand {error}", cure) from None
    if not chosen:
        raise InputError("E-EFFECT", "--effects", "names no case", "Name some, or leave it out for those of a plan.")
    return chosen


def score(
    folder: Annotated[
        Path, typer.Argument(parser=folder_name, metavar="FOLDER", help="Folder made by `rockref blind make`.")
    ],
    workers: Annotated[int | None, typer.Option(min=1, help="Cases at a time; default: one per core.")] = None,
    dask: SharedDaskAddress = None,
    check: Annotated[bool, typer.Option("--check", help="End with exit code 1 if a goal is not met.")] = False,
    as_json: AsJson = False,
) -> None:
    """Diagnose the cases that have no verdict yet, then open the truth and print the table of scores.

    Verdicts are kept in the folders of the cases (verdict.json): an interrupted run goes on, and verdicts of another
    tool can be scored. The digests of the verdicts are written to VERDICTS.json before the truth is opened. The scores
    are written to scores.json.

    \b
    Example:
      rockref blind score blind --workers 2
      rockref blind score blind --json > scores.json
    """
    from rockref.blind.scoring import evaluation
    from rockref.commands._progress import progress

    with progress("diagnosing cases") as ahead:
        found = evaluation.score(folder, workers=workers, dask=dask, progress=ahead)
    _print(found, as_json)
    for what, whole in found["sealed"].items():
        if not whole:
            typer.echo(f"rockref: not as it was sealed: {what}", err=True)
    _check(found, check)


def judge(
    folder: Annotated[
        Path, typer.Argument(parser=folder_name, metavar="FOLDER", help="Folder scored by `rockref blind score`.")
    ],
    check: Annotated[bool, typer.Option("--check", help="End with exit code 1 if a goal is not met.")] = False,
    as_json: AsJson = False,
) -> None:
    """Decide every case again from its stored evidence, by the present rules and calibration, and print the scores.

    Nothing is fitted and nothing is written: hundreds of cases take seconds. A case without evidence.json keeps its
    stored verdict. The stated probabilities are compared with the share of right verdicts.

    \b
    Example:
      rockref blind judge blind
    """
    from rockref.blind.scoring import evaluation

    found = evaluation.judge(folder)
    _print(found, as_json)
    _check(found, check)


def _print(found: dict, as_json: bool) -> None:
    """Print the scores, the cases that failed, and how right stated probabilities are."""
    from rockref.blind.scoring import intervals, table

    if as_json:
        typer.echo(json.dumps(found, indent=1))
        return
    typer.echo(table.as_text(found["by_block"]))
    for line in found["failures"]:
        typer.echo(f"- {line}")
    if found["by_word"]:
        typer.echo(f"\nHow often each word was right\n\n{intervals.words_as_text(found['by_word'])}")
    for block, rows in found["reliability"].items():
        if rows:
            typer.echo(f"\nProbabilities, {block}\n\n{intervals.as_text(rows)}")


def _check(found: dict, check: bool) -> None:
    if check and any(row["met"] is False for rows in found["by_block"].values() for row in rows):
        raise typer.Exit(1)


#: The three as one command.
blind = typer.Typer(cls=FullHelp, no_args_is_help=True, rich_markup_mode=None, help=HELP)
for function in (make, score, judge):
    blind.command()(function)
