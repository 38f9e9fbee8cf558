"""From a clone of github.com/DAIRLab/ImpactModeling to an experiment folder of planar drops of a square."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from rockref.measure.importing.contactnets import own_folder
from rockref.measure.records.release import FIT, HOLDOUT
from rockref.measure.tosses.load import LEAST_FRAMES, POSE, held_out
from rockref.model.errors import InputError
from rockref.model.storage import write_text

#: Where a clone has its drops.
INSIDE = Path("Wang") / "Wang-Mason Square" / "dice-data-processed"
#: Columns of a file: place [m], angle [rad], and their rates, which are not used.
HEADER = "x,z,th,vx,vz,vth"
#: Side of the square that the source states [m].
WIDTH = 0.060
# The source states no mass, and the motion of a drop does not depend on it; decided: a tenth of a kilogram.
MASS = 0.1
#: Rate of the camera [Hz]: the stated velocities are differences of places 4 ms apart.
RATE = 250.0
# A square that is turned by half a turn looks the same, and the tracker takes one for the other. Decided: a square that
# comes at 2.4 m/s and rolls over a corner turns with 80 rad/s; with 100 rad/s, or at 5 m/s, the tracker has jumped.
TURN, JUMP = 100.0 / RATE, 5.0 / RATE
#: Written digits after the point: 1e-6 m, 1e-7 of a quaternion.
DIGITS = (6,) * 3 + (7,) * 4

README = """# Planar drops of a square

{drops} drops of a square of {width:g} m, made by `rockref import planardrops`; {left} more were left out, whose tracker
jumps.

Source: github.com/DAIRLab/ImpactModeling, `{inside}` (BSD 3-Clause; Dynamic Autonomy and Intelligent Robotics Lab).
Its x was reversed: angle and place are of opposite hand there, as the balance of the moment of momentum over impacts on
one corner shows. Angles were continued over half turns, which a square does not show. Nothing was filtered. Times are
frame / {rate:g} Hz. Mass and thickness are not stated: {mass:g} kg and a cube were taken; in a plane neither matters.
"""


def import_planardrops(source: Path, folder: Path) -> tuple[int, int]:
    """Write ``experiment.toml``, a table a drop and ``README.md`` into `folder`; return drops and those left out.

    source : the clone, or the folder of its ``traj_*.csv`` files.

    Raises InputError: E-FOLDER, where there are no such files; E-FILE, E-SHAPE, for one that is no drop; E-WRITE, for a
    folder that holds files of others.
    """
    own_folder(folder, README.splitlines()[0], lambda name: name == "experiment.toml" or name.startswith("drop"))
    where = source / INSIDE if (source / INSIDE).is_dir() else source
    paths = {int(p.stem[5:]): p for p in where.glob("traj_*.csv") if p.stem[5:].isdigit()}
    if not paths:
        cure = "Name a clone of github.com/DAIRLab/ImpactModeling."
        raise InputError("E-FOLDER", str(source), "holds no files traj_1.csv", cure)
    poses = {number: poses_of(paths[number]) for number in sorted(paths)}
    drops = {number: rows for number, rows in poses.items() if rows is not None}
    if not drops:
        raise InputError("E-SHAPE", str(where), "holds no drop that can be used", "Get the files again.")
    folder.mkdir(parents=True, exist_ok=True)
    runs = []
    for number, rows in drops.items():
        lines = [",".join([f"{k / RATE:.4f}", *(f"{a:.{d}f}" for a, d in zip(row, DIGITS, strict=True))])
                 for k, row in enumerate(rows)]  # fmt: skip
        write_text(folder / f"drop{number:03d}.csv", "\n".join(["t_s," + ",".join(POSE), *lines]) + "\n")
        use = HOLDOUT if held_out(str(number)) else FIT
        runs.append(f'[[run]]\nid = "{number}"\nfile = "drop{number:03d}.csv"\nuse = "{use}"\n')
    head = (
        f'name = "planar_drops"\nkind = "toss"\nbaseline = "four_points"\n\n[block]\nmass_kg = {MASS}\n'
        f"width_m = {WIDTH}\nheight_m = {WIDTH}\n"
    )
    write_text(folder / "experiment.toml", "\n".join([head, *runs]))
    left = len(poses) - len(drops)
    facts = {"drops": len(drops), "left": left, "width": WIDTH, "inside": INSIDE.as_posix(), "rate": RATE, "mass": MASS}
    write_text(folder / "README.md", README.format(**facts))
    return len(drops), left


def poses_of(path: Path) -> np.ndarray | None:
    """Return x, y, z [m] and the quaternion (N, 7) of one file, body to board; None where the tracker lost the square.

    The square turns by its angle about +y. Raises InputError E-FILE, E-SHAPE.
    """
    try:
        header, *lines = path.read_text(encoding="utf-8").split()
        rows = np.array([[float(cell) for cell in line.split(",")] for line in lines])
    except (OSError, ValueError) as e:
        raise InputError("E-FILE", str(path), f"cannot be read ({e})", "Get the file again.") from e
    if header != HEADER or rows.ndim != 2 or rows.shape[1] != 6 or len(rows) < LEAST_FRAMES:
        what = f"of shape {rows.shape} is no drop"
        raise InputError("E-SHAPE", str(path), what, f"Its columns are {HEADER}.")
    x, z, angle = -rows[:, 0], rows[:, 1], np.unwrap(rows[:, 2], period=np.pi)
    step = np.hypot(np.diff(x), np.diff(z))
    if not np.isfinite(rows[:, :3]).all() or step.max() > JUMP or np.abs(np.diff(angle)).max() > TURN:
        return None
    zero = np.zeros(len(x))
    return np.column_stack([x, zero, z, np.cos(0.5 * angle), zero, np.sin(0.5 * angle), zero])
