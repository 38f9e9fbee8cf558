"""A table of one's own: comma-separated columns whose names say the unit, `t [s],ax [m/s2]` or `t_s,ax_g`."""

from __future__ import annotations

import re

import numpy as np

from rockref.measure.reading.dialect import is_number, split_line
from rockref.measure.records.notice import Notice, shown
from rockref.model.errors import InputError
from rockref.shake.records.channel import Channel, acceleration_factor, positive_step

_NAME = re.compile(r"(?P<name>t|time|ax|ay|az)(?:\s*[\[(](?P<bracket>.*)[\])]|_(?P<suffix>\w+))?", re.IGNORECASE)
_TIMES = {"s": 1.0, "ms": 1e-3}
# Units as a suffix, where a slash cannot stand.
_SUFFIXES = {"m_s2": "m/s2", "cm_s2": "cm/s2", "mm_s2": "mm/s2"}
#: decided: a stamp may be rounded by a hundredth of the interval; more is a clock that is not uniform.
UNEVEN = 0.01


def is_csv(lines: list[str]) -> bool:
    """Return whether the first line names a time or an acceleration among fields separated by commas."""
    return any(_NAME.fullmatch(field) for field in re.split(r"[,;\t]", lines[0].strip().replace('"', "")))


def read_csv(lines: list[str], path: str) -> list[Channel]:
    """Return the components of a table: columns t and ax, ay or az, with their units in the names.

    Missing rows are filled by straight lines, which is what the rule of the base motion says between samples.

    Raises InputError: E-DELIMITER, E-RECORD-UNIT, E-RECORD-NUMBER, E-RECORD-TIME, E-RECORD-STEP, E-COLUMN-MISSING,
    E-COLUMN-TWICE.
    """
    where = f"{path}, line 1"
    if "," not in lines[0]:
        cure = "Separate the columns by commas and write decimals with a point."
        raise InputError("E-DELIMITER", where, "the columns are not separated by commas", cure)
    places = _places(split_line(lines[0], ","), where)
    rows = [(k + 2, split_line(line, ",")) for k, line in enumerate(lines[1:]) if line.strip()]
    values = {name: factor * _column(rows, place, path, name) for name, (place, factor) in places.items()}
    t = values.pop("t")
    steps, dt = _steps(t, path)
    grid = t[0] + dt * np.arange(steps[-1] + 1)
    notices = _gaps(t, steps, rows, path)
    return [
        Channel(f"{path}, column a{axis}", np.interp(grid, t[0] + dt * steps, a), dt, axis, float(t[0]), notices)
        for axis, a in ((name[1], a) for name, a in values.items())
    ]


def _places(fields: list[str], where: str) -> dict[str, tuple[int, float]]:
    """Place and factor to SI of the columns that are known."""
    places: dict[str, tuple[int, float]] = {}
    for place, field in enumerate(fields):
        match = _NAME.fullmatch(field)
        if match is None:
            continue
        name = "t" if match["name"].lower() == "time" else match["name"].lower()
        unit = match["bracket"] or _SUFFIXES.get((match["suffix"] or "").lower(), match["suffix"] or "")
        if name in places:
            what = f"two columns hold {name}"
            raise InputError("E-COLUMN-TWICE", f"{where}, column {place + 1}", what, "Keep one of the two.")
        places[name] = place, _factor(name, unit, f"{where}, column {shown(field)}")
    if "t" not in places or len(places) < 2:
        missing = "t" if "t" not in places else "ax, ay or az"
        what = f"no column {missing}"
        raise InputError("E-COLUMN-MISSING", where, what, "Name the columns, for example t [s],ax [m/s2].")
    return places


def _factor(name: str, unit: str, where: str) -> float:
    if name != "t":
        return acceleration_factor(unit, where)
    if unit.strip().lower() not in _TIMES:
        what = f"the unit of time is {shown(unit)}" if unit else "time states no unit"
        raise InputError("E-RECORD-UNIT", where, what, "Name the column t [s] or t [ms].")
    return _TIMES[unit.strip().lower()]


def _column(rows: list[tuple[int, list[str]]], place: int, path: str, name: str) -> np.ndarray:
    for line, fields in rows:
        if place >= len(fields) or not is_number(fields[place]):
            found = shown(fields[place]) if place < len(fields) else "nothing"
            what = f"{found} is no number for {name}"
            cure = "Give every column a value in every row; columns of different rates go into files of their own."
            raise InputError("E-RECORD-NUMBER", f"{path}, line {line}", what, cure)
    return np.array([float(fields[place]) for _, fields in rows])


def _steps(t: np.ndarray, path: str) -> tuple[np.ndarray, float]:
    """Return each row's place on a uniform grid, whole numbers from 0, and the interval [s]."""
    if len(t) < 2 or not (np.diff(t) > 0.0).all():
        row = 2 if len(t) < 2 else int(np.flatnonzero(np.diff(t) <= 0.0)[0]) + 3
        raise InputError("E-RECORD-TIME", f"{path}, line {row}", "time does not rise", "Sort the rows, drop repeats.")
    guess = float(np.median(np.diff(t)))
    steps = np.concatenate([[0.0], np.cumsum(np.round(np.diff(t) / guess))]).astype(int)
    dt = positive_step(float((t[-1] - t[0]) / max(1, steps[-1])), path)
    off = np.abs(t - t[0] - dt * steps) / dt
    if off.max() > UNEVEN or (np.diff(steps) < 1).any():
        row = int(np.argmax(off)) + 2
        what = f"time is not uniform: off by {off.max():.2g} of the interval of {dt:.4g} s"
        cure = "Resample it by a method of your own, and say so: resampling changes the pulse."
        raise InputError("E-RECORD-TIME", f"{path}, line {row}", what, cure)
    return steps, dt


def _gaps(t: np.ndarray, steps: np.ndarray, rows: list[tuple[int, list[str]]], path: str) -> tuple[Notice, ...]:
    missing = np.diff(steps) - 1
    if not missing.any():
        return ()
    k = int(np.argmax(missing))
    what = f"{int(missing.sum())} rows are missing, most after {t[k]:.4g} s"
    return (Notice("W-RECORD-GAP", f"{path}, line {rows[k][0]}", what, "Straight lines were drawn over them."),)
