"""Measure how well the judge judges, and write `benchmarks/judged.csv`: `python benchmarks/judged.py [PART...]`.

Parts: first, second, third (lists of mistakes), scheme (other integrators), variants (correct ones), zoo. What is not
measured keeps its rows; the rows of a first judgement are never written anew. Without a part all are measured: a
quarter of an hour of processor time. `python docs/make_judge_table.py` makes the table of the documentation of it.
"""

from __future__ import annotations

import csv
import json
import subprocess
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import strangers
import strangers_controls
import strangers_controls_c

FILE = Path(__file__).with_name("judged.csv")
ZOO_PAGE = Path(__file__).resolve().parents[1] / "docs/reference/zoo.md"
COLUMNS = ("judged", "way", "when", "asked", "detected", "named", "top_two")
PARTS = (*strangers.LISTS, "scheme", "variants", "zoo")
Row = dict[str, Any]


def of_list(part: str) -> Iterator[Row]:
    """A list of mistakes, by pieces, by runs, by runs without forces."""
    pairs = strangers.of_schemes() if part == "scheme" else ((m, None) for m in strangers.LISTS[part])
    counts = strangers.counted([strangers.of_mistake(m, scheme) for m, scheme in pairs])
    for way, row in counts.items():
        yield {"way": way, "top_two": row["top two"]} | {k: row[k] for k in ("asked", "detected", "named")}


def of_zoo(_: str) -> Iterator[Row]:
    """Mistakes that the vectors were admitted by, and controls; by runs with the fingerprints, and without its own.

    Writes the page of the zoo, too.
    """
    command = [sys.executable, "-m", "rockref", "conform", "zoo", "--json", "--output", str(ZOO_PAGE)]
    found = json.loads(subprocess.run(command, capture_output=True, text=True).stdout)
    n = found["planted"]
    yield {"way": "pieces", "asked": n, "detected": found["detected"], "named": found["attributed"]}
    yield {"way": "runs", "asked": n, "top_two": found["attributed_black_box"]}
    yield {"way": "runs, each as if it were new", "asked": n, "top_two": found["attributed_black_box_unknown"]}
    yield {"way": "controls", "asked": found["controls"], "detected": found["controls_rejected"]}


def of_variants(_: str) -> Iterator[Row]:
    """Correct variants, of which none is to be rejected."""
    asked = len(strangers_controls.IN_PYTHON) + len(strangers_controls_c.IN_C)
    yield {"way": "pieces and runs", "asked": asked, "detected": strangers.controls("")}


def kept(parts: tuple[str, ...]) -> list[Row]:
    """The rows that are there already and are not measured."""
    if not FILE.exists():
        return []
    with FILE.open(encoding="utf-8", newline="") as file:
        return [row for row in csv.DictReader(file) if row["judged"] not in parts or row["when"] == "first"]


def main(parts: tuple[str, ...]) -> int:
    """Measure the parts, and write all rows in order."""
    if unknown := [p for p in parts if p not in PARTS]:
        print(f"{unknown[0]} is none of {', '.join(PARTS)}", file=sys.stderr)
        return 2
    rows = kept(parts)
    for part in parts:
        measure = {"zoo": of_zoo, "variants": of_variants}.get(part, of_list)
        rows += [{"judged": part, "when": "now", **row} for row in measure(part)]
        rows.sort(key=lambda row: (PARTS.index(row["judged"]), row["when"] != "first"))
        with FILE.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, restval="", lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    return 0


if __name__ == "__main__":
    warnings.simplefilter("ignore", RuntimeWarning)
    raise SystemExit(main(tuple(sys.argv[1:]) or PARTS))
