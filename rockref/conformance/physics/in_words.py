"""A profile as text for a terminal."""

from __future__ import annotations

import textwrap
from typing import Any

MARKS = {"pass": "pass", "fail": "FAIL", "remark": "remark", "not judged": "not judged"}
WIDTH = 110


def text(profile: dict[str, Any]) -> str:
    """Return a profile as text: verdicts of the settings side by side, then what was seen, then the passports."""
    facts, settings = profile["facts"], profile["settings"]
    lines = [f"{profile['engine']} {facts.get('version', '')} ({', '.join(told(facts))})", ""]
    lines += [f"{'':20}" + "".join(f"{name:14}" for name in settings)]
    for rows in zip(*(s["findings"] for s in settings.values()), strict=True):
        lines.append(f"{rows[0]['check']:20}" + "".join(f"{MARKS[f['verdict']]:14}" for f in rows))
    for name, setting in settings.items():
        lines += ["", f"{name}: {knobs(setting)}"]
        for finding in setting["findings"]:
            lines += said(finding)
    if profile["passport"]:
        lines += ["", "Restitution passport: impact at 1 m/s of 8 kg, centre of mass above the contact", ""]
        lines += [f"{'':32}{'shape':8}{'e':>6}  {'range':13}{'time ms':>8}{'depth mm':>10}"]
        lines += [row for name, one in profile["passport"].items() for row in passport_rows(name, one["shapes"])]
    return "\n".join(line.rstrip() for line in lines) + "\n"


def told(facts: dict[str, str]) -> list[str]:
    """Return precision and integrator, where they are known."""
    return [facts[key] for key in ("precision", "integrator") if key in facts]


def knobs(setting: dict[str, Any]) -> str:
    """Return the step and the knobs of a setting in a line."""
    own = [f"{key} {value}" for key, value in setting["knobs"].items() if key != "step"]
    return ", ".join([f"step {1e3 * setting['step']:g} ms", *(own or ["nothing set"])])


def said(finding: dict[str, Any]) -> list[str]:
    """Return a finding's lines: the figures where it passes, and what is seen and what to do where it does not."""
    head = f"  {finding['check']}: {finding['measured']}"
    lines = [head if not finding["reference"] else f"{head} (reference {finding['reference']})"]
    if finding["seen"]:
        lines += wrapped(f"{MARKS[finding['verdict']]}: {finding['seen']}")
    if finding["advice"]:
        lines += wrapped(f"known cause: {finding['advice']}")
    return lines


def wrapped(line: str) -> list[str]:
    """Return a line broken and indented below a finding."""
    return textwrap.wrap(line, WIDTH, initial_indent="    ", subsequent_indent="      ", break_long_words=False)


def passport_rows(name: str, shapes: dict[str, dict[str, float]]) -> list[str]:
    """Return the rows of a passport."""
    return [
        f"{name if k == 0 else '':32}{shape:8}{r['e']:6.3f}  {r['low']:.3f} - {r['high']:.3f}"
        f"{1e3 * r['time']:8.2f}{1e3 * r['depth']:10.2f}"
        for k, (shape, r) in enumerate(shapes.items())
    ]
