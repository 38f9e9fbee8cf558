"""Experiments of kind ``shaken``: a folder with ``experiment.toml``, the table ``tests.csv`` and records of motions."""

from __future__ import annotations

import hashlib
import io
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from rockref.measure.reading.columns import DEGREE
from rockref.measure.reading.keys import SHAKEN
from rockref.measure.reading.rawfile import read_text
from rockref.measure.reading.schema import Field, Number, Section, Text, read_fields, read_toml
from rockref.measure.records.notice import Notice, shown
from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError
from rockref.model.problem import GRAVITY
from rockref.model.shown import Shown, span
from rockref.shake.ensemble import Draws
from rockref.shake.motion_size import motion_size
from rockref.shake.records.door import read_record

TABLE = "tests.csv"
#: decided: a campaign of more tests than this is several experiments.
MOST_TESTS = 20_000
#: What runs of a model draw, since nobody knows it of the tests; decided ranges, those of any placing.
DRAWS: tuple[Field, ...] = (
    Number("heading", {"deg": 1.0, "rad": 1 / DEGREE}, 0.0, 180.0, required=False),
    Number("feet", {"m": 1.0, "mm": 1e-3}, 0.0, 1.0, required=False),
    Number("friction", {"": 1.0}, 0.0, 3.0, required=False),
)
TOP: tuple[Field, ...] = (Text("name"), Text("kind", (SHAKEN,)), Section("draws", required=False))
#: Columns of numbers by what they hold, with their units.
NUMBERS = {
    "fell": {"fell": 1.0},
    "factor": {"factor": 1.0},
    "rotate": {"rotate_deg": 1.0},
    "pga": {"pga_m_s2": 1.0, "pga_g": GRAVITY},
    "pgv": {"pgv_m_s": 1.0, "pgv_cm_s": 1e-2},
    "tilt": {"tilt_rad": 1.0, "tilt_deg": DEGREE},
    "slide": {"slide_m": 1.0, "slide_mm": 1e-3},
    "twist": {"twist_rad": 1.0, "twist_deg": DEGREE},
}
LABELS = ("test", "motion", "record")
#: Maxima of a test that are compared, with their unit.
MAXIMA = {"tilt": "rad", "slide": "m", "twist": "rad"}
#: Columns with somebody else's probability of falling: p_ and a name.
_PREDICTION = re.compile(r"p_(\w+)", re.ASCII)


@dataclass(frozen=True, eq=False, repr=False)
class ShakenExperiment(Shown):
    """Tests of a block on a shake table.

    motion : (n,) labels; tests of one motion depend on one another
    fell : (n,) 0 or 1, or None;  maxima : (n,) by name, of `MAXIMA`; NaN where a test has none
    sizes : (n, 2) PGA [m/s2] and PGV [m/s], or None;  motions : of the plate, one a test, or None without records
    stated : (n,) probabilities of falling by name, from columns p_NAME;  draws : what is unknown of every test
    """

    name: str
    motion: np.ndarray
    fell: np.ndarray | None
    maxima: dict[str, np.ndarray]
    sizes: np.ndarray | None
    motions: tuple[BaseMotion, ...] | None
    stated: dict[str, np.ndarray]
    draws: Draws
    digest: str
    notices: tuple[Notice, ...] = field(default=(), repr=False)

    def facts(self) -> dict[str, str]:
        """Return name, tests, motions, outcomes and remarks, in words."""
        found = {"name": self.name, "tests": str(len(self.motion)), "motions": str(len(np.unique(self.motion)))}
        found |= {} if self.fell is None else {"fell": str(int(self.fell.sum()))}
        found |= {"maxima": ", ".join(self.maxima)} if self.maxima else {}
        found |= {} if self.sizes is None else {"PGA": span(self.sizes[:, 0], "m/s2", 3)}
        found |= {"records": "yes" if self.motions is not None else "no"}
        return found | ({"remarks": str(len(self.notices))} if self.notices else {})


def is_shaken_folder(path: Path | str) -> bool:
    """Return whether a folder holds an experiment of kind ``shaken``; never raises."""
    try:
        return read_toml(Path(path) / "experiment.toml")[0].get("kind") == SHAKEN
    except InputError:
        return False


def load_shaken(folder: Path | str) -> ShakenExperiment:
    """Read a folder of tests on a shake table.

    Raises InputError: those of :func:`read_toml`, :func:`read_fields` and of the reader of records, E-COLUMN-MISSING,
    E-COLUMN-TWICE, E-NUMBER, E-RANGE, E-SIZE, E-PATH.
    """
    folder = Path(folder)
    document, toml = read_toml(folder / "experiment.toml")
    top = read_fields(document, TOP, str(folder / "experiment.toml"))
    draws = read_fields(top["draws"] or {}, DRAWS, f"{folder / 'experiment.toml'}, [draws]")
    source = folder / TABLE
    raw = read_text(source)
    table, notices = _table(raw.text, source)
    numbers = {name: _numbers(table, name, source) for name in NUMBERS}
    motions, digests, found = _motions(table, numbers, folder)
    motion = table["motion"] if "motion" in table else table.get("record")
    if motion is None:
        cure = "Give a column motion: tests of one motion depend on one another."
        raise InputError("E-COLUMN-MISSING", str(source), "has no column motion and no column record", cure)
    fell, maxima = _outcomes(numbers, source)
    stated = {m[1]: _column(table, m[0], source) for name in table.columns if (m := _PREDICTION.fullmatch(name))}
    digest = hashlib.sha256("".join([toml, raw.sha256, *digests]).encode()).hexdigest()
    return ShakenExperiment(
        name=top["name"], motion=np.array([str(label) for label in motion]), fell=fell, maxima=maxima,
        sizes=_sizes(numbers, motions), motions=motions, stated=stated,
        draws=Draws(**{k: v or 0.0 for k, v in draws.items()}), digest=digest,
        notices=(*raw.notices, *notices, *found),
    )  # fmt: skip


def _outcomes(numbers: dict[str, Any], source: Path) -> tuple[np.ndarray | None, dict[str, np.ndarray]]:
    """Return what fell (n,) or None, and the maxima by name. Raises InputError E-RANGE, E-COLUMN-MISSING."""
    fell = numbers["fell"]
    if fell is not None and not np.isin(fell, (0.0, 1.0)).all():
        line = int(np.flatnonzero(~np.isin(fell, (0.0, 1.0)))[0]) + 2
        raise InputError("E-RANGE", f"{source}, line {line}, column fell", "is not 0 or 1", "1 for fell, 0 for stood.")
    maxima = {name: numbers[name] for name in MAXIMA if numbers[name] is not None}
    if fell is None and not maxima:
        cure = "Give fell (0 or 1), or a largest tilt_deg, slide_mm or twist_deg."
        raise InputError("E-COLUMN-MISSING", str(source), "states no outcome", cure)
    return fell, maxima


def _table(text: str, source: Path) -> tuple[Any, list[Notice]]:
    """Return the table as text, and a remark on columns that nobody knows."""
    import pandas as pd

    try:
        table = pd.read_csv(io.StringIO(text), dtype=str, keep_default_na=False, skipinitialspace=True)
    except ValueError as e:
        raise InputError("E-FILE", str(source), f"cannot be read ({str(e)[:80]})", "Give comma-separated text.") from e
    if not 0 < len(table) <= MOST_TESTS:
        raise InputError("E-SIZE", str(source), f"has {len(table)} tests", f"Give 1 to {MOST_TESTS}.")
    known = {*LABELS, *(key for units in NUMBERS.values() for key in units)}
    strangers = [name for name in table.columns if name not in known and not _PREDICTION.fullmatch(name)]
    if not strangers:
        return table, []
    what = f"columns {', '.join(shown(name) for name in strangers[:4])} are not known"
    return table, [Notice("W-COLUMN-UNREAD", str(source), what, "They were left unread.")]


def _numbers(table: Any, name: str, source: Path) -> np.ndarray | None:
    """Return a quantity in SI (n,), None where the table has no column of it. Raises InputError E-COLUMN-TWICE."""
    keys = [key for key in NUMBERS[name] if key in table.columns]
    if len(keys) > 1:
        raise InputError("E-COLUMN-TWICE", str(source), f"{' and '.join(keys)} say the same", "Keep one of them.")
    if not keys:
        return None
    return NUMBERS[name][keys[0]] * _column(table, keys[0], source, empty=name in MAXIMA)


def _column(table: Any, key: str, source: Path, empty: bool = False) -> np.ndarray:
    """Return a column of numbers (n,); True and False are 1 and 0, nothing is NaN where it may be `empty`."""
    words = {"true": "1", "false": "0"} | ({"": "nan"} if empty else {})
    values = np.empty(len(table))
    for k, cell in enumerate(table[key]):
        try:
            values[k] = float(words.get(cell.strip().lower(), cell))
        except ValueError:
            values[k] = np.inf
        if np.isinf(values[k]) or (np.isnan(values[k]) and not empty):
            where = f"{source}, line {k + 2}, column {key}"
            raise InputError("E-NUMBER", where, f"{shown(cell)} is not a number", "Mend or remove the row.")
    return values


def _motions(
    table: Any, numbers: dict[str, Any], folder: Path
) -> tuple[tuple[BaseMotion, ...] | None, list[str], list[Notice]]:
    """Return the motion of each test, digests of the records, and what their reader noticed."""
    if "record" not in table:
        return None, [], []
    read: dict[str, BaseMotion] = {}
    notices: list[Notice] = []
    for name in dict.fromkeys(table["record"]):
        files = [_inside(folder, part) for part in name.split("+")]
        record = read_record(files)
        read[name] = record.base
        notices += record.notices
    digests = [hashlib.sha256(base.a.tobytes()).hexdigest() for base in read.values()]
    count = len(table)
    factor, turn = (numbers["factor"], np.ones(count)), (numbers["rotate"], np.zeros(count))
    factors, turns = (given if given is not None else default for given, default in (factor, turn))
    made: dict[tuple[str, float, float], BaseMotion] = {}
    keys = list(zip(table["record"], factors.tolist(), turns.tolist(), strict=True))
    for key in keys:
        if key not in made:
            made[key] = read[key[0]].rotated(key[2]).scaled(key[1])
    return tuple(made[key] for key in keys), digests, notices


def _inside(folder: Path, name: str) -> Path:
    """Return the path of a record in the folder. Raises InputError E-PATH for one that is not inside."""
    path = folder / name.strip()
    if not name.strip() or not path.resolve().is_relative_to(folder.resolve()):
        cure = "Put the record into the folder, and write its name only."
        raise InputError("E-PATH", f"{folder / TABLE}, column record", f"{shown(name)} is not inside", cure)
    return path


def _sizes(numbers: dict[str, Any], motions: tuple[BaseMotion, ...] | None) -> np.ndarray | None:
    """Return PGA and PGV (n, 2), stated ones before those of the records; None where they are not known."""
    known: dict[int, tuple[float, float]] = {}
    if motions is not None:
        known = {id(base): motion_size(base) for base in motions}
    columns = []
    for place, name in enumerate(("pga", "pgv")):
        if numbers[name] is not None:
            columns.append(numbers[name])
        elif motions is not None:
            columns.append(np.array([known[id(base)][place] for base in motions]))
        else:
            return None
    return np.column_stack(columns)
