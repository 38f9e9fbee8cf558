"""One component of a recorded motion, and what its numbers and units may look like in a file."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from rockref.measure.records.notice import Notice, shown
from rockref.model.errors import InputError

#: Standard gravity [m/s2], by which records in g are scaled (3rd CGPM, 1901).
STANDARD_GRAVITY = 9.80665
# What one unit is worth in m/s2; written as `unit_key` makes them.
ACCELERATION = {
    "g": STANDARD_GRAVITY,
    "mg": 1e-3 * STANDARD_GRAVITY,
    "m/s2": 1.0,
    "mm/s2": 1e-3,
    "cm/s2": 1e-2,
    "gal": 1e-2,
}
#: A number of Fortran or C, also where the next one touches it at its sign.
NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?")
#: Other words for one letter of the compass; a pair such as WE names an axis, positive towards north or east.
_WORDS = {"NORTH": "N", "NS": "N", "SN": "N", "SOUTH": "S", "EAST": "E", "EW": "E", "WE": "E", "WEST": "W"}
Direction = float | str | None


@dataclass(frozen=True)
class Channel:
    """One component of acceleration.

    where : the file, and the line where its values begin
    a : (n,) acceleration [m/s2];  dt : interval [s]
    direction : azimuth in degrees clockwise from north, or "up", "down", "x", "y", "z"; None where the file is silent
    start : time of the first sample on a clock that the channels share [s]; None where the file is silent
    notices : what was noticed while reading
    """

    where: str
    a: np.ndarray
    dt: float
    direction: Direction = None
    start: float | None = None
    notices: tuple[Notice, ...] = ()


def unit_key(text: str) -> str:
    """Return a unit as the table of accelerations writes it: `CM/SEC/SEC`, `cm/sec^2` and `cm/s2` are one."""
    key = text.strip().lower().replace("**", "").replace("^", "").replace("²", "2")
    key = re.sub(r"\bsec\b|\bsec(?=2)|\bseconds?\b", "s", key).replace(" ", "")
    return key.replace("/s/s", "/s2")


def acceleration_factor(text: str, where: str) -> float:
    """Return what one unit is worth in m/s2.

    Raises InputError E-RECORD-UNIT where none is stated, or one of another quantity.
    """
    key = unit_key(text)
    if key in ACCELERATION:
        return ACCELERATION[key]
    what = f"the unit is {shown(text.strip())}, which is no acceleration" if key else "the file states no unit"
    known = ", ".join(ACCELERATION)
    raise InputError("E-RECORD-UNIT", where, what, f"Give a record of acceleration whose file says one of {known}.")


def numbers(lines: list[str], first: int, path: str) -> np.ndarray:
    """Return all numbers of free lines; values may touch at a sign. `first` is the number of the first line.

    Raises InputError E-RECORD-NUMBER at what is no number.
    """
    values: list[str] = []
    for k, line in enumerate(lines):
        rest = NUMBER.sub(" ", line).replace(",", " ").strip()
        if rest:
            raise InputError(
                "E-RECORD-NUMBER", f"{path}, line {first + k}", f"{shown(rest)} is no number", "Repair that line."
            )
        values += NUMBER.findall(line)
    return as_floats(values)


def columns(lines: list[str], first: int, path: str, width: int, count: int) -> np.ndarray:
    """Return `count` numbers in columns of `width` characters, which may touch on both sides.

    Raises InputError E-RECORD-NUMBER at what is no number, E-RECORD-COUNT where the lines end early.
    """
    values: list[str] = []
    for k, line in enumerate(lines):
        if len(values) >= count:
            break
        row = line.rstrip()
        cells = [row[i : i + width].strip() for i in range(0, len(row), width)][: count - len(values)]
        wrong = next((cell for cell in cells if not NUMBER.fullmatch(cell)), None)
        if wrong is not None:
            what = f"{shown(wrong)} is no number in columns of {width}"
            raise InputError("E-RECORD-NUMBER", f"{path}, line {first + k}", what, "Repair that line.")
        values += cells
    check_count(len(values), count, f"{path}, line {first}")
    return as_floats(values)


def as_floats(values: list[str]) -> np.ndarray:
    """Return numbers as text as floats; Fortran's D is an exponent."""
    return np.array([value.replace("D", "E").replace("d", "e") for value in values], dtype=float)


def check_count(found: int, stated: int, where: str) -> None:
    """Refuse a file that holds another number of values than it says. Raises InputError E-RECORD-COUNT."""
    if found != stated:
        what = f"the header says {stated} values, the file holds {found}"
        raise InputError("E-RECORD-COUNT", where, what, "The file is cut or damaged: get it again.")


def positive_step(dt: float, where: str) -> float:
    """Return an interval that is positive. Raises InputError E-RECORD-STEP."""
    if not 0.0 < dt < 1.0:
        what = f"the interval between samples is {dt:g} s"
        raise InputError("E-RECORD-STEP", where, what, "An accelerogram has an interval between 0 and 1 s.")
    return dt


def direction_of(text: str) -> Direction:
    """Return the direction that a word names: degrees, letters of the compass, up or down; else None."""
    word = text.strip().upper()
    if re.fullmatch(r"\d{1,3}", word) and int(word) <= 360:
        return float(int(word) % 360)
    compass = {"N": 0.0, "E": 90.0, "S": 180.0, "W": 270.0}
    word = word.replace("-", "") if word[:1].isalpha() else word
    word = _WORDS.get(word, word)
    if word in compass:
        return compass[word]
    if word in {"U", "UP", "UD", "U-D", "Z", "V", "VER", "VERT", "VERTICAL"}:
        return "up"
    return "down" if word in {"D", "DN", "DWN", "DOWN"} else None
