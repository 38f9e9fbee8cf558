"""The layout of a logger's text: delimiter, decimal mark, preamble, header, rows."""

from __future__ import annotations

import io
import tempfile
import zipfile
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

import numpy as np

from rockref.measure.reading.dialect import are_units
from rockref.measure.reading.rawfile import MAX_TEXT_BYTES, RawText, read_text
from rockref.measure.records.notice import Notice, shown
from rockref.model.errors import InputError

#: Delimiter and decimal mark, the likeliest first where a text fits several. None is any white space.
LAYOUTS: tuple[tuple[str | None, str], ...] = (
    (";", "."), (";", ","), ("\t", "."), ("\t", ","), (",", "."), (None, "."), (None, ","),
)  # fmt: skip
SPOKEN = {";": "semicolons", "\t": "tabs", ",": "commas", None: "spaces"}
# decided: the layout shows in forty rows; the last row may be cut off.
LOOKED_AT = 40
# decided: three rates at least; the time may be missing where the sample rate is stated.
LEAST_NUMBERS = 3
# decided: a logger that garbles more than one row in a hundred is not to be trusted with the others.
MAX_LOST_SHARE = 0.01
#: Files in the archive of a phone that hold the gyroscope, the calibrated one first.
IN_ARCHIVES = ("gyroscope.csv", "raw data.csv", "gyroscopeuncalibrated.csv")


@dataclass(frozen=True, eq=False)
class Log:
    """One file of a logger as a table of numbers.

    Attributes: ``source``, its path for messages; ``names`` (M,) of the header, empty where there is none; ``values``
    (N, M), NaN where a cell holds no number; ``words``, cells of columns without any number; ``preamble``, the lines
    before the header; ``layout`` in words; ``header_line``, its number.
    """

    source: str
    names: tuple[str, ...]
    values: np.ndarray = field(repr=False)
    words: dict[int, list[str]] = field(repr=False)
    preamble: tuple[str, ...] = field(repr=False)
    layout: str
    header_line: int
    notices: tuple[Notice, ...] = ()


def read_log(path: Path) -> Log:
    """Read a logger's file, or the gyroscope's file in a phone's archive or folder.

    Raises InputError: those of ``read_text``, E-LAYOUT where no delimiter fits, E-FOLDER, E-ZIP.
    """
    if path.is_dir():
        path = _inside_folder(path)
    raw = _from_archive(path) if path.suffix.lower() == ".zip" else read_text(path)
    lines = raw.text.rstrip().split("\n")
    delimiter, decimal, width = _layout(lines, path)
    first = next(i for i, line in enumerate(lines) if _is_row(line, delimiter, decimal, width))
    header = next((i for i in range(first - 1, -1, -1) if lines[i].strip()), None)
    names = _names(lines[header], delimiter, decimal) if header is not None else ()
    units: tuple[str, ...] = ()
    above = next((i for i in range((header or 0) - 1, -1, -1) if lines[i].strip()), None)
    if above is not None and len(names) == width and are_units(list(names)):
        units, names, header = names, _names(lines[above], delimiter, decimal), above
    if names and len(names) != width:
        names = _fitted(names, width)
    if units and names:
        names = tuple(
            f"{name} [{unit.strip('[]()')}]" if unit else name for name, unit in zip(names, units, strict=True)
        )
    values, words = _parse(lines[first:], delimiter, decimal, width, path)
    end = (header if names else first) or 0
    spoken = f"{SPOKEN[delimiter]}, decimal {'comma' if decimal == ',' else 'point'}"
    notices = tuple(n for n in raw.notices if n.code != "W-BOM")
    return Log(str(path), names, values, words, tuple(lines[:end]), spoken, (header or 0) + 1, notices)


def _inside_folder(folder: Path) -> Path:
    """Return the gyroscope's file in a folder that a phone exported."""
    for wanted in IN_ARCHIVES:
        for path in sorted(folder.iterdir()):
            if path.name.lower() == wanted:
                return path
    cure = "Name the files of the logger."
    raise InputError("E-FOLDER", str(folder), "holds no Gyroscope.csv", cure)


def _from_archive(path: Path) -> RawText:
    """Return the text of the gyroscope's file in a zip archive."""
    cure = "Unpack it, and name the file of the gyroscope."
    try:
        with zipfile.ZipFile(path) as archive:
            by_name = {PurePosixPath(info.filename).name.lower(): info for info in archive.infolist()}
            info = next((by_name[name] for name in IN_ARCHIVES if name in by_name), None)
            if info is None:
                raise InputError("E-ZIP", str(path), "holds no Gyroscope.csv", cure)
            if info.file_size > MAX_TEXT_BYTES:
                raise InputError("E-SIZE", str(path), f"holds {info.file_size} bytes of text", cure)
            with archive.open(info) as packed:
                data = packed.read(MAX_TEXT_BYTES + 1)
    except (OSError, zipfile.BadZipFile, RuntimeError, NotImplementedError) as error:
        raise InputError("E-ZIP", str(path), f"is no archive that can be read ({error})", cure) from None
    with tempfile.TemporaryDirectory() as folder:
        member = Path(folder) / "Gyroscope.csv"
        member.write_bytes(data)
        return read_text(member)


def _split(line: str, delimiter: str | None) -> list[str]:
    return [cell.strip().strip('"').strip() for cell in line.split(delimiter)]


def _number(cell: str, decimal: str) -> bool:
    if decimal == ",":
        if "." in cell:
            return False
        cell = cell.replace(",", ".")
    try:
        return bool(np.isfinite(float(cell)))
    except ValueError:
        return False


def _is_row(line: str, delimiter: str | None, decimal: str, width: int) -> bool:
    cells = _split(line, delimiter)
    return len(cells) == width and sum(_number(cell, decimal) for cell in cells) >= LEAST_NUMBERS


def _layout(lines: list[str], path: Path) -> tuple[str | None, str, int]:
    """Return delimiter, decimal mark and number of cells of the rows: where most are numbers."""
    body = [line for line in lines if line.strip()][-LOOKED_AT - 1 : -1] or lines[-1:]
    best: tuple[float, str | None, str, int] = (0.0, None, ".", 0)
    for delimiter, decimal in LAYOUTS:
        rows = [_split(line, delimiter) for line in body]
        width = int(np.median([len(row) for row in rows]))
        alike = [row for row in rows if len(row) == width]
        numbers = sum(_number(cell, decimal) for row in alike for cell in row) / len(alike)
        if numbers >= LEAST_NUMBERS and len(alike) > 0.5 * len(rows) and numbers > best[0]:
            best = (numbers, delimiter, decimal, width)
    if not best[0]:
        cure = "Export rows of numbers: time, and three rates."
        raise InputError("E-LAYOUT", str(path), f"no rows of numbers are found, as in {shown(body[-1])}", cure)
    _refuse_cut_decimals(lines, best[1], best[3], path)
    return best[1], best[2], best[3]


def _refuse_cut_decimals(lines: list[str], delimiter: str | None, width: int, path: Path) -> None:
    """Refuse a text that writes a comma both between and in its numbers: half of every number would be a column."""
    head = next((_split(line, ",") for line in lines if line.strip()), [])
    if delimiter == "," and len(head) >= LEAST_NUMBERS and width in (2 * len(head), 2 * len(head) - 1):
        cure = "Export with a decimal point (an English locale), or with semicolons between the columns."
        what = f"{width} fields for {len(head)} columns: the decimals seem to be written with a comma"
        raise InputError("E-DECIMAL-COMMA", str(path), what, cure)


def _names(line: str, delimiter: str | None, decimal: str) -> tuple[str, ...]:
    cells = _split(line.lstrip("#%/ "), delimiter)
    return () if any(_number(cell, decimal) for cell in cells) else tuple(cells)


def _fitted(names: tuple[str, ...], width: int) -> tuple[str, ...]:
    """Return the names where a delimiter at the end of the rows, or of the header, makes one column too many."""
    if len(names) == width + 1 and not names[-1]:
        return names[:-1]
    return (*names, "") if len(names) == width - 1 else ()


def _parse(
    lines: list[str], delimiter: str | None, decimal: str, width: int, path: Path
) -> tuple[np.ndarray, dict[int, list[str]]]:
    """Return the cells as (N, width) numbers, NaN where a cell is none, and the words of columns without numbers."""
    import pandas as pd

    rows = [line for line in lines if line.strip()]
    whole = [line for line in rows if len(_split(line, delimiter)) == width]
    lost = len(rows) - len(whole)
    # The last row of a log that was stopped by its plug is cut.
    if lost > max(1, MAX_LOST_SHARE * len(rows)):
        what = f"{lost} of {len(rows)} rows have another number of cells than {width}"
        raise InputError("E-FIELDS", str(path), what, "Export the run again.")
    text = io.StringIO("\n".join(line.strip(" ") for line in whole))
    separator = r"\s+" if delimiter is None else delimiter
    frame = pd.read_csv(text, sep=separator, header=None, decimal=decimal, skipinitialspace=True, low_memory=False)
    values = np.full((len(frame), width), np.nan)
    words: dict[int, list[str]] = {}
    for column in range(width):
        cells = frame[column]
        numbers = pd.to_numeric(cells, errors="coerce").to_numpy(np.float64)
        values[:, column] = numbers
        if not np.isfinite(numbers).any() and cells.notna().any():
            words[column] = [str(cell) for cell in cells]
    return values, words
