"""The judge judged: every mistake and every control of the zoo run as a backend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rockref.conformance.backends.call import as_mapping
from rockref.conformance.backends.side_by_side import grouped, simulate
from rockref.conformance.faults.mistakes import BY_ID, CONTROLS, MISTAKES
from rockref.conformance.judge.causes import fingerprints
from rockref.conformance.judge.findings import finite, judge
from rockref.conformance.judge.trajectories import RunCheck, judge_rows
from rockref.conformance.judge.verdict import verdict
from rockref.conformance.vectors import trajectory, window_names

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
