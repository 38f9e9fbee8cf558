"""PEER's `.AT2`: four lines of header, then acceleration in g, usually five values a line.

Source of the layout: the files of the PEER NGA-West2 database, https://ngawest2.berkeley.edu.
"""

from __future__ import annotations

import re

from rockref.measure.records.notice import shown
from rockref.model.errors import InputError
from rockref.shake.records.channel import (
    Channel,
    Direction,
    acceleration_factor,
    check_count,
    direction_of,
    numbers,
    positive_step,
)

_SIZES = (
    re.compile(r"NPTS\s*=\s*(?P<n>\d+)[\s,]*DT\s*=\s*(?P<dt>[\d.]+(?:E[+-]?\d+)?)", re.IGNORECASE),
    re.compile(r"(?P<n>\d+)[\s,]+(?P<dt>[\d.]+(?:E[+-]?\d+)?)[\s,]+NPTS\s*,\s*DT", re.IGNORECASE),
)
_UNIT = re.compile(r"UNITS?\s+(?:OF|ARE|IN)\s+\(?\s*([A-Z][A-Z0-9/*^]*)", re.IGNORECASE)


def is_at2(lines: list[str]) -> bool:
    """Return whether the fourth line is that of an AT2 file (or of a velocity or displacement file)."""
    return len(lines) > 4 and any(size.search(lines[3]) for size in _SIZES)


def read_at2(lines: list[str], path: str) -> list[Channel]:
    """Return the one component of an AT2 file.

    Raises InputError: E-RECORD-KIND (VT2, DT2), E-RECORD-UNIT, E-RECORD-STEP, E-RECORD-COUNT, E-RECORD-NUMBER.
    """
    third = f"{path}, line 3"
    if re.search(r"VELOC|DISPL", lines[2], re.IGNORECASE):
        what = f"{shown(lines[2].strip())}: not acceleration"
        raise InputError("E-RECORD-KIND", third, what, "Give the .AT2 file of that record.")
    unit = _UNIT.search(lines[2])
    factor = acceleration_factor(unit[1] if unit else "", third)
    sizes = next(match for size in _SIZES if (match := size.search(lines[3])))
    values = numbers(lines[4:], 5, path)
    check_count(len(values), int(sizes["n"]), f"{path}, line 4")
    dt = positive_step(float(sizes["dt"]), f"{path}, line 4")
    return [Channel(f"{path}, line 5", factor * values, dt, _direction(lines[1]))]


def _direction(line: str) -> Direction:
    """Return the first word of the last field of the second line, the direction; some files have none."""
    words = line.rsplit(",", 1)[-1].split() if "," in line else []
    return direction_of(words[0]) if words else None
