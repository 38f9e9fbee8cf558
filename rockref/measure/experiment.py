"""Experiment folders: ``experiment.toml`` and one table a run."""

from __future__ import annotations

import math
import re
import shlex
from collections.abc import Collection, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from rockref.measure.checks.checklist import checked
from rockref.measure.checks.copies import note_copies
from rockref.measure.checks.datasheet import completed
from rockref.measure.checks.sensor import sensor_faults
from rockref.measure.reading.columns import DEGREE, POSE, RATES
from rockref.measure.reading.keys import (
    BLOCK,
    GYRO,
    PRIOR,
    RELEASE,
    SHAKEN,
    USES,
    check_complete,
    run_fields,
    top_fields,
)
from rockref.measure.reading.schema import read_fields, read_toml
from rockref.measure.reading.table import read_table
from rockref.measure.reading.timebase import check_forward, regular_samples
from rockref.measure.records.notice import Notice, shown
from rockref.measure.records.release import FIT, HOLDOUT, Experiment, Gyro, Run
from rockref.measure.signals.signal import Signal
from rockref.model.errors import InputError

# kg/m3: osmium, the densest element, has 22590 (CRC Handbook of Chemistry and Physics).
DENSEST = 23e3
# kg/m3; decided: the lightest boards of plastic foam, of which a block of records might be.
LIGHTEST = 10.0
# rad, where a release states none; decided: 1 mm of wire (the source's "±0.08°").
TILT_UNCERTAINTY = 1.4e-3
# decided: a campaign of more runs than this is several experiments.
MAX_RUNS = 1000
# Endings of what loggers write.
LOGS = (".csv", ".txt", ".tsv", ".zip")
# decided: ids and names become parts of file names in reports.
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}", re.ASCII)


def load_experiment(folder: Path | str, *, uses: Collection[str] = USES) -> Experiment:
    """Load an experiment folder; runs whose use is not in `uses` are listed, but their file is not opened.

    Raises InputError: those of the reader (see :func:`read_table`), of the keys (:func:`read_fields`), of the time
    column (:func:`regular_samples`), of the signal (:func:`check_release_run`), and E-FOLDER, E-RUN-TWICE, E-PATH,
    E-NO-FIT, E-TURNED, E-TILT, E-NAME, E-KIND.
    """
    wrong = sorted(set(uses) - set(USES))
    if wrong:
        raise InputError("E-CHOICE", "argument uses", f"{shown(str(wrong[0]))} is not known", "Known are fit, holdout.")
    folder = Path(folder)
    if not folder.is_dir():
        cure = "Name a folder that holds experiment.toml and the tables of the runs."
        if folder.is_file() and folder.suffix in LOGS:
            cure = f"Make an experiment of it and the other logs: {_new(folder.parent)}"
        raise InputError("E-FOLDER", shown(str(folder), 200), "is not a folder", cure)
    source = folder / "experiment.toml"
    if not source.is_file() and any(folder.glob("tosses.csv*")):
        cure = "Use it with compare, diagnose, fit, add or reproduce cube."
        raise InputError("E-KIND", shown(str(folder), 200), "holds tosses; this is not for tosses", cure)
    if not source.is_file() and any(path.suffix in LOGS for path in folder.iterdir()):
        cure = f"Make an experiment of them: {_new(folder)}"
        raise InputError("E-FILE", str(source), "is not there, and the folder holds logs", cure)
    document, sha256 = read_toml(source)
    if document.get("kind") == SHAKEN:
        cure = "Use it with rockref compare."
        raise InputError("E-KIND", str(source), "holds tests on a shake table; this is not for them", cure)
    experiment = replace(_head(document, folder, str(source)), toml_sha256=sha256)
    runs = _listed_runs(document["run"], experiment, str(source))
    notices = _density(experiment, str(source)) + _tilt(experiment, str(source))
    if not any(run.use == HOLDOUT for run in runs):
        alone = "Record more runs: what one run shows, none confirms."
        cure = alone if len(runs) == 1 else "Keep one run in four back, with another tilt or side."
        notices.append(Notice("W-NO-HOLDOUT", str(source), "no run is marked holdout", cure))
    if "gyro" in document:
        gyro, found = _gyro(document["gyro"], runs, folder, str(source))
        experiment, notices = replace(experiment, gyro=gyro), notices + found
    loaded = tuple(_load_run(run, experiment, notices) if run.use in uses else run for run in runs)
    notices.extend(note_copies(loaded, str(source)))
    faults, found = sensor_faults(experiment, loaded) if experiment.gyro is not None else ([], [])
    notices.extend(found)
    return replace(experiment, runs=loaded, notices=tuple(notices), sensor_faults=tuple(faults))


def _new(logs: Path) -> str:
    """Return the command that makes an experiment of a folder of logs, with a block to be replaced by one's own."""
    return shlex.join(
        ["rockref", "new", "my_block", str(logs), "--mass", "54kg", "--width", "100mm", "--height", "688mm"]
    )


def _head(document: Mapping[str, Any], folder: Path, source: str) -> Experiment:
    release = document.get("kind") != "toss"
    check_complete(document, source)
    top = read_fields(document, top_fields(release), source)
    if not _NAME.fullmatch(top["name"]):
        raise _bad_name(f"{source}, key name", top["name"])
    block = read_fields(top["block"], BLOCK, f"{source}, [block]")
    tilt = read_fields(top["release"], RELEASE, f"{source}, [release]") if top["release"] is not None else {}
    prior = read_fields(top["prior"], PRIOR, f"{source}, [prior]") if top["prior"] is not None else {}
    named = {key: top[key] for key in ("name", "kind", "baseline")}
    stated = {key: ends for key, ends in prior.items() if ends is not None}
    uncertainty = tilt.get("tilt_uncertainty")
    return Experiment(folder, **named, **block, tilt_uncertainty=uncertainty, gyro=None, runs=(), prior=stated)


def _gyro(table: Any, runs: tuple[Run, ...], folder: Path, source: str) -> tuple[Gyro, list[Notice]]:
    """Return the gyroscope, and remarks on what of its data sheet was not stated."""
    stated = read_fields(table, GYRO, f"{source}, [gyro]")
    first = next(run for run in runs if run.use == FIT)
    sheet, notices = completed(stated, folder / first.file, source)
    return Gyro(**{**sheet, "zero_uncertainty": sheet["zero_uncertainty"] or 0.0}), notices  # type: ignore[arg-type]


def _density(experiment: Experiment, source: str) -> list[Notice]:
    """Look whether a block of this mass, width and height can be of anything."""
    density = experiment.mass / (experiment.width**2 * experiment.height)
    if LIGHTEST <= density <= DENSEST:
        return []
    limit = "no matter has more than 23000" if density > DENSEST else "hard foam has ten at least"
    what = f"a block of {experiment.mass:g} kg and this size has {density:.3g} kg/m3, and {limit}"
    return [Notice("W-DENSITY", f"{source}, [block]", what, "Check mass, width and height, and their units.")]


def _tilt(experiment: Experiment, source: str) -> list[Notice]:
    """Look whether the release says how far a stated tilt may be off."""
    if experiment.kind == "toss" or experiment.tilt_uncertainty:
        return []
    what = f"states no uncertainty of the tilt; fits let it be {TILT_UNCERTAINTY:g} rad off"
    return [Notice("W-TILT", f"{source}, [release]", what, "Give tilt_uncertainty_rad: 1 mm of wire is 0.0014 rad.")]


def _bad_name(where: str, name: str) -> InputError:
    cure = "Use up to 64 letters, digits, points, dashes and underscores."
    return InputError("E-NAME", where, f"{shown(name)} cannot be part of a file name", cure)


def _listed_runs(tables: list[Any], experiment: Experiment, source: str) -> tuple[Run, ...]:
    if len(tables) > MAX_RUNS:
        raise InputError("E-RANGE", f"{source}, [[run]]", f"{len(tables)} runs", f"List at most {MAX_RUNS}.")
    runs: list[Run] = []
    ids: dict[str, int] = {}
    files: dict[Path, int] = {}
    for number, table in enumerate(tables, start=1):
        where = f"{source}, run[{number}]"
        run = _listed_run(table, experiment, where)
        path = _inside(experiment.path, run.file, f"{where}, key file")
        _check_first(ids.setdefault(run.id, number), number, f"{where}, key id", f"id {shown(run.id)}")
        _check_first(files.setdefault(path, number), number, f"{where}, key file", f"file {shown(run.file)}")
        runs.append(run)
    if not any(run.use == FIT for run in runs):
        raise InputError("E-NO-FIT", f"{source}, [[run]]", "no run is marked fit", 'Mark at least one use = "fit".')
    return tuple(runs)


def _check_first(first: int, number: int, where: str, what: str) -> None:
    if first != number:
        cure = "Give every run an id and a file of its own."
        raise InputError("E-RUN-TWICE", where, f"the {what} is also that of run[{first}]", cure)


def _listed_run(table: Any, experiment: Experiment, where: str) -> Run:
    release = experiment.kind == "release"
    values = read_fields(table, run_fields(release), where)
    if not _NAME.fullmatch(values["id"]):
        raise _bad_name(f"{where}, key id", values["id"])
    if release:
        tilt, turn = (next(key for key in table if key.startswith(name)) for name in ("release_tilt", "block_turned"))
        _check_tilt(values["release_tilt"], experiment, f"{where}, key {tilt}")
        _check_turn(values["block_turned"], f"{where}, key {turn}")
    return Run(**values | {"block_turned": values["block_turned"] or 0.0})


def _check_tilt(tilt: float, experiment: Experiment, where: str) -> None:
    tipping = math.atan2(experiment.width, experiment.height)
    if tilt <= 0.0:
        what = f"a tilt of {tilt:g} rad"
        raise InputError("E-TILT", where, what, "Write it positive; block_turned_deg = 180 says the other side.")
    if tilt >= tipping:
        unit = " Are these degrees?" if tilt < 90 and tilt * DEGREE < tipping else ""
        what = f"a tilt of {tilt:.6g} rad, where this block falls over at {tipping:.6g} rad"
        raise InputError("E-TILT", where, what, f"Check the tilt, its unit, and width and height.{unit}")


def _check_turn(turn: float, where: str) -> None:
    # decided: a degree is more than a person's placing of the block is off.
    if min(abs(turn), abs(turn - math.pi)) > DEGREE:
        what = f"the block is turned by {turn / DEGREE:.6g} degrees"
        raise InputError("E-TURNED", where, what, "Only 0 and 180 are known: then the block rocks about its X axis.")


def _inside(folder: Path, name: str, where: str) -> Path:
    """Return the real path of a file of the experiment. Raises InputError: E-PATH, E-FILE."""
    cure = "Put the table into the experiment's folder and write its name only."
    if "\0" in name or "\\" in name or len(name) > 255 or not name.endswith((".csv", ".csv.gz")):
        raise InputError("E-PATH", where, f"{shown(name)} is not the name of a .csv or .csv.gz file", cure)
    inner = Path(name)
    if inner.is_absolute() or ".." in inner.parts or ":" in name:
        raise InputError("E-PATH", where, f"{shown(name)} leads out of the folder", cure)
    try:
        real = (folder / inner).resolve(strict=True)
    except (OSError, RuntimeError):
        raise InputError("E-FILE", where, f"there is no file {shown(name)} in {folder}", cure) from None
    if not real.is_relative_to(folder.resolve()):
        raise InputError("E-PATH", where, f"{shown(name)} is a link out of the folder", cure)
    return real


def _load_run(run: Run, experiment: Experiment, notices: list[Notice]) -> Run:
    release = experiment.kind == "release"
    table = read_table(experiment.path / run.file, ("t", *(RATES if release else POSE)))
    notices.extend(table.notices)
    t, columns, filled = table.columns["t"], dict(table.columns), tuple[int, ...]()
    if experiment.gyro is not None:
        t, others, filled, found = regular_samples(table, experiment.gyro.sample_rate)
        columns = dict(others)
        notices.extend(found)
    else:
        check_forward(table)
    crv = _stack(columns, RATES)
    absent = [name for name in POSE if name not in columns]
    if 0 < len(absent) < len(POSE):
        what = f"there is a part of a pose, without {', '.join(absent)}"
        notices.append(Notice("W-POSE", str(table.path), what, "What is there of it is left out; give all seven."))
    if release and crv is not None:
        seen = checked(Signal.of(t, crv, table, run, experiment))
        t, crv, notices_of = seen.t, _frozen(seen.crv), seen.notices
        filled = tuple(sorted({i for i in filled if i < len(t)} | set(seen.drawn)))
        notices.extend(notices_of)
    return replace(run, t=_frozen(t), crv=crv, pose=_stack(columns, POSE), filled=filled, sha256=table.sha256)


def _stack(columns: Mapping[str, np.ndarray], names: tuple[str, ...]) -> np.ndarray | None:
    if any(name not in columns for name in names):
        return None
    return _frozen(np.stack([columns[name] for name in names], axis=-1))


def _frozen(array: np.ndarray) -> np.ndarray:
    array.flags.writeable = False
    return array
