"""The verdict as JUnit XML, which continuous integration reads."""

from __future__ import annotations

from xml.etree import ElementTree

from rockref.conformance.judge.trajectories import RunCheck
from rockref.conformance.judge.verdict import Verdict
from rockref.conformance.reports.terminal import bars, numbers


def junit(v: Verdict) -> bytes:
    """Return JUnit XML: a test suite per layer, a test case per vector, run, property, claimed effect; what is not
    shown is skipped."""
    root = ElementTree.Element("testsuites", name=f"rockref conform {v.findings.backend['name']}")
    by_layer: dict[str, dict[str, list]] = {}
    for check in v.findings.checks:
        by_layer.setdefault(check.layer, {}).setdefault(check.vector, []).append(check)
    for layer, vectors in by_layer.items():
        bad = sum(any(c.failed for c in checks) for checks in vectors.values())
        suite = ElementTree.SubElement(root, "testsuite", name=layer, tests=str(len(vectors)), failures=str(bad))
        for name, checks in vectors.items():
            case = ElementTree.SubElement(suite, "testcase", classname=f"{layer}.{checks[0].rule}", name=name)
            failed = [c for c in checks if c.failed]
            if failed:
                said = "; ".join(map(numbers, failed))
                ElementTree.SubElement(case, "failure", message=said[:500]).text = said
            elif all(c.grade in ("not shown", "not judged") for c in checks):
                ElementTree.SubElement(case, "skipped")
    if v.findings.runs:
        _runs(root, v.findings.runs)
    properties = [(p.name, "" if p.holds else p.note or "does not hold") for p in v.findings.properties]
    claimed = [e for e in v.findings.effects if e.grade != "not shown"]
    effects = [(f"{e.effect} {e.vector}".strip(), (e.note or bars(e.worst)) if e.failed else "") for e in claimed]
    moved = [case for case in effects if case[0].startswith("base motion")]
    effects = [case for case in effects if case not in moved]
    for name, cases in (("L6", properties), ("LE", effects), ("LB", moved)):
        _suite(root, name, cases)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)


def _runs(root: ElementTree.Element, runs: list[RunCheck]) -> None:
    def said(r: RunCheck) -> str:
        at = f" from t = {r.first['t_s']:.6g} s" if r.first else ""
        return r.note or f"{r.worst:.3g} bars{at}"

    _suite(root, "L5", [(r.id, said(r) if r.failed else "") for r in runs])


def _suite(root: ElementTree.Element, layer: str, cases: list[tuple[str, str]]) -> None:
    """Add a suite of cases: name, and what is said where it fails."""
    if not cases:
        return
    bad = sum(bool(said) for _, said in cases)
    suite = ElementTree.SubElement(root, "testsuite", name=layer, tests=str(len(cases)), failures=str(bad))
    for name, said in cases:
        case = ElementTree.SubElement(suite, "testcase", classname=layer, name=name)
        if said:
            ElementTree.SubElement(case, "failure", message=said)
