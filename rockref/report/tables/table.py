"""A table of texts, for the terminal and for the page alike."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


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
