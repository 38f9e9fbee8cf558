"""Profiles of many engines as one page in Markdown."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from rockref.conformance.physics.checks import CHECKS
from rockref.conformance.physics.in_words import knobs

Profile = dict[str, Any]
SIGNS = {"pass": "✓", "fail": "**✗**", "remark": "○", "not judged": "–"}
HEAD = """# Do physics engines rock?

Written by `rockref conform physics` (of all engines at once: `python benchmarks/physics_engines.py`). A block on a
plate is dropped, slid, tilted and balanced in each engine, and compared with closed forms and the theory of the rocking
block.

A failure says something about a setting, not about an engine: *default* changes nothing, *careful* is what rockref's
adapter sets. A remark (○) is no fault; – was not judged, because the contact is too soft for the check.
"""


def page(profiles: list[Profile], skipped: dict[str, str]) -> str:
    """Return the page of all profiles; `skipped` has the engines that did not run, with the reason."""
    parts = [HEAD, "## Verdicts\n", verdicts(profiles), "## Figures\n", FIGURES_HEAD, figures(profiles)]
    parts += ["## What was seen, and which knob is known\n", *(seen(p) for p in profiles)]
    parts += ["## Restitution passport\n", PASSPORT_HEAD, passports(profiles), "## Versions and settings\n"]
    parts += [versions(profiles)]
    if skipped:
        parts += ["Not run:\n", "\n".join(f"- {name}: {why}" for name, why in skipped.items()) + "\n"]
    return "\n".join(parts)


def table(head: list[str], rows: list[list[str]]) -> str:
    """Return a table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines) + "\n"


def each(profiles: list[Profile]):
    """Yield engine, setting, and the findings by name."""
    for p in profiles:
        for name, setting in p["settings"].items():
            yield p["engine"], name, {f["check"]: f for f in setting["findings"]}


def verdicts(profiles: list[Profile]) -> str:
    """Return the table of verdicts: a row an engine and setting."""
    rows = [
        [engine, name, *(SIGNS[found[check]["verdict"]] for check in CHECKS)] for engine, name, found in each(profiles)
    ]
    return table(["engine", "setting", *CHECKS], rows)


FIGURES_HEAD = """Relative errors, where no unit stands. *Flip*: interval between flips of a free body; *D*: sliding
distance along the sides and along the diagonal; *creep*: of a cube on a slope; *¼ period*: from half the slenderness to
upright; *e₁*: ratio of rates at the first impact, 0.942 for a rigid block (Housner), which no law has to give;
*topple*: acceleration over g b / h; *p below, above*: growth of the fall from just below and above the balance angle.
"""


def number(found: dict[str, Any], check: str, key: str, show: Callable[[float], str]) -> str:
    """Return a raw figure of a check as text; a dash where there is none."""
    value = found[check]["numbers"].get(key)
    return "–" if value is None or math.isnan(value) else "never" if math.isinf(value) else show(value)


def share(value: float) -> str:
    """Return a relative error: three digits, or its power of ten where it is small."""
    return f"{value:+.4f}" if abs(value) >= 5e-5 else f"{value:.0e}"


FIGURES: list[tuple[str, str, str, Callable[[float], str]]] = [
    ("flip", "flight", "interval", share),
    ("D 0°", "slide", "distance along", share),
    ("D 45°", "slide", "distance along the diagonal", share),
    ("creep m/s", "rest", "creep slope", lambda a: f"{a:.0e}"),
    ("¼ period", "rocking period", "off", share),
    ("e₁", "impact ratio", "ratio", lambda a: f"{a:.3f}"),
    ("topple", "toppling", "load", lambda a: f"{a:.4f}"),
    ("p below", "balance on an edge", "below", share),
    ("p above", "balance on an edge", "above", share),
]


def figures(profiles: list[Profile]) -> str:
    """Return the table of figures."""
    rows = [
        [engine, name, *(number(found, check, key, show) for _, check, key, show in FIGURES)]
        for engine, name, found in each(profiles)
    ]
    return table(["engine", "setting", *(head for head, *_ in FIGURES)], rows)


def seen(profile: Profile) -> str:
    """Return what was seen of an engine; the same sentence about two settings once."""
    told: dict[str, list[str]] = {}
    for name, setting in profile["settings"].items():
        for f in setting["findings"]:
            if f["seen"]:
                told.setdefault(sentence(f), []).append(name)
    silent = [name for name in profile["settings"] if not any(name in names for names in told.values())]
    lines = [f"- *{', '.join(names)}*: {line}" for line, names in told.items()]
    lines += [f"- *{name}*: nothing." for name in silent]
    return f"### {profile['engine']}\n\n" + "\n".join(lines) + "\n"


def sentence(finding: dict[str, Any]) -> str:
    """Return what a check saw, the cause, and the knob as code: it may look like a tag."""
    mark = "" if finding["verdict"] == "fail" else f" ({finding['verdict']})"
    what, _, cure = finding["advice"].partition("; ")
    known = f" Known cause: {what}. Knob: `{cure}`." if finding["advice"] else ""
    return f"**{finding['check']}**{mark}: {finding['seen']}.{known}"


PASSPORT_HEAD = """What an engine's knobs make of an impact: a body of 8 kg at 1 m/s, the centre of mass above the
contact. *e* is the restitution from the height of the rebound, median of five phases of the impact within a step, and
its range; *time* is that of contact; *depth* is the largest. No verdict: lively or dead is the user's choice.
"""


def passports(profiles: list[Profile]) -> str:
    """Return the table of passports, a row a knob set and shape."""
    rows = []
    for p in profiles:
        for name, one in p["passport"].items():
            for shape, r in one["shapes"].items():
                time = "–" if math.isnan(r["time"]) else f"{1e3 * r['time']:.2f}"
                e = ["–", "–"] if math.isnan(r["e"]) else [f"{r['e']:.3f}", f"{r['low']:.3f} to {r['high']:.3f}"]
                rows.append([p["engine"], name, shape, *e, time, f"{1e3 * r['depth']:.2f}"])
    return table(["engine", "setting", "shape", "e", "range", "time ms", "depth mm"], rows)


def versions(profiles: list[Profile]) -> str:
    """Return versions, precision, integrator, and the knobs of every setting and passport."""
    rows = []
    for p in profiles:
        facts = p["facts"]
        own = [facts.get(key, "") for key in ("version", "precision", "integrator")]
        for name, setting in p["settings"].items():
            rows.append([p["engine"], *own, name, f"`{knobs(setting)}`"])
        for name in p["passport"]:
            if name not in p["settings"]:
                k = p["passport"][name]["knobs"]
                rows.append(
                    [p["engine"], *own, f"passport: {name}", f"`{knobs({'knobs': k, 'step': k.get('step', 1e-3)})}`"]
                )
    return table(["engine", "version", "precision", "integrator", "setting", "step and knobs"], rows)
