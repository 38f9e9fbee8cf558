"""Write the table of `docs/reference/judged.md` on how well the judge judges, from `benchmarks/judged.csv`."""

from __future__ import annotations

import csv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SOURCE = ROOT / "benchmarks" / "judged.csv"
TABLE = ROOT / "docs" / "reference" / "judged_table.inc"
HEAD = "| what is judged | shown | asked | detected | named by the right rule | in the top two |"
NAMES = {"scheme": "mistakes in other integrators", "variants": "correct variants", "zoo": "zoo"}


def name(judged: str) -> str:
    """What is judged, in words: a list by its number, with its mistakes as they are or in other integrators."""
    number, _, scheme = judged.partition(" ")
    return NAMES.get(judged) or f"list {number}" + (", in other integrators" if scheme else "")


def rows() -> list[dict[str, str]]:
    """What was measured, in order."""
    with SOURCE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def cell(now: dict[str, str], first: dict[str, str] | None, key: str) -> str:
    """A count, with that of the first judgement before it where that was another one."""
    before = first[key] if first else ""
    if not before or before == now[key]:
        return now[key]
    of = f" of {first['asked']}" if first and first["asked"] != now["asked"] else ""
    return f"{before}{of}, now {now[key]}"


def table() -> list[str]:
    """The lines of the table."""
    found = rows()
    first = {(r["judged"], r["way"]): r for r in found if r["when"] == "first"}
    lines = [HEAD, "| --- | --- |" + " ---: |" * 4]
    for row in found:
        if row["when"] == "first":
            continue
        before = first.get((row["judged"], row["way"]))
        counts = [cell(row, before, key) for key in ("detected", "named", "top_two")]
        if row["judged"] == "variants" or row["way"] == "controls":
            counts[0] = f"{counts[0]} rejected"
        lines.append(f"| {name(row['judged'])} | {row['way']} | {row['asked']} | {' | '.join(counts)} |")
    return lines


def write() -> None:
    """Write the table where the page takes it from."""
    TABLE.write_text("\n".join(table()) + "\n", encoding="utf-8")


if __name__ == "__main__":
    write()
