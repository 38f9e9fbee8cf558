"""Write `docs/explanation/blind_history.md` from `benchmarks/blind_history.csv`."""

from __future__ import annotations

import csv
from pathlib import Path

from rockref.blind.scoring.intervals import wilson

ROOT = Path(__file__).resolve().parents[1]
SOURCE = ROOT / "benchmarks" / "blind_history.csv"
PAGE = ROOT / "docs" / "explanation" / "blind_history.md"
#: Shares: heading, column of the hits, column of their number.
SHARES = (
    ("false alarms on controls", "alarms", "controls"),
    ("single effects first", "first", "singles"),
    ("pairs, both named", "both", "pairs"),
    ("unlisted effects, right axis and phase", "right_card", "outsiders"),
    ("matched pairs", "twins_right", "twins"),
    ("wrong names", "wrong_names", "n"),
    ("numbers inside their interval", "inside", "intervals"),
)
#: Methods: key in the source, heading, what it does.
METHODS = (
    (
        "listening",
        "A model that listens",
        "Each run is simulated once, from its release, and listens to the gyroscope.",
    ),
    ("windows", "Windows", "The model was restarted in short windows; all cases are near Table 3.1."),
)
HEAD = """# The blind test, set by set

Each row is a set of the [blind test](blind_test.md), or the part of one that one version of the discoverer diagnosed,
in order. Verdicts stood before the truth of the row was opened. A set has the number of its seed; its blocks are `near`
Table 3.1 or `other` ones. An interval is to hold nine numbers in ten. An empty cell was not measured, or nothing of the
kind was drawn. Seconds a case are the median: by the `clock`, two at a time on two cores; by the clock on a `shared`
machine; of `processor` time of one thread.
"""


def rows() -> list[dict[str, str]]:
    """The sets, in order."""
    with SOURCE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def share(row: dict[str, str], hits: str, n: str) -> str:
    """Hits of a number, or nothing where there is none."""
    return f"{row[hits]} of {row[n]}" if row[hits] and row[n] not in ("", "0") else ""


def line(row: dict[str, str]) -> str:
    """A set as a row of the table."""
    error = row["size_error_percent"] and f"{row['size_error_percent']} %"
    seconds = row["seconds_median"] and f"{row['seconds_median']} ({row['clock']})"
    cells = [
        row["set"],
        row["blocks"],
        row["cases"],
        *(share(row, hits, n) for _, hits, n in SHARES),
        error,
        seconds,
        row["note"],
    ]
    return f"| {' | '.join(cells)} |"


def total(found: list[dict[str, str]], hits: str, n: str) -> str:
    """All hits of all numbers, with the 95 % Wilson interval."""
    counted = [row for row in found if row[hits] and row[n]]
    a, b = (sum(int(row[key]) for row in counted) for key in (hits, n))
    if not b:
        return "-"
    low, high = wilson(a, b)
    return f"{a} of {b} ({100 * low:.1f} to {100 * high:.1f} %)"


def section(key: str, title: str, words: str) -> str:
    """Return the table of the sets of one method, and their totals."""
    found = [row for row in rows() if row["method"] == key]
    if not found:
        return ""
    heads = ["set", "blocks", "cases", *(head for head, _, _ in SHARES), "size, median error", "seconds a case", "note"]
    lines = [f"## {title}", "", words, "", f"| {' | '.join(heads)} |"]
    lines += ["| --- | --- | --- |" + " ---: |" * (len(heads) - 4) + " --- |", *map(line, found)]
    blocks = list(dict.fromkeys(row["blocks"] for row in found))
    lines += ["", "Together, with 95 % Wilson intervals:", "", f"| score | {' | '.join(blocks)} |"]
    lines += ["| --- |" + " --- |" * len(blocks)]
    for head, hits, n in SHARES:
        cells = [total([row for row in found if row["blocks"] == b], hits, n) for b in blocks]
        lines.append(f"| {head} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def text() -> str:
    """Return the page."""
    return "\n".join(part for part in (HEAD, *(section(*method) for method in METHODS)) if part)


def write() -> None:
    """Write the page."""
    PAGE.write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    write()
