"""The keys of a TOML file: which there may be, in which unit, in which range; everything else is refused by name."""

from __future__ import annotations

import difflib
import math
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rockref.measure.reading.rawfile import read_text
from rockref.measure.records.notice import shown
from rockref.model.errors import InputError

# decided: a thousand runs of 150 characters are 150 kB.
MAX_TOML_BYTES = 2**18
# decided: no key of ours needs more; it also bounds the depth of dotted keys, whose cost grows with its square.
MAX_TOML_LINE = 1000


@dataclass(frozen=True)
class Number:
    """A number with a unit: its key is ``<name>_<unit>``, or the bare name where the unit is empty."""

    name: str
    units: Mapping[str, float]
    low: float
    high: float
    required: bool = True
    example: str = ""

    @property
    def keys(self) -> list[str]:
        """Return every key under which the number may stand."""
        return [f"{self.name}_{unit}" if unit else self.name for unit in self.units]


@dataclass(frozen=True)
class Range(Number):
    """Two numbers with a unit, the lower one first: a list ``[low, high]``."""


@dataclass(frozen=True)
class Text:
    """A piece of text: one of `choices`, or anything short if there are none."""

    name: str
    choices: Sequence[str] = ()
    required: bool = True
    example: str = ""

    @property
    def keys(self) -> list[str]:
        """Return the one key under which the text stands."""
        return [self.name]


@dataclass(frozen=True)
class Section:
    """A sub-table, or a list of them; read later with a specification of its own."""

    name: str
    many: bool = False
    required: bool = True

    @property
    def keys(self) -> list[str]:
        """Return the one key under which the section stands."""
        return [self.name]


Field = Number | Text | Section


def read_toml(path: Path) -> tuple[dict[str, Any], str]:
    """Return the content of a TOML file and the SHA-256 of its bytes.

    Raises InputError: E-FILE, E-SIZE, E-GZIP, E-ENCODING, E-EMPTY, E-TOML.
    """
    cure = "Compare it with the example in the documentation."
    raw = read_text(path, max_packed=MAX_TOML_BYTES, max_text=MAX_TOML_BYTES, if_empty=cure)
    for number, line in enumerate(raw.text.split("\n"), start=1):
        if len(line) > MAX_TOML_LINE:
            raise InputError("E-TOML", f"{path}, line {number}", f"{len(line)} characters in one line", cure)
    try:
        return tomllib.loads(raw.text), raw.sha256
    except RecursionError:
        raise InputError("E-TOML", str(path), "tables or lists are nested too deeply", cure) from None
    except ValueError as error:  # TOMLDecodeError is one; an integer of more than 4300 digits raises a plain one
        raise InputError("E-TOML", str(path), f"is not TOML ({error})", cure) from None


def read_fields(table: Any, fields: Sequence[Field], where: str) -> dict[str, Any]:
    """Return the values of `fields` by name, numbers in SI; a field that may be absent is then None.

    `where` is the file and the path of the table in it, for example ``experiment.toml, run[2]``.
    Raises InputError: E-TYPE, E-KEY-UNKNOWN, E-KEY-MISSING, E-KEY-TWICE, E-UNIT, E-RANGE, E-CHOICE.
    """
    if not isinstance(table, dict):
        raise InputError("E-TYPE", where, f"{_value(table)} is not a table", "Write a table with its keys.")
    refuse_unknown(table, fields, where)
    found: dict[str, Any] = {}
    for field in fields:
        present = [key for key in field.keys if key in table]
        if len(present) > 1:
            what = f"{' and '.join(present)} say the same thing"
            raise InputError("E-KEY-TWICE", where, what, "Keep one of them.")
        if not present:
            if field.required:
                what = f"no key {' or '.join(field.keys)}"
                raise InputError("E-KEY-MISSING", where, what, "Add it.")
            found[field.name] = None
            continue
        found[field.name] = _read(field, present[0], table[present[0]], f"{where}, key {present[0]}")
    return found


def refuse_unknown(table: Mapping[str, Any], fields: Sequence[Field], where: str) -> None:
    """Refuse a key that no field has. Raises InputError: E-KEY-UNKNOWN, and E-UNIT for one without its unit."""
    known = {key: field for field in fields for key in field.keys}
    for key in table:
        if key in known:
            continue
        for field in fields:
            if isinstance(field, Number) and (key == field.name or key.startswith(field.name + "_")):
                what = f"the key {shown(key)} names no unit that is known"
                raise InputError("E-UNIT", f"{where}, key {shown(key)}", what, f"Write {' or '.join(field.keys)}.")
        # difflib is quadratic in the length of a key, and a key may be as long as a line.
        near = difflib.get_close_matches(key[:64], list(known), n=1, cutoff=0.5)
        hint = f"Did you mean {near[0]}?" if near else f"Known are {', '.join(sorted(known))}."
        raise InputError("E-KEY-UNKNOWN", f"{where}, key {shown(key)}", "the key is not known", hint)


def _read(field: Field, key: str, value: Any, where: str) -> Any:
    if isinstance(field, Number):
        factor = field.units[key[len(field.name) + 1 :]]
        return (_range if isinstance(field, Range) else _number)(value, field, factor, where)
    if isinstance(field, Text):
        return _text(value, field, where)
    if field.many:
        if not isinstance(value, list) or not value or not all(isinstance(item, dict) for item in value):
            raise InputError("E-TYPE", where, f"{_value(value)} is not a list of tables", f"Write [[{field.name}]].")
    elif not isinstance(value, dict):
        raise InputError("E-TYPE", where, f"{_value(value)} is not a table", f"Write [{field.name}].")
    return value


def _number(value: Any, field: Number, factor: float, where: str) -> float:
    # bool is an int to Python, and not to anybody else.
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError("E-TYPE", where, f"{_value(value)} is not a number", "Write a number without quotes.")
    low, high = field.low / factor, field.high / factor
    # Compared before it is made a float: a whole number of a thousand digits has no float.
    if (isinstance(value, float) and not math.isfinite(value)) or not low <= value <= high:
        what = f"{_value(value)} is outside {low:.6g} to {high:.6g}"
        raise InputError("E-RANGE", where, what, "Check the number and its unit.")
    return float(value) * factor


def _range(value: Any, field: Number, factor: float, where: str) -> tuple[float, float]:
    if not isinstance(value, list) or len(value) != 2:
        raise InputError("E-TYPE", where, f"{_value(value)} is not a range", "Write [low, high].")
    low, high = (_number(number, field, factor, where) for number in value)
    if not low < high:
        raise InputError("E-RANGE", where, f"{low:.6g} to {high:.6g} is empty", "Write the lower number first.")
    return low, high


def _text(value: Any, field: Text, where: str) -> str:
    if not isinstance(value, str):
        raise InputError("E-TYPE", where, f"{_value(value)} is not text", "Write it in double quotes.")
    if field.choices and value not in field.choices:
        near = difflib.get_close_matches(value[:64], list(field.choices), n=1, cutoff=0.5)
        hint = f"Did you mean {near[0]}?" if near else f"Known are {', '.join(field.choices)}."
        raise InputError("E-CHOICE", where, f"{shown(value)} is not known", hint)
    return value


def _value(value: Any) -> str:
    """Return a value of the file for a message, short, whatever it is."""
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, list):
        return f"a list of {len(value)}"
    if isinstance(value, int) and not isinstance(value, bool) and abs(value) >= 10**40:
        return "a whole number of more than forty digits"
    return shown(str(value)) if isinstance(value, str) else shown(str(value)).strip("'")
