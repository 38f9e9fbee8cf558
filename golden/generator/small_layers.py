"""The small layers: questions answered, barred, hunted with, numbered, and written as JSON."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from golden.generator.admission import hunted
from golden.generator.bounds.bars import Barred, Case, barred
from golden.generator.bounds.branches import branch
from golden.generator.questions import body, derived, full, point, step
from golden.generator.short_runs import scheme
from rockref.conformance.rules import BY_ID
from rockref.conformance.vectors import SCHEMA, vector_of

#: The questions of each layer, in order. The seed of a question is its place.
QUESTIONS = {
    "L0": (derived.derived, derived.release, derived.inner_pivots, derived.elsewhere),
    "L1": (point.all_points, full.points, point.whatever_else, full.eight_places),
    "L2": (body.assembly, full.assembly),
    "L3": (body.exponentials, body.steps, body.no_rotation, full.steps, body.hardly_turned),
    "L4": (step.steps, step.elsewhere),
    "L5s": scheme.SHORT_RUNS,
    "L7": (derived.channel,),
}
LAYERS = (*QUESTIONS, "LS")
#: Inputs that the vectors of a layer may share, by name of the set.
SHARED = ("mass", "g", "inertia", "P", "K_N", "C_N", "K_T", "C_T", "mu_0", "mu", "names")


def rounded_up(bar: np.ndarray) -> Any:
    """Return bars with two digits, rounded up, as nested lists."""

    def up(b: float) -> float:
        if b == 0 or not math.isfinite(b):
            return b
        digits = 1 - math.floor(math.log10(b))
        if digits > 300:
            return b
        return float(f"{math.ceil(b * 10**digits * (1 - 1e-9)) / 10**digits:.2g}")

    return np.vectorize(up, otypes=[float])(bar).tolist() if bar.size else bar.tolist()


def in_hex(value: Any) -> Any:
    """Return nested lists of hexadecimal floats."""
    return [in_hex(v) for v in value] if isinstance(value, list) else float(value).hex()


def stored(value: Any) -> Any:
    """Return a number or an array as it stands in the files: hexadecimal, the decimal beside; flags and names as they
    are."""
    if isinstance(value, np.ndarray | np.generic):
        if np.asarray(value).dtype == bool:
            return {"flags": np.asarray(value).tolist()}
        value = np.asarray(value, float).tolist()
        return {"hex": in_hex(value), "decimal": value}
    if isinstance(value, float):
        return {"hex": value.hex(), "decimal": value}
    return {"flags": value} if isinstance(value, bool) else value


def result_of(b: Barred, rule: tuple[str, str], route: str) -> dict[str, Any]:
    """Return an expected result as it stands in the files."""
    entry = stored(b.value)
    entry["bar"] = None if b.bar is None else rounded_up(b.bar)
    entry["bar_float32"] = None if b.bar_float32 is None else rounded_up(b.bar_float32)
    entry |= {"rule": rule[0], "route": "exact" if b.bar is None else route}
    return entry | ({"rule_traced": rule[1]} if rule[1] != rule[0] else {})


def entry_of(case: Case, number: int, sets: dict[str, Any]) -> dict[str, Any]:
    """Return a vector as it stands in the files, not yet hunted with."""
    inputs = {k: stored(v) for k, v in case.inputs.items()}
    entry: dict[str, Any] = {"id": f"{case.layer}-{case.rule}-{number:04d}", "layer": case.layer, "rule": case.rule}
    entry |= {"piece": case.piece, "equation": BY_ID[case.rule].equation, "flags": list(case.flags), "hunts": []}
    if case.set is not None:
        shared = sets.setdefault(case.set, {k: inputs[k] for k in SHARED if k in inputs})
        inputs = {k: v for k, v in inputs.items() if shared.get(k) != v}
        entry["set"] = case.set
    entry["in"] = inputs
    if case.layer == "LS":
        values, bars = scheme.converged(case.inputs)
        found = {k: Barred(values[k[:-2]], bars[k[:-2]], None) for k in case.fields}
    else:
        found = barred(case, seed=number)
    route = "longdouble, converged" if case.layer == "LS" else "mpmath-50"
    entry["expect"] = {k: result_of(b, case.fields[k], route) for k, b in found.items()}
    for name, shown in case.instead.items():
        entry["expect"][name]["instead_of"] = shown
    entry["branch"] = branch(case)
    if case.place is not None:
        entry["place"] = case.place
    if case.margin is not None:
        entry["margin"] = float(f"{case.margin:.3g}")
    return entry


def vectors(layer: str, refused: list[str]) -> tuple[dict[str, Any], Iterator[dict[str, Any]]]:
    """Return the shared inputs (filled while the iterator runs) and the admitted vectors; ids of the refused ones are
    added."""
    sets: dict[str, Any] = {}

    def admitted() -> Iterator[dict[str, Any]]:
        for number, case in numbered(layer):
            entry = entry_of(case, number, sets)
            vector = hunted(vector_of(entry, sets))
            if vector is None:
                refused.append(f"{entry['id']} {case.flags}")
                continue
            yield entry | {"hunts": list(vector.hunts), "resolving": vector.resolving}

    return sets, admitted()


def numbered(layer: str) -> Iterator[tuple[int, Case]]:
    """Yield the questions of a layer with their numbers; those to other integrators have the numbers of their short
    runs."""
    if layer == "LS":
        yield from scheme.all_of_them()
        return
    yield from enumerate((case for group in QUESTIONS[layer] for case in group()), 1)


def document(layer: str, refused: list[str]) -> dict[str, Any]:
    """Return the file of one layer."""
    sets, entries = vectors(layer, refused)
    found = list(entries)
    return {"schema": SCHEMA, "layer": layer, "sets": sets, "vectors": found}


def written(thing: Any) -> bytes:
    """Return JSON with one vector a line, the same bytes for the same content."""
    if "vectors" not in thing:
        return (json.dumps(thing, indent=1, ensure_ascii=False) + "\n").encode()
    head = {k: v for k, v in thing.items() if k != "vectors"}
    lines = ",\n".join(json.dumps(v, ensure_ascii=False, separators=(",", ":")) for v in thing["vectors"])
    text = json.dumps(head, ensure_ascii=False, separators=(",", ":"))[:-1] + ',\n"vectors":[\n' + lines + "\n]}\n"
    return text.encode()
