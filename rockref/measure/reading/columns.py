"""The names of columns: which quantity, in which unit."""

from __future__ import annotations

import difflib
import math
from collections.abc import Sequence
from dataclasses import dataclass

from rockref.measure.records.notice import Notice, shown
from rockref.model.errors import InputError

DEGREE = math.pi / 180.0

# What a unit suffix is worth in SI. A quaternion has no unit.
UNITS: dict[str, dict[str, float]] = {
    "time": {"s": 1.0, "ms": 1e-3, "us": 1e-6},
    "rate": {"deg_s": DEGREE, "rad_s": 1.0, "mrad_s": 1e-3},
    "length": {"m": 1.0, "mm": 1e-3},
    "quaternion": {"": 1.0},
}
# The columns that a run may have, and what each one is.
QUANTITIES: dict[str, str] = (
    {"t": "time"}
    | dict.fromkeys(("wx", "wy", "wz"), "rate")
    | dict.fromkeys(("x", "y", "z"), "length")
    | dict.fromkeys(("qw", "qx", "qy", "qz"), "quaternion")
)
RATES = ("wx", "wy", "wz")
POSE = ("x", "y", "z", "qw", "qx", "qy", "qz")
# decided: time, three rates, seven of pose, and room for a logger's own channels.
MAX_COLUMNS = 64


@dataclass(frozen=True)
class Column:
    """One column of a table: its place, the quantity it holds and the factor that makes it SI."""

    place: int
    name: str
    quantity: str
    unit: str
    factor: float


def full_names(quantity: str) -> list[str]:
    """Return every name that a column of this quantity may have."""
    return [f"{quantity}_{unit}" if unit else quantity for unit in UNITS[QUANTITIES[quantity]]]


def parse_header(header: str, where: str, needed: Sequence[str]) -> tuple[list[Column], int, list[Notice]]:
    """Return the known columns of a header line, how many columns there are in all, and notices about unknown ones.

    Raises InputError: E-HEADER, E-DELIMITER, E-UNIT, E-COLUMN-TWICE, E-COLUMN-MISSING.
    """
    names = [name.strip() for name in header.split(",")]
    _check_is_header(header, names, where)
    columns: list[Column] = []
    strangers: list[str] = []
    for place, name in enumerate(names):
        column = _known(place, name, where)
        if column is None:
            strangers.append(name)
        else:
            columns.append(column)
    _check_once(columns, where)
    _check_needed(columns, strangers, needed, where)
    cure = "It was left unread."
    notices = [Notice("W-COLUMN-UNREAD", where, f"column {shown(name)} is not known", cure) for name in strangers]
    return columns, len(names), notices


def _check_is_header(header: str, names: list[str], where: str) -> None:
    example = "The first line names the columns, for example t_s,wx_deg_s,wy_deg_s,wz_deg_s."
    for other, called in ((";", "semicolons"), ("\t", "tabs")):
        if len(names) == 1 and header.count(other) >= 1:
            cure = "Separate the columns by commas and write decimals with a point."
            raise InputError("E-DELIMITER", where, f"the columns are separated by {called}", cure)
    if header.lstrip().startswith("#"):
        raise InputError("E-HEADER", where, "the first line is a comment", example)
    if len(names) > MAX_COLUMNS:
        raise InputError("E-HEADER", where, f"{len(names)} columns, more than {MAX_COLUMNS}", example)
    if any(_is_number(name) for name in names):
        raise InputError("E-HEADER", where, f"the first line holds numbers ({shown(header)})", example)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _known(place: int, name: str, where: str) -> Column | None:
    quantity, _, unit = name.partition("_")
    if quantity not in QUANTITIES:
        return None
    units = UNITS[QUANTITIES[quantity]]
    if unit not in units:
        what = f"column {shown(name)} has the unit {shown(unit)}" if unit else f"column {shown(name)} names no unit"
        raise InputError("E-UNIT", where, what, f"Name it {' or '.join(full_names(quantity))}.")
    return Column(place, name, quantity, unit, units[unit])


def _check_once(columns: list[Column], where: str) -> None:
    seen: dict[str, Column] = {}
    for column in columns:
        if column.quantity in seen:
            first = seen[column.quantity]
            what = (
                f"columns {first.place + 1} ({first.name}) and {column.place + 1} ({column.name}) are the same quantity"
            )
            raise InputError("E-COLUMN-TWICE", where, what, "Keep one of the two.")
        seen[column.quantity] = column


def _check_needed(columns: list[Column], strangers: list[str], needed: Sequence[str], where: str) -> None:
    present = {column.quantity for column in columns}
    for quantity in needed:
        if quantity in present:
            continue
        names = full_names(quantity)
        near = difflib.get_close_matches(names[0], strangers, n=1, cutoff=0.5)
        hint = f" Is it the column {shown(near[0])}?" if near else ""
        what = f"no column {' or '.join(names)}"
        raise InputError("E-COLUMN-MISSING", where, what, f"Add it, or rename the one that holds it.{hint}")
