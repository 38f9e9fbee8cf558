"""The judge: puts all questions to a backend and collects what is wrong."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from rockref.conformance import vectors
from rockref.conformance.backends import call, richardson
from rockref.conformance.judge.causes.data_flow import with_consequences_marked
from rockref.conformance.judge.causes.steps_of_a_run import step_is_wrong
from rockref.conformance.judge.claims import ClaimCheck, judge_claims
from rockref.conformance.judge.compare_answer import (
    LOOK,
    OTHERWISE,
    Check,
    compare,
    in_bars,
    no_answer,
    of_the_right_shape,
    stand_ins,
)
from rockref.conformance.judge.shaken import judge_shaken
from rockref.conformance.judge.trajectories import RunCheck, judge_runs
from rockref.conformance.rules import PIECES
from rockref.conformance.vectors import Vector
from rockref.conformance.vectors.fields import result
from rockref.model.errors import InputError

LAYERS = ("L0", "L1", "L2", "L3", "L4", "L5s", "LS", "L5", "L6", "L7", "LE", "LB")
PROFILES = ("float64", "float32", "scheme")
#: From how many bars on a run of another integrator is not asked once more, and into how many parts its steps are
#: divided then. Decided: an error of second order becomes a sixteenth with each.
NEARLY, FINER = 32.0, (4, 16)
#: What a backend with another integrator is not asked: its own step is its own.
NOT_OF_THE_SCHEME = {"integrate", "step"}


@dataclass
class Findings:
    """Everything that was seen of one backend; `answers` to the vectors of the small layers and short runs.

    step_is_wrong : whether the step, asked from the states of the first short run that is outside, is wrong by itself
    """

    backend: dict[str, Any]
    profile: str
    layers: tuple[str, ...]
    checks: list[Check] = field(default_factory=list)
    runs: list[RunCheck] = field(default_factory=list)
    properties: list[Any] = field(default_factory=list)
    effects: list[ClaimCheck] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    answers: list[tuple[Vector, dict[str, Any]]] = field(default_factory=list)
    pieces: tuple[str, ...] = ()
    step_is_wrong: bool = False
    seconds: float = 0.0

    @property
    def failures(self) -> list[Check]:
        """Return the checks that are outside."""
        return [c for c in self.checks if c.failed]


def described(backend: Any) -> dict[str, Any]:
    """Return name, language, precision and version of a backend, as far as it says."""
    name = getattr(backend, "name", type(backend).__name__)
    language, precision = getattr(backend, "language", "Python"), getattr(backend, "precision", "float64")
    facts = {"name": name, "language": language, "precision": precision, "version": getattr(backend, "version", "")}
    return {key: call.printable(value) for key, value in facts.items()}


def chosen_layers(layers: Iterable[str] | None) -> tuple[str, ...]:
    """Return layers by name, in order; all of them by default. Raises InputError (E-LAYER)."""
    if layers is None:
        return LAYERS
    wanted = tuple(layers)
    for name in wanted:
        if name not in LAYERS:
            raise InputError("E-LAYER", "layers", f"has {name!r}", f"Use some of {', '.join(LAYERS)}.")
    return tuple(name for name in LAYERS if name in wanted)


def of_the_profile(layer: str, profile: str) -> bool:
    """Return whether a layer is asked in a profile: of other integrators no step, but short runs of their own."""
    return layer != "L4" if profile == "scheme" else layer != "LS"


def used_profile(backend: Any, wanted: str | None) -> str:
    """Return the profile that is asked for, or else what the backend says of its precision. Raises InputError
    (E-PROFILE)."""
    if wanted is not None and wanted not in PROFILES:
        raise InputError("E-PROFILE", "profile", f"is {wanted!r}", f"Use one of {', '.join(PROFILES)}.")
    precision = getattr(backend, "precision", "float64")
    return wanted or (precision if precision in PROFILES else "float64")


def judge(
    backend: Any,
    layers: Iterable[str] | None = None,
    profile: str = "float64",
    progress: Callable[[str, float], None] | None = None,
    examples: int = 100,
) -> Findings:
    """Judge a backend.

    Parameters
    ----------
    backend : an object with `simulate`, and as many of the other pieces as it likes to show (`rules.PIECES`).
    layers : some of L0 .. L4, L5s (short runs), LS (short runs of other integrators), L5 (trajectories),
        L6 (properties), L7, LE (effects that it claims), LB (a plate that moves, if it claims that); all by default.
    profile : "float64", "float32", or "scheme" (the same physics by another integrator).
    progress : called with the layer and the share of it that is done.
    examples : drawn for each property of L6.

    Raises
    ------
    InputError
        E-LAYER, E-PROFILE; E-BACKEND, where there is no `simulate`.
    """
    profile = used_profile(backend, profile)
    if not call.has(backend, "simulate"):
        raise InputError(
            "E-BACKEND", described(backend)["name"], "has no simulate(problem)", "It is the one mandatory piece."
        )
    wanted = tuple(name for name in chosen_layers(layers) if of_the_profile(name, profile))
    pieces = tuple(p for p in PIECES if call.has(backend, p))
    findings = Findings(described(backend), profile, wanted, pieces=pieces)
    begin = time.perf_counter()
    for layer in wanted:
        report = None if progress is None else (lambda share, layer=layer: progress(layer, share))
        _layer(backend, findings, layer, report, examples)
    findings.checks = of_the_right_shape(findings.checks)
    if profile == "scheme":
        findings.checks = by_finer_steps(backend, findings, findings.checks, compare)
    if profile != "float32":
        findings.checks = with_consequences_marked(findings.checks, findings.answers)
    if profile != "float32" and not any(c.layer != "L4" and not c.follows for c in findings.failures):
        # Where nothing is wrong yet, or all follows from rows that nobody looked at, the rows after the forces are
        # looked at, too; of other integrators those of LS.
        rows = [(v, out) for v, out in findings.answers if profile == "float64" or v.layer == "LS"]
        others = [c for v, out in rows for c in stand_ins(v, out, profile)]
        if profile == "scheme":
            others = by_finer_steps(backend, findings, others, stand_ins)
        findings.checks += with_consequences_marked(others, findings.answers)
    if profile != "float32":
        findings.checks += left_behind(backend, findings)
    if profile == "float64":
        findings.step_is_wrong = wrong_in_a_run(backend, findings)
    findings.remarks += getattr(backend, "remarks", [])
    findings.seconds = time.perf_counter() - begin
    return findings


def _layer(backend: Any, found: Findings, layer: str, report: Callable[[float], None] | None, examples: int) -> None:
    """Judge one layer."""
    if layer == "L5":
        found.runs = judge_runs(backend, found.profile, report)
    elif layer in ("LE", "LB"):
        judged = judge_claims if layer == "LE" else judge_shaken
        found.effects += judged(backend) if found.profile == "float64" else []
    elif layer == "L6":
        _properties(backend, found, examples)
    else:
        _small(backend, found, asked_in(layer, backend), report)


def asked_in(layer: str, backend: Any) -> tuple[Vector, ...]:
    """Return the vectors of a small layer for a backend: the steps of L4 are asked as runs of one step where it shows
    none."""
    return vectors.steps_as_runs() if layer == "L4" and not call.has(backend, "step") else vectors.layer(layer)


def _small(backend: Any, findings: Findings, asked: tuple[Vector, ...], report: Callable[[float], None] | None) -> None:
    """Judge one of the small layers."""
    for i, vector in enumerate(asked):
        if findings.profile == "scheme" and vector.piece in NOT_OF_THE_SCHEME:
            continue
        if call.has(backend, vector.piece):
            findings.checks += answered(backend, vector, findings.profile, findings.answers)
        if report is not None and i % max(1, len(asked) // 50) == 0:
            report((i + 1) / len(asked))


def answered(
    backend: Any, vector: Vector, profile: str, kept: list[tuple[Vector, dict[str, Any]]] | None = None
) -> list[Check]:
    """Return the checks of one vector; whatever the backend raises is its answer. `kept` gets the answer."""
    ask = richardson.ask if vector.layer == "LS" else call.ask
    try:
        out = ask(backend, vector)
        if kept is not None:
            kept.append((vector, out))
        return compare(vector, out, profile)
    except call.ANYTHING as e:  # the backend is a stranger's
        return no_answer(vector, call.raised(e))


def by_finer_steps(
    backend: Any,
    findings: Findings,
    checks: list[Check],
    weigh: Callable[[Vector, dict[str, Any], str], list[Check]],
) -> list[Check]:
    """Return the checks of another integrator, those of its runs that are outside with finer steps, where all of them
    are nearly inside and nothing else is wrong.

    What a right integrator is off by goes with its step: where one takes steps of its own, or a foot begins or ceases
    to slide, more than bars allow may be left after an extrapolation. A mistake stays.

    weigh : what made the checks of a vector and an answer, in a profile
    """
    for finer in FINER:
        failed = [c for c in checks if c.failed]
        if not failed or any(c.layer != "LS" or not c.worst <= NEARLY for c in failed):
            return checks
        for id_ in {c.vector for c in failed}:
            i = next(i for i, (v, _) in enumerate(findings.answers) if v.id == id_)
            vector = findings.answers[i][0]
            try:
                out = richardson.ask(backend, vector, finer)
                again = weigh(vector, out, findings.profile)
            except call.ANYTHING:  # the backend is a stranger's, and has answered before
                return checks
            findings.answers[i] = vector, out
            checks = [c for c in checks if c.vector != id_] + again
    return checks


def left_behind(backend: Any, findings: Findings) -> list[Check]:
    """Return a failure of S2 where the first short run that is outside has another answer after itself."""
    short = [c for c in findings.failures if c.layer in ("L5s", "LS") and c.weighed and c.bar is not None]
    failed = next(iter(short), None)
    known = {v.id: (v, out) for v, out in findings.answers}
    if failed is None or failed.vector not in known:
        return []
    vector, before = known[failed.vector]
    asked = richardson.ask if vector.layer == "LS" else call.ask
    try:
        first, again = (asked(backend, vector) for _ in range(2))
        # The answer of another integrator may be one with finer steps.
        before = first if vector.layer == "LS" else before
        old, new = (np.asarray(result(failed.name, out, vector.branch), float) for out in (before, again))
        same = (old == new) | (np.isnan(old) & np.isnan(new))
        changed = bool(np.any(~same & (in_bars(new, old, np.asarray(vector.expect[failed.name].bar)) > LOOK)))
    except call.ANYTHING:  # the backend is a stranger's
        return []
    return [replace(failed, rule="S2", note=OTHERWISE)] if changed else []


def wrong_in_a_run(backend: Any, findings: Findings) -> bool:
    """Return whether a step that passes by itself is wrong in the first short run that is outside."""
    failed = findings.failures
    if not failed or not call.has(backend, "step") or any(c.layer != "L5s" for c in failed):
        return False
    vector = next((v for v, _ in findings.answers if v.id == failed[0].vector), None)
    return vector is not None and step_is_wrong(backend, vector)


def _properties(backend: Any, findings: Findings, examples: int) -> None:
    """Judge L6, where hypothesis is installed."""
    if findings.profile != "float64":
        findings.remarks.append(f"L6 (properties) is not judged in the profile {findings.profile}.")
        return
    try:
        from rockref.conformance.judge.properties import bit_by_bit, judge_properties
    except ImportError:
        findings.remarks.append("L6 (properties) needs hypothesis: pip install hypothesis.")
        return
    findings.properties = judge_properties(backend, examples)
    if all(p.holds for p in findings.properties):
        findings.remarks += filter(None, [bit_by_bit(backend)])


def finite(value: float) -> float | None:
    """Return a number as JSON can hold it."""
    return value if math.isfinite(value) else None
