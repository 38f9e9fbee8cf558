"""What `mutmut run` found, against the floors of `docs/mutation.md` and known survivors: ``python -m tests.mutation``.

A mutant that a test fails on, or whose tests do not come to an end, is killed; one that no test reaches survives. The
score is the killed ones of all. Exit code 1 where it is below the floor of a folder, or where a mutant has no verdict.
"""

from __future__ import annotations

import csv
import json
import re
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
KNOWN = ROOT / "benchmarks" / "mutation_survivors.csv"

#: Exit codes of a mutant's tests, as mutmut writes them: pytest's own, a run that was cut off, no tests (33).
KILLED, TIMEOUT, SURVIVED = {1, 3}, {36, 24, -24, 152, 255}, {0, 5, 33}


class Score(NamedTuple):
    """How many mutants there are, how many were killed (timeouts among them), which survived, which are undecided."""

    all: int
    killed: int
    timeouts: int
    survivors: list[str]
    undecided: list[str]

    @property
    def percent(self) -> float:
        return 100 * self.killed / self.all if self.all else 0.0


def readable(mutant: str) -> str:
    """`rockref.model.contact.x_norm__mutmut_9` is "model.contact.norm 9"; a method has its class before it."""
    function, number = mutant.removeprefix("rockref.").split("__mutmut_")
    folder, _, name = function.rpartition(".")
    name = name.removeprefix("x").removeprefix("_") if "ǁ" not in name else name.removeprefix("xǁ").replace("ǁ", ".")
    return f"{folder}.{name} {number}"


def score(verdicts: dict[str, int | None]) -> Score:
    """The score of mutants with their exit codes."""
    names = {readable(mutant): code for mutant, code in verdicts.items()}
    killed = [name for name, code in names.items() if code in KILLED | TIMEOUT]
    return Score(
        all=len(names),
        killed=len(killed),
        timeouts=sum(names[name] in TIMEOUT for name in killed),
        survivors=[name for name, code in names.items() if code in SURVIVED],
        undecided=[name for name, code in names.items() if code not in KILLED | TIMEOUT | SURVIVED],
    )


def found(mutants: Path) -> dict[str, dict[str, int | None]]:
    """Exit codes of the mutants of every file, from the folder that mutmut works in."""
    files = sorted(mutants.rglob("*.py.meta"))
    codes = {str(f.relative_to(mutants))[: -len(".meta")]: json.loads(f.read_text("utf-8")) for f in files}
    return {name: meta["exit_code_by_key"] for name, meta in codes.items() if meta["exit_code_by_key"]}


def listed(lines: Iterable[str]) -> set[str]:
    """The survivors in the lines of a table: a row of `model.contact.norm` and "9, 29" tells two."""
    rows = csv.DictReader(lines)
    return {f"{row['function']} {number}" for row in rows for number in row["mutants"].split(", ")}


def floors_of(page: str) -> dict[str, float]:
    """The floor of each folder [%], which stand on the page: "97.00 % in `rockref/model`"."""
    stated = re.findall(r"(\d+\.\d+) % in `rockref/(\w+)`", page)
    if not stated:
        raise LookupError("docs/mutation.md does not state a floor")
    return {folder: float(percent) for percent, folder in stated}


def report(by_file: dict[str, dict[str, int | None]], page: str, known: set[str]) -> tuple[str, bool]:
    """What to print, and whether the floors of the page hold; `known` are survivors that nothing can be done about."""
    lines = [f"{'file':40} {'mutants':>8} {'killed':>8} {'timeouts':>8} {'survived':>8}"]
    for name, verdicts in by_file.items():
        s = score(verdicts)
        lines.append(f"{name:40} {s.all:8} {s.killed:8} {s.timeouts:8} {len(s.survivors):8}")
    total = score({mutant: code for verdicts in by_file.values() for mutant, code in verdicts.items()})
    lines += [f"survived, and not in {KNOWN.name}: {name}" for name in total.survivors if name not in known]
    lines += [f"in {KNOWN.name}, and no survivor: {name}" for name in sorted(known - set(total.survivors))]
    lines += [f"without a verdict: {name}" for name in total.undecided]
    holds = not total.undecided
    for folder, floor in floors_of(page).items():
        inside = [verdicts for name, verdicts in by_file.items() if name.startswith(f"rockref/{folder}/")]
        s = score({mutant: code for verdicts in inside for mutant, code in verdicts.items()})
        lines.append(f"{folder}: {s.killed} of {s.all} mutants killed: {s.percent:.2f} %, the floor is {floor:.2f} %")
        holds = holds and s.percent >= floor
    return "\n".join(lines), holds


def main() -> int:
    known = listed(KNOWN.read_text("utf-8").splitlines())
    text, holds = report(found(ROOT / "mutants"), (ROOT / "docs" / "mutation.md").read_text("utf-8"), known)
    print(text)
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
