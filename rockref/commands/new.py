"""`rockref new`: an experiment folder from the files of a logger."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from rockref.commands import _quantities as typed
from rockref.commands._options import AsJson, folder_name

if TYPE_CHECKING:
    from rockref.measure.importing import Campaign, Choices

PICTURE = "first_swing.png"


def new(
    folder: Annotated[
        Path, typer.Argument(parser=folder_name, metavar="FOLDER", help="The experiment folder to make.")
    ],
    logs: Annotated[
        list[Path], typer.Argument(metavar="LOGS", help="Files of the logger, one per run, or a folder of them.")
    ],
    mass: Annotated[
        float | None, typer.Option(parser=typed.mass, metavar="MASS", help="Mass of the block, as 54kg or 800g.")
    ] = None,
    width: Annotated[
        float | None, typer.Option(parser=typed.length, metavar="LENGTH", help="Side of the square base, as 100mm.")
    ] = None,
    height: Annotated[
        float | None, typer.Option(parser=typed.length, metavar="LENGTH", help="Height of the block, as 0.688m.")
    ] = None,
    tilt: Annotated[
        list[str] | None,
        typer.Option(
            help="Release tilt of all runs, as 6.7deg, or of run 05, as 05=6.2deg. Default: the integral of the rates."
        ),
    ] = None,
    turned: Annotated[
        str | None,
        typer.Option(help="Runs with the block turned by 180 degrees, as 05,06; or none. Default: measured."),
    ] = None,
    holdout: Annotated[
        str | None, typer.Option(help="Runs that no fit may read, as 03,05, or none. Default: one in four.")
    ] = None,
    axes: Annotated[
        str | None, typer.Option(help="The chip's axes along X, Y, Z of the block, as y,-x,z. Default: measured.")
    ] = None,
    columns: Annotated[
        str | None, typer.Option(help="Columns of time and rates, by name or place, as t,gx,gy,gz or 1,5,6,7.")
    ] = None,
    unit: Annotated[
        str | None,
        typer.Option(help="Unit of the rates: rad_s, deg_s, mrad_s, mdeg_s. Default: as written, or measured."),
    ] = None,
    rate: Annotated[
        float | None,
        typer.Option(parser=typed.frequency, metavar="HZ", help="Samples per second, where the files hold no time."),
    ] = None,
    bandwidth: Annotated[
        float | None,
        typer.Option(
            parser=typed.frequency,
            metavar="HZ",
            help="Bandwidth of the gyroscope, from its data sheet, as 100Hz. Default: three tenths of the sample rate.",
        ),
    ] = None,
    four_points: Annotated[
        bool, typer.Option("--four-points", help="The baseline stands on its four corners, not on eight points.")
    ] = False,
    yes: Annotated[bool, typer.Option("--yes", "-y", help="Ask nothing; take what is proposed.")] = False,
    as_json: AsJson = False,
) -> None:
    """Make an experiment folder from the files of a logger.

    Finds delimiter, decimal mark, header, units, sample rate, the release, the zero of the gyroscope and its noise,
    which axis is which, the tilts and the turned runs. Holds out one run in four. Reads exports of phyphox, Sensor
    Logger, Xsens, Arduino with an MPU, and tables with a header. Only mass and sides must be stated; on a terminal the
    command asks for them. All that it found is written to experiment.toml, and can be changed there.

    \b
    Example:
      rockref new my_block logs/*.csv --mass 54kg --width 100mm --height 688mm
      rockref new my_block logs --mass 54kg --width 100mm --height 688mm --tilt 6.7deg --tilt 05=6.2deg --turned 06
    """
    from rockref.commands._results import in_json, say_remarks, say_written
    from rockref.commands._terminal import console
    from rockref.measure.importing import check_vacant, write_campaign
    from rockref.model.storage import write_bytes
    from rockref.report.charts.first_swing import first_swing_png
    from rockref.report.terminal.next_command import after_import
    from rockref.report.terminal.text import say_command

    check_vacant(folder)
    asking = not yes and not as_json and sys.stdin.isatty()
    paths = _files(logs)
    sides = _sides(mass, width, height, asking)
    stated = dict(axes=axes, columns=columns, unit=unit, rate=rate, bandwidth=bandwidth)
    choices = _choices(sides, tilt or [], turned, holdout, four_points, stated)
    campaign = _found(paths, choices)
    if not as_json:
        _tell(campaign)
    if asking:
        campaign = _asked(campaign, paths)
    experiment, campaign, left_out = write_campaign(
        campaign, folder, lambda _, place: write_bytes(place / PICTURE, first_swing_png(campaign))
    )
    say_remarks((*campaign.notices, *left_out, *experiment.notices))
    if as_json:
        typer.echo(in_json(_facts(campaign, folder)))
        return
    say_written([folder / "experiment.toml", folder / PICTURE])
    say_command(console(), after_import(folder))


def _files(logs: list[Path]) -> list[Path]:
    """Return the files that are named, and those in the folders that are, in the order of their numbers."""
    import re

    from rockref.measure.importing.layout import IN_ARCHIVES
    from rockref.model.errors import InputError

    found: list[Path] = []
    for path in logs:
        if not path.exists():
            raise InputError("E-FILE", str(path), "is not there", "Name the files of the logger.")
        inside = sorted(path.iterdir()) if path.is_dir() else []
        if not inside or any(p.name.lower() in IN_ARCHIVES for p in inside):
            found.append(path)
            continue
        endings = (".csv", ".txt", ".tsv", ".log", ".dat", ".zip", ".gz")
        found += [p for p in inside if p.suffix.lower() in endings or (p.is_dir() and not p.name.startswith("."))]
    return sorted(found, key=lambda p: [int(w) if w.isdigit() else w for w in re.split(r"(\d+)", str(p))])


def _sides(mass: float | None, width: float | None, height: float | None, asking: bool) -> tuple[float, float, float]:
    """Return mass kg, width and height m; what is not stated is asked for, or refused all at once."""
    from rockref.model.errors import InputError

    given = {"mass": mass, "width": width, "height": height}
    missing = [name for name, value in given.items() if value is None]
    if missing and not asking:
        example = {"mass": "--mass 54kg", "width": "--width 100mm", "height": "--height 688mm"}
        what = f"{' and '.join(missing)} of the block {'is' if len(missing) == 1 else 'are'} not stated"
        raise InputError("E-KEY-MISSING", "rockref new", what, f"Add {' '.join(example[name] for name in missing)}.")
    parsers: dict[str, Any] = {"mass": typed.mass, "width": typed.length, "height": typed.length}
    words = {"mass": "Mass, as 54kg", "width": "Side of the base, as 100mm", "height": "Height, as 688mm"}
    for name in missing:
        given[name] = typer.prompt(words[name], value_proc=parsers[name])
    return given["mass"], given["width"], given["height"]  # type: ignore[return-value]


def _choices(
    sides: tuple[float, float, float],
    tilts: list[str],
    turned: str | None,
    holdout: str | None,
    four_points: bool,
    stated: dict[str, Any],
) -> "Choices":
    from rockref.measure.importing import Choices
    from rockref.measure.importing.units import RATE_NAMES

    if stated["unit"] is not None and stated["unit"] not in RATE_NAMES.units:
        raise typer.BadParameter(f"{stated['unit']!r} is not known; write {', '.join(RATE_NAMES.units)}.")
    by_run = dict(text.split("=", 1) for text in tilts if "=" in text)
    of_all = [text for text in tilts if "=" not in text]
    axes = tuple(stated["axes"].split(",")) if stated["axes"] else None
    return Choices(
        *sides,
        tilt=typed.angle(of_all[-1]) if of_all else None,
        tilts={run.strip(): typed.angle(text) for run, text in by_run.items()},
        turned=_runs(turned),
        holdout=_runs(holdout),
        axes=axes,  # type: ignore[arg-type]
        columns=tuple(stated["columns"].split(",")) if stated["columns"] else (),
        unit=stated["unit"],
        rate=stated["rate"],
        bandwidth=stated["bandwidth"],
        baseline="four_points" if four_points else "eight_points",
    )


def _runs(text: str | None) -> tuple[str, ...] | None:
    """Return runs as they are typed: None where nothing is, () for the word none."""
    if text is None:
        return None
    return tuple(word.strip() for word in text.split(",") if word.strip() and word.strip() != "none")


def _found(paths: list[Path], choices: "Choices") -> "Campaign":
    from rockref.commands._progress import progress
    from rockref.measure.importing import import_logs

    with progress("reading the logs") as ahead:
        return import_logs(paths, choices, ahead)


def _tell(campaign: "Campaign") -> None:
    """Print what was found, the runs, and the first swing of the first run."""
    import math

    from rockref.commands._terminal import console
    from rockref.measure.importing.units import SPOKEN
    from rockref.report.charts.first_swing import swing_in_text
    from rockref.report.tables.table import table_of
    from rockref.report.terminal.text import print_table, say

    out, first = console(), campaign.runs[0]
    unit = SPOKEN.get(campaign.unit, campaign.unit)
    say(out, f"{len(campaign.runs)} runs: {first.logger}; {first.layout}; {unit}; {campaign.rate:.6g} samples a second")
    say(out, f"axes: {campaign.axes_words} ({campaign.axes.reason})")
    noise, step = math.degrees(campaign.noise), math.degrees(campaign.resolution)
    steps = f"steps of {step:.3g} deg/s" if step else "no steps"
    say(out, f"gyroscope: noise {noise:.3g} deg/s, {steps}, bandwidth {campaign.bandwidth:.4g} Hz")
    columns = {
        "run": lambda run: run.id,
        "log": lambda run: Path(run.source).name,
        "at rest": lambda run: f"{run.standing:.1f} s",
        "tilt": lambda run: f"{math.degrees(run.tilt):.2f}°",
        "side": lambda run: "turned" if run.turned else "as is",
        "use": lambda run: run.use,
    }
    print_table(out, table_of(campaign.runs, "", columns, prose=True))
    say(out, f"First swing of run {first.id}, rate about X:")
    room = max(16, min(64, out.width - 2 - len(" +000 deg/s")))
    for line in swing_in_text(first, room):
        out.print("  " + line, markup=False, highlight=False, no_wrap=True, overflow="ignore", crop=False)


def _asked(campaign: "Campaign", paths: list[Path]) -> "Campaign":
    """Return the campaign after the experimenter looked at it: tilts, sides, hold-out, and which way is up."""
    from dataclasses import replace

    from rockref.measure.importing.axes import other_way_up

    choices = campaign.choices
    if typer.confirm("First swing and table right?", default=True):
        if campaign.axes.up_known or typer.confirm(_up(campaign), default=True):
            # Answered: nothing is left to remark on.
            return replace(campaign, notices=tuple(n for n in campaign.notices if n.code != "W-UP"))
        return _found(paths, replace(choices, axes=other_way_up(campaign.axes)))
    tilts = {
        run.id: typer.prompt(f"Tilt of run {run.id}", f"{run.tilt:.4f}rad", value_proc=typed.angle)
        for run in campaign.runs
    }
    turned = _runs(typer.prompt("Runs turned by 180 degrees", _listed(campaign, "turned")))
    holdout = _runs(typer.prompt("Runs that no fit may read", _listed(campaign, "holdout")))
    up = campaign.axes.up_known or typer.confirm(_up(campaign), default=True)
    changed = replace(choices, tilt=None, tilts=tilts, turned=turned, holdout=holdout)
    campaign = _found(paths, changed if up else replace(changed, axes=other_way_up(campaign.axes)))
    _tell(campaign)
    return campaign


def _listed(campaign: "Campaign", what: str) -> str:
    chosen = [r.id for r in campaign.runs if (r.turned if what == "turned" else r.use == "holdout")]
    return ",".join(chosen) or "none"


def _up(campaign: "Campaign") -> str:
    axis, turn = campaign.axes.places[2], campaign.axes.signs[2]
    return f"Does the chip's {'-' if turn < 0 else ''}{'xyz'[axis]} point up?"


def _facts(campaign: "Campaign", folder: Path) -> dict[str, Any]:
    return {
        "folder": str(folder),
        "unit": campaign.unit,
        "axes": campaign.axes_words,
        "sample_rate_hz": campaign.rate,
        "bandwidth_hz": campaign.bandwidth,
        "noise_rad_s": campaign.noise,
        "resolution_rad_s": campaign.resolution,
        "runs": [
            {
                "id": run.id,
                "log": run.source,
                "use": run.use,
                "release_tilt_rad": run.tilt,
                "measured_tilt_rad": run.measured,
                "turned": run.turned,
                "release_s": run.release,
                "first_impact_s": run.impact,
            }
            for run in campaign.runs
        ],
        "written": [str(folder / "experiment.toml"), str(folder / PICTURE)],
    }
