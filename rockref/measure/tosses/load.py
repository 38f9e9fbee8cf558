"""Tosses of a rigid block: poses by camera, many short runs in one table, or an experiment folder of kind ``toss``."""

from __future__ import annotations

import hashlib
import io
import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rockref.measure.checks.toss_axes import check_axes
from rockref.measure.experiment import load_experiment
from rockref.measure.reading.columns import MAX_COLUMNS
from rockref.measure.reading.rawfile import read_text
from rockref.measure.reading.schema import read_toml
from rockref.measure.records.notice import Notice
from rockref.measure.records.release import FIT, HOLDOUT
from rockref.measure.records.toss import Toss, Tosses
from rockref.model.errors import InputError

if TYPE_CHECKING:
    import pandas as pd

#: Names of the one table of all tosses, the first that is there is read.
TABLES = ("tosses.csv.gz", "tosses.csv")
NEEDED = ("toss", "frame", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz")
POSE = NEEDED[2:]
VELOCITY = ("vx_m_s", "vy_m_s", "vz_m_s")
RATE = ("wx_body_rad_s", "wy_body_rad_s", "wz_body_rad_s")
#: Camera rate that the table's public source states [Hz]; used where there is no column ``t_s``.
FRAME_RATE = 148.0
#: Values that the source of the public tosses states: mass [kg], width [m], isotropic inertia [kg m2], coefficients of
#: friction and restitution (contact-nets, data/params_processed/experiment.json; dair_pll, contactnets_cube.urdf).
CUBE_MASS, CUBE_WIDTH, CUBE_INERTIA, CUBE_MU, CUBE_RESTITUTION = 0.37, 0.1048, 8.1e-4, 0.18, 0.125
#: Share of the tosses that are held out; decided: enough of both for intervals on either side.
HELD_OUT_PERCENT = 40
#: Fewest frames of a toss that can be used: a start and something to compare.
LEAST_FRAMES = 6
#: Two tosses are copies where their heights agree to this at every frame [m]; decided: written digits are 1e-6 m, and
#: heights of different tosses differ by their noise of 1e-5 m at least.
SAME_HEIGHT = 2.5e-6
#: Jump of the pose between two frames above which the tracker lost the block: 0.15 m (22 m/s) or 1.5 rad (220 rad/s).
JUMP, TURN = 0.15, 1.5
#: A table of more rows than this is several experiments (decided: 5000 tosses of 100 frames).
MOST_ROWS = 500_000
#: No number, length, time or rate of a toss is larger; decided: below it no product overflows, and ids are exact.
MOST = 1e15
#: Cameras take so many frames a second [Hz]; decided.
LEAST_RATE, MOST_RATE = 1.0, 1e6
#: Frames by which an interval between two may be off; decided: a lost frame makes it one, and no clock jitters by half.
UNEVEN = 0.5


def held_out(group: str) -> bool:
    """Return the stated rule of splitting: a toss is held out by the SHA-256 of its group's number, copies with
    originals."""
    digest = hashlib.sha256(f"rockref-toss-{group}".encode()).hexdigest()
    return int(digest[:8], 16) % 100 < HELD_OUT_PERCENT


def is_toss_folder(path: Path | str) -> bool:
    """Return whether a folder (or a table itself) holds tosses; never raises."""
    path = Path(path)
    if path.name in TABLES and path.is_file():
        return True
    if any((path / name).is_file() for name in TABLES):
        return True
    try:
        return read_toml(path / "experiment.toml")[0].get("kind") == "toss"
    except InputError:
        return False


def load_tosses(path: Path | str, split: str = "rule") -> Tosses:
    """Read tosses from a folder with ``tosses.csv.gz``, from that file, or from an experiment folder of kind ``toss``.

    split : "rule" (see `held_out`; an experiment.toml has its own marks), "all_fit", or "all_holdout" (a folder that
        only judges).

    Raises InputError: E-UNIT, E-AXES, E-POSE, E-BOARD (see `check_axes`), E-HEADER, E-COLUMN-MISSING, E-COLUMN-TWICE,
    E-FIELDS, E-NUMBER, E-POSE, E-RATE, E-GAP, E-SHORT, E-SIZE, E-CHOICE; those of `read_text` and of `load_experiment`.
    """
    path = Path(path)
    if split not in ("rule", "all_fit", "all_holdout"):
        raise InputError("E-CHOICE", "argument split", f"is {split!r}", "Use rule, all_fit or all_holdout.")
    table = path if path.is_file() else next((path / n for n in TABLES if (path / n).is_file()), None)
    found = _from_experiment(path) if table is None else _from_table(table)
    if split != "rule":
        use = FIT if split == "all_fit" else HOLDOUT
        found = replace(found, tosses=tuple(replace(toss, use=use) for toss in found.tosses))
    return found


def _from_experiment(path: Path) -> Tosses:
    experiment = load_experiment(path)
    if experiment.kind != "toss":
        raise InputError(
            "E-KIND", str(path / "experiment.toml"), f"is of kind {experiment.kind}", 'Tosses have kind = "toss".'
        )
    tosses = []
    for run in experiment.runs:
        assert run.t is not None and run.pose is not None
        if len(run.t) < LEAST_FRAMES:
            what, cure = f"has {len(run.t)} frames", f"Give {LEAST_FRAMES} frames or more."
            raise InputError("E-SHORT", str(path / run.file), what, cure)
        tosses.append(_toss(run.id, run.id, run.use, np.asarray(run.t), np.asarray(run.pose), str(path / run.file)))
    rate = float(1 / np.median(np.concatenate([np.diff(toss.t) for toss in tosses])))
    _check_rate(rate, f"{path}, times of the runs")
    for run, toss in zip(experiment.runs, tosses, strict=True):
        _check_frames(toss.t, rate, path / run.file)
    check_axes(tosses, (experiment.width, experiment.width, experiment.height), str(path))
    return Tosses(
        path=path, name=experiment.name, rate=rate, mass=experiment.mass,
        width=experiment.width, height=experiment.height, tosses=tuple(tosses), notices=experiment.notices,
        sha256=experiment.digest,
    )  # fmt: skip


def _check_rate(rate: float, where: str) -> None:
    if not LEAST_RATE <= rate <= MOST_RATE:
        cure = "Check the unit: time is in s from the first frame."
        raise InputError("E-RATE", where, f"frames come at {rate:.6g} Hz", cure)


def _check_frames(t: np.ndarray, rate: float, where: Path) -> None:
    """Refuse times t (N,) [s] of another rate than the camera's [Hz], or with a hole: tosses lie side by side, frame by
    frame."""
    off = np.flatnonzero(np.abs(np.diff(t) * rate - 1) > UNEVEN)
    if len(off):
        what = f"{t[off[0] + 1] - t[off[0]]:.4g} s between two frames, where the camera takes {rate:.6g} a second"
        cure = "Give all runs at the rate of one camera, and cut a run before a hole."
        raise InputError("E-GAP", f"{where}, line {off[0] + 3}", what, cure)


def _from_table(table: Path) -> Tosses:
    raw = read_text(table)
    data = _numbers(raw.text, table)
    rate = FRAME_RATE
    if "t_s" in data.columns:
        span = data.groupby("toss").agg(frames=("frame", "max"), first=("frame", "min"), t=("t_s", "max"))
        span = span[span.frames > span["first"]]
        if len(span) and (span.t > 0).all():
            rate = round(float(np.median((span.frames - span["first"]) / span.t)), 3)
    _check_rate(rate, f"{table}, column t_s")
    tosses, notices, every = [], list(raw.notices), []
    for number, rows in data.groupby("toss", sort=True):
        rows = rows.sort_values("frame")
        id, group = _label(number), _label(rows["group"].iloc[0]) if "group" in rows else _label(number)
        where = f"{table}, toss {id}"
        if len(rows) < LEAST_FRAMES or np.any(np.diff(rows["frame"]) != 1):
            notices.append(Notice("W-TOSS-LEFT-OUT", where, "is too short or has gaps", "It was left out."))
            continue
        use = HOLDOUT if held_out(group) else FIT
        t = (rows["frame"].to_numpy() - rows["frame"].iloc[0]) / rate
        toss = _toss(id, group, use, t, rows[list(POSE)].to_numpy(float), where)
        every.append(toss)
        lost = tracking_lost(toss)
        if lost:
            notices.append(Notice("W-TOSS-LEFT-OUT", where, f"jumps at frame {lost}", "It was left out."))
            continue
        if all(name in rows for name in (*VELOCITY, *RATE)):
            toss = replace(toss, v=rows[list(VELOCITY)].to_numpy(float), W=rows[list(RATE)].to_numpy(float))
        tosses.append(toss)
    check_axes(every, (CUBE_WIDTH, CUBE_WIDTH, CUBE_WIDTH), str(table))
    if not tosses:
        raise InputError("E-SIZE", str(table), "holds no toss that can be used", f"Give {LEAST_FRAMES} frames or more.")
    originals, copies = without_copies(tosses)
    return Tosses(
        path=table.parent, name=table.parent.resolve().name, rate=rate, mass=CUBE_MASS, width=CUBE_WIDTH,
        height=CUBE_WIDTH, tosses=tuple(originals), copies=tuple(copies), notices=tuple(notices),
        sha256=raw.sha256,
    )  # fmt: skip


def _numbers(text: str, table: Path) -> pd.DataFrame:
    """Return the known columns of a table of tosses, float64; others are left unread.

    Raises InputError: E-HEADER, E-COLUMN-MISSING, E-COLUMN-TWICE, E-SIZE, E-FIELDS, E-FILE, E-NUMBER.
    """
    import pandas as pd

    header, *rows = text.rstrip("\n").split("\n")
    names = [name.strip().strip('"') for name in header.split(",")]
    known = [name for name in (*NEEDED, *VELOCITY, *RATE, "t_s", "group") if name in names]
    _check_header(names, known, table)
    if not 0 < len(rows) <= MOST_ROWS:
        raise InputError("E-SIZE", str(table), f"has {len(rows)} rows", f"Give 1 to {MOST_ROWS} rows.")
    if '"' not in text:  # a remark may have commas
        _check_fields(rows, len(names), table)
    places = sorted(names.index(name) for name in known)
    try:
        data = pd.read_csv(io.StringIO(text), usecols=places, index_col=False, low_memory=False)
    except (ValueError, OverflowError) as e:
        raise InputError(
            "E-FILE", str(table), f"cannot be read as a table ({str(e)[:80]})", "Give comma-separated text."
        ) from e
    data.columns = pd.Index([names[place] for place in places])
    lines = [number for number, row in enumerate(rows, start=2) if row.strip()]  # blank ones are passed over
    for name in known:
        values = pd.to_numeric(data[name], errors="coerce").to_numpy(float)
        bad = np.flatnonzero(~(np.abs(values) < MOST))
        if len(bad):
            raise InputError(
                "E-NUMBER",
                f"{table}, line {lines[bad[0]]}, column {name}",
                "is not a number",
                "Mend or remove the row.",
            )
        data[name] = values
    return data


def _check_header(names: list[str], known: list[str], table: Path) -> None:
    if len(names) > MAX_COLUMNS:
        raise InputError("E-HEADER", str(table), f"has {len(names)} columns", f"Keep at most {MAX_COLUMNS}.")
    missing = [name for name in NEEDED if name not in known]
    if missing:
        raise InputError(
            "E-COLUMN-MISSING", str(table), f"has no column {missing[0]}", f"It needs {', '.join(NEEDED)}."
        )
    twice = [name for name in known if names.count(name) > 1]
    if twice:
        raise InputError("E-COLUMN-TWICE", str(table), f"has two columns {twice[0]}", "Keep one of the two.")


def _check_fields(rows: list[str], width: int, table: Path) -> None:
    for number, row in enumerate(rows, start=2):
        if row and row.count(",") != width - 1:
            what = f"{row.count(',') + 1} fields for {width} columns"
            raise InputError("E-FIELDS", f"{table}, line {number}", what, "Mend the row.")


def _label(number: float) -> str:
    return str(int(number)) if float(number).is_integer() else str(number)


def _toss(id: str, group: str, use: str, t: np.ndarray, pose: np.ndarray, where: str) -> Toss:
    from rockref.model.rotation import from_quaternion

    size = np.linalg.norm(pose[:, 3:], axis=1)
    bad = np.flatnonzero(np.abs(size - 1) > 0.05)
    if len(bad):
        raise InputError("E-POSE", f"{where}, frame {bad[0]}", "its quaternion has not length 1", "Scalar first, unit.")
    return Toss(id, group, use, t - t[0], np.ascontiguousarray(pose[:, :3]), from_quaternion(pose[:, 3:]))


def tracking_lost(toss: Toss) -> int:
    """Return the first frame to which the pose jumps farther than any block can move; 0 where it does not."""
    far = np.linalg.norm(np.diff(toss.x, axis=0), axis=1) > JUMP
    trace = np.einsum("nij,nij->n", toss.Lambda[1:], toss.Lambda[:-1])
    far |= trace < 1 + 2 * math.cos(TURN)
    return int(np.argmax(far)) + 1 if far.any() else 0


def without_copies(tosses: list[Toss]) -> tuple[list[Toss], list[tuple[str, str]]]:
    """Return originals, and (copy, original) for the tosses that are turned copies of others by their group or their
    heights.

    A toss turned about the vertical has the same heights, frame for frame. Of a set the first one is the original.
    """
    kept: list[Toss] = []
    copies: list[tuple[str, str]] = []
    by_group: dict[str, Toss] = {}
    by_length: dict[int, list[Toss]] = {}
    # Those that are their own group come first, so that an original is kept where it is there.
    for toss in sorted(tosses, key=lambda a: a.id != a.group):
        original = by_group.get(toss.group)
        if original is None:
            same = by_length.setdefault(toss.frames, [])
            original = next((a for a in same if np.max(np.abs(a.x[:, 2] - toss.x[:, 2])) < SAME_HEIGHT), None)
        if original is not None:
            copies.append((toss.id, original.id))
            continue
        by_group[toss.group] = toss
        by_length.setdefault(toss.frames, []).append(toss)
        kept.append(toss)
    order = {toss.id: i for i, toss in enumerate(tosses)}
    return sorted(kept, key=lambda a: order[a.id]), copies
