"""The verdict as a page with the divergence drawn, and as a badge."""

from __future__ import annotations

import importlib
import inspect
import math
from html import escape
from importlib import resources

import numpy as np

from rockref.conformance.judge.trajectories import RunCheck
from rockref.conformance.judge.verdict import Verdict
from rockref.conformance.reports.terminal import bars, number, rule_lines, text
from rockref.conformance.rules import BY_ID

#: Colours of the badge and of the page; the page is readable without them.
GOOD, BAD, INK = "#2e7d32", "#c62828", "#1f2933"


def badge(v: Verdict) -> str:
    """Return a badge, SVG."""
    said = [v.findings.profile] if v.findings.profile != "float64" else []
    said += ["quick"] if "L5" not in v.findings.layers else []
    profile = f" ({', '.join(said)})" if said else ""
    left, right = "rockref", f"conforms{profile}" if v.passed else f"fails {v.rule or ''}".strip()
    # Widths: 6.6 pixels a letter in 11-pixel Verdana, and 5 on either side.
    a, b = (round(6.6 * len(t)) + 10 for t in (left, right))
    colour = GOOD if v.passed else BAD
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{a + b}" height="20" role="img" '
        f'aria-label="{left}: {escape(right)}">'
        f'<rect width="{a}" height="20" fill="#555"/><rect x="{a}" width="{b}" height="20" fill="{colour}"/>'
        f'<g fill="#fff" font-family="Verdana,sans-serif" font-size="11" text-anchor="middle">'
        f'<text x="{a / 2}" y="14">{left}</text><text x="{a + b / 2}" y="14">{escape(right)}</text></g></svg>\n'
    )


def curve(run: RunCheck, width: int = 640, height: int = 160) -> str:
    """Return the deviation of a run in bars over time, logarithmic, with the bar itself as a line; SVG."""
    low, high = -3.0, max(2.0, math.ceil(np.log10(np.clip(run.ratios, 1e-3, 1e12).max())))
    left, bottom = 48, height - 24
    span = max(run.t[-1] - run.t[0], 1e-12) if len(run.t) else 1.0

    def x(t: float) -> float:
        return left + (t - run.t[0]) / span * (width - left - 8)

    def y(ratio: float) -> float:
        return bottom - (np.log10(np.clip(ratio, 1e-3, 1e12)) - low) / (high - low) * (bottom - 8)

    points = " ".join(f"{x(t):.1f},{y(r):.1f}" for t, r in zip(run.t, run.ratios, strict=True))
    marks = [
        f'<text x="{left - 6}" y="{y(10**k) + 4:.1f}" text-anchor="end">1e{k}</text>'
        for k in range(int(low), int(high) + 1, 3)
    ]
    lines = [
        f'<line x1="{left}" x2="{width - 8}" y1="{y(1):.1f}" y2="{y(1):.1f}" stroke="{GOOD}" stroke-dasharray="4 3"/>'
    ]
    if run.first is not None:
        t = run.first["t_s"]
        lines.append(f'<line x1="{x(t):.1f}" x2="{x(t):.1f}" y1="8" y2="{bottom}" stroke="{BAD}"/>')
        # Below the axis, where no curve runs, and left of the end of the axis.
        at = min(x(t), width - 230.0)
        lines.append(f'<text x="{at:.1f}" y="{height - 6}" fill="{BAD}">first outside: {t:.5g} s</text>')
    axis = (
        f'<text x="{width - 8}" y="{height - 6}" text-anchor="end">t = {run.t[-1]:.4g} s</text>' if len(run.t) else ""
    )
    return (
        f'<svg viewBox="0 0 {width} {height}" width="{width}" role="img" '
        f'aria-label="deviation of {escape(run.id)} in bars" '
        f'font-family="sans-serif" font-size="11" fill="{INK}">{"".join(marks)}{"".join(lines)}'
        f'<polyline points="{points}" fill="none" stroke="{INK}" stroke-width="1.2"/>{axis}</svg>'
    )


def page(v: Verdict) -> str:
    """Return one self-contained page: the verdict, the rule with what was expected and got, its text in the law, the
    rest."""
    colour = GOOD if v.passed else BAD
    runs = "".join(
        f"<h3>{escape(r.id)}: {escape(r.grade)}</h3><p>{escape(r.title)}{'. ' + escape(r.note) if r.note else ''}</p>"
        + (f'<div class="static">{curve(r)}</div>' if len(r.t) else "")
        for r in v.findings.runs
        if r.failed or not any(x.failed for x in v.findings.runs)
    )
    rules = "\n".join(rule_lines(v))
    drawn = f"<h2>Deviation in bars (dashed: one bar)</h2>{runs}" if runs else ""
    heading = f"{escape(v.findings.backend['name'])}: {v.status}{f' ({v.rule})' if v.rule else ''}"
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8"><title>rockref conform</title>'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<style>{_style()}pre{{overflow-x:auto;font-size:13px;padding:1rem;background:var(--tint)}}"
        f"h1{{border-left:8px solid {colour};padding-left:.6rem}}</style></head><body><main>"
        f"<h1>{heading}</h1>{rule_card(v)}{drawn}"
        f'<details class="evidence"{"" if v.rule else " open"}><summary>The whole report</summary>'
        f"<pre>{escape(text(v))}</pre><h2>Rules</h2><pre>{escape(rules)}</pre></details></main></body></html>\n"
    )


def rule_card(v: Verdict) -> str:
    """Return the first wrong rule: what it says, what was expected and got, and its text in the law; nothing without
    one."""
    if v.rule is None:
        return ""
    rule, check = BY_ID[v.rule], v.check
    facts = []
    if check is not None and check.expected is not None:
        at = f"[{', '.join(map(str, check.index))}]" if check.index else ""
        bar = "" if check.bar is None else f"<small>bar: {check.bar:.2g}</small>"
        off = "" if check.bar is None else f"<small>{escape(bars(check.worst))} off</small>"
        facts = [(f"Expected, {check.name}{at}", number(check.expected), bar), ("Got", number(check.got), off)]
    cells = "".join(
        f"<div><dt>{escape(label)}</dt><dd>{escape(value)}{note}</dd></div>" for label, value, note in facts
    )
    said = f'<p class="next"><strong>Common slip:</strong> {escape(v.slip)}</p>' if v.slip else ""
    said += f"<p>{escape(v.says)}</p>" if v.says else ""
    where = "" if check is None else f" · vector {escape(check.vector)}"
    return (
        f'<section class="card" id="rule-{rule.id}"><p class="kicker">first divergence{where}</p>'
        f'<h2>{rule.id}: {escape(rule.says)}</h2><p class="lead">Equation {escape(rule.equation)} of the law; '
        f'<a href="#law-{rule.id}">its text</a>.</p><dl class="facts">{cells}</dl>{said}'
        f'<details id="law-{rule.id}" open><summary>{escape(rule.function.replace(":", "."))}</summary>'
        f"<pre>{escape(_source(rule.function))}</pre></details></section>"
    )


def _source(function: str) -> str:
    """Return the text of a function of the law, named as module:function."""
    module, _, name = function.partition(":")
    return inspect.getsource(getattr(importlib.import_module(module), name))


def _style() -> str:
    """Return the style that all pages share."""
    return (resources.files("rockref") / "report" / "html" / "assets" / "style.css").read_text(encoding="utf-8")
