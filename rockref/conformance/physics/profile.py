"""All checks of one engine, its settings side by side, as plain values that can be stored and shown again."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from rockref.conformance.physics.adapter import Adapter, Engine, Lost
from rockref.conformance.physics.causes import advice
from rockref.conformance.physics.checks import CHECKS
from rockref.conformance.physics.finding import Finding
from rockref.conformance.physics.passport import all_passports
from rockref.conformance.physics.trial import Trial

#: What a fault of free motion does to the checks that come after.
FREE = ("echo", "flight", "fall")
FOLLOWING = ("friction", "gravity", "damping", "early", "pivot", "stale")

Progress = Callable[[str, float], None]


def judge_setting(adapter: Adapter, setting: str, progress: Progress | None = None) -> list[Finding]:
    """Return the findings of all checks of an engine at one of its settings."""
    trial, found = Trial(Engine(adapter, setting)), []
    for k, (name, check) in enumerate(CHECKS.items()):
        try:
            found.append(fallen(name, trial) if name not in FREE and not trial.is_held else check(trial))
        except Lost as error:
            found.append(Finding(name, "fail", "none", seen=str(error), cause="lost"))
        if progress is not None:
            progress(setting, (k + 1) / len(CHECKS))
    return explained(found)


def fallen(name: str, trial: Trial) -> Finding:
    """Return the answer to a check of contact where the plate does not hold the block."""
    seen = f"the plate does not hold the block, which is {trial.rest.sink:.2g} m below it after settling"
    return Finding(name, "fail", "none", seen=seen, cause="plate")


def explained(findings: list[Finding]) -> list[Finding]:
    """Return the findings, where what fails later is told as a consequence of a fault of free motion."""
    first = next((f for f in findings if f.verdict == "fail" and f.check in FREE and f.cause), None)
    if first is None:
        return findings
    return [
        replace(f, cause=first.cause, seen=f"{f.seen} (may follow from what {first.check} found)")
        if f.verdict == "fail" and f.check not in FREE and f.cause in FOLLOWING
        else f
        for f in findings
    ]


def judge_engine(adapter: Adapter, quick: bool = False, progress: Progress | None = None) -> dict[str, Any]:
    """Return the profile of an engine: facts, findings of every setting, passports unless `quick`.

    The result is plain values; `in_words`, `page` and JSON are made of it.
    """
    settings = {}
    for name, knobs in adapter.settings.items():
        found = judge_setting(adapter, name, progress)
        told = [f.as_dict() | {"advice": advice(f.cause, adapter.knobs) if f.seen else ""} for f in found]
        settings[name] = {"knobs": knobs, "step": Engine(adapter, name).step, "findings": told}
    passports = {} if quick else all_passports(adapter)
    knobs = {name: adapter.settings.get(name, adapter.passport.get(name)) for name in passports}
    return {
        "engine": adapter.name,
        "target": adapter.target,
        "facts": adapter.facts(),
        "settings": settings,
        "passport": {name: {"knobs": knobs[name], "shapes": table} for name, table in passports.items()},
    }


def falls_short(profile: dict[str, Any]) -> bool:
    """Return whether a check fails at the engine's last setting: the careful one, where there are two."""
    last = list(profile["settings"].values())[-1]
    return any(f["verdict"] == "fail" for f in last["findings"])
