"""The verdict in words, for a terminal."""

from __future__ import annotations

import math

from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.judge.findings import Findings
from rockref.conformance.judge.trajectories import RunCheck
from rockref.conformance.judge.verdict import Verdict, alike, downstream_of, grades, not_asked, remarks
from rockref.conformance.rules import BY_ID, PIECES, RULES
from rockref.conformance.vectors import AS_RUN, layer, manifest

GRADES = ("bitwise", "inside", "look", "negligible", "outside", "not judged")
RED, GREEN, BOLD, PLAIN = "\x1b[31m", "\x1b[32m", "\x1b[1m", "\x1b[0m"


def painted(text: str, *codes: str, colour: bool) -> str:
    """Return text in colour, or as it is."""
    return "".join(codes) + text + PLAIN if colour else text


def number(value: float | bool | None) -> str:
    """Return a number as far as it is worth reading."""
    if value is None or isinstance(value, bool):
        return str(value)
    return f"{value:.10g}" if math.isfinite(value) else str(value)


def bars(value: float) -> str:
    """Return a deviation in bars."""
    return f"{value:.3g} bars" if math.isfinite(value) else "not comparable"


def numbers(check: Check) -> str:
    """Return expected, bar and got of a check."""
    at = f"[{', '.join(map(str, check.index))}]" if check.index else ""
    if check.expected is None:
        return f"{check.name}: {check.note}"
    bar = "" if check.bar is None else f" +- {check.bar:.2g}"
    off = "" if check.bar is None else f" ({bars(check.worst)})"
    return f"{check.name}{at} expected {number(check.expected)}{bar}, got {number(check.got)}{off}" + (
        f"; {check.note}" if check.note else ""
    )


def flags_of(id_: str, name: str) -> str:
    """Return what a vector shows, in its own flags."""
    found = next((v for v in layer(name) if v.id == id_.removesuffix(AS_RUN)), None)
    return ", ".join(found.flags) if found else ""


def rule_lines(v: Verdict) -> list[str]:
    """Return a rule a line, with its status."""
    words = {
        "pass": "pass",
        "look": "pass (see the remarks)",
        "fail": "FAIL",
        "follows": "follows",
        "no answer": "no usable answer",
        "not shown": "not shown",
    }
    return [
        f"  {r.id:3} {words[v.rules[r.id]]:22} {r.says}  {r.equation}" for r in RULES if v.rules[r.id] != "not shown"
    ]


def divergence(v: Verdict, colour: bool) -> list[str]:
    """Return the first wrong rule, and what shows it."""
    lines = [painted(f"COMMON SLIP  {v.slip}", BOLD, RED, colour=colour)] if v.slip else []
    if v.rule is not None:
        rule = BY_ID[v.rule]
        lines.append(
            painted(f"FIRST DIVERGENCE  rule {rule.id} - {rule.says}, {rule.equation}", BOLD, RED, colour=colour)
        )
    if v.check is not None:
        lines.append(f"  vector {v.check.vector} ({flags_of(v.check.vector, v.check.layer)}): {numbers(v.check)}")
    if v.says:
        lines.append(f"  {v.says}")
    if alike(v):
        lines.append(f"  runs cannot tell it from {', '.join(f'{r} ({BY_ID[r].says})' for r in alike(v))}")
    if v.rule is not None:
        lines.append(_upstream(v))
    if v.consequences:
        after = [r for r in downstream_of(v.rule) if v.rules.get(r) in ("fail", "follows")] if v.rule else []
        named = f" (rules {' '.join(after)})" if after else ""
        lines.append(
            f"  {len(v.consequences)} other results are outside{named}; look at the first one before the others"
        )
    return lines


def _upstream(v: Verdict) -> str:
    assert v.rule is not None
    before = [r.id for r in RULES[: [r.id for r in RULES].index(v.rule)] if v.rules[r.id] in ("pass", "look")]
    return f"  rules before it that pass: {' '.join(before) or 'none is shown'}"


def run_line(r: RunCheck) -> str:
    """Return a run in one line."""
    if r.note:
        return f"  {r.id:34} {r.grade:8} {r.note}"
    late = [str(k) for k, i in enumerate(r.impacts, 1) if i["grade"] == "outside"]
    which = f"; main impact {', '.join(late)} outside" if late else ""
    return f"  {r.id:34} {r.grade:8} {bars(r.worst)} up to {r.horizon_s:.4g} s{which}"


def run_lines(v: Verdict) -> list[str]:
    """Return the runs, and where the first one parts."""
    runs = v.findings.runs
    if not runs:
        return []
    failed = [r for r in runs if r.failed]
    lines = [f"Runs (L5): {len(runs) - len(failed)} of {len(runs)} inside"]
    lines += [run_line(r) for r in runs if r.failed or r.grade == "look"]
    if v.run is not None:
        lines += impact_lines(v.run)
    if v.run is not None and v.run.first is not None:
        f = v.run.first
        lines.append(
            f"  first divergent sample of {v.run.id}: t = {f['t_s']:.6g} s, {f['quantity']}{f['index']} expected "
            f"{number(f['expected'])} +- {f['bar']:.2g}, got {number(f['got'])}"
        )
        event = v.run.event
        lines.append(
            f"  the event before it: point {event[1]} {event[2]} at {event[0]:.6g} s"
            if event
            else "  no event before it"
        )
    return lines


def impact_lines(run: RunCheck) -> list[str]:
    """Return the main impacts that are outside: run, which one, instants, deviation."""
    return [
        f"  main impact {number} of {run.id}: expected at {i['t_s']:.9g} s +- {i['bar_s']:.2g} s, {came(i)}"
        for number, i in enumerate(run.impacts, 1)
        if i["grade"] == "outside"
    ]


def came(impact: dict) -> str:
    """Return when an impact came, and by how much late or early."""
    if impact["got_s"] is None:
        return "did not come"
    off = impact["got_s"] - impact["t_s"]
    return (
        f"came at {impact['got_s']:.9g} s, {abs(off):.3g} s {'late' if off > 0 else 'early'} ({bars(impact['bars'])})"
    )


def neighbour_lines(v: Verdict) -> list[str]:
    """Return similar mistakes of the zoo."""
    known = manifest()["mistakes"]
    if v.alone:
        return ["  no mistake of the zoo leaves similar traces"]
    return [
        f"  resembles {id_}, rule {known[id_]['rule']}: {known[id_]['says']} (cosine {cosine:.3f})"
        for id_, cosine in v.neighbours
    ]


def unseen(v: Verdict) -> list[str]:
    """Return for who passes: the rules that no piece shows and on which no run depends, as runs are given what they
    make."""
    hidden = {
        piece: [r for r in rules if v.rules[r] == "not shown"]
        for piece, rules in PIECES.items()
        if piece not in v.findings.pieces
    }
    said = [f"{' '.join(rules)} ({piece})" for piece, rules in hidden.items() if rules]
    why = "no piece shows them, and runs are given their points, constants and start"
    return [f"Not seen: {', '.join(said)}; {why}"] if said else []


def passing(f: Findings) -> str:
    """Return the word for who passes: in which profile, and what was not asked."""
    left = not_asked(f)
    quick = "quick: long runs and properties were not asked"
    said = [f.profile] if f.profile != "float64" else []
    said += [quick if left == ["L5", "L6"] else f"not asked: {' '.join(left)}"] if left else []
    return f"PASS ({'; '.join(said)})" if said else "PASS"


def text(v: Verdict, colour: bool = False) -> str:
    """Return the whole verdict."""
    f = v.findings
    who = " ".join(p for p in (f.backend["name"], f.backend["version"]) if p)
    lines = [
        f"{who} ({f.backend['language']}, {f.backend['precision']}), profile {f.profile}, layers {' '.join(f.layers)}"
    ]
    lines.append("pieces shown: simulate " + " ".join(f.pieces))
    lines += divergence(v, colour) + run_lines(v) + neighbour_lines(v)
    broken = [p for p in f.properties if not p.holds]
    if f.properties:
        lines.append(f"Properties (L6): {len(f.properties) - len(broken)} of {len(f.properties)} hold")
    lines += [f"  {p.name}: {p.note}" for p in broken]
    claimed = [e for e in f.effects if e.grade != "not shown"]
    shaken = [e for e in claimed if e.vector.startswith("LB")]
    if of_effects := [e for e in claimed if e not in shaken]:
        good, all_ = len([e for e in of_effects if not e.failed]), len({e.effect for e in of_effects})
        lines.append(f"Effects (LE): {all_} claimed; {good} of {len(of_effects)} vectors inside")
    if shaken:
        lines.append(f"Base motion (LB): {len([e for e in shaken if not e.failed])} of {len(shaken)} vectors inside")
    lines += [f"  {e.effect}: {e.note or bars(e.worst)} ({e.vector})" for e in claimed if e.failed]
    lines += ["Rules:"] + rule_lines(v) if v.status == "FAIL" else []
    lines += unseen(v) if v.passed and "L5s" in f.layers else []
    lines += [f"Remark: {r}" for r in remarks(v)]
    counted = grades(v)
    told = ", ".join(f"{counted[g]} {g}" for g in GRADES if g in counted)
    lines.append(f"Results: {told}; {f.seconds:.1f} s")
    word = f"{v.status} ({v.rule})" if v.rule else v.status
    word = passing(f) if v.passed else word
    lines.append(painted(word, BOLD, GREEN if v.passed else RED, colour=colour))
    return "\n".join(lines) + "\n"
