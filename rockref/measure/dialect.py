"""The dialect of a text table: delimiter, decimal mark, header, row of units, first and last row of numbers.

Loggers and spreadsheets write a table in many ways. This module tells which one it is; what may be read is decided by
who reads.
"""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

_SEPARATOR = re.compile(r"\s*\"?sep=(.)\"?\s*", re.IGNORECASE)
_POINT = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_COMMA = re.compile(r"[+-]?(\d+,?\d*|,\d+)([eE][+-]?\d+)?", re.ASCII)
#: Words of rows of units, in lower case and without brackets; what is in none of the forms is a name.
_UNIT = re.compile(
    r"(s|ms|us|µs|ns|sec|seconds?|milliseconds?|microseconds?|deg|rad|°|m|mm|cm|g|mg|hz|v|mv|-|–|)"
    r"([/·*]?\s?(s|sec|s2|s\^2|s²|second))?",
    re.IGNORECASE,
)
DELIMITERS = (",", ";", "\t", "|")
# decided: so many lines show the dialect; a header with its facts is shorter than half of them.
SHOWN = 200


@dataclass(frozen=True)
class Dialect:
    """How a table is written. Lines count from zero.

    Attributes: ``delimiter``; ``decimal`` mark, ``.`` or ``,``; ``names`` of the columns, empty where there is no
    header; ``units``, the words of a row of units, or empty; ``header``, ``first`` and ``last``: the lines of the
    header (or None) and of the first and the last row of numbers; ``quoted``, whether fields stand in quotes.
    """

    delimiter: str
    decimal: str
    names: tuple[str, ...]
    units: tuple[str, ...]
    header: int | None
    first: int
    last: int
    quoted: bool


def separator_line(line: str) -> str | None:
    """Return the delimiter that a first line ``sep=;`` of a spreadsheet names, or None."""
    match = _SEPARATOR.fullmatch(line)
    return match[1] if match else None


def split_line(line: str, delimiter: str) -> list[str]:
    """Return the fields of one line, blanks and quotes around them taken off."""
    if '"' not in line:
        return [field.strip() for field in line.split(delimiter)]
    return [field.strip() for field in next(csv.reader([line], delimiter=delimiter, skipinitialspace=True))]


def is_number(field: str, decimal: str = ".") -> bool:
    """Whether a field is a plain number with this decimal mark."""
    return bool((_POINT if decimal == "." else _COMMA).fullmatch(field))


def are_units(fields: Sequence[str]) -> bool:
    """Whether all fields of a line are units, in brackets or not, and one of them at least is not empty."""
    bare = [field.strip().strip("[]()") for field in fields]
    return any(bare) and all(_UNIT.fullmatch(word) for word in bare)


def detect(lines: Sequence[str]) -> Dialect | None:
    """Return the dialect of a table given as lines, or None where no rows of numbers are found.

    Facts before the header, a row of units below it, and lines behind the last row are told by their places.
    """
    named = separator_line(lines[0]) if lines else None
    shown = list(lines[:SHOWN])
    best: tuple[int, int, Dialect] | None = None
    for delimiter in (named,) if named else DELIMITERS:
        for decimal in (".", ","):
            if decimal == delimiter:
                continue
            rows = [split_line(line, delimiter) if line.strip() else [] for line in shown]
            found = _numbers_in(rows, decimal)
            if found is None:
                continue
            first, width, count = found
            dialect = _with_header(lines, rows, delimiter, decimal, first, width)
            key = (count, width)
            if best is None or key > best[:2]:
                best = (*key, dialect)
    return best[2] if best else None


def _numbers_in(rows: list[list[str]], decimal: str) -> tuple[int, int, int] | None:
    """Return the first row of numbers, their usual width, and how many there are; None for fewer than two columns."""
    numeric = [len(row) > 1 and sum(is_number(field, decimal) for field in row) > 0.5 * len(row) for row in rows]
    widths = Counter(len(row) for row, good in zip(rows, numeric, strict=True) if good)
    if not widths:
        return None
    width = widths.most_common(1)[0][0]
    places = [k for k, (row, good) in enumerate(zip(rows, numeric, strict=True)) if good and len(row) == width]
    return places[0], width, len(places)


def _with_header(
    lines: Sequence[str], rows: list[list[str]], delimiter: str, decimal: str, first: int, width: int
) -> Dialect:
    above = first - 1
    units: list[str] = []
    if above > 0 and len(rows[above]) == width and are_units(rows[above]) and len(rows[above - 1]) == width:
        units, above = rows[above], above - 1
    # A header may lack the empty name of a trailing delimiter, or have one more.
    has_header = above >= 0 and abs(len(rows[above]) - width) <= 1 and len(rows[above]) > 1
    last = len(lines) - 1
    while last > first and not _is_row(lines[last], delimiter, decimal):
        last -= 1
    return Dialect(
        delimiter=delimiter,
        decimal=decimal,
        names=tuple(rows[above]) if has_header else (),
        units=tuple(units),
        header=above if has_header else None,
        first=first,
        last=last,
        quoted='"' in lines[first],
    )


def _is_row(line: str, delimiter: str, decimal: str) -> bool:
    fields = split_line(line, delimiter) if line.strip() else []
    return len(fields) > 1 and sum(is_number(field, decimal) for field in fields) > 0.5 * len(fields)
