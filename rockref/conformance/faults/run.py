"""The judge judged: every mistake and every control of the zoo run as a backend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rockref.conformance.backends.call import as_mapping
from rockref.conformance.backends.side_by_side import grouped, simulate
from rockref.conformance.faults.mistakes import BY_ID, CONTROLS, MISTAKES
from rockref.conformance.judge.causes import fingerprints
from rockref.conformance.judge.causes.wrong_base_motion import OF_BASE
from rockref.conformance.judge.findings import finite, judge
from rockref.conformance.judge.shaken import shaken_vectors
from rockref.conformance.judge.trajectories import RunCheck, judge_rows
from rockref.conformance.judge.verdict import verdict
from rockref.conformance.vectors import manifest, trajectory, window_names

#: Small before long: the short runs are asked only where the pieces by themselves have nothing to object.
LAYERS = ("L0", "L1", "L2", "L3", "L4", "L7")
#: A run of ten thousand steps, for what passes all of them: a clock.
LONG = "flight"


def judge_run(backend: Any, name: str) -> RunCheck:
    """Judge one run of L5."""
    asked = trajectory(name)
    return judge_rows(asked, as_mapping(backend.simulate(asked.problem), "simulate"), "float64")


def case_of_mistake(mistake: Any, black_box: bool) -> dict[str, Any]:
    """Judge one mistake: whether it is found, and what is named, by its pieces and (as a black box) by its runs."""
    backend = mistake.backend()
    found = verdict(judge(backend, LAYERS))
    if found.passed or (found.check is not None and found.check.layer == "L4"):
        findings = judge(backend, (*LAYERS, "L5s"))
        if not findings.failures:
            findings.runs = [judge_run(backend, LONG)]
        found = verdict(findings)
    check = found.check
    hit = [c for c in found.findings.checks if c.failed and c.rule == mistake.rule]
    case: dict[str, Any] = {
        "id": mistake.id,
        "kind": "mistake",
        "rule": mistake.rule,
        "says": mistake.says,
        "detected": not found.passed,
        "named": found.rule,
        "attributed": found.rule == mistake.rule,
        "vector": None if check is None else check.vector,
        "layer": None if check is None else check.layer,
        "bars": finite(max((c.worst for c in hit), default=0.0)),
        "failed_vectors": len({c.vector for c in found.findings.failures}),
    }
    return case | (seen_as_black_box(mistake, backend) if black_box else {"black_box": None})


class BlackBox:
    """A backend of which nothing but its runs is seen."""

    precision = "float64"

    def __init__(self, backend: Any):
        self.simulate, self.simulate_many = backend.simulate, backend.simulate_many


def seen_as_black_box(mistake: Any, backend: Any) -> dict[str, Any]:
    """Return what the short runs point to, and the two nearest mistakes; and the two nearest if this one were not
    known."""
    box = BlackBox(backend)
    pointed = verdict(judge(box, ("L5s",))).rule
    marks = fingerprints.fingerprint(box)
    near = fingerprints.neighbours(marks, rule=pointed)
    others = fingerprints.neighbours(marks, without=(mistake.id,), rule=pointed)
    visible = bool((abs(marks) > 0).any())
    return {
        "black_box": {
            "visible": visible,
            "short_runs_point_to": pointed,
            "neighbours": [{"mistake": i, "rule": BY_ID[i].rule, "cosine": round(c, 3)} for i, c in near],
            "attributed": visible and mistake.rule in {BY_ID[i].rule for i, _ in near},
            "without_itself": [{"mistake": i, "rule": BY_ID[i].rule, "cosine": round(c, 3)} for i, c in others],
            "attributed_without_itself": visible
            and mistake.rule in {pointed, *(BY_ID[i].rule for i, _ in others[: 1 if pointed else 2])},
        }
    }


def judge_windows(backend: Any) -> list[RunCheck]:
    """Judge the windows of L5."""
    asked, found = [trajectory(name) for name in window_names()], []
    for group in grouped([t.problem for t in asked]):
        answers = simulate(backend, [asked[i].problem for i in group])
        found += [
            judge_rows(asked[i], as_mapping(a, "simulate"), "float64") for i, a in zip(group, answers, strict=True)
        ]
    return found


def case_of_control(control: Any, runs: bool) -> dict[str, Any]:
    """Judge one control: whether it is let through, by its pieces and, with `runs`, by the windows."""
    backend = control.backend()
    found = verdict(judge(backend, (*LAYERS, "L5s")))
    worst = max((c.worst for c in found.findings.checks), default=0.0)
    rejected = not found.passed
    if runs:
        judged = judge_windows(backend)
        rejected = rejected or any(r.failed for r in judged)
        worst = max(worst, *(r.worst for r in judged))
    return {
        "id": control.id,
        "kind": "control",
        "says": control.says,
        "rejected": rejected,
        "named": found.rule,
        "bars": finite(worst),
    }


def run_zoo(black_box: bool = True, progress: Callable[[str, float], None] | None = None) -> dict[str, Any]:
    """Judge the whole zoo; counts, and a case for every mistake and control. Without `black_box`, no runs: seconds, not
    minutes."""
    cases = []
    total = len(MISTAKES) + len(CONTROLS)
    for inmate in (*MISTAKES, *CONTROLS):
        cases.append(case_of_control(inmate, black_box) if inmate in CONTROLS else case_of_mistake(inmate, black_box))
        if progress is not None:
            progress("zoo", len(cases) / total)
    return summary(cases)


#: The shares of mistakes that have to be named by the planted rule: with pieces shown; in the top two by runs alone.
WITH_PIECES, BLACK_BOX = 0.95, 0.80


def falls_short(found: dict[str, Any]) -> bool:
    """Return whether a mistake is let through, a control rejected, or fewer mistakes named by their rules than is
    stated."""
    planted, box = found["planted"], found["attributed_black_box"]
    named = found["attributed"] >= WITH_PIECES * planted and (box is None or box >= BLACK_BOX * planted)
    return found["detected"] < planted or bool(found["controls_rejected"]) or not named


def summary(cases: list[dict[str, Any]]) -> dict[str, Any]:
    """Return counts, and the cases."""
    mistakes = [c for c in cases if c["kind"] == "mistake"]
    controls = [c for c in cases if c["kind"] == "control"]
    seen = [c for c in mistakes if c["black_box"]]
    return {
        "detected": sum(c["detected"] for c in mistakes),
        "attributed": sum(c["attributed"] for c in mistakes),
        "attributed_black_box": sum(c["black_box"]["attributed"] for c in seen) if seen else None,
        "attributed_black_box_unknown": sum(c["black_box"]["attributed_without_itself"] for c in seen)
        if seen
        else None,
        "planted": len(mistakes),
        "controls": len(controls),
        "controls_rejected": sum(c["rejected"] for c in controls),
        "cases": cases,
    }


def row(case: dict[str, Any]) -> list[str]:
    """Return a case as cells of a table: id, rule, what, where caught, bars, named, as a black box."""
    if case["kind"] == "control":
        verdict_ = "REJECTED" if case["rejected"] else "passes"
        return [case["id"], "", case["says"], "", _bars(case["bars"]), verdict_, "", ""]
    box = case["black_box"]
    near = "" if not box else ", ".join(n["mistake"] for n in box["neighbours"]) if box["visible"] else "not visible"
    unseen = "" if not box else "yes" if box["attributed_without_itself"] else "no"
    named = case["named"] or "none"
    return [
        case["id"],
        case["rule"],
        case["says"],
        case["vector"] or "not caught",
        _bars(case["bars"]),
        named,
        near,
        unseen,
    ]


def _bars(value: float | None) -> str:
    return "decision" if value is None else f"{value:.1e}" if value >= 1000 else f"{value:.2g}"


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


def in_words(found: dict[str, Any]) -> str:
    """Return the zoo as lines."""
    lines = ["  ".join(row(c)) for c in found["cases"]]
    n = found["planted"]
    lines.append(f"detected {found['detected']}/{n}, attributed {found['attributed']}/{n}")
    if found["attributed_black_box"] is not None:
        unknown = found["attributed_black_box_unknown"]
        lines.append(
            f"by runs alone, in the top two: {found['attributed_black_box']}/{n}; {unknown}/{n} if each were new"
        )
    lines.append(f"controls rejected {found['controls_rejected']}/{found['controls']}")
    return "\n".join(lines)


def resolving_rows() -> list[list[str]]:
    """Return by rule: vectors, mistakes hunted, and the smallest deviation that one of them makes, from the
    manifest."""
    rows = [["rule", "vectors", "mistakes hunted", "smallest deviation [bars]"], ["---"] * 4]
    for rule, facts in manifest()["resolving_power"].items():
        rows.append([rule, str(facts["vectors"]), " ".join(facts["hunts"]), f"{facts['worst_bars']:.3g}"])
    return rows


def page(found: dict[str, Any]) -> str:
    """Return the zoo and the resolving power of the vectors as a page of the documentation."""
    totals = in_words(found).splitlines()[len(found["cases"]) :]
    power = "\n".join("| " + " | ".join(r) + " |" for r in resolving_rows())
    return (
        "# The zoo: planted mistakes, and what the judge says of them\n\n"
        "Written by `rockref conform zoo --output docs/reference/zoo.md`; not to be edited.\n\n"
        "Every line is a backend that makes one mistake. *first vector* and *named* are what the judge says when the\n"
        "backend shows its pieces; *bars* is the largest deviation in a vector of the planted rule. The last two\n"
        "columns are for the same backend as a black box: up to two mistakes that leave similar traces, and whether\n"
        "the planted rule would be among the two named if this mistake were not in the zoo, which is what a mistake\n"
        "of your own meets.\n"
        "Controls (C) are no mistakes and have to pass.\n\n"
        + "".join(f"- {line}\n" for line in totals)
        + misnamed(found)
        + f"\n{in_markdown(found)}\n## Resolving power of the vectors\n\n"
        "A vector is admitted only if every mistake that it is said to hunt moves it by a hundred bars.\n\n"
        f"{power}\n" + of_a_moving_plate()
    )


def of_a_moving_plate() -> str:
    """Return the part of the page on mistakes with a plate that moves, from the vectors LB."""
    rows = [["", "mistake with a plate that moves (B1)", "least deviation in LB [bars]"], ["---"] * 3]
    for mistake in OF_BASE:
        least = min(v.resolving[mistake.id] for v in shaken_vectors())
        rows.append([mistake.id, mistake.says, f"{least:.2g}"])
    lines = "\n".join("| " + " | ".join(r) + " |" for r in rows)
    return (
        "\n## A plate that moves\n\n"
        "Runs of LB, which a backend claims by the piece `shaken`. Each mistake is outside in every one of them, and\n"
        f"the judge names it.\n\n{lines}\n"
    )


def misnamed(found: dict[str, Any]) -> str:
    """Return a line of the page: the mistakes that have the name of another rule where pieces are shown."""
    wrong = [c for c in found["cases"] if c["kind"] == "mistake" and not c["attributed"]]
    said = ", ".join(f"{c['id']} ({c['named']} in place of {c['rule']})" for c in wrong)
    return f"- named by another rule where pieces are shown: {said}\n" if wrong else ""


def in_markdown(found: dict[str, Any]) -> str:
    """Return the zoo as a table for the documentation."""
    rows = [HEAD, ["---"] * len(HEAD), *map(row, found["cases"])]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in r) + " |" for r in rows) + "\n"
