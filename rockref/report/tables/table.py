"""A table of texts, for the terminal and for the page alike, and numbers as texts."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Table:
    """A table of texts: ``caption``, ``columns``, ``rows`` (the first text of a row heads it); ``note`` below it.

    ``prose`` is for words, which are set left and may break; numbers are set right.
    """

    caption: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str]]
    note: str = ""
    prose: bool = False


def table_of(
    items: Iterable[Any], caption: str, columns: Mapping[str, Callable[[Any], str]], note: str = "", prose: bool = False
) -> Table:
    """Return a table with a row for each item: `columns` has the headings, and what each says of an item."""
    return Table(caption, tuple(columns), [[say(item) for say in columns.values()] for item in items], note, prose)


def number(value: float | None, digits: int = 2, plus: bool = False) -> str:
    """Return a number with so many digits behind the point, an en dash for what is not known."""
    if value is None or not math.isfinite(value):
        return "\u2013"
    return f"{value:{'+' if plus else ''}.{digits}f}"


def figures(value: float | None, count: int = 3) -> str:
    """Return a number with so many figures, as people write it; infinite (None in a record) as a sign."""
    if value is None or math.isinf(value):
        return "-∞" if value is not None and value < 0 else "∞"
    size = abs(value)
    return f"{value:.{count}g}" if size == 0 or 1e-3 <= size < 10.0 ** (count + 1) else f"{value:.{count - 1}e}"


def with_unit(unit: str) -> str:
    """Return a unit as it stands in a table: empty for a pure number."""
    return "" if unit == "1" else unit
