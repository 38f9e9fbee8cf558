"""The table of scores of a blind test, near the source and for other blocks, with Wilson intervals and goals."""

from __future__ import annotations

import statistics
from collections.abc import Iterable, Mapping
from typing import Any

from rockref.blind.cases.blocks import NEAR, OTHER
from rockref.blind.cases.plan import CONTROL, FAULTY, MATCHED, PAIR, SINGLE, SIZES, UNLISTED
from rockref.blind.scoring.intervals import wilson

Marks = list[dict[str, Any]]
Limits = tuple[float | None, float | None]
#: Goals by score: least and most, near the source, and for other blocks. Decided as what the discoverer is built for.
GOALS: dict[str, dict[str, Limits]] = {
    "controls: false alarms": {NEAR: (None, 0.0), OTHER: (None, 0.0)},
    "controls: an effect named": {NEAR: (None, 0.0), OTHER: (None, 0.0)},
    "single: truth first": {NEAR: (0.97, None), OTHER: (0.92, None)},
    "all: wrong name": {NEAR: (None, 0.005), OTHER: (None, 0.01)},
    "two effects: both named": {NEAR: (0.90, None), OTHER: (0.80, None)},
    "in no list: something else": {NEAR: (0.97, None), OTHER: (0.95, None)},
    "in no list: with the right axis and phase": {NEAR: (0.97, None), OTHER: (0.95, None)},
    "faulty records: refused": {NEAR: (0.95, None), OTHER: (0.95, None)},
    "gap closed on held-out runs, median": {NEAR: (0.95, None), OTHER: (0.95, None)},
    "size of the effect: relative error, median": {NEAR: (None, 0.02), OTHER: (None, 0.03)},
    "size of the effect: 90 % interval covers": {NEAR: (0.88, 0.93), OTHER: (0.86, 0.94)},
    "seconds a case, median": {NEAR: (None, 45.0), OTHER: (None, 60.0)},
    "seconds a case, longest": {NEAR: (None, 90.0), OTHER: (None, 120.0)},
}


def scores(marks: Marks, block: str = NEAR) -> list[dict[str, Any]]:
    """Return rows with the goals of a kind of block: score, value, low, high, n, goal, met (None without goal or
    case)."""
    rows = _shares(marks) + _numbers(marks)
    for row in rows:
        least, most = GOALS.get(row["score"], {}).get(block, (None, None))
        goals = [f"{sign} {limit:g}" for sign, limit in ((">=", least), ("<=", most)) if limit is not None]
        row["goal"], row["met"], value = " and ".join(goals), None, row["value"]
        if goals and value is not None:
            row["met"] = (least is None or value >= least) and (most is None or value <= most)
    return rows


def _shares(marks: Marks) -> list[dict[str, Any]]:
    """Return shares of verdicts, by kind of case."""
    of = {kind: [m for m in marks if m["kind"] == kind] for kind in (CONTROL, SINGLE, PAIR, UNLISTED, MATCHED, FAULTY)}
    single, sound = of[SINGLE], [m for m in marks if m["kind"] != FAULTY]
    by_size = [
        _share(f"single: truth first, {size:g} x typical", (m["first"] for m in single if m["sizes"] == [size]))
        for size in SIZES
    ]
    return [
        _share("controls: false alarms", (m["false_alarm"] for m in of[CONTROL])),
        _share("controls: an effect named", (m["false_name"] for m in of[CONTROL])),
        _share("single: truth first", (m["first"] for m in single)),
        _share("single: truth in a class of at most three", (m["in_class"] for m in single)),
        _share(
            "single: truth first, or none and stated as too small", (m["first"] or m["below_limit"] for m in single)
        ),
        _share("single: named", (m["named"] for m in single)),
        *by_size,
        _share("single: truth first, another form", (m["first"] for m in single if m["forms"] != ["catalogue"])),
        _share("all: wrong name", (m["wrong_name"] for m in marks)),
        _share("two effects: both named", (m["both"] for m in of[PAIR])),
        _share("two effects: one of them", (m["one"] for m in of[PAIR])),
        _share("in no list: something else", (m["abstained"] for m in of[UNLISTED])),
        _share("in no list: with the right axis and phase", (m["card"] for m in of[UNLISTED])),
        _share("matched pairs: truth in a class of at most three", (m["in_class"] for m in of[MATCHED])),
        _share("matched pairs: called a class", (m["as_class"] for m in of[MATCHED])),
        _share("faulty records: refused", (m["refused"] for m in of[FAULTY])),
        _share("sound records: refused", (m["verdict"] == "refused" for m in sound)),
    ]


def _numbers(marks: Marks) -> list[dict[str, Any]]:
    """Return medians, and how often intervals hold."""
    gaps = [m["gap_closed"] for m in marks if m.get("gap_closed") is not None]
    errors = [e for m in marks for e in m.get("size_errors", ())]
    inside = [c for m in marks for c in m.get("covered", ())]
    seconds = [float(m["seconds"]) for m in marks if isinstance(m.get("seconds"), (int, float))]
    return [
        _number("gap closed on held-out runs, median", gaps),
        _number("size of the effect: relative error, median", errors),
        _share("size of the effect: 90 % interval covers", inside),
        _number("seconds a case, median", seconds),
        _number("seconds a case, longest", seconds, pick=max),
    ]


def _share(score: str, values: Iterable[bool]) -> dict[str, Any]:
    found = [bool(v) for v in values]
    n, hits = len(found), sum(found)
    low, high = wilson(hits, n)
    value = hits / n if n else None
    return {"score": score, "value": value, "n": n, "hits": hits, "low": low, "high": high, "percent": True}


def _number(score: str, values: list[float], pick=statistics.median) -> dict[str, Any]:
    value = float(pick(values)) if values else None
    low, _, high = statistics.quantiles(values, n=4) if len(values) > 1 else [value] * 3
    percent = "seconds" not in score
    return {"score": score, "value": value, "n": len(values), "low": low, "high": high, "percent": percent}


def as_text(by_block: Mapping[str, list[dict[str, Any]]]) -> str:
    """Return the rows of several kinds of block side by side, in Markdown; those that have a case.

    Intervals are 95 % Wilson of a share, quartiles of a median.
    """
    blocks = [block for block, rows in by_block.items() if any(row["n"] for row in rows)]
    lines = [f"| score | {' | '.join(f'{b} | goal' for b in blocks)} |", "| --- |" + " --- | --- |" * len(blocks)]
    for rows in zip(*(by_block[b] for b in blocks), strict=True):
        if any(row["n"] for row in rows):
            cells = [f"{_cell(row)} | {row['goal']}{_MET[row['met']]}" for row in rows]
            lines.append(f"| {rows[0]['score']} | {' | '.join(cells)} |")
    return "\n".join(lines)


_MET = {True: "", False: " **missed**", None: ""}


def _cell(row: dict[str, Any]) -> str:
    if row["value"] is None:
        return "-"
    interval = f"{shown(row['low'], row['percent'])} to {shown(row['high'], row['percent'])}"
    if "hits" in row:
        return f"{row['hits']} of {row['n']} ({interval})"
    return f"{shown(row['value'], row['percent'])} ({interval})"


def shown(value: float | None, percent: bool) -> str:
    """Return a number of the table, or a dash."""
    if value is None:
        return "-"
    return f"{100 * value:.1f} %" if percent else f"{value:.0f}"


def failures(marks: Marks) -> list[str]:
    """Return a line for each case whose verdict was not right."""
    lines = []
    for m in marks:
        good = {
            CONTROL: not m.get("false_alarm", False), SINGLE: m.get("first", False), MATCHED: m.get("in_class", False),
            PAIR: m.get("both", False), UNLISTED: m.get("card", False),
            FAULTY: m.get("refused", False),
        }[m["kind"]]  # fmt: skip
        if not good or m["wrong_name"]:
            true = " + ".join(f"{e} x {s:g}" for e, s in zip(m["truth"], m["sizes"], strict=True)) or "nothing"
            form = "".join(f" ({f})" for f in m["forms"] if f != "catalogue")
            said = f"{m['verdict']} {', '.join(m['said'])}".strip()
            lines.append(f"{m['name']} [{m['kind']}]: {true}{form}; verdict: {said}")
    return lines
