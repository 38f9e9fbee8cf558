"""How the numbers that decide a verdict change the verdicts: stored evidence of scored blind tests, decided again.

    python benchmarks/calibration.py SET... [--chart reliability.png]

First, how often each word was right. Then each number of `calibration.toml` is moved alone; a table says how many
verdicts each value changes, and what becomes of the scores. The chart compares stated probabilities with the share of
verdicts that are right.
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

from rockref.blind.scoring.evaluation import OPENED
from rockref.blind.scoring.intervals import by_word, reliability
from rockref.blind.scoring.judging import EVIDENCE, VERDICT, decided_from
from rockref.blind.scoring.marks import mark
from rockref.discover.evidence.evidence import Evidence
from rockref.discover.verdict.calibration import Calibration, calibration

#: Values that are tried of each number.
TRIED = {
    "temperature": (1, 1.5, 2, 3, 4, 5, 7, 12, 25),
    "companion": (0, 40, 75, 150, 300),
    "prior_odds": (0.2, 0.1, 0.05, 0.02, 0.005),
    "certain": (0.8, 0.9, 0.95, 0.99),
    "least_amplitude": (0.05, 0.1, 0.2, 0.3),
    "misfit": (1.0, 1.05, 1.1, 1.2, 1.5),
    "misfit_of_run": (1.05, 1.15, 1.25, 1.5, 2.0),
    "proof": (0.0, 0.1, 0.25, 0.5),
    "remnant": (0.0, 0.02, 0.05, 0.1, 0.2),
}

Case = tuple[dict[str, Any], dict[str, Any], Evidence]


def cases_of(folders: list[Path]) -> list[Case]:
    """Return truth, stored verdict and evidence of all cases that have evidence."""
    found = []
    for folder in folders:
        for truth in json.loads((folder / OPENED).read_text(encoding="utf-8"))["cases"]:
            place = folder / truth["name"]
            if (place / EVIDENCE).exists():
                stored = json.loads((place / VERDICT).read_text(encoding="utf-8"))
                found.append((truth, stored, Evidence.load(place / EVIDENCE)))
    return found


def marks_of(cases: list[Case], numbers: Calibration) -> list[dict[str, Any]]:
    """Return the marks of all cases, decided by these numbers."""
    return [mark(truth, decided_from(evidence, stored, numbers)) for truth, stored, evidence in cases]


def summary(marks: list[dict[str, Any]]) -> str:
    """Return the scores that matter in a line."""
    kinds = Counter(m["kind"] for m in marks)
    counted = {
        "controls not none": (sum(m.get("false_alarm", False) for m in marks), kinds["control"]),
        "single first": (sum(m.get("first", False) for m in marks if m["kind"] == "single"), kinds["single"]),
        "pairs both": (sum(m.get("both", False) for m in marks), kinds["pair"]),
        "unlisted effects": (sum(m.get("abstained", False) for m in marks), kinds["unlisted"]),
        "wrong name": (sum(m["wrong_name"] for m in marks), len(marks)),
        "right": (sum(m["right"] for m in marks), len(marks)),
    }
    inside = [c for m in marks for c in m.get("covered", ())]
    covers = f"intervals {sum(inside)}/{len(inside)}"
    return "; ".join([*(f"{name} {hits}/{n}" for name, (hits, n) in counted.items()), covers])


def chart(marks: list[dict[str, Any]], path: Path) -> None:
    """Draw stated probabilities against the share of verdicts that are right, with Wilson intervals."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    rows = reliability(marks)
    figure, axes = plt.subplots(figsize=(4.2, 4.0), layout="constrained")
    axes.plot([0, 1], [0, 1], color="0.6", linewidth=1)
    stated = [r["stated"] for r in rows]
    share = [r["right"] / r["n"] for r in rows]
    below = [s - r["low"] for s, r in zip(share, rows, strict=True)]
    above = [r["high"] - s for s, r in zip(share, rows, strict=True)]
    axes.errorbar(stated, share, [below, above], fmt="o", capsize=3)
    for r, s in zip(rows, share, strict=True):
        axes.annotate(str(r["n"]), (r["stated"], s), xytext=(6, -12), textcoords="offset points", fontsize=8)
    axes.set(
        xlim=(0, 1.02),
        ylim=(0, 1.05),
        xlabel="stated probability, mean of a bin",
        ylabel="share of verdicts that are right",
    )
    figure.savefig(path, dpi=120)


def main() -> None:
    """Print the tables of the sets that are named."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="+", type=Path)
    parser.add_argument("--chart", type=Path)
    given = parser.parse_args()
    cases, numbers = cases_of(given.sets), calibration()
    today = marks_of(cases, numbers)
    print(f"{len(cases)} cases; today: {summary(today)}")
    for row in by_word(today):
        print(f"  {row['verdict']}: right {row['right']} of {row['n']}")
    for name, values in TRIED.items():
        for value in values:
            marks = marks_of(cases, replace(numbers, **{name: float(value)}))
            words = zip(today, marks, strict=True)
            changed = sum((a["verdict"], a["said"]) != (b["verdict"], b["said"]) for a, b in words)
            print(f"{name} = {value:g}: {changed} changed; {summary(marks)}")
    if given.chart:
        chart(today, given.chart)


if __name__ == "__main__":
    main()
