"""Which branches the tests take, folder by folder: ``python -m tests.covered .coverage.json`` (see `make coverage`).

The file is that of `coverage json`. Files that are less than LEAST covered follow, the least covered first, each with
the lines that a branch is missing from.
"""

from __future__ import annotations

import json
import sys
from collections import defaultdict
from pathlib import Path

#: Per cent of a folder's branches that its tests are to take.
LEAST = 95.0


def folders(files: dict) -> dict[str, list[int]]:
    """Branches taken, branches, lines run, lines: of each folder of the package."""
    found: dict[str, list[int]] = defaultdict(lambda: [0, 0, 0, 0])
    for file, facts in files.items():
        parts = Path(file).parts
        own, total = facts["summary"], found["/".join(parts[:2]) if len(parts) > 2 else parts[0]]
        for i, key in enumerate(("covered_branches", "num_branches", "covered_lines", "num_statements")):
            total[i] += own[key]
    return dict(found)


def percent(part: int, all: int) -> float:
    """Of nothing, all of it."""
    return 100.0 * part / all if all else 100.0


def main(path: str) -> None:
    """Print the tables."""
    files = json.loads(Path(path).read_text())["files"]
    print(f"{'folder':24s} {'branches':>18s} {'lines':>18s}")
    for name, (branches, all_branches, lines, all_lines) in sorted(folders(files).items()):
        own = f"{branches} of {all_branches}, {percent(branches, all_branches):.0f} %"
        print(f"{name:24s} {own:>18s} {lines:6d} of {all_lines}, {percent(lines, all_lines):.0f} %")
    rows = []
    for file, facts in files.items():
        taken = percent(facts["summary"]["covered_branches"], facts["summary"]["num_branches"])
        if taken < LEAST:
            rows.append((taken, file, sorted({abs(begin) for begin, _ in facts["missing_branches"]})))
    for taken, file, lines in sorted(rows):
        print(f"{taken:5.0f} % {file}: {', '.join(map(str, lines))}")


if __name__ == "__main__":
    main(sys.argv[1])
