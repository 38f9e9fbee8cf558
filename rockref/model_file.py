"""model.toml: the block, its parameters with their uncertainty, its effects, and where each came from."""

from __future__ import annotations

import difflib
import os
import re
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rockref.effects import catalogue
from rockref.effects.user import file_and_class
from rockref.model.errors import InputError
from rockref.model.parameters import Parameters
from rockref.model.problem import ContactPoints
from rockref.model.storage import read_bytes, write_text

FORMAT = 1
#: A model file is a page of text, and TOML's time grows with the square of the length of a dotted key. Decided: what is
#: longer is refused unread, and not written; at worst a file takes ten seconds.
LARGEST_FILE, LONGEST_LINE = 2**18, 8000
#: Decided: a list of more numbers is written with one on a line.
SHORT_LIST = 60

BLOCK_KEYS = {"mass_kg": "mass", "width_m": "width", "depth_m": "depth", "height_m": "height", "g_m_s2": "g"}
PARAMETER_KEYS = {
    "K_N_N_m": "K_N",
    "K_T_N_m": "K_T",
    "beta_int": "beta_int",
    "beta_ext": "beta_ext",
    "mu_int": "mu_int",
    "mu_ext": "mu_ext",
    "delta_long_m": "delta_long",
    "delta_diag_m": "delta_diag",
    "theta_0_rad": "theta_0",
}
POINT_KEYS = {"set": "points", "foot_radius_m": "foot_radius"}
PROPERTY_KEYS = {"K_N_N_m": "K_N", "K_T_N_m": "K_T", "C_N_N_s_m": "C_N", "C_T_N_s_m": "C_T", "mu_0": "mu_0", "mu": "mu"}
SECTIONS = (
    "format",
    "block",
    "points",
    "parameters",
    "properties",
    "custom_points",
    "effects",
    "uncertainty",
    "origin",
)


def unknown_key(where: str, key: str, known) -> InputError:
    """Return the error for a key that nobody knows, with the nearest one that is known (E-KEY)."""
    near = difflib.get_close_matches(key, sorted(known), 1)
    cure = f"Did you mean {near[0]!r}?" if near else f"Known: {', '.join(sorted(known))}."
    return InputError("E-KEY", where, f"unknown key {key[:80]!r}", cure)


def read_toml(path: str | os.PathLike) -> dict[str, Any]:
    """Return the tables of a TOML file. Raises InputError (E-FILE, E-TOML, E-ENCODING)."""
    raw = read_bytes(path, LARGEST_FILE)
    try:
        text = raw.decode("utf-8-sig")
        check_lines(text, str(path))
        return tomllib.loads(text)
    except UnicodeDecodeError as e:
        line = raw.count(b"\n", 0, e.start) + 1
        what = f"is not UTF-8: byte {raw[e.start]:#04x} in line {line}"
        raise InputError("E-ENCODING", str(path), what, "Save it as UTF-8.") from e
    except RecursionError as e:
        raise InputError("E-TOML", str(path), "is nested too deeply", "A model file is a page of text.") from e
    except InputError:
        raise
    except ValueError as e:  # TOMLDecodeError is one; an integer of more than 4300 digits raises a plain one
        raise InputError(
            "E-TOML", str(path), f"is not valid TOML: {str(e)[:200]}", "Mend the line that is named."
        ) from e


def check_lines(text: str, where: str) -> None:
    """Refuse a file with a line that is too long to be read in time (E-TOML)."""
    for line, content in enumerate(text.split("\n"), start=1):
        if len(content) > LONGEST_LINE:
            what = f"has {len(content)} characters in line {line}"
            raise InputError("E-TOML", where, what, f"Write at most {LONGEST_LINE} in a line.")


def number(where: str, value: Any, size: int | None = None) -> Any:
    """Return a finite float, or a tuple of `size` of them; else InputError (E-TYPE)."""
    items = value if size is not None else [value]
    good = isinstance(items, list) and (size is None or size < 0 or len(items) == size)
    if not good or any(isinstance(a, bool) or not isinstance(a, (int, float)) for a in items):
        wanted = "a number" if size is None else f"a list of {size if size > 0 else ''} numbers"
        raise InputError("E-TYPE", where, f"is {value!r}"[:120], f"Give {wanted}.")
    try:
        numbers = tuple(float(a) for a in items)
    except OverflowError as e:
        raise InputError("E-TYPE", where, "is too large for a number", "Give a finite number.") from e
    if not np.all(np.isfinite(numbers)):
        raise InputError("E-TYPE", where, f"is {value!r}"[:120], "Give a finite number.")
    return numbers if size is not None else numbers[0]


def table(where: str, tables: dict, name: str, known) -> dict:
    """Return a sub-table whose keys are all known; empty where it is missing."""
    found = tables.get(name, {})
    if not isinstance(found, dict):
        raise InputError("E-TYPE", f"{where}: {name}", "is not a table", f"Write [{name}].")
    for key in found:
        if known is not None and key not in known:
            raise unknown_key(f"{where}: [{name}]", key, known)
    return found


def load(cls, path: str | os.PathLike, effects: Sequence[str] = ()):
    """Return a model of class `cls` from a TOML file; `effects` are the user's own that it may have, each
    "file.py:Class"."""
    for spec in effects:
        file_and_class(spec)  # an id is none
        catalogue.named(spec)
    tables, where = read_toml(path), str(path)
    for key in tables:
        if key not in SECTIONS:
            raise unknown_key(where, key, SECTIONS)
    if tables.get("format", FORMAT) != FORMAT:
        what = f"is {tables['format']!r}"[:80]
        raise InputError("E-FORMAT", f"{where}: format", what, f"This version reads {FORMAT}.")
    values: dict[str, Any] = {}
    block = table(where, tables, "block", set(BLOCK_KEYS) | {"inertia_kg_m2"})
    for key, name in BLOCK_KEYS.items():
        if key in block:
            values[name] = number(f"{where}: [block] {key}", block[key])
    if "inertia_kg_m2" in block:
        values["inertia"] = np.array(number(f"{where}: [block] inertia_kg_m2", block["inertia_kg_m2"], 9)).reshape(3, 3)
    points = table(where, tables, "points", POINT_KEYS)
    if "set" in points:
        values["points"] = points["set"]
    if "foot_radius_m" in points:
        values["foot_radius"] = number(f"{where}: [points] foot_radius_m", points["foot_radius_m"])
    values["parameters"] = Parameters().replace(
        **{
            name: number(f"{where}: [parameters] {key}", value, 4 if name == "delta_long" else None)
            for key, value in table(where, tables, "parameters", PARAMETER_KEYS).items()
            for name in [PARAMETER_KEYS[key]]
        }
    )
    if "properties" in tables:
        given = table(where, tables, "properties", PROPERTY_KEYS)
        values["properties"] = _properties(f"{where}: [properties]", given, 8)
    if "custom_points" in tables:
        values["custom_points"] = _custom_points(where, tables)
    values["effects"] = catalogue.from_table(where, tables.get("effects", {}), Path(path).parent)
    values["uncertainty"], values["origin"] = (
        table(where, tables, "uncertainty", None),
        table(where, tables, "origin", None),
    )
    model = cls(**values)
    try:
        model.check()
    except InputError as e:
        raise InputError(e.code, f"{where}: {key_of(e.where)}", e.what, e.cure) from e
    return model


#: Names of the code -> table and key of the file.
PLACES = {
    **{name: f"[block] {key}" for key, name in BLOCK_KEYS.items()},
    **{name: f"[parameters] {key}" for key, name in PARAMETER_KEYS.items()},
    **{name: f"[points] {key}" for key, name in POINT_KEYS.items()},
    "inertia": "[block] inertia_kg_m2",
    "custom_points": "[custom_points]",
}
#: The same within [properties] and [custom_points].
PLACES_OF_POINTS = {**{name: key for key, name in PROPERTY_KEYS.items()}, "P": "P_m", "radius": "radius_m"}


def key_of(where: str) -> str:
    """Return table and key of the file for the place that a check of the model names.

    "K_N" is "[parameters] K_N_N_m", "custom_points K_N of point a" is "[custom_points] K_N_N_m of point a".
    """
    part, _, rest = where.partition(" ")
    if part in ("properties", "custom_points") and rest:
        name = re.match(r"\w*", rest)[0]  # type: ignore[index]
        return f"[{part}] {PLACES_OF_POINTS.get(name, name)}{rest[len(name) :]}"
    name = re.match(r"\w*", where)[0]  # type: ignore[index]
    return PLACES.get(name, name) + where[len(name) :]


def _properties(where: str, given: dict, n: int) -> dict[str, np.ndarray]:
    missing = [k for k in PROPERTY_KEYS if k not in given]
    if missing:
        raise InputError("E-KEY", where, f"{missing[0]} is missing", f"Give {n} numbers.")
    return {PROPERTY_KEYS[k]: np.array(number(f"{where} {k}", given[k], n)) for k in PROPERTY_KEYS}


def _custom_points(where: str, tables: dict) -> ContactPoints:
    given = table(where, tables, "custom_points", {*PROPERTY_KEYS, "names", "P_m", "radius_m"})
    names = given.get("names")
    if not isinstance(names, list) or not names or not all(isinstance(n, str) for n in names):
        raise InputError("E-TYPE", f"{where}: [custom_points] names", f"is {names!r}"[:80], "Give a list of labels.")
    n = len(names)
    P = np.array(number(f"{where}: [custom_points] P_m", given.get("P_m"), 3 * n)).reshape(n, 3)
    q = _properties(f"{where}: [custom_points]", given, n)
    radius = (
        np.array(number(f"{where}: [custom_points] radius_m", given["radius_m"], n)) if "radius_m" in given else None
    )
    return ContactPoints(P=P, radius=radius, names=tuple(names), **q)


def plain(value: Any) -> Any:
    """Return NumPy scalars and arrays as plain numbers and lists."""
    if isinstance(value, np.ndarray):
        return value.ravel().tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (tuple, list)):
        return [plain(v) for v in value]
    return value


def written(value: Any) -> Any:
    """Return a value as tomlkit writes it: a long list with one entry on a line."""
    import tomlkit

    value = plain(value)
    if not isinstance(value, list) or len(value) <= SHORT_LIST:
        return value
    lines = tomlkit.array()
    lines.extend(value)
    return lines.multiline(True)


def save(model, path: str | os.PathLike) -> None:
    """Write `model` as TOML; every number is written so that it reads back to the same bits.

    Raises InputError where a value is none with which anything can be computed, or the file cannot be written.
    """
    import tomlkit

    model.check_values()
    document = tomlkit.document()
    document.add(tomlkit.comment("A rockref model. SI units; the unit is in the key."))
    tables: dict[str, Any] = {"format": FORMAT, "block": {k: getattr(model, n) for k, n in BLOCK_KEYS.items()}}
    if model.inertia is not None:
        tables["block"]["inertia_kg_m2"] = model.inertia
    tables["points"] = {k: getattr(model, n) for k, n in POINT_KEYS.items()}
    tables["parameters"] = {k: getattr(model.parameters, n) for k, n in PARAMETER_KEYS.items()}
    if model.properties is not None:
        tables["properties"] = {k: model.properties[n] for k, n in PROPERTY_KEYS.items()}
    if model.custom_points is not None:
        c = model.custom_points
        tables["custom_points"] = {"names": c.names, "P_m": c.P, **{k: getattr(c, n) for k, n in PROPERTY_KEYS.items()}}
        if c.radius is not None:
            tables["custom_points"]["radius_m"] = c.radius
    # In the order of the step, in which they are read back: a model has one text.
    tables["effects"] = catalogue.to_table(catalogue.in_step_order(model.effects), Path(path).parent)
    tables |= {"uncertainty": model.uncertainty, "origin": model.origin}
    for key, value in tables.items():
        if isinstance(value, dict):
            if value:
                document[key] = {
                    k: ({i: written(j) for i, j in v.items()} if isinstance(v, dict) else written(v))
                    for k, v in value.items()
                }
        else:
            document[key] = value
    text = tomlkit.dumps(document)
    check_lines(text, str(path))
    write_text(path, text)
