"""What commands on a plate that moves share: records as they are named, and what is printed of runs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from rockref.model.base_motion import BaseMotion
    from rockref.shake.extremes import Extremes


def motion(record: str, scale: float = 1.0, rotate: float = 0.0) -> BaseMotion:
    """Return the motion in a file, or in the files of its components that + joins, times a factor and turned."""
    from rockref.commands._results import say_remarks
    from rockref.model.errors import InputError
    from rockref.shake.records.door import read_record

    for name, value in (("--scale", scale), ("--rotate", rotate)):
        if not abs(value) < 1e6:
            raise InputError("E-RANGE", name, f"is {value!r}", "Give a finite number.")
    read = read_record(record.split("+"))
    say_remarks(list(read.notices))
    return read.base.rotated(rotate).scaled(scale)


def simulate_shaken(
    model: str, record: str, scale: float, rotate: float, effects: list[str], rows: dict, others: dict, as_json: bool
) -> None:
    """Run one block on a shaken plate, print its extremes, and write its rows where they are wanted.

    rows : output, rate, duration and step, as `rockref simulate` takes them.  others : its options that a release has.

    Raises InputError (E-OPTION) for one of those that is given.
    """
    from dataclasses import asdict

    from rockref.commands._models import model_with, of_file
    from rockref.commands._results import in_json
    from rockref.engines import run
    from rockref.report.tables.response_table import check_name, write_response
    from rockref.shake.ensemble import AFTER, run_all

    refuse_options({key: value for key, value in others.items() if value not in (None, False, "auto")})
    if rows["output"] is not None:
        check_name(rows["output"])
    chosen, base = model_with(model, effects), motion(record, scale, rotate)
    duration = base.end + AFTER if rows["duration"] is None else rows["duration"]
    with of_file(model):
        problem = chosen.problem(duration, rows["step"], rows["rate"], base=base)
        found = run_all([problem])[0]
        written = None if rows["output"] is None else write_response(run(problem), rows["output"])
    if as_json:
        typer.echo(in_json({"model": model, "record": record, **asdict(found), "output": written}))
        return
    print_extremes(found, base)
    if written is not None:
        typer.echo(f"wrote {written['path']}: {written['rows']} rows, {written['columns']} columns")


def refuse_options(given: dict) -> None:
    """Refuse options of a release beside a plate that moves (E-OPTION)."""
    from rockref.model.errors import InputError

    for key in given:
        raise InputError("E-OPTION", f"--{key}", "has no meaning beside --base", "Leave it out, or --base.")


def print_extremes(found: Extremes, base: BaseMotion) -> None:
    """Print what became of one run, a line a quantity."""
    import math

    import numpy as np

    peak = float(np.max(np.hypot(base.a[:, 0], base.a[:, 1])))
    lift = "no foot lifted" if math.isnan(found.uplift) else f"{found.uplift:.4f}"
    ends = {"fell": "overturned", "rest": "at rest", "duration": "still moving", "lost": "without numbers"}
    lines = [
        ("peak of the plate (m/s2)", f"{peak:.3f}, horizontal; record of {base.end:.2f} s"),
        ("end (s)", f"{found.end:.3f}, {ends[found.ended]}"),
        ("largest tilt (deg)", f"{math.degrees(found.tilt):.4f} at {found.tilt_at:.3f} s"),
        ("largest slide (mm)", f"{found.slide * 1e3:.4f}"),
        ("largest twist (deg)", f"{math.degrees(found.twist):.4f}"),
        ("first uplift (s)", lift),
        ("impacts", str(found.impacts)),
        (
            "left (mm, mm, deg)",
            f"{found.left_x * 1e3:.4f}, {found.left_y * 1e3:.4f}, {math.degrees(found.left_twist):.4f}",
        ),
    ]
    for name, value in lines:
        typer.echo(f"{name:25} {value}")


def numbers(text: str, option: str) -> Sequence[float]:
    """Return the numbers in a list that commas separate. Raises InputError (E-TYPE)."""
    from rockref.model.errors import InputError

    try:
        return [float(word) for word in text.split(",")]
    except ValueError:
        raise InputError("E-TYPE", option, f"is {text!r}", "Give numbers, separated by commas.") from None
