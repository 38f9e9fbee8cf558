"""The keys of ``experiment.toml``: units, ranges, an example each; what is missing is said at once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from rockref.measure.reading.columns import DEGREE
from rockref.measure.reading.schema import Field, Number, Range, Section, Text, refuse_unknown
from rockref.measure.records.release import FIT, HOLDOUT
from rockref.model.errors import InputError

USES = (FIT, HOLDOUT)
KINDS = ("release", "toss")
#: Kind of a folder of tests on a shake table, which `rockref.shake.experiment` reads.
SHAKEN = "shaken"
BASELINES = ("eight_points", "four_points")

_LENGTH = {"m": 1.0, "mm": 1e-3}
_RATE = {"deg_s": DEGREE, "rad_s": 1.0}
_ANGLE = {"rad": 1.0, "deg": DEGREE}
_TURN = {"deg": DEGREE, "rad": 1.0}
_HZ = {"hz": 1.0}

# decided ranges: a block that two hands or a crane can move, an instrument that can be bought.
BLOCK = (
    Number("mass", {"kg": 1.0}, 1e-3, 1e6, example="54.0"),
    Number("width", _LENGTH, 1e-3, 100.0, example="0.100"),
    Number("height", _LENGTH, 1e-3, 100.0, example="0.688"),
)
RELEASE = (Number("tilt_uncertainty", _ANGLE, 0.0, 0.5, required=False),)
# Ranges of the law's numbers that replace the wide ones of a fit; decided: what `rockref.api.Model` takes.
PRIOR = (
    Range("K_N", {"N_m": 1.0}, 1.0, 1e13, required=False),
    Range("K_T_over_K_N", {"": 1.0}, 1e-3, 1e3, required=False),
    *(Range(name, {"": 1.0}, 1e-4, 10.0, required=False) for name in ("beta_int", "beta_ext", "mu_int", "mu_ext")),
    Range("delta_long", _LENGTH, -1.0, 1.0, required=False),
    Range("delta_diag", _LENGTH, 1e-6, 10.0, required=False),
)
GYRO = (
    Number("sample_rate", _HZ, 10.0, 1e6, example="1000"),
    Number("noise", _RATE, 0.0, 2.0, required=False),
    Number("bandwidth", _HZ, 0.1, 1e6, required=False),
    Number("resolution", _RATE, 0.0, 2.0, required=False),
    Number("range", _RATE, 1e-3, 1e3, required=False),
    Number("zero_uncertainty", _RATE, 0.0, 0.1, required=False),
)


def top_fields(release: bool) -> tuple[Field, ...]:
    """Return the keys of the document; a toss has neither release nor gyroscope to state."""
    return (
        Text("name", example='"my_block"'),
        Text("kind", KINDS, example='"release"'),
        Text("baseline", BASELINES, example='"eight_points"'),
        Section("block"),
        Section("release", required=False),
        Section("gyro", required=release),
        Section("prior", required=False),
        Section("run", many=True),
    )


def run_fields(release: bool) -> tuple[Field, ...]:
    """Return the keys of a run."""
    return (
        Text("id", example='"01"'),
        Text("file", example='"run01.csv"'),
        Text("use", USES, example='"fit"'),
        Number("release_tilt", _ANGLE, -1e6, 1e6, required=release, example="0.117"),
        Number("block_turned", _TURN, -1e6, 1e6, required=release, example="0"),
    )


def check_complete(document: Mapping[str, Any], source: str) -> None:
    """Refuse a document in which keys are missing, and name all of them, with an example line each.

    A key that is not known is refused before: it may be a missing one, misspelt. Raises InputError: E-KEY-MISSING,
    E-KEY-UNKNOWN, E-UNIT.
    """
    missing: list[tuple[str, str]] = []
    lines: list[str] = []
    for title, head, table, fields in _tables(document):
        if not isinstance(table, Mapping):
            continue  # refused with its type when it is read
        refuse_unknown(table, fields, f"{source}, {title}" if title else source)
        absent = [
            field
            for field in fields
            if not isinstance(field, Section) and field.required and not any(key in table for key in field.keys)
        ]
        if not absent:
            continue
        missing += [(title, " or ".join(field.keys)) for field in absent]
        lines += [head] if head else []
        lines += [f"{field.keys[0]} = {field.example}" for field in absent]
    if not missing:
        return
    places = {title for title, _ in missing}
    where = source if len(places) > 1 or "" in places else f"{source}, {places.pop()}"
    named = ", ".join(f"{title} {keys}".strip() if where == source else keys for title, keys in missing)
    what = f"no key {named}" if len(missing) == 1 else f"{len(missing)} keys are missing: {named}"
    raise InputError("E-KEY-MISSING", where, what, "Add, with your own values:\n  " + "\n  ".join(lines) + "\n")


def _tables(document: Mapping[str, Any]) -> Iterator[tuple[str, str, Any, Sequence[Field]]]:
    """Yield title, heading, content and keys of the document's tables; absent ones are empty."""
    release = document.get("kind") != "toss"
    yield "", "", document, top_fields(release)
    yield "[block]", "[block]", document.get("block", {}), BLOCK
    if release or "gyro" in document:
        yield "[gyro]", "[gyro]", document.get("gyro", {}), GYRO
    runs = document.get("run", [{}])
    for number, run in enumerate(runs if isinstance(runs, list) else [], start=1):
        yield f"run[{number}]", "[[run]]", run, run_fields(release)
