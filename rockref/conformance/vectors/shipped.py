"""The vectors as they are shipped: reading them, checking their digests, the problems that they pose."""

from __future__ import annotations

import csv
import hashlib
import io
import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import lru_cache
from importlib.resources import files
from typing import Any

import numpy as np

from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError
from rockref.model.problem import Block, ContactPoints, Problem, State
from rockref.model.storage import unpacked

VERSION = "v1"
SCHEMA = "rockref-vectors/1"
#: Decided: the largest file that is shipped has 0.9 MB, 1.0 MB unpacked; a number has 30 characters.
LARGEST, LONGEST_NUMBER = 16_000_000, 1000


@dataclass(frozen=True)
class Expected:
    """One expected result: value (float64 or bool), bar and bar_float32 of the same shape (None: exact flag; in
    float32 not judged), the rule that it shows, the rule that it shows to who sees the trace, and the route.

    instead_of : looked at only where that result is not shown
    """

    value: np.ndarray
    bar: np.ndarray | None
    bar_float32: np.ndarray | None
    rule: str
    rule_traced: str
    route: str
    instead_of: str = ""


@dataclass(frozen=True)
class Vector:
    """One question put to one piece of a backend, with the answers.

    place : of a short run: between which numbers it is judged, where that is not its own number
    """

    id: str
    layer: str
    rule: str
    piece: str
    equation: str
    flags: tuple[str, ...]
    hunts: tuple[str, ...]
    inputs: dict[str, Any]
    expect: dict[str, Expected]
    branch: dict[str, Any]
    margin: float | None = None
    resolving: dict[str, float] = field(default_factory=dict)
    place: float | None = None


@dataclass(frozen=True)
class Trajectory:
    """One run: its problem, the rows, their bars, where comparison ends, and the instants of the main impacts.

    columns : name -> (N,) or (N, k): t_s, W_rad_s, x_m, Lambda (N, 9), converged_..., and bar_..., bar_float32_...,
        bar_scheme_... (N,)
    """

    id: str
    title: str
    problem: Problem
    meta: dict[str, Any]
    columns: dict[str, np.ndarray]


def folder():
    """Return the folder of the vectors inside the package."""
    return files("rockref.conformance") / "vectors" / VERSION


def read_bytes(name: str) -> bytes:
    """Return a shipped file, e.g. "L1.json". Raises InputError (E-VECTORS) where it is missing or altered."""
    path = folder().joinpath(*name.split("/"))
    try:
        with path.open("rb") as stream:
            data = stream.read(LARGEST + 1)
    except OSError as e:
        raise InputError("E-VECTORS", name, "is not there", "Install rockref anew, or run `make golden`.") from e
    if len(data) > LARGEST:
        raise InputError("E-VECTORS", name, f"has more than {LARGEST} bytes", "Install rockref anew.")
    if name != "MANIFEST.json":
        listed = manifest()["files"]
        with as_shipped("MANIFEST.json"):
            wanted = listed.get(name, {}).get("sha256")
        if wanted != hashlib.sha256(data).hexdigest():
            raise InputError("E-VECTORS", name, "does not have the digest of the manifest", "Install rockref anew.")
    return data


@contextmanager
def as_shipped(name: str) -> Iterator[None]:
    """Say of a file that cannot be understood that it is not as it was shipped (E-VECTORS)."""
    try:
        yield
    except InputError:
        raise
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError, OverflowError, csv.Error) as e:
        what = f"is not as it was shipped ({type(e).__name__}: {str(e)[:80]})"
        raise InputError("E-VECTORS", name, what, "Install rockref anew.") from e


@lru_cache
def manifest() -> dict[str, Any]:
    """Return the manifest: schema, versions, digests, resolving power. Raises InputError (E-VECTORS)."""
    with as_shipped("MANIFEST.json"):
        found = json.loads(read_bytes("MANIFEST.json"))
        return found | {"files": dict(found["files"]), "trajectories": list(found["trajectories"])}


def from_hex(nested: Any) -> Any:
    """Return numbers from hexadecimal text, nested lists as they are."""
    if isinstance(nested, list):
        return [from_hex(n) for n in nested]
    if len(nested) > LONGEST_NUMBER:
        raise ValueError(f"a number of {len(nested)} characters")
    return float.fromhex(nested)


def value_of(entry: Any) -> Any:
    """Return a stored value: numbers as float64 array, flags as bool array, whole numbers and names as they are."""
    if isinstance(entry, dict) and "hex" in entry:
        return np.array(from_hex(entry["hex"]))
    if isinstance(entry, dict) and "flags" in entry:
        return np.array(entry["flags"], bool)
    return entry


def expected_of(entry: dict[str, Any]) -> Expected:
    """Return an expected result from its stored form."""
    bars = {k: None if entry.get(k) is None else np.array(entry[k], float) for k in ("bar", "bar_float32")}
    rule = entry["rule"]
    return Expected(
        np.asarray(value_of(entry)),
        bars["bar"],
        bars["bar_float32"],
        rule,
        entry.get("rule_traced", rule),
        entry["route"],
        entry.get("instead_of", ""),
    )


def vector_of(entry: dict[str, Any], sets: dict[str, Any]) -> Vector:
    """Return a vector from its stored form; `sets` holds inputs that many vectors share."""
    stored = dict(sets[entry["set"]]) if "set" in entry else {}
    stored.update(entry["in"])
    return Vector(
        entry["id"],
        entry["layer"],
        entry["rule"],
        entry["piece"],
        entry["equation"],
        tuple(entry["flags"]),
        tuple(entry["hunts"]),
        {k: value_of(v) for k, v in stored.items()},
        {k: expected_of(v) for k, v in entry["expect"].items()},
        entry["branch"],
        entry.get("margin"),
        entry.get("resolving", {}),
        entry.get("place"),
    )


@lru_cache
def layer(name: str) -> tuple[Vector, ...]:
    """Return all vectors of one layer, "L0" .. "L4", "L7", or of the short runs, "L5s". Raises InputError
    (E-VECTORS)."""
    with as_shipped(f"{name}.json"):
        document = json.loads(read_bytes(f"{name}.json"))
        return tuple(vector_of(entry, document["sets"]) for entry in document["vectors"])


#: What a row of a run shows of a step, and how it ends a vector's name there.
OF_A_ROW, AS_RUN = ("x", "Lambda", "W", "F_N", "anchored", "F_stick", "F_slip"), "-run"


@lru_cache
def steps_as_runs() -> tuple[Vector, ...]:
    """Return the vectors of L4 as runs of one step, for who shows no step: the same numbers, looked for in the second
    row."""

    def as_run(v: Vector) -> Vector:
        expect = {f"{k}@1": e for k, e in v.expect.items() if k in OF_A_ROW}
        return replace(v, id=v.id + AS_RUN, piece="simulate", expect=expect)

    return tuple(map(as_run, layer("L4")))


def problem_of(q: dict[str, Any]) -> Problem:
    """Return a Problem from flat inputs, the keys of the JSON-lines protocol."""
    block = Block(np.asarray(q["mass"]), np.asarray(q["inertia"]), np.asarray(q["g"]))
    made = {k: np.asarray(q[k]) for k in ("P", "K_N", "K_T", "C_N", "C_T", "mu_0", "mu")}
    names = tuple(q.get("names", [f"point {i}" for i in range(len(q["P"]))]))
    points = ContactPoints(**made, radius=None, names=names)
    state: dict[str, Any] = {k: np.asarray(q[k]) for k in ("x", "v", "Lambda", "W", "s")}
    state |= {k: np.asarray(q[k], bool) for k in ("anchored", "sliding")}
    state |= {k: np.asarray(q[k]) for k in ("a", "T", "F") if q.get(k) is not None}
    start = State(**state, t=float(q.get("t", 0.0)))
    base = None
    if q.get("base") is not None:
        base = BaseMotion(float(q["base"]["t_0"]), float(q["base"]["dt"]), np.asarray(q["base"]["a"], float))
    times = float(q["step"]), float(q["duration"]), float(q["output_rate"])
    return Problem(block, points, start, *times, base=base)


def flat(problem: Problem) -> dict[str, Any]:
    """Return the flat inputs of a problem, as `problem_of` takes them."""
    b, p, s = problem.block, problem.points, problem.start
    q: dict[str, Any] = {"mass": b.mass, "inertia": b.inertia, "g": b.g, "names": list(p.names)}
    q |= {k: getattr(p, k) for k in ("P", "K_N", "K_T", "C_N", "C_T", "mu_0", "mu")}
    q |= {k: getattr(s, k) for k in ("x", "v", "Lambda", "W", "s", "anchored", "sliding", "t")}
    q |= {k: getattr(s, k) for k in ("a", "T", "F") if getattr(s, k) is not None}
    if (base := problem.base) is not None:
        q["base"] = {"t_0": base.t_0, "dt": base.dt, "a": base.a}
    return q | {k: getattr(problem, k) for k in ("step", "duration", "output_rate")}


def trajectory_names() -> tuple[str, ...]:
    """Return the trajectories of L5, in order."""
    return tuple(manifest()["trajectories"])


def window_names() -> tuple[str, ...]:
    """Return the windows of L5: 20 ms cut out of trajectories."""
    return tuple(manifest()["windows"])


@lru_cache
def trajectory(name: str) -> Trajectory:
    """Return one trajectory of L5. Raises InputError (E-VECTORS; E-GZIP, E-SIZE)."""
    with as_shipped(f"L5/{name}.json"):
        meta = json.loads(read_bytes(f"L5/{name}.json"))
        problem = problem_of({k: value_of(v) for k, v in meta["problem"].items()})
    with as_shipped(f"L5/{name}.csv.gz"):
        columns = columns_of(unpacked(read_bytes(f"L5/{name}.csv.gz"), f"L5/{name}.csv.gz", LARGEST).decode())
        return Trajectory(meta["id"], meta["title"], problem, meta, columns)


def columns_of(text: str) -> dict[str, np.ndarray]:
    """Return the columns of a run from CSV: (N,), or (N, k) where there are k of the name, `W_rad_s[0]` for example."""
    header, *rows = csv.reader(io.StringIO(text))
    table = np.array([[float(c) if c else np.nan for c in row] for row in rows])
    columns: dict[str, np.ndarray] = {}
    for key in dict.fromkeys(h.partition("[")[0] for h in header):
        picked = [i for i, h in enumerate(header) if h.partition("[")[0] == key]
        columns[key] = table[:, picked[0]] if header[picked[0]] == key else table[:, picked]
    return columns
