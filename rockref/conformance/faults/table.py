"""The judged zoo as a table: rows, a CSV file, a page."""

from __future__ import annotations

import csv
import io
from typing import Any

from rockref.conformance.faults.mistakes import BY_ID
from rockref.conformance.judge.causes.wrong_base_motion import OF_BASE
from rockref.conformance.judge.shaken import shaken_vectors
from rockref.conformance.vectors import manifest

HEAD = [
    "id",
    "rule",
    "mistake",
    "first vector",
    "bars",
    "named",
    "nearest by runs alone",
    "in the top two if it were new",
]
NOT_CAUGHT, REJECTED = "not caught", "REJECTED"


def row(case: dict[str, Any]) -> list[str]:
    """Return a case as cells of a table: id, rule, what, where caught, bars, named, as a black box."""
    if case["kind"] == "control":
        verdict_ = REJECTED if case["rejected"] else "passes"
        return [case["id"], "", case["says"], "", _bars(case["bars"]), verdict_, "", ""]
    box = case["black_box"]
    near = "" if not box else ", ".join(n["mistake"] for n in box["neighbours"]) if box["visible"] else "not visible"
    unseen = "" if not box else "yes" if box["attributed_without_itself"] else "no"
    caught = case["vector"] or ("a long run" if case["detected"] else NOT_CAUGHT)
    named = case["named"] or "none"
    return [case["id"], case["rule"], case["says"], caught, _bars(case["bars"]), named, near, unseen]


def _bars(value: float | None) -> str:
    return "decision" if value is None else f"{value:.1e}" if value >= 1000 else f"{value:.2g}"


def rows(found: dict[str, Any]) -> list[list[str]]:
    """Return a row for each case of the judged zoo."""
    return [row(case) for case in found["cases"]]


def totals(table: list[list[str]]) -> list[str]:
    """Return what the rows add up to, as lines."""
    mistakes, controls = [r for r in table if r[1]], [r for r in table if not r[1]]
    n = len(mistakes)
    detected, named = sum(r[3] != NOT_CAUGHT for r in mistakes), sum(r[5] == r[1] for r in mistakes)
    lines = [f"detected {detected}/{n}, attributed {named}/{n}"]
    if any(r[7] for r in mistakes):
        near = sum(r[1] in {BY_ID[id].rule for id in r[6].split(", ") if id in BY_ID} for r in mistakes)
        new = sum(r[7] == "yes" for r in mistakes)
        lines.append(f"by runs alone, in the top two: {near}/{n}; {new}/{n} if each were new")
    rejected = sum(r[5] == REJECTED for r in controls)
    return [*lines, f"controls rejected {rejected}/{len(controls)}"]


def in_words(found: dict[str, Any]) -> str:
    """Return the zoo as lines."""
    table = rows(found)
    return "\n".join([*("  ".join(r) for r in table), *totals(table)])


def in_csv(table: list[list[str]]) -> str:
    """Return the rows as a CSV file with a header."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([HEAD, *table])
    return text.getvalue()


def in_markdown(head: list[str], table: list[list[str]]) -> str:
    """Return a table for the documentation."""
    lines = [head, ["---"] * len(head), *table]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in r) + " |" for r in lines) + "\n"


def resolving_power() -> str:
    """Return by rule: vectors, mistakes hunted, and the smallest deviation that one of them makes, from the
    manifest."""
    head = ["rule", "vectors", "mistakes hunted", "smallest deviation [bars]"]
    facts = manifest()["resolving_power"].items()
    return in_markdown(head, [[r, str(f["vectors"]), " ".join(f["hunts"]), f"{f['worst_bars']:.3g}"] for r, f in facts])


def with_a_moving_plate() -> str:
    """Return the table of mistakes with a plate that moves, from the vectors LB."""
    least = {m.id: min(v.resolving[m.id] for v in shaken_vectors()) for m in OF_BASE}
    head = ["", "mistake with a plate that moves (B1)", "least deviation in LB [bars]"]
    return in_markdown(head, [[m.id, m.says, f"{least[m.id]:.2g}"] for m in OF_BASE])


def misnamed(table: list[list[str]]) -> list[str]:
    """Return a line on the mistakes that have the name of another rule where pieces are shown, if there are any."""
    said = ", ".join(f"{r[0]} ({r[5]} in place of {r[1]})" for r in table if r[1] and r[5] != r[1])
    return [f"named by another rule where pieces are shown: {said}"] if said else []


def page(table: list[list[str]]) -> str:
    """Return the zoo and the resolving power of the vectors as a page of the documentation."""
    return (
        "# The zoo: planted mistakes, and what the judge says of them\n\n"
        "Every line is a backend that makes one mistake. *first vector* and *named* are what the judge says when the\n"
        "backend shows its pieces; *bars* is the largest deviation in a vector of the planted rule. The last two\n"
        "columns are for the same backend as a black box: up to two mistakes that leave similar traces, and whether\n"
        "the planted rule would be among the two named if this mistake were not in the zoo, which is what a mistake\n"
        "of your own meets.\n"
        "Controls (C) are no mistakes and have to pass.\n\n"
        + "".join(f"- {line}\n" for line in [*totals(table), *misnamed(table)])
        + f"\n{in_markdown(HEAD, table)}\n## Resolving power of the vectors\n\n"
        "A vector is admitted only if every mistake that it is said to hunt moves it by a hundred bars.\n\n"
        f"{resolving_power()}\n## A plate that moves\n\n"
        "Runs of LB, which a backend claims by the piece `shaken`. Each mistake is outside in every one of them, and\n"
        f"the judge names it.\n\n{with_a_moving_plate()}"
    )
