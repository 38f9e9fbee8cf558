"""From a clone of github.com/DAIRLab/contact-nets to a folder of tosses."""

from __future__ import annotations

import gzip
import io
from collections.abc import Callable
from pathlib import Path

import numpy as np

from rockref.measure.reading.tensorfile import read_tensor
from rockref.measure.tosses.load import CUBE_WIDTH, FRAME_RATE, POSE, RATE, SAME_HEIGHT, TABLES, VELOCITY
from rockref.model.errors import InputError
from rockref.model.storage import write_bytes, write_text

#: Where a clone has its tosses.
INSIDE = Path("data") / "tosses_processed"
#: Columns of a tensor: position and velocity in half-widths, quaternion, body rates; then six of control, all zero.
POSITION, QUATERNION, SPEED, TURN, LEAST_COLUMNS = slice(0, 3), slice(3, 7), slice(7, 10), slice(10, 13), 13

#: Written digits after the point: 1e-6 m, 1e-7 of a quaternion, 1e-5 m/s and rad/s; a twentieth of the noise at most.
DIGITS = (6,) * 3 + (7,) * 4 + (5,) * 6

README = """# Tosses of a cube

{tosses} recordings, {copies} of them turned copies of others (column `group`), made by `rockref import contactnets`.

Source: github.com/DAIRLab/contact-nets, `data/tosses_processed` (BSD 3-Clause; S. Pfrommer, M. Halm, M. Posa, CoRL
2020, arXiv:2009.11193). Lengths and velocities were multiplied by {half} m, the half-width by which the source divides
them; nothing was filtered or corrected. Times are frame / {rate:g} Hz: the source keeps none.
"""


def import_contactnets(source: Path, folder: Path) -> tuple[int, int]:
    """Write ``tosses.csv.gz`` and ``README.md`` into `folder`; returns the numbers of recordings and of copies.

    source : the clone, or the folder of its ``.pt`` files.

    Raises InputError: E-FOLDER, where there are no such files; E-FILE, E-SHAPE, for one that is no toss; E-WRITE, for a
    folder that holds files of others: a ``README.md`` that is there stays as it is.
    """
    own_folder(folder, README.splitlines()[0], lambda name: name == TABLES[0])
    where = source / INSIDE if (source / INSIDE).is_dir() else source
    paths = sorted((p for p in where.glob("*.pt") if p.stem.isdigit()), key=lambda p: int(p.stem))
    if not paths:
        raise InputError(
            "E-FOLDER", str(source), "holds no numbered .pt files", "Name a clone of github.com/DAIRLab/contact-nets."
        )
    tables = {int(path.stem): toss_of(path) for path in paths}
    groups = groups_of(tables)
    text = io.StringIO()
    text.write("toss,group,frame,t_s," + ",".join((*POSE, *VELOCITY, *RATE)) + "\n")
    for number, rows in tables.items():
        for frame, row in enumerate(rows):
            numbers = [f"{a:.{d}f}" for a, d in zip(row, DIGITS, strict=True)]
            text.write(f"{number},{groups[number]},{frame},{frame / FRAME_RATE:.6f}," + ",".join(numbers) + "\n")
    folder.mkdir(parents=True, exist_ok=True)
    copies = sum(groups[n] != n for n in tables)
    write_bytes(folder / TABLES[0], gzip.compress(text.getvalue().encode(), mtime=0))
    write_text(
        folder / "README.md", README.format(tosses=len(tables), copies=copies, half=CUBE_WIDTH / 2, rate=FRAME_RATE)
    )
    return len(tables), copies


def own_folder(folder: Path, head: str, is_own: Callable[[str], bool]) -> None:
    """Refuse a folder that is none, or has files that are not those of an import. Raises InputError E-WRITE.

    head : first line of the import's ``README.md``;  is_own : whether a name is that of another of its files
    """
    if not folder.exists():
        return
    others = [] if folder.is_dir() else [folder.name]
    if folder.is_dir():
        others = sorted(p.name for p in folder.iterdir() if p.name != "README.md" and not is_own(p.name))
        readme = folder / "README.md"
        if readme.is_file() and not readme.read_bytes().startswith(head.encode()):
            others.append("README.md")
    if others:
        raise InputError(
            "E-WRITE", str(folder), f"holds something else already ({others[0]})", "Name a new or an empty folder."
        )


def toss_of(path: Path) -> np.ndarray:
    """Return (N, 13) position [m], quaternion, velocity [m/s], body rates [rad/s] of one file."""
    tensor = read_tensor(path)
    rows = tensor.reshape(-1, tensor.shape[-1]) if tensor.ndim >= 2 else tensor[None]
    good = rows.shape[-1] >= LEAST_COLUMNS and np.all(np.isfinite(rows))
    if not good or np.any(np.abs(np.linalg.norm(rows[:, QUATERNION], axis=1) - 1) > 0.05):
        raise InputError(
            "E-SHAPE", str(path), f"of shape {tensor.shape} is no toss", "Rows are position, quaternion, velocities."
        )
    half = CUBE_WIDTH / 2
    return np.concatenate([rows[:, POSITION] * half, rows[:, QUATERNION], rows[:, SPEED] * half, rows[:, TURN]], axis=1)


def groups_of(tables: dict[int, np.ndarray]) -> dict[int, int]:
    """Return for every toss the first one with the same heights: a copy turned about the vertical."""
    groups: dict[int, int] = {}
    for number in sorted(tables):
        z = tables[number][:, 2]
        same = (n for n in groups if groups[n] == n and len(tables[n]) == len(z))
        first = next((n for n in same if np.max(np.abs(tables[n][:, 2] - z)) < SAME_HEIGHT), number)
        groups[number] = first
    return groups
