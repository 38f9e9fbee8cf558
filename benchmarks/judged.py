"""Measure how well the judge judges, and write `benchmarks/judged.csv`: `python benchmarks/judged.py [PART...]`.

Parts: first to fourth (lists of mistakes), scheme and "fourth scheme" (other integrators), variants (correct ones),
zoo. What is not measured keeps its rows; the rows of a first judgement are never written anew. Without a part all are
measured: half an hour of processor time. `python docs/make_judge_table.py` makes the table of the documentation of it.
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

FILE = Path(__file__).with_name("judged.csv")
ZOO_PAGE = Path(__file__).resolve().parents[1] / "docs/reference/zoo.md"
COLUMNS = ("judged", "way", "when", "asked", "detected", "named", "top_two")
OF_SCHEMES = {
    "scheme": strangers.of_schemes,
    "fourth scheme": strangers.of_fourth_schemes,
    "fifth scheme": strangers.of_fifth_schemes,
}
PARTS = (*strangers.LISTS, *OF_SCHEMES, "variants", "zoo")
Row = dict[str, Any]


def of_list(part: str) -> Iterator[Row]:
    """A list of mistakes, by pieces, by runs, by runs without forces."""
    pairs = OF_SCHEMES[part]() if part in OF_SCHEMES else ((m, None) for m in strangers.LISTS[part])
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
    asked = len(strangers.IN_PYTHON) + len(strangers.IN_C) + len(strangers.STEPS)
    yield {"way": "pieces and runs", "asked": asked, "detected": strangers.controls("")}


def written() -> list[Row]:
    """The rows that are there already."""
    if not FILE.exists():
        return []
    with FILE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def main(parts: tuple[str, ...]) -> int:
    """Measure the parts, and write all rows in order."""
    if unknown := [p for p in parts if p not in PARTS]:
        print(f"{unknown[0]} is none of {', '.join(PARTS)}", file=sys.stderr)
        return 2
    before = written()
    rows = [row for row in before if row["judged"] not in parts or row["when"] == "first"]
    for part in parts:
        measure = {"zoo": of_zoo, "variants": of_variants}.get(part, of_list)
        made = list(measure(part))
        known = any(row["judged"] == part for row in before)
        for when in ("now",) if known else ("first", "now"):
            rows += [{"judged": part, "when": when, **row} for row in made]
        rows.sort(key=lambda row: (PARTS.index(row["judged"]), row["when"] != "first"))
        with FILE.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, restval="", lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    return 0


if __name__ == "__main__":
    warnings.simplefilter("ignore", RuntimeWarning)
    raise SystemExit(main(tuple(sys.argv[1:]) or PARTS))
