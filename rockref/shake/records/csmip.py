"""CSMIP's volume 2: per channel a header of text, integers and reals, then acceleration in columns that touch.

Source of the layout: California Strong Motion Instrumentation Program, report OSMS 85-03.
"""

from __future__ import annotations

import math
import re

from rockref.shake.records.channel import Channel, Direction, acceleration_factor, columns, direction_of, positive_step

# An earlier line of the header says "points of" too, without the step.
_DATA = re.compile(
    r"^\s*(?P<n>\d+)\s+points\s+of\s+accel\s+data\s+equally\s+spaced\s+at\s+(?P<dt>[\d.]+)\s*sec[.,]?"
    r"(?:\s*,?\s*(?:in|\(units:)\s*(?P<unit>[a-z][a-z0-9/]*))?[^(]*(?:\((?P<a_line>\d+)f(?P<width>\d+)\.\d+\))?",
    re.IGNORECASE,
)
_CHANNEL = re.compile(r"chan\s*\d+\s*:\s*([a-z0-9]+)", re.IGNORECASE)
# Where a file states no format: eight columns of ten (OSMS 85-03).
_A_LINE, _WIDTH = 8, 10


def is_csmip(lines: list[str]) -> bool:
    """Return whether a block of acceleration begins somewhere."""
    return any(_DATA.match(line) for line in lines)


def read_csmip(lines: list[str], path: str) -> list[Channel]:
    """Return every channel of a CSMIP file.

    Raises InputError: E-RECORD-UNIT, E-RECORD-STEP, E-RECORD-COUNT, E-RECORD-NUMBER.
    """
    found, searched = [], 0
    for k, line in enumerate(lines):
        if block := _DATA.match(line):
            where = f"{path}, line {k + 1}"
            factor = acceleration_factor(block["unit"] or "", where)
            count, dt = int(block["n"]), positive_step(float(block["dt"]), where)
            a_line, width = int(block["a_line"] or _A_LINE), int(block["width"] or _WIDTH)
            rows = lines[k + 1 : k + 1 + math.ceil(count / a_line)]
            values = columns(rows, k + 2, path, width, count)
            found.append(Channel(f"{path}, line {k + 2}", factor * values, dt, _direction(lines[searched:k])))
            searched = k
    return found


def _direction(header: list[str]) -> Direction:
    """Return the word after `Chan n:` in the last header before the block: degrees, up, or a name of the building's
    axes."""
    words = [match[1] for line in header if (match := _CHANNEL.search(line))]
    return direction_of(words[-1]) if words else None
