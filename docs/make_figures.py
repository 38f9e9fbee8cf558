"""Write the table of figures of `README.md` from `docs/figures.toml`: ``python docs/make_figures.py``."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
README = ROOT / "README.md"
SOURCE = ROOT / "docs" / "figures.toml"
BEGIN, END = "<!-- figures: begin -->", "<!-- figures: end -->"


def read() -> dict[str, Any]:
    """The measured results: `machines` by their short name, and the list `row`."""
    return tomllib.loads(SOURCE.read_text(encoding="utf-8"))


def measured(row: dict[str, Any]) -> str:
    """When a figure was measured, and on what."""
    return f"{row['date']}" if row["machine"] == "any" else f"{row['date']}, {row['machine']}"


def table(found: dict[str, Any]) -> str:
    """The machines in a sentence, and a line for each figure."""
    used = [name for name in found["machines"] if name != "any" and any(r["machine"] == name for r in found["row"])]
    where = "; ".join(f"*{name}* is {found['machines'][name]}" for name in used)
    lines = [
        "Each figure with the command that measures it again, the day on which it was measured, and the machine",
        f"where it depends on one: {where}.",
        "`docs/make_figures.py` writes this table from `docs/figures.toml`; `make bench` measures the speeds on yours.",
        "",
        "| what | figure | measured by | measured on |",
        "| --- | --- | --- | --- |",
    ]
    for row in found["row"]:
        command = f"`{row['command']}`" if row["command"] else "by hand, once"
        lines.append(f"| {row['what']} | {row['figure']} | {command} | {measured(row)} |")
    return "\n".join(lines)


def page(text: str) -> str:
    """The README with the table between its two markers."""
    part = re.compile(rf"(?<={BEGIN}\n).*?(?=\n{END})", re.DOTALL)
    if not part.search(text):
        raise SystemExit(f"{README.name} has no lines {BEGIN} and {END}")
    return part.sub(lambda _: table(read()), text)


if __name__ == "__main__":
    README.write_text(page(README.read_text(encoding="utf-8")), encoding="utf-8")
