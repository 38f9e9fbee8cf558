"""A table of numbers with named columns, from CSV or CSV.gz."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np

from rockref.measure.reading.columns import QUANTITIES, UNITS, Column, parse_header
from rockref.measure.reading.dialect import are_units, is_number, separator_line, split_line
from rockref.measure.reading.rawfile import read_text
from rockref.measure.records.notice import Notice, shown
from rockref.model.errors import InputError

# decided: a quarter of an hour at 2 kHz; 64 MiB of text could otherwise hold sixty million rows of nothing.
MAX_ROWS = 2_000_000
# decided: 64 columns of 24 characters make 1600.
MAX_LINE = 4096

# decided: a logger closes a file with a few facts.
LONGEST_FOOTER = 20
# Stands for a comma inside of quotes; no number has it.
_INNER = "\x1f"
# A line that begins with a word, or with a sign of remarks, is no row of numbers.
_TEXT = re.compile(r"\s*(\"?[^\W\d][^,]{2,}|#|//|%|;)", re.ASCII)
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.ASCII | re.IGNORECASE)
_DECIMAL_COMMA = re.compile(r"[+-]?\d+,\d+", re.ASCII)
_CLOCK = re.compile(r"(\d+:)?\d+:\d+(\.\d+)?", re.ASCII)
_WHOLE = re.compile(r"[+-]?\d+", re.ASCII)


@dataclass(frozen=True)
class Table:
    """The columns of a file in SI units, by quantity.

    Attributes
    ----------
    path : the file
    columns : (N,) by quantity (``t``, ``wx``, ..., ``qz``): s, rad/s, m.
    names : the name in the file of each quantity, with its unit
    sha256 : digest of the bytes on disk
    first_line : line of the first row, counted from one
    """

    path: Path
    columns: Mapping[str, np.ndarray]
    names: Mapping[str, str]
    sha256: str
    notices: tuple[Notice, ...]
    first_line: int = 2

    @property
    def rows(self) -> int:
        """Return number of rows below the header."""
        return len(next(iter(self.columns.values())))


def read_table(path: Path | str, needed: Sequence[str], *, max_rows: int = MAX_ROWS) -> Table:
    """Read the table in `path`, which must have a column for every quantity in `needed`.

    Raises InputError with file, line, column and the text found: E-FILE, E-SIZE, E-GZIP, E-ENCODING, E-EMPTY,
    E-HEADER, E-DELIMITER, E-UNIT, E-COLUMN-TWICE, E-COLUMN-MISSING, E-ROWS, E-BLANK, E-FIELDS, E-DECIMAL-COMMA,
    E-NUMBER, E-NOT-FINITE.
    """
    path = Path(path)
    raw = read_text(path)
    # Counted before anything is split: a hundred million empty lines would cost gigabytes as a list.
    if raw.text.count("\n") > max_rows + 1:
        raise InputError("E-ROWS", str(path), f"more than {max_rows} rows, which is no run", "Cut the file to the run.")
    lines = raw.text.rstrip().split("\n")
    above, lines = _without_separator(lines, path)
    _check_top(lines, path, above, needed)
    columns, width, notices = parse_header(
        _plain(_short(lines[0], path, above + 1)), f"{path}, line {above + 1}", needed
    )
    body, skipped, said = _rows(lines, columns, path, above)
    notices += said
    if not body:
        raise InputError("E-EMPTY", str(path), "there is no row below the header", "Export the run again.")
    values = _numbers(body, columns, width, path, skipped)
    return Table(
        path=path,
        columns=MappingProxyType({c.quantity: _frozen(values[:, c.place] * c.factor) for c in columns}),
        names=MappingProxyType({c.quantity: c.name for c in columns}),
        sha256=raw.sha256,
        notices=raw.notices + tuple(notices),
        first_line=skipped + 1,
    )


def _frozen(array: np.ndarray) -> np.ndarray:
    array.flags.writeable = False
    return array


def _short(line: str, path: Path, number: int) -> str:
    if len(line) > MAX_LINE:
        what = f"{len(line)} characters in one line"
        raise InputError("E-FIELDS", f"{path}, line {number}", what, "Write one row per line.")
    return line


def _without_separator(lines: list[str], path: Path) -> tuple[int, list[str]]:
    """Return how many lines stand above the header, and the lines from the header on; a line ``sep=,`` is passed over.

    Raises InputError E-DELIMITER, E-EMPTY.
    """
    separator = separator_line(lines[0])
    if separator is None:
        return 0, lines
    if separator != ",":
        cure = "Separate the columns by commas and write decimals with a point."
        raise InputError("E-DELIMITER", f"{path}, line 1", f"the columns are separated by {separator!r}", cure)
    if len(lines) < 2:
        raise InputError("E-EMPTY", str(path), "there is nothing below its first line", "Export the run again.")
    return 1, lines[1:]


def _check_top(lines: list[str], path: Path, above: int, needed: Sequence[str]) -> None:
    """Refuse lines of a logger above the header (E-HEADER), where the header stands below them."""
    for number, line in enumerate(lines[:LONGEST_FOOTER]):
        known = {name.partition("_")[0] for name in split_line(line[:MAX_LINE], ",")}
        if known.issuperset(needed):
            if number and not lines[0].lstrip().startswith("#"):
                what = f"the first line is {shown(lines[0])}; the names stand in line {above + number + 1}"
                cure = "Remove the lines above the names of the columns."
                raise InputError("E-HEADER", f"{path}, line {above + 1}", what, cure)
            return


def _plain(line: str) -> str:
    """Return a line without quotes around fields; a comma inside of quotes becomes a sign that no number has."""
    if '"' not in line:
        return line
    return ",".join(field.replace(",", _INNER) for field in split_line(line, ","))


def _rows(lines: list[str], columns: list[Column], path: Path, above: int) -> tuple[list[str], int, list[Notice]]:
    """Return the rows below the header, plain, how many lines stand above the first one, and remarks.

    A row of units that agrees with the names, and lines of text behind the last row, are passed over (W-DIALECT); so
    are delimiters at the end of every line. Raises InputError E-UNIT.
    """
    body, notices, skipped = lines[1:], list[Notice](), above + 1
    if body and are_units(split_line(body[0], ",")):
        _check_units(split_line(body[0], ","), columns, f"{path}, line {skipped + 1}")
        notices.append(Notice("W-DIALECT", f"{path}, line {skipped + 1}", "holds units", "The line was passed over."))
        body, skipped = body[1:], skipped + 1
    end = len(body)
    while end > 1 and end > len(body) - LONGEST_FOOTER and _is_text(body[end - 1]):
        end -= 1
    if end < len(body):
        where, what = f"{path}, line {skipped + end + 1}", _lines(len(body) - end)
        notices.append(Notice("W-DIALECT", where, what, "They were passed over."))
        body = body[:end]
    if body and all(line.endswith(",") for line in body) and not lines[0].rstrip().endswith(","):
        body = [line.rstrip()[:-1] for line in body]
    if any('"' in line for line in body):
        body = [_plain(_short(line, path, number)) for number, line in enumerate(body, start=skipped + 1)]
    return body, skipped, notices


def _lines(count: int) -> str:
    return "a line of text behind the last row" if count == 1 else f"{count} lines of text behind the last row"


def _is_text(line: str) -> bool:
    """Return whether a line begins with a word or with a sign of remarks, and holds not a row of numbers."""
    return bool(_TEXT.match(line)) and sum(map(is_number, split_line(line[:MAX_LINE], ","))) < 2


def _check_units(units: list[str], columns: list[Column], where: str) -> None:
    """Refuse a row of units that says something else than the names of the columns (E-UNIT)."""
    for column in columns:
        unit = units[column.place].strip("[]()").lower() if column.place < len(units) else ""
        said = {"°/s": "deg_s", "deg/s": "deg_s", "dps": "deg_s", "rad/s": "rad_s", "mrad/s": "mrad_s", "µs": "us"}
        unit = said.get(unit, unit)
        if unit in UNITS[QUANTITIES[column.quantity]] and unit != column.unit:
            what = f"the unit of {column.name} is {units[column.place]}"
            raise InputError("E-UNIT", where, what, "The unit is part of a column's name: correct one of the two.")


def _numbers(body: list[str], columns: list[Column], width: int, path: Path, skipped: int = 1) -> np.ndarray:
    """Return the body, below `skipped` lines, as (N, width) floats. Columns that are not known may hold anything."""
    longest = max(map(len, body))
    for number, line in enumerate(body, start=skipped + 1):
        if not line or line.isspace():
            cure = "Remove the empty line; if rows are missing there, leave them out."
            raise InputError("E-BLANK", f"{path}, line {number}", "an empty line between rows", cure)
        if longest > MAX_LINE:
            _short(line, path, number)
    try:
        values = _fast(body, columns, width)
    except ValueError:
        raise _first_fault(body, columns, width, path, skipped) from None
    if not np.isfinite(values).all():
        raise _first_fault(body, columns, width, path, skipped)
    return values


def _fast(body: list[str], columns: list[Column], width: int) -> np.ndarray:
    """Return (N, width) floats; raise ValueError where a row is not what it should be."""
    places = [c.place for c in columns]
    if len(places) == width:
        values = np.loadtxt(body, delimiter=",", comments=None, ndmin=2)
        if values.shape[1] != width:
            raise ValueError("number of columns")
        return values
    # Columns that are left unread may hold text, and loadtxt does not count the ones that it skips.
    if any(line.count(",") != width - 1 for line in body):
        raise ValueError("number of columns")
    values = np.zeros((len(body), width))
    values[:, places] = np.loadtxt(body, delimiter=",", comments=None, ndmin=2, usecols=places)
    return values


def _first_fault(body: list[str], columns: list[Column], width: int, path: Path, skipped: int) -> InputError:
    """Find the first row that is at fault, the slow way, and say what is wrong with it."""
    for number, line in enumerate(body, start=skipped + 1):
        fields = line.split(",")
        if _is_text(line) and ";" not in line:
            again = [field.strip() for field in fields[: len(columns)]] == [column.name for column in columns]
            what = "the header stands there again" if again else f"a line of text between rows ({shown(line)})"
            cure = "A second record begins there: cut the file before it." if again else "Remove the line."
            return InputError("E-FIELDS", f"{path}, line {number}", what, cure)
        if len(fields) != width:
            return _wrong_count(fields, width, f"{path}, line {number}", last=number == len(body) + skipped)
        for column in columns:
            fault = _wrong_number(
                fields[column.place].strip().replace(_INNER, ","), f"{path}, line {number}, column {column.name}"
            )
            if fault is not None:
                return fault
    return InputError("E-NUMBER", str(path), "a row cannot be read as numbers", "Write plain decimal numbers.")


def _wrong_count(fields: list[str], width: int, where: str, *, last: bool) -> InputError:
    halves = all(_WHOLE.fullmatch(field.strip()) for field in fields)
    # Every number cut in two (or all but a whole time) by the comma that the reader takes for a separator.
    if halves and len(fields) in (2 * width, 2 * width - 1):
        what = f"{len(fields)} fields for {width} columns: the decimals seem to be written with a comma"
        return InputError("E-DECIMAL-COMMA", where, what, "Export with a decimal point (an English locale).")
    if len(fields) == 1 and ";" in fields[0] or any(";" in field for field in fields):
        what = f"semicolons in {shown(','.join(fields))}"
        return InputError("E-DELIMITER", where, what, "Separate the columns by commas, with decimal points.")
    what = f"{len(fields)} fields for {width} columns"
    cure = "The file seems to be cut off: copy it again." if last and len(fields) < width else "Mend the row."
    return InputError("E-FIELDS", where, what, cure)


def _wrong_number(field: str, where: str) -> InputError | None:
    bare = field.strip("\"'")
    if _NOT_FINITE.fullmatch(field):
        cure = "A sample that is missing is left out, not written as a word."
        return InputError("E-NOT-FINITE", where, f"{shown(field)} is not a finite number", cure)
    if _NUMBER.fullmatch(field):
        if np.isfinite(float(field)):
            return None
        return InputError("E-NOT-FINITE", where, f"{shown(field)} is too large for a number", "Mend the sample.")
    if not field:
        return InputError("E-NUMBER", where, "the field is empty", "Leave the row out, or fill the sample in.")
    if _DECIMAL_COMMA.fullmatch(bare):
        cure = "Write decimals with a point."
        return InputError("E-DECIMAL-COMMA", where, f"{shown(field)} has a decimal comma", cure)
    return InputError("E-NUMBER", where, f"{shown(field)} is not a number", _cure_of(field))


def _cure_of(field: str) -> str:
    """Return what to do about a field that is no number."""
    if _NUMBER.fullmatch(field.replace("\N{MINUS SIGN}", "-")):
        return "Its minus sign is that of print (U+2212): write a hyphen."
    if _CLOCK.fullmatch(field):
        return "That is a time of day: write seconds from the release."
    return "Write plain decimal numbers."
