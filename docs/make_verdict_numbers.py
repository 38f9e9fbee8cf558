"""Write the table of numbers in `docs/explanation/verdicts.md`: ``python docs/make_verdict_numbers.py``."""

from __future__ import annotations

import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SOURCE = ROOT / "rockref" / "discover" / "verdict" / "calibration.toml"
PAGE = ROOT / "docs" / "explanation" / "verdicts.md"
BEGIN, END = "<!-- numbers: begin -->\n", "<!-- numbers: end -->\n"


def table() -> str:
    """Return the numbers as rows: name, value, meaning, how the value was found."""
    numbers = tomllib.loads(SOURCE.read_text(encoding="utf-8"))
    rows = [f"| `{name}` | {n['value']:g} | {n['meaning']} | {n['calibrated']} |\n" for name, n in numbers.items()]
    return "| number | value | meaning | found |\n| --- | ---: | --- | --- |\n" + "".join(rows)


def page(text: str) -> str:
    """Return the page with the table of today between its marks."""
    before, _, rest = text.partition(BEGIN)
    _, _, after = rest.partition(END)
    return before + BEGIN + table() + END + after


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
