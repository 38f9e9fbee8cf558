"""Write `docs/reference/figures.md`, and the table of figures of `README.md`, from `docs/figures.toml`."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
README = ROOT / "README.md"
PAGE = ROOT / "docs" / "reference" / "figures.md"
SOURCE = ROOT / "docs" / "figures.toml"
#: What the README links to as a table in the project, and the page that is made of it.
MADE = {
    "benchmarks/zoo.csv": "docs/reference/zoo.md",
    "benchmarks/blind_history.csv": "docs/explanation/blind_history.md",
    "benchmarks/judged.csv": "docs/reference/judged.md",
}
BEGIN, END = "<!-- figures: begin -->", "<!-- figures: end -->"


def read() -> dict[str, Any]:
    """The measured results: `machines` and `parts` by their short names, and the list `row`."""
    return tomllib.loads(SOURCE.read_text(encoding="utf-8"))


def measured(row: dict[str, Any]) -> str:
    """When a figure was measured, and on what."""
    return f"{row['date']}" if row["machine"] == "any" else f"{row['date']}, {row['machine']}"


def machines(found: dict[str, Any], rows: list[dict[str, Any]]) -> str:
    """What the short names of the machines of some rows stand for."""
    used = [name for name in found["machines"] if name != "any" and any(r["machine"] == name for r in rows)]
    return "; ".join(f"*{name}* is {found['machines'][name]}" for name in used)


def table(rows: Iterable[dict[str, Any]]) -> list[str]:
    """A line for each figure."""
    lines = ["| what | figure | measured by | measured on |", "| --- | --- | --- | --- |"]
    for row in rows:
        command = f"`{row['command']}`" if row["command"] else "by hand, once"
        lines.append(f"| {row['what']} | {row['figure']} | {command} | {measured(row)} |")
    return lines


def readme(text: str) -> str:
    """The README with the table of the figures that have few words for it between its two markers."""
    part = re.compile(rf"(?<={BEGIN}\n).*?(?=\n{END})", re.DOTALL)
    if not part.search(text):
        raise SystemExit(f"{README.name} has no lines {BEGIN} and {END}")
    found = read()
    rows = [row for row in found["row"] if row["readme"]]
    lines = ["| what | figure | measured by |", "| --- | --- | --- |"]
    lines += [f"| {row['what']} | {row['readme']} | `{row['command']}` |" for row in rows]
    days = sorted(row["date"] for row in rows)
    lines += [
        "",
        f"Measured from {days[0]} to {days[-1]}; [all figures, with day and machine](docs/figures.toml).",
    ]
    return part.sub(lambda _: "\n".join(lines), text)


def page() -> str:
    """All figures, part by part. Links are written from the root of the project, and shortened here."""
    found = read()
    lines = [
        "# Figures",
        "",
        "Each figure with the command that measures it again, the day on which it was measured, and the machine where",
        f"it depends on one: {machines(found, found['row'])}. `make bench` measures the speeds on yours.",
    ]
    for part, title in found["parts"].items():
        lines += ["", f"## {title}", "", *table(row for row in found["row"] if row["part"] == part)]
    text = "\n".join(lines) + "\n"
    for file, built in MADE.items():
        text = text.replace(f"]({file})", f"]({built})")
    return text.replace("](docs/reference/", "](").replace("](docs/", "](../")


def write() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    README.write_text(readme(README.read_text(encoding="utf-8")), encoding="utf-8")
    write()
