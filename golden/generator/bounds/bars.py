"""The bar of every expected number: how far a correct backend may be from it, measured.

bar = 8 max(|float64 - fifty digits|, spread of runs with all inputs moved by one ulp (of whole steps, vectors by one of
their largest component) and the points in random order, spread under random rounding of every operation) + 1 ulp. The
factor 8 is decided: the ensembles have 8 to 16 members, and the largest deviation of so few is what a further member
exceeds about once in ten.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from golden.generator.bounds.answers import ANSWERS
from golden.generator.bounds.arithmetic import Digits, Doubles, RandomRounding, converted
from rockref.conformance.backends.law import RulesBackend
from rockref.conformance.vectors import problem_of
from rockref.conformance.vectors.fields import branch_of, result

FACTOR = 8
ULP_RUNS, ORDER_RUNS, ROUNDING_RUNS = 16, 4, 8
FIFTY = Digits()

#: Inputs and results that have one entry per contact point, by piece.
PER_POINT = {
    "kinematics": ({"P"}, {"r", "u", "xi", "xi_rate", "v_slide"}),
    "assemble": ({"r", "F"}, set()),
    "step": (
        {"P", "K_N", "C_N", "K_T", "C_T", "mu_0", "mu", "s", "anchored", "sliding", "F"},
        {"anchored", "sliding", "F_N"},
    ),
}


@dataclass
class Case:
    """A question before it has an answer. fields: result -> (rule, rule for who sees the trace).

    instead : result -> the one in whose stead it is looked at, where that is not shown
    on_surface : the inputs lie exactly on a switching surface and every operation on them is exact: they are not moved.
    place : of a short run: between which numbers it is judged, where that is not its own number
    """

    rule: str
    layer: str
    piece: str
    inputs: dict[str, Any]
    fields: dict[str, tuple[str, str]]
    flags: tuple[str, ...] = ()
    on_surface: bool = False
    branch: dict[str, Any] = field(default_factory=dict)
    set: str | None = None
    margin: float | None = None
    instead: dict[str, str] = field(default_factory=dict)
    place: float | None = None


@dataclass
class Barred:
    """A result with its bars: value (float64 or bool); None where there is no bar."""

    value: np.ndarray
    bar: np.ndarray | None
    bar_float32: np.ndarray | None


def ulp(a: np.ndarray, dtype: Any = np.float64) -> np.ndarray:
    """Return distance to the next number of that precision, in float64."""
    a = np.abs(np.asarray(a, float)).astype(dtype)
    return np.spacing(np.where(np.isfinite(a), a, 0)).astype(float)


def answer(case: Case, m: Any, inputs: dict[str, Any] | None = None) -> dict[str, Any]:
    """Return the named results of a case in the arithmetic m."""
    q = {k: converted(v, m.number) for k, v in (case.inputs if inputs is None else inputs).items()}
    return {k: v for k, v in ANSWERS[case.piece](q, m).items() if k in case.fields}


def moved(inputs: dict[str, Any], rng: random.Random) -> dict[str, Any]:
    """Return all numbers moved by -1, 0 or +1 ulp at random; rotations by an ulp of 1 in every entry, as a pose kept as
    a quaternion has its rounding; a coefficient of friction that is zero stays so."""
    keep = {"step", "duration", "output_rate", "t"}
    found = {
        k: v if k in keep else moved_pose(v, rng) if k == "Lambda" else moved_number(v, rng) for k, v in inputs.items()
    }
    return found | {k: np.maximum(found[k], 0.0) for k in ("mu_0", "mu") if isinstance(found.get(k), np.ndarray)}


def moved_whole(inputs: dict[str, Any], rng: random.Random) -> dict[str, Any]:
    """Return the inputs of a whole step moved as by `moved`, and what has three components by up to an ulp of the
    largest: the axes of the body, and the point of it whose place is kept, are a program's own choice."""
    found, reach = moved(inputs, rng), float(np.max(np.abs(inputs["P"])))
    for key in ("P", "W", "T", "inertia", "x"):
        if inputs.get(key) is None:
            continue
        a = np.asarray(inputs[key])
        size = max(float(np.max(np.abs(a))), reach if key == "x" else 0.0)
        shift = np.array([rng.choice((-1.0, 0.0, 1.0)) for _ in range(a.size)]).reshape(a.shape)
        found[key] = a + shift * np.spacing(size) * (size > 0)
    upper = np.triu(found["inertia"])
    return found | {"inertia": upper + np.triu(upper, 1).T}


def moved_number(a: Any, rng: random.Random) -> Any:
    """Return a number or an array moved by up to an ulp; flags and names stay."""
    if isinstance(a, np.ndarray) and a.dtype != bool:
        shift = np.array([rng.choice((-1.0, 0.0, 1.0)) for _ in range(a.size)]).reshape(a.shape)
        return np.where(shift == 0, a, np.nextafter(a, np.where(shift > 0, np.inf, -np.inf)))
    return rng.choice((a, np.nextafter(a, np.inf), np.nextafter(a, -np.inf))) if isinstance(a, float) else a


def moved_pose(Lambda: np.ndarray, rng: random.Random) -> np.ndarray:
    """Return a rotation matrix moved by up to half an ulp of 1 in every entry."""
    shift = np.array([rng.choice((-1.0, 0.0, 1.0)) for _ in range(Lambda.size)]).reshape(Lambda.shape)
    return Lambda + shift * 2.0**-53


def reordered(case: Case, rng: random.Random) -> dict[str, Any]:
    """Return the results with the contact points taken in a random order, in float64, put back in place."""
    per_point, results = PER_POINT[case.piece]
    n = len(case.inputs["P" if "P" in case.inputs else "r"])
    order = list(range(n))
    rng.shuffle(order)
    back = np.argsort(order)
    inputs = {k: v[order] if k in per_point else v for k, v in case.inputs.items()}
    found = answer(case, Doubles, inputs)
    # What is picked by branch comes in the random order: a point's own force does not depend on it, and is left out.
    return {k: [v[i] for i in back] if k in results else v for k, v in found.items() if k[2:] not in ("stick", "slip")}


def by_the_law(case: Case, dtype: Any) -> dict[str, Any]:
    """Return the results of the law's own text in float64 or float32."""
    backend = RulesBackend(dtype=dtype)
    if case.piece in ("step", "simulate"):
        out = getattr(backend, case.piece)(problem_of(case.inputs))
        out = out if isinstance(out, dict) else vars(out)
    else:
        out = getattr(backend, case.piece)(**case.inputs)
    branch = branch_of(out["anchored"], out["sliding"]) if case.piece == "step" else {}
    return {k: result(k, out, branch) for k in case.fields}


def subtracted(member: Any, exactly: Any) -> np.ndarray:
    """Return |member - exactly| as float64, the difference taken in fifty digits."""
    a, b = np.asarray(converted_floats(member), object), np.asarray(exactly, object)
    difference = [abs(FIFTY.number(p) - q) for p, q in zip(a.ravel(), b.ravel(), strict=True)]
    return np.array([float(d) for d in difference]).reshape(b.shape)


def converted_floats(value: Any) -> Any:
    """Return nested lists of plain floats from arrays of any precision; fifty-digit numbers stay."""
    if isinstance(value, np.ndarray | np.generic):
        return np.asarray(value, float).tolist()
    if isinstance(value, list | tuple):
        return [converted_floats(v) for v in value]
    return float(value) if isinstance(value, float) else value


def is_flag(value: Any) -> bool:
    """Return whether a result is made of flags."""
    while isinstance(value, list):
        value = value[0]
    return isinstance(value, bool | np.bool_)


def same_flags(member: dict[str, Any], exactly: dict[str, Any]) -> bool:
    """Return whether all flags of a member are those of the answer."""
    return all(
        np.array_equal(np.asarray(member[k]), np.asarray(v)) for k, v in exactly.items() if is_flag(v) and k in member
    )


def spread(members: list[dict[str, Any]], exactly: dict[str, Any]) -> dict[str, np.ndarray]:
    """Return the largest deviation of the members from the answer, by result."""
    found = {}
    for key, value in exactly.items():
        if not is_flag(value):
            deviations = [subtracted(m[key], value) for m in members if key in m]
            found[key] = np.max(deviations, axis=0)
    return found


def barred(case: Case, seed: int) -> dict[str, Barred]:
    """Return the answer of a case with its bars, in the profiles float64 and float32.

    Raises
    ------
    AssertionError
        where a member of the float64 ensembles takes another branch: such a case is no vector.
    """
    rng = random.Random(seed)
    exactly = answer(case, FIFTY)
    members = [answer(case, Doubles), by_the_law(case, np.float64)]
    if not case.on_surface:
        move = moved_whole if case.piece in ("step", "simulate") else moved
        members += [answer(case, FIFTY, move(case.inputs, rng)) for _ in range(ULP_RUNS)]
    if case.piece in PER_POINT:
        members += [reordered(case, rng) for _ in range(ORDER_RUNS)]
    members += [answer(case, RandomRounding(seed + i)) for i in range(ROUNDING_RUNS)]
    for member in members:
        assert same_flags(member, exactly), f"{case.rule} {case.flags}: a correct float64 run takes another branch"
    width = spread(members, exactly)
    single = [by_the_law(case, np.float32)]
    single += [answer(case, RandomRounding(seed + 100 + i, single=True)) for i in range(ROUNDING_RUNS)]
    comparable = all(same_flags(member, exactly) for member in single)
    with np.errstate(all="ignore"):
        width32 = spread(single, exactly) if comparable else {}
    results = {}
    for key, value in exactly.items():
        if is_flag(value):
            results[key] = Barred(np.array(value, bool), None, np.zeros(()) if comparable else None)
            continue
        nearest = np.array(converted_floats_of(value))
        bar = FACTOR * width[key] + ulp(nearest)
        bar32 = FACTOR * width32[key] + ulp(nearest, np.float32) if comparable else None
        if bar32 is not None and not np.all(np.isfinite(bar32)):
            bar32 = None
        results[key] = Barred(nearest, bar, bar32)
    return results


def converted_floats_of(value: Any) -> Any:
    """Return nested lists of the floats nearest to fifty-digit numbers."""
    return [converted_floats_of(v) for v in value] if isinstance(value, list) else float(value)
