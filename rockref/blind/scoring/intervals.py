"""How sure a share is, and whether stated probabilities are right."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import Any

from rockref.shake.statistics.bands import wilson_interval

#: Edges of the bins of stated probabilities; the last holds one, and the last but one what a sure verdict says.
EDGES = (0.0, 0.5, 0.7, 0.85, 0.95, 1.0)


def wilson(hits: int, n: int) -> tuple[float, float]:
    """Return the 95 % Wilson interval of a share of `hits` in `n` (0 to 1 if n is 0)."""
    return wilson_interval(hits, n) if n else (0.0, 1.0)


def reliability(marks: Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """Compare stated probabilities with the share of verdicts that are right.

    Returns a row for each bin that is not empty: `from`, `to`, `stated` (mean probability), `right`, `n`, and the
    Wilson interval `low`, `high` of the share. Calibrated verdicts have `stated` inside it.
    """
    said = [m for m in marks if m.get("probability") is not None]
    rows = []
    for low, high in pairwise(EDGES):
        inside = [m for m in said if low <= m["probability"] < high or m["probability"] == high == EDGES[-1]]
        if inside:
            hits, n = sum(m["right"] for m in inside), len(inside)
            interval = dict(zip(("low", "high"), wilson(hits, n), strict=True))
            stated = sum(m["probability"] for m in inside) / n
            rows.append({"from": low, "to": high, "stated": stated, "right": hits, "n": n, **interval})
    return rows


def by_word(marks: Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return of each word of a verdict how often it was right: `verdict`, `right`, `n`, and the Wilson interval."""
    said: dict[str, list[bool]] = {}
    for m in marks:
        said.setdefault(m["verdict"], []).append(bool(m["right"]))
    rows = []
    for word, right in sorted(said.items(), key=lambda item: -len(item[1])):
        low, high = wilson(sum(right), len(right))
        rows.append({"verdict": word, "right": sum(right), "n": len(right), "low": low, "high": high})
    return rows


def words_as_text(rows: list[dict[str, Any]]) -> str:
    """Return the table of `by_word` in Markdown."""
    lines = ["| verdict | right | interval |", "| --- | ---: | --- |"]
    return "\n".join(lines + [f"| `{r['verdict']}` | {_right(r)} |" for r in rows])


def as_text(rows: list[dict[str, Any]]) -> str:
    """Return the table of stated probabilities in Markdown."""
    lines = ["| probability | stated, mean | right | interval |", "| --- | ---: | ---: | --- |"]
    for r in rows:
        lines.append(f"| {r['from']:g} to {r['to']:g} | {100 * r['stated']:.1f} % | {_right(r)} |")
    return "\n".join(lines)


def _right(r: dict[str, Any]) -> str:
    """Return how many were right, and the interval of the share, as two cells."""
    return f"{r['right']} of {r['n']} | {100 * r['low']:.0f} to {100 * r['high']:.0f} %"
