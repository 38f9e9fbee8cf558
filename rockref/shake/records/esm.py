"""The `.ASC` files of ESM and of like databases (ITACA, AFAD): lines of `KEY: value`, then one value a line.

Source of the layout: header format DYNA 1.2 of the Engineering Strong-Motion database, https://esm-db.eu.
"""

from __future__ import annotations

import re
from datetime import UTC, datetime

from rockref.measure.records.notice import shown
from rockref.model.errors import InputError
from rockref.shake.records.channel import (
    NUMBER,
    Channel,
    Direction,
    acceleration_factor,
    check_count,
    direction_of,
    numbers,
    positive_step,
)

_KEY = re.compile(r"([A-Z][A-Z0-9_/^]*)\s*:(.*)")
_START = "DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS"
_DIGITS = re.compile(r"(\d{4})\D?(\d\d)\D?(\d\d)\D(\d\d)\D?(\d\d)\D?(\d\d)(\.\d+)?")


def is_esm(lines: list[str]) -> bool:
    """Return whether the header has the keys of this format."""
    head = "\n".join(lines[:80])
    return "SAMPLING_INTERVAL_S:" in head and "NDATA:" in head


def read_esm(lines: list[str], path: str) -> list[Channel]:
    """Return the one component of an ESM file.

    Raises InputError: E-RECORD-KIND (velocity, displacement, spectra), E-RECORD-UNIT, E-RECORD-KEY, E-RECORD-STEP,
    E-RECORD-COUNT, E-RECORD-NUMBER.
    """
    header: dict[str, tuple[str, int]] = {}
    first = 0
    while first < len(lines) and (match := _KEY.match(lines[first])):
        header[match[1]] = match[2].strip(), first + 1
        first += 1
    kind, line = header.get("DATA_TYPE", ("", 1))
    if "ACCELERATION" not in kind.upper() or "SPECTR" in kind.upper():
        what = f"DATA_TYPE is {shown(kind)}, not ACCELERATION"
        raise InputError("E-RECORD-KIND", f"{path}, line {line}", what, "Give the file of acceleration (.ACC.ASC).")
    unit, line = header.get("UNITS", ("", 1))
    factor = acceleration_factor(unit, f"{path}, line {line}")
    values = numbers(lines[first:], first + 1, path)
    count, line = _number(header, "NDATA", path)
    check_count(len(values), int(count), f"{path}, line {line}")
    dt, line = _number(header, "SAMPLING_INTERVAL_S", path)
    dt = positive_step(dt, f"{path}, line {line}")
    start = _seconds(header.get(_START, ("", 1))[0])
    return [Channel(f"{path}, line {first + 1}", factor * values, dt, _direction(header), start)]


def _number(header: dict[str, tuple[str, int]], key: str, path: str) -> tuple[float, int]:
    text, line = header.get(key, ("", 1))
    if not NUMBER.fullmatch(text):
        what = f"{key} is {shown(text)}, not a number"
        raise InputError("E-RECORD-KEY", f"{path}, line {line}", what, "The header is damaged: get the file again.")
    return float(text), line


def _direction(header: dict[str, tuple[str, int]]) -> Direction:
    """Return the last letter of the stream: E, N or Z; other letters name no direction."""
    stream = header.get("STREAM", ("", 1))[0]
    return direction_of(stream[-1]) if stream[-1:] in ("E", "N", "Z") else None


def _seconds(text: str) -> float | None:
    """Return seconds of a time in any of the spellings, 20190728_160905.700 or 2023/02/06 01:17:29.868; None if
    empty."""
    match = _DIGITS.match(text)
    if match is None:
        return None
    year, month, day, hour, minute, second = (int(part) for part in match.groups()[:6])
    moment = datetime(year, month, day, hour, minute, second, tzinfo=UTC)
    return moment.timestamp() + float(match[7] or 0.0)
