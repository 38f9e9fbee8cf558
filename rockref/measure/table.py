"""A table of numbers with named columns, from CSV or CSV.gz."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np

from rockref.measure.columns import Column, parse_header
from rockref.measure.notice import Notice
from rockref.measure.rawfile import MAX_PACKED_BYTES, MAX_TEXT_BYTES, read_text, shown
from rockref.model.errors import InputError

# decided: a quarter of an hour at 2 kHz; 64 MiB of text could otherwise hold sixty million rows of nothing.
MAX_ROWS = 2_000_000
# decided: 64 columns of 24 characters make 1600.
MAX_LINE = 4096

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity)", re.ASCII | re.IGNORECASE)
_DECIMAL_COMMA = re.compile(r"[+-]?\d+,\d+", re.ASCII)
_WHOLE = re.compile(r"[+-]?\d+", re.ASCII)


@dataclass(frozen=True)
class Table:
    """The columns of a file in SI units, by quantity.

    Attributes
    ----------
    path : Path
        The file.
    columns : mapping of str to (N,) float64
        By quantity (``t``, ``wx``, ..., ``qz``): s, rad/s, m.
    names : mapping of str to str
        The name in the file of each quantity, with its unit.
    sha256 : str
        Digest of the bytes on disk.
    notices : tuple of Notice
    """

    path: Path
    columns: Mapping[str, np.ndarray]
    names: Mapping[str, str]
    sha256: str
    notices: tuple[Notice, ...]

    @property
    def rows(self) -> int:
        """Number of rows below the header."""
        return len(next(iter(self.columns.values())))


def read_table(
    path: Path | str,
    needed: Sequence[str],
    *,
    max_packed: int = MAX_PACKED_BYTES,
    max_text: int = MAX_TEXT_BYTES,
    max_rows: int = MAX_ROWS,
) -> Table:
    """Read the table in `path`, which must have a column for every quantity in `needed`.

    Raises InputError with file, line, column and the text found: E-FILE, E-SIZE, E-GZIP, E-ENCODING, E-EMPTY,
    E-HEADER, E-DELIMITER, E-UNIT, E-COLUMN-TWICE, E-COLUMN-MISSING, E-ROWS, E-BLANK, E-FIELDS, E-DECIMAL-COMMA,
    E-NUMBER, E-NOT-FINITE.
    """
    path = Path(path)
    raw = read_text(path, max_packed=max_packed, max_text=max_text)
    # Counted before anything is split: a hundred million empty lines would cost gigabytes as a list.
    if raw.text.count("\n") > max_rows + 1:
        raise InputError("E-ROWS", str(path), f"more than {max_rows} rows, which is no run", "Cut the file to the run.")
    lines = raw.text.rstrip().split("\n")
    columns, width, notices = parse_header(_short(lines[0], path, 1), f"{path}, line 1", needed)
    body = lines[1:]
    if not body:
        raise InputError("E-EMPTY", str(path), "there is no row below the header", "Export the run again.")
    values = _numbers(body, columns, width, path)
    return Table(
        path=path,
        columns=MappingProxyType({c.quantity: _frozen(values[:, c.place] * c.factor) for c in columns}),
        names=MappingProxyType({c.quantity: c.name for c in columns}),
        sha256=raw.sha256,
        notices=raw.notices + tuple(notices),
    )


def _frozen(array: np.ndarray) -> np.ndarray:
    array.flags.writeable = False
    return array


def _short(line: str, path: Path, number: int) -> str:
    if len(line) > MAX_LINE:
        what = f"{len(line)} characters in one line"
        raise InputError("E-FIELDS", f"{path}, line {number}", what, "Write one row per line.")
    return line


def _numbers(body: list[str], columns: list[Column], width: int, path: Path) -> np.ndarray:
    """Return the body as (N, width) floats. Columns that are not known may hold anything."""
    for number, line in enumerate(body, start=2):
        if not line or line.isspace():
            cure = "Remove the empty line; if rows are missing there, leave them out."
            raise InputError("E-BLANK", f"{path}, line {number}", "an empty line between rows", cure)
        _short(line, path, number)
    try:
        values = _fast(body, columns, width)
    except ValueError:
        raise _first_fault(body, columns, width, path) from None
    if not np.isfinite(values).all():
        raise _first_fault(body, columns, width, path)
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


def _first_fault(body: list[str], columns: list[Column], width: int, path: Path) -> InputError:
    """Find the first row that is at fault, the slow way, and say what is wrong with it."""
    for number, line in enumerate(body, start=2):
        fields = line.split(",")
        if len(fields) != width:
            return _wrong_count(fields, width, f"{path}, line {number}", last=number == len(body) + 1)
        for column in columns:
            fault = _wrong_number(fields[column.place].strip(), f"{path}, line {number}, column {column.name}")
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
    return InputError("E-NUMBER", where, f"{shown(field)} is not a number", "Write plain decimal numbers.")
