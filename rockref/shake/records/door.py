"""The door: files of a recorded motion, of whatever format, become the motion of the plate."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rockref.measure.reading.rawfile import read_text
from rockref.measure.records.notice import Notice
from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError
from rockref.shake.records.at2 import is_at2, read_at2
from rockref.shake.records.channel import Channel
from rockref.shake.records.checks import remarks
from rockref.shake.records.cosmos import is_cosmos, read_cosmos
from rockref.shake.records.csmip import is_csmip, read_csmip
from rockref.shake.records.csv_table import is_csv, read_csv
from rockref.shake.records.esm import is_esm, read_esm
from rockref.shake.records.join import joined
from rockref.shake.records.knet import is_knet, read_knet

#: Each format: how it is told from the text, and who reads it. The first that fits is taken.
FORMATS = (
    (is_at2, read_at2),
    (is_esm, read_esm),
    (is_knet, read_knet),
    (is_cosmos, read_cosmos),
    (is_csmip, read_csmip),
    (is_csv, read_csv),
)
Paths = str | os.PathLike[str] | Sequence[str | os.PathLike[str]]


@dataclass(frozen=True)
class Record:
    """A recorded motion as read: the motion of the plate, its components as the files have them, and remarks."""

    base: BaseMotion
    channels: tuple[Channel, ...]
    notices: tuple[Notice, ...]


def read(paths: Paths) -> BaseMotion:
    """Return the motion of the plate from one file, or from the files of its components. Raises as `read_record`."""
    return read_record(paths).base


def read_record(paths: Paths) -> Record:
    """Read one to three components: PEER AT2, ESM ASC, K-NET, COSMOS, CSMIP V2, or a table with units in its names.

    The first sample becomes t = 0. Axes: see `join.joined`.

    Raises InputError: E-FILE and others of reading a text, E-RECORD-FORMAT, and those of the format.
    """
    files = [Path(paths)] if isinstance(paths, (str, os.PathLike)) else [Path(path) for path in paths]
    if not files:
        raise InputError("E-RECORD-CHANNELS", "records", "no file is named", "Name one to three files.")
    channels = [channel for file in files for channel in _channels(file)]
    a, dt, notices = joined(channels)
    base = BaseMotion(t_0=0.0, dt=dt, a=a, name=files[0].stem)
    return Record(base, tuple(channels), tuple(notices + remarks(a, dt, str(files[0]))))


def _channels(path: Path) -> list[Channel]:
    lines = read_text(path, if_empty="Get the record again.").text.split("\n")
    while lines and not lines[-1].strip():
        lines.pop()
    # A transfer that ended every line twice.
    if len(lines) > 2 and not any(line.strip() for line in lines[1::2]):
        lines = lines[::2]
    for fits, reader in FORMATS:
        if fits(lines):
            return reader(lines, str(path))
    cure = "Give PEER .AT2, ESM .ASC, K-NET, COSMOS or CSMIP .V2, or a table whose first line is t [s],ax [m/s2]."
    raise InputError("E-RECORD-FORMAT", f"{path}, line 1", "no known format of records", cure)
