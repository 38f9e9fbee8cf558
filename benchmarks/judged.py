"""Measure how well the judge judges, and write `benchmarks/judged.csv`: `python benchmarks/judged.py [PART...]`.

Parts: the numbers of the lists, "scheme" and such as "4 scheme" (lists in other integrators), variants (correct ones),
zoo. What is not measured keeps its rows; the rows of a first judgement are never written anew. Without a part all are
measured: hours of processor time. Each mistake that is judged is kept in `judged.partial` beside: whoever is
interrupted types the same again, and goes on where the measurement ended, unless the judge has changed since. What is
not named is printed. `python docs/make_judge_table.py` makes the table of the documentation of it.
"""

from __future__ import annotations

import csv
import hashlib
import json
import os
import subprocess
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from strangers import correct, judging, planting, registry, report

FILE = Path(__file__).with_name("judged.csv")
ROOT = FILE.parents[1]
KEPT = FILE.with_suffix(".partial")
ZOO = ROOT / "benchmarks/zoo.csv"
COLUMNS = ("judged", "way", "when", "asked", "detected", "named", "top_two")
PARTS = (*registry.LISTS, *judging.OF_SCHEMES, "variants", "zoo")
Row = dict[str, Any]


def judge_digest() -> str:
    """What judges, as a digest: vectors, code, and the texts in which the mistakes are planted."""
    parts = [*(ROOT / "rockref/conformance").rglob("*"), *FILE.parent.glob("strangers/*.py"), planting.SOURCE]
    digest = hashlib.sha256()
    for path in sorted(p for p in parts if p.is_file() and "__pycache__" not in p.parts):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def kept(digest: str) -> dict[str, Any]:
    """What was judged already by this judge, by part and mistake; a line that was not written whole is passed over."""
    found = {}
    for line in KEPT.read_text(encoding="utf-8").splitlines() if KEPT.exists() else ():
        try:
            entry = json.loads(line)
        except json.JSONDecodeError:
            continue
        if entry["judge"] == digest:
            found[entry["key"]] = entry["found"]
    return found


def of_list(part: str) -> Iterator[Row]:
    """A list of mistakes, by pieces, by runs, by runs without forces."""
    digest = judge_digest()
    known, found = kept(digest), []
    pairs = (
        list(judging.OF_SCHEMES[part]()) if part in judging.OF_SCHEMES else [(m, None) for m in registry.LISTS[part]]
    )
    for mistake, scheme in pairs:
        key = f"{part}: {mistake.says}, {scheme}"
        if key not in known:
            known[key] = judging.of_mistake(mistake, scheme)
            with KEPT.open("a", encoding="utf-8") as file:
                file.write(json.dumps({"judge": digest, "key": key, "found": known[key]}) + "\n")
        found.append(known[key])
        print(f"{part}: {len(found)} of {len(pairs)}", file=sys.stderr, flush=True)
    report.show(found, [], as_json=False)
    for way, row in report.counted(found).items():
        yield {"way": way, "top_two": row["top two"]} | {k: row[k] for k in ("asked", "detected", "named")}


def of_zoo(_: str) -> Iterator[Row]:
    """Mistakes that the vectors were admitted by, and controls; by runs with the fingerprints, and without its own.

    Writes the table of the zoo, too.
    """
    command = [sys.executable, "-m", "rockref", "conform", "zoo", "--json", "--output", str(ZOO)]
    found = json.loads(subprocess.run(command, capture_output=True, text=True).stdout)
    n = found["planted"]
    yield {"way": "pieces", "asked": n, "detected": found["detected"], "named": found["attributed"]}
    yield {"way": "runs", "asked": n, "top_two": found["attributed_black_box"]}
    yield {"way": "runs, each as if it were new", "asked": n, "top_two": found["attributed_black_box_unknown"]}
    yield {"way": "controls", "asked": found["controls"], "detected": found["controls_rejected"]}


def of_variants(_: str) -> Iterator[Row]:
    """Correct variants, of which none is to be rejected."""
    asked = len(registry.IN_PYTHON) + len(registry.IN_C) + len(registry.STEPS)
    yield {"way": "pieces and runs", "asked": asked, "detected": correct.controls("")}


def written() -> list[Row]:
    """The rows that are there already."""
    if not FILE.exists():
        return []
    with FILE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def write(rows: list[Row]) -> None:
    """Write all rows in order, whole or not at all."""
    new = FILE.with_suffix(".csv.partial")
    with new.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(rows, key=lambda row: (PARTS.index(row["judged"]), row["when"] != "first")))
    os.replace(new, FILE)


def main(parts: tuple[str, ...]) -> int:
    """Measure part by part; the rows of a part are exchanged when all of it is measured."""
    if unknown := [p for p in parts if p not in PARTS]:
        print(f"{unknown[0]} is none of {', '.join(PARTS)}", file=sys.stderr)
        return 2
    for part in parts:
        made = list({"zoo": of_zoo, "variants": of_variants}.get(part, of_list)(part))
        rows = written()
        known = any(row["judged"] == part for row in rows)
        rows = [row for row in rows if row["judged"] != part or row["when"] == "first"]
        for when in ("now",) if known else ("first", "now"):
            rows += [{"judged": part, "when": when, **row} for row in made]
        write(rows)
    return 0


if __name__ == "__main__":
    warnings.simplefilter("ignore", RuntimeWarning)
    raise SystemExit(main(tuple(sys.argv[1:]) or PARTS))
