"""COSMOS volume 2: text, integers, reals and comments, then one channel; the unit is a code.

Source of the layout: Strong Motion Data Format, COSMOS, version 1.20, https://www.cosmos-eq.org.
"""

from __future__ import annotations

import re

from rockref.measure.records.notice import Notice, shown
from rockref.model.errors import InputError
from rockref.shake.records.channel import STANDARD_GRAVITY, Channel, Direction, columns, positive_step

_FORMAT = re.compile(r"Format\s+v\s*\d", re.IGNORECASE)
_INTEGERS = re.compile(r"^\s*(\d+)\s+Integer-header values follow.*Format=\s*\((\d+)I(\d+)\)", re.IGNORECASE)
_REALS = re.compile(r"^\s*(\d+)\s+Real-header values follow.*Format=\s*\((\d+)F(\d+)\.\d+\)", re.IGNORECASE)
_DATA = re.compile(
    r"^\s*(?P<n>\d+)\s+(?P<kind>\w+)\s+pts.*units\s*=\s*(?P<unit>[^(,]*)\((?P<code>\d+)\)\s*,?"
    r"\s*Format\s*=\s*\((?P<a_line>\d+)[EF](?P<width>\d+)\.\d+\)",
    re.IGNORECASE,
)
#: Table 2 of the format: what one unit is worth in m/s2. 50 is counts, and no acceleration.
UNIT_CODES = {2: STANDARD_GRAVITY, 4: 1e-2, 10: 1e-2, 11: 1e-3 * STANDARD_GRAVITY}
# Places in the headers, counted from 0: azimuth of the sensor among the integers, interval in ms among the reals.
_AZIMUTH, _INTERVAL_MS = 53, 61
#: Codes of directions that are no azimuth.
_UP, _DOWN = 400, 401


def is_cosmos(lines: list[str]) -> bool:
    """Return whether the first line names the format and the headers follow."""
    return bool(lines and _FORMAT.search(lines[0])) and any(_INTEGERS.match(line) for line in lines[:40])


def read_cosmos(lines: list[str], path: str) -> list[Channel]:
    """Return every channel of a COSMOS file: one, or several written one after the other.

    Raises InputError: E-RECORD-KIND, E-RECORD-UNIT, E-RECORD-KEY, E-RECORD-STEP, E-RECORD-COUNT, E-RECORD-NUMBER.
    """
    found: list[Channel] = []
    integers: list[float] = []
    reals: list[float] = []
    for k, line in enumerate(lines):
        if head := _INTEGERS.match(line):
            integers = _header(lines, k, path, head)
        elif head := _REALS.match(line):
            reals = _header(lines, k, path, head)
        elif block := _DATA.match(line):
            found.append(_channel(lines, k, path, block, integers, reals))
    if not found:
        raise InputError("E-RECORD-KIND", path, "no line announces values with a unit", "Give a V1 or V2 file.")
    return found


def _header(lines: list[str], k: int, path: str, head: re.Match[str]) -> list[float]:
    count, a_line, width = (int(group) for group in head.groups())
    rows = lines[k + 1 : k + 1 + -(-count // a_line)]
    return columns(rows, k + 2, path, width, count).tolist()


def _channel(
    lines: list[str], k: int, path: str, block: re.Match[str], integers: list[float], reals: list[float]
) -> Channel:
    where = f"{path}, line {k + 1}"
    if not block["kind"].lower().startswith("accel"):
        what = f"holds {block['kind']}, not acceleration"
        raise InputError("E-RECORD-KIND", where, what, "Give the file of acceleration.")
    code = int(block["code"])
    if code not in UNIT_CODES:
        what = f"the unit is {shown(block['unit'].strip())} (code {code}), which is no acceleration"
        raise InputError("E-RECORD-UNIT", where, what, "Give the corrected record in g, cm/s2, gal or mg.")
    if len(reals) <= _INTERVAL_MS:
        what = f"the header of reals holds {len(reals)} values"
        raise InputError("E-RECORD-KEY", where, what, "The header is damaged: get the file again.")
    dt = positive_step(1e-3 * reals[_INTERVAL_MS], where)
    count, a_line, width = int(block["n"]), int(block["a_line"]), int(block["width"])
    rows = _rows(lines, k + 1, -(-count // a_line))
    held = sum(-(-len(row.rstrip()) // width) for row in rows)
    notices: tuple[Notice, ...] = ()
    # Known of files of several networks: one value less than announced.
    if held == count - 1:
        what = f"{count} values are announced, {held} are there"
        notices = (Notice("W-RECORD-COUNT", where, what, "The values that are there were used."),)
        count = held
    values = columns(rows, k + 2, path, width, count)
    return Channel(f"{path}, line {k + 2}", UNIT_CODES[code] * values, dt, _direction(integers), None, notices)


def _rows(lines: list[str], first: int, most: int) -> list[str]:
    """Return lines of values: at most so many, and none of the mark at the end of the data."""
    rows = lines[first : first + most]
    end = next((i for i, row in enumerate(rows) if "end-of-data" in row.lower() or not row.strip()), len(rows))
    return rows[:end]


def _direction(integers: list[float]) -> Direction:
    code = int(integers[_AZIMUTH]) if len(integers) > _AZIMUTH else 0
    if 1 <= code <= 360:
        return float(code % 360)
    return {_UP: "up", _DOWN: "down"}.get(code)
