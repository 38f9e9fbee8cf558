"""Write `docs/reference/zoo.md` from `benchmarks/zoo.csv`: ``python docs/make_zoo.py``."""

from __future__ import annotations

import csv
from pathlib import Path

from rockref.conformance.faults.table import page

ROOT = Path(__file__).resolve().parents[1]
SOURCE = ROOT / "benchmarks" / "zoo.csv"
PAGE = ROOT / "docs" / "reference" / "zoo.md"


def text() -> str:
    """Return the page."""
    with SOURCE.open(encoding="utf-8", newline="") as file:
        return page(list(csv.reader(file))[1:])


def write() -> None:
    """Write the page."""
    PAGE.write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    write()
