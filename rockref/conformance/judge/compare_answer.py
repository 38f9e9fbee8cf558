"""One answer against one vector: by how many bars it is off, and which rule that speaks of."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rockref.conformance.backends.call import printable
from rockref.conformance.judge.negligible import same_force, size_and_unit
from rockref.conformance.rules import ORDER
from rockref.conformance.vectors import Expected, Vector, problem_of
from rockref.conformance.vectors.fields import PARTS, RESULTS, Missing, result
from rockref.model.simulate import output_steps

#: A result within ten bars is inside "look": it passes, and is pointed out.
LOOK = 10.0
#: And in the profile of other integrators inside two: their bars are those of whole schemes.
LOOK_SCHEME = 2.0
FLAGS = ("touching", "sliding", "anchored")
#: What a start may lose in single precision: a conversion of units, a quaternion; eight ulps.
SINGLE = 8 * float(np.finfo(np.float32).eps)
ELSEWHERE = "the first row is not the start that was given"
OTHERWISE = "asked once more, the same run has another answer: a run before it leaves something behind"


@dataclass(frozen=True)
class Check:
    """One expected result of one vector, judged.

    worst : deviation in bars where it is largest, at `index`; expected, bar, got : the numbers there
    follows : a decision in the same vector is wrong, so that this result says nothing about its own rule
    weighed : whether there was an answer to weigh; one that is missing or of another shape speaks of no rule
    """

    vector: str
    layer: str
    rule: str
    name: str
    grade: str
    worst: float = 0.0
    index: tuple[int, ...] = ()
    expected: float | bool | None = None
    bar: float | None = None
    got: float | bool | None = None
    note: str = ""
    follows: bool = False
    weighed: bool = True

    @property
    def failed(self) -> bool:
        """Return whether it is outside."""
        return self.grade == "outside"

    @property
    def rank(self) -> float:
        """Place in the order of the rules; the threshold itself is looked at before the decision that it makes."""
        return ORDER["T2"] - 0.5 if self.name == "trace.threshold" else ORDER[self.rule]


def bar_of(expected: Expected, profile: str) -> np.ndarray | None:
    """Return the bar in a profile; None where the profile does not judge this number."""
    return expected.bar_float32 if profile == "float32" else expected.bar


def grade_of(worst: float, negligible: bool = False, look: float = LOOK) -> str:
    """Return the grade of a deviation in bars; `negligible`: it was larger, and too small to be physical."""
    if worst == 0:
        return "bitwise"
    return "inside" if worst <= 1 else "outside" if worst > look else "negligible" if negligible else "look"


def look_of(profile: str, layer: str) -> float:
    """Return from how many bars on a result is outside: what has no integrator in it is weighed by other schemes,
    too."""
    return LOOK_SCHEME if profile == "scheme" and layer in ("LS", "L5") else LOOK


def in_bars(got: Any, expected: np.ndarray, bar: np.ndarray) -> np.ndarray:
    """Return |got - expected| / bar, the difference taken in the wider of the two precisions; infinite where not a
    number."""
    wide = np.longdouble if np.asarray(got).dtype == np.longdouble else np.float64
    with np.errstate(all="ignore"):
        apart = np.abs(np.asarray(got, wide) - expected.astype(wide)).astype(float)
        ratio = np.where(apart == 0, 0.0, apart / bar)
    return np.where(np.isfinite(np.asarray(got, float)) & ~np.isnan(ratio), ratio, np.inf)


def weighed_in_bars(
    got: Any, expected: np.ndarray, bar: np.ndarray, size: float, look: float = LOOK
) -> tuple[np.ndarray, np.ndarray]:
    """Return the deviations in bars, those below a physical `size` no more than what passes; and where that made a
    difference."""
    ratio = in_bars(got, expected, bar)
    with np.errstate(all="ignore"):
        small = (np.abs(np.asarray(got, float) - expected) <= size) & (ratio > look)
    return np.where(small, look, ratio), small


def compare_number(name: str, layer: str, got: Any, expected: Expected, bar: np.ndarray, look: float) -> dict[str, Any]:
    """Return the grade, worst place and numbers there."""
    size, unit = size_and_unit(name, layer)
    ratio, small = weighed_in_bars(got, expected.value, bar, size, look)
    # Of those that are set to what passes, the place of the largest difference.
    apart = np.where(small, np.abs(np.asarray(got, float) - expected.value), -1.0)
    decides = apart if float(np.max(ratio)) == look and np.any(small) else ratio
    index = np.unravel_index(int(np.argmax(decides)), ratio.shape) if ratio.ndim else ()
    at = tuple(int(i) for i in index)
    found, grade = float(np.asarray(got)[at]), grade_of(float(ratio[at]), bool(small[at]), look)
    note = "" if np.isfinite(found) else "not a finite number"
    note = f"differs by {float(apart[at]):.2g} {unit}".strip() if grade == "negligible" else note
    return {
        "grade": grade, "worst": float(ratio[at]), "index": at, "expected": float(expected.value[at]),
        "bar": float(bar[at]), "got": found, "note": note,
    }  # fmt: skip


def compare_flag(name: str, vector: Vector, got: Any, expected: np.ndarray) -> dict[str, Any]:
    """Compare flags, which are equal or not; whether a foot slides is negligible where it changes the force by
    nothing."""
    wrong = np.asarray(got, bool) != expected
    if not np.any(wrong):
        return {"grade": "bitwise"}
    index = tuple(int(i) for i in np.argwhere(wrong)[0]) if wrong.ndim else ()
    if name == "sliding" and vector.piece == "contact_law" and same_force(vector.inputs):
        return {"grade": "negligible", "note": "sticking and sliding give the same force"}
    return {
        "grade": "outside", "worst": float("inf"), "index": index,
        "expected": bool(expected[index]), "got": bool(np.asarray(got)[index]),
    }  # fmt: skip


def compare_one(name: str, vector: Vector, out: dict[str, Any], profile: str) -> Check:
    """Compare one expected result."""
    expected = vector.expect[name]
    rule = expected.rule_traced if shows_what_lies_between(vector, out) else expected.rule
    common: dict[str, Any] = {"vector": vector.id, "layer": vector.layer, "rule": rule, "name": name}
    try:
        got = np.asarray(result(name, out, vector.branch))
    except Missing:
        return Check(**common, grade="not shown")
    except (TypeError, ValueError, IndexError) as e:
        return Check(**common, grade="outside", worst=float("inf"), note=f"unusable answer: {e}", weighed=False)
    flag = expected.value.dtype == bool
    bar = np.zeros(()) if flag and profile != "float32" else bar_of(expected, profile)
    if bar is None:
        return Check(**common, grade="not judged")
    if got.shape != expected.value.shape or (got.dtype.kind not in "bfiu"):
        note = (
            f"has shape {got.shape}, not {expected.value.shape}"
            if got.shape != expected.value.shape
            else unreadable(got)
        )
        return Check(**common, grade="outside", worst=float("inf"), note=note, weighed=False)
    if flag:
        return Check(**common, **compare_flag(name, vector, got, expected.value))
    look = look_of(profile, vector.layer)
    return Check(**common, **compare_number(name, vector.layer, got, expected, bar, look))


def shows_what_lies_between(vector: Vector, out: dict[str, Any]) -> bool:
    """Return whether an answer shows what a result is made of: a trace, or the moment that is turned into body axes."""
    return bool(out.get("trace")) or (vector.piece == "assemble" and out.get("moment") is not None)


def unreadable(got: np.ndarray) -> str:
    """Return what stands in the place of numbers."""
    odd = next((x for x in got.ravel().tolist() if not isinstance(x, int | float)), None)
    if odd is None:
        return "holds null, which is no number (is it a NaN?)"
    return f"is no number but {type(odd).__name__}, first {printable(repr(odd))[:40]}"


def compare(vector: Vector, out: dict[str, Any], profile: str = "float64") -> list[Check]:
    """Compare all expected results of a vector against one answer; an answer without a single result of its piece is
    none."""
    if all(out.get(name) is None for name in RESULTS[vector.piece]):
        return no_answer(vector, f"gives none of {', '.join(RESULTS[vector.piece])}")
    said = wrong_shape(vector, out) if vector.piece == "simulate" else ""
    if said:
        return rows_of_another_number(vector, out) or no_answer(vector, said)
    checks = [compare_one(name, vector, out, profile) for name in asked_for(vector, out, profile)]
    if vector.piece == "simulate" and out.get("t") is not None:
        checks += rows_at_wrong_instants(vector, out["t"])
    if vector.piece == "simulate":
        checks += first_row_elsewhere(vector, out, profile)
    decided_wrongly = any(c.failed for c in checks if c.name.partition("@")[0] in FLAGS)
    if not decided_wrongly:
        return checks
    dependent = ("F_T", "s", "F_stick", "F_slip", "s_stick", "s_slip")
    return [Check(**{**vars(c), "follows": True}) if c.failed and c.name in dependent else c for c in checks]


def wrong_shape(vector: Vector, out: dict[str, Any]) -> str:
    """Return what is wrong with the shape of the rows of a short run: N rows of 3 rates, 3 coordinates, a matrix 3 by
    3, and so on."""
    rows, n = len(output_steps(problem_of(vector.inputs))), len(vector.inputs["P"])
    right = {"W": (rows, 3), "x": (rows, 3), "Lambda": (rows, 3, 3), "F": (rows, n, 3), "anchored": (rows, n)}
    for key, shape in right.items():
        got: Any = out.get(key)
        try:
            found = shape if got is None else np.shape(got)
        except ValueError:
            return f"{key} has rows of different lengths"
        if found != shape:
            return f"{key} has shape {found}, not {shape}{likely_shape(found, shape)}"
    return ""


def likely_shape(found: tuple[int, ...], right: tuple[int, ...]) -> str:
    """Return what rows of another shape seem to be, and how they should be; "" where nothing is known."""
    if len(right) == 3 and found[1:] == (4,):
        return ": quaternions? give the matrices, three lists of three numbers a row"
    if len(right) > 1 and len(found) < len(right) and np.prod(found) == np.prod(right):
        return ": nest the lists, rows first"
    if len(right) == 2 and found == right[::-1]:
        return ": turned over? rows come first"
    return ""


def rows_of_another_number(vector: Vector, out: dict[str, Any]) -> list[Check]:
    """Return a failure of S2 where all rows are as they should be, but there are more or fewer; from it all others
    follow."""
    if not shows(out, "W"):
        return []
    rows, found = len(output_steps(problem_of(vector.inputs))), np.shape(out["W"])[:1]
    pad = {k: np.zeros((rows, *np.shape(out[k])[1:])) for k in ("W", "x", "Lambda", "F", "anchored") if shows(out, k)}
    if any(np.shape(out[k])[:1] != found for k in pad) or wrong_shape(vector, pad):
        return []
    note = f"gives {found[0]} rows, not {rows}"
    others = [replace(c, follows=True) for c in no_answer(vector, note)]
    return [Check(vector.id, vector.layer, "S2", "t", "outside", float("inf"), note=note), *others]


def shows(out: dict[str, Any], key: str) -> bool:
    """Return whether there are rows of a quantity, of one length."""
    try:
        return out.get(key) is not None and len(np.shape(out[key])) > 0
    except ValueError:
        return False


def wrong_instants(got: Any, wanted: np.ndarray, step: float) -> str:
    """Return what is wrong with the instants of the rows: each is within half a step of what was asked."""
    try:
        got = np.asarray(got, float)
    except (TypeError, ValueError):
        return "t holds no numbers"
    if got.shape != wanted.shape:
        return f"t has shape {got.shape}, not {wanted.shape}"
    off = np.flatnonzero(~(np.abs(got - wanted) <= 0.5 * step))
    return f"row {off[0]} is at t = {float(got[off[0]]):.6g} s, not {wanted[off[0]]:.6g} s" if len(off) else ""


def rows_at_wrong_instants(vector: Vector, got: Any) -> list[Check]:
    """Return a failure of S2 where the rows of a short run are not at their instants."""
    problem = problem_of(vector.inputs)
    said = wrong_instants(got, problem.step * output_steps(problem), problem.step)
    return [Check(vector.id, vector.layer, "S2", "t", "outside", float("inf"), note=said)] if said else []


def first_row_elsewhere(vector: Vector, out: dict[str, Any], profile: str) -> list[Check]:
    """Return a failure of S2 for each of x, Lambda and W of which the first row is not the start that was given."""
    found = []
    for key in ("x", "Lambda", "W"):
        try:
            got = np.asarray(out[key], float)[0]
        except (KeyError, TypeError, ValueError, IndexError):
            continue
        start = np.asarray(vector.inputs[key], float)
        size = size_and_unit(key)[0] + (SINGLE * float(np.max(np.abs(start))) if profile == "float32" else 0.0)
        ratio = in_bars(got, start, np.full(start.shape, size))
        if np.max(ratio) > 1:
            at = tuple(int(i) for i in np.unravel_index(int(np.argmax(ratio)), ratio.shape))
            numbers: dict[str, Any] = {"expected": float(start[at]), "bar": size, "got": float(got[at])}
            found.append(Check(vector.id, vector.layer, "S2", f"{key}@0", "outside", float(ratio[at]), at, **numbers,
                               note=ELSEWHERE))  # fmt: skip
    return found


def of_the_right_shape(checks: list[Check]) -> list[Check]:
    """Return the checks without those of first rows where rows have another shape elsewhere: where there are as many of
    them as a row is long, they have the right one by chance."""
    if all(c.weighed for c in checks):
        return checks
    return [c for c in checks if c.note != ELSEWHERE]


def asked_for(vector: Vector, out: dict[str, Any], profile: str = "float64") -> list[str]:
    """Return the results that are weighed: those that stand in for others only where the others are not shown; of
    another integrator in a short run those before its first step."""

    def shown(name: str) -> bool:
        return out.get(PARTS.get(name.partition("@")[0], name.partition("@")[0])) is not None

    if profile == "scheme" and vector.layer == "L5s":
        return [k for k in vector.expect if k.endswith("@0")]
    return [k for k, e in vector.expect.items() if not e.instead_of or not shown(e.instead_of)]


def stand_ins(vector: Vector, out: dict[str, Any], profile: str) -> list[Check]:
    """Return what stands in for results that are shown, where it is outside: what happens after them.

    Forces that are shown and right are summed wrongly (A1), where the block is moved wrongly by them, or their moments
    are (A2), where it is turned.
    """
    left = vector.expect.keys() - set(asked_for(vector, out, profile))
    found = [c for c in (compare_one(name, vector, out, profile) for name in vector.expect if name in left) if c.failed]
    return [replace(c, rule="A2" if c.name.startswith("Lambda") else "A1") for c in found]


def no_answer(vector: Vector, note: str) -> list[Check]:
    """Return the checks of a vector to which there was no usable answer: of results that stand in for others only where
    there are no others."""
    asked = [(name, e) for name, e in vector.expect.items() if not e.instead_of] or list(vector.expect.items())
    return [
        Check(vector.id, vector.layer, e.rule, name, "outside", float("inf"), note=note, weighed=False)
        for name, e in asked
    ]
