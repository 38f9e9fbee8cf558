"""What spreadsheets and loggers add to a comma-separated table: a separator line, quotes, a row of units."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence

_SEPARATOR = re.compile(r"\s*\"?sep=(.)\"?\s*", re.IGNORECASE)
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
#: Words of rows of units, in lower case and without brackets; what is in none of the forms is a name.
_UNIT = re.compile(
    r"(s|ms|us|µs|ns|sec|seconds?|milliseconds?|microseconds?|deg|mrad|rad|dps|°|m|mm|cm|g|mg|hz|v|mv|-|–|)"
    r"([/·*]?\s?(s|sec|s2|s\^2|s²|second))?",
    re.IGNORECASE,
)


def separator_line(line: str) -> str | None:
    """Return the delimiter that a first line ``sep=;`` of a spreadsheet names, or None."""
    match = _SEPARATOR.fullmatch(line)
    return match[1] if match else None


def split_line(line: str, delimiter: str) -> list[str]:
    """Return the fields of one line, blanks and quotes around them taken off."""
    if '"' not in line:
        return [field.strip() for field in line.split(delimiter)]
    return [field.strip() for field in next(csv.reader([line], delimiter=delimiter, skipinitialspace=True))]


def is_number(field: str) -> bool:
    """Return whether a field is a plain number with a decimal point."""
    return bool(_NUMBER.fullmatch(field))


def are_units(fields: Sequence[str]) -> bool:
    """Return whether all fields of a line are units, in brackets or not, and one of them at least is not empty."""
    bare = [field.strip().strip("[]()") for field in fields]
    return any(bare) and all(_UNIT.fullmatch(word) for word in bare)
