"""The table of scores of a blind test, with Wilson intervals and goals."""

from __future__ import annotations

import statistics
from collections.abc import Iterable
from typing import Any

from rockref.blind.cases.plan import CONTROL, FAULTY, OUTSIDER, PAIR, SINGLE, SIZES, TWIN
from rockref.blind.scoring.wilson import wilson

Marks = list[dict[str, Any]]


def scores(marks: Marks) -> list[dict[str, Any]]:
    """Rows: score, value, low, high, n, goal, met (None where there is no goal or no case)."""
    of = {kind: [m for m in marks if m["kind"] == kind] for kind in (CONTROL, SINGLE, PAIR, OUTSIDER, TWIN, FAULTY)}
    single = of[SINGLE]
    rows = [
        _share("controls: false alarms", (m["false_alarm"] for m in of[CONTROL]), most=0.0),
        _share("controls: an effect named", (m["false_name"] for m in of[CONTROL]), most=0.0),
        _share("single: truth first", (m["first"] for m in single), least=0.97),
        _share("single: truth in a class of at most three", (m["in_class"] for m in single), least=1.0),
        _share(
            "single: truth first, or none and stated as too small", (m["first"] or m["below_limit"] for m in single)
        ),
        _share("single: named", (m["named"] for m in single)),
    ]
    for size in SIZES:
        rows.append(
            _share(f"single: truth first, {size:g} x typical", (m["first"] for m in single if m["sizes"] == [size]))
        )
    rows += [
        _share("single: truth first, another form", (m["first"] for m in single if m["forms"] != ["catalogue"])),
        _share("all: wrong name", (m["wrong_name"] for m in marks), most=0.01),
        _share("two effects: both named", (m["both"] for m in of[PAIR]), least=0.90),
        _share("two effects: one of them", (m["one"] for m in of[PAIR])),
        _share("in no list: something else", (m["abstained"] for m in of[OUTSIDER]), least=0.95),
        _share("in no list: with the right axis and phase", (m["card"] for m in of[OUTSIDER]), least=0.95),
        _share("twins: truth in a class of at most three", (m["in_class"] for m in of[TWIN])),
        _share("twins: called a class", (m["as_class"] for m in of[TWIN])),
        _share("faulty records: refused", (m["refused"] for m in of[FAULTY]), least=0.95),
    ]
    gaps = [m["gap_closed"] for m in marks if m.get("gap_closed") is not None]
    errors = [e for m in marks for e in m.get("size_errors", ())]
    inside = [c for m in marks for c in m.get("covered", ())]
    seconds = [float(m["seconds"]) for m in marks if isinstance(m.get("seconds"), (int, float))]
    rows += [
        _number("gap closed on held-out runs, median", gaps, least=0.95),
        _number("size of the effect: relative error, median", errors, most=0.05),
        _share("size of the effect: 90 % interval covers", inside, least=0.85, most=0.95),
        _number("seconds a case, median", seconds, most=120.0),
        _number("seconds a case, longest", seconds, pick=max),
    ]
    return rows


def _share(score: str, values: Iterable[bool], least: float | None = None, most: float | None = None) -> dict[str, Any]:
    found = [bool(v) for v in values]
    n, hits = len(found), sum(found)
    low, high = wilson(hits, n)
    value = hits / n if n else None
    return _row(score, value, n, least, most) | {"hits": hits, "low": low, "high": high, "percent": True}


def _number(
    score: str, values: list[float], least: float | None = None, most: float | None = None, pick=statistics.median
) -> dict[str, Any]:
    value = float(pick(values)) if values else None
    quarters = statistics.quantiles(values, n=4) if len(values) > 1 else [value] * 3
    percent = "seconds" not in score
    return _row(score, value, len(values), least, most) | {"low": quarters[0], "high": quarters[2], "percent": percent}


def _row(score: str, value: float | None, n: int, least: float | None, most: float | None) -> dict[str, Any]:
    goals = [f"{sign} {limit:g}" for sign, limit in ((">=", least), ("<=", most)) if limit is not None]
    met = None
    if goals and value is not None:
        met = (least is None or value >= least) and (most is None or value <= most)
    return {"score": score, "value": value, "n": n, "goal": " and ".join(goals), "met": met}


def as_text(rows: list[dict[str, Any]]) -> str:
    """The table in Markdown. Intervals are 95 % Wilson of a share, quartiles of a median."""
    lines = ["| score | value | interval | n | goal | met |", "| --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        met = {True: "yes", False: "**no**", None: ""}[row["met"]]
        value, low, high = (_shown(row[k], row["percent"]) for k in ("value", "low", "high"))
        interval = f"{low} to {high}" if row["n"] else ""
        lines.append(f"| {row['score']} | {value} | {interval} | {row['n']} | {row['goal']} | {met} |")
    return "\n".join(lines)


def beside(methods: dict[str, list[dict[str, Any]]]) -> str:
    """Scores of several methods side by side, in Markdown; only those that have a goal and a case."""
    lines = ["| score | " + " | ".join(methods) + " | n |", "| --- |" + " --- |" * (len(methods) + 1)]
    for rows in zip(*methods.values(), strict=True):
        if rows[0]["goal"] and any(row["value"] is not None for row in rows) and "seconds" not in rows[0]["score"]:
            shown = " | ".join(_shown(row["value"], row["percent"]) for row in rows)
            lines.append(f"| {rows[0]['score']} | {shown} | {rows[0]['n']} |")
    return "\n".join(lines)


def _shown(value: float | None, percent: bool) -> str:
    if value is None:
        return "-"
    return f"{100 * value:.1f} %" if percent else f"{value:.0f}"


def failures(marks: Marks) -> list[str]:
    """A line for each case whose verdict was not right."""
    lines = []
    for m in marks:
        good = {
            CONTROL: not m.get("false_alarm", False), SINGLE: m.get("first", False), TWIN: m.get("in_class", False),
            PAIR: m.get("both", False), OUTSIDER: m.get("card", False),
            FAULTY: m.get("refused", False),
        }[m["kind"]]  # fmt: skip
        if not good or m["wrong_name"]:
            true = " + ".join(f"{e} x {s:g}" for e, s in zip(m["truth"], m["sizes"], strict=True)) or "nothing"
            form = "".join(f" ({f})" for f in m["forms"] if f != "catalogue")
            said = f"{m['verdict']} {', '.join(m['said'])}".strip()
            lines.append(f"{m['name']} [{m['kind']}]: {true}{form}; verdict: {said}")
    return lines
