"""Records of a simulator that nobody here wrote: LAMMPS, whose feet are spheres, diagnosed as if they were measured."""

import gzip
from pathlib import Path

import numpy as np
import pytest

from rockref.discover.diagnose import diagnose
from rockref.measure import load_experiment
from rockref.measure.gyroscope import record

HERE = Path(__file__).resolve()
PEER = HERE.parents[1] / "golden" / "peers" / "base_r1mm_dt1e-06.csv.gz"
CONTROL = HERE.parents[2] / "data" / "experiments" / "mystery-08"
#: The columns t, wx, wy, wz.
READ = (0, 8, 9, 10)


def recorded(folder, uses=("fit", "fit", "holdout")):
    """An experiment of one release, recorded three times by the control's gyroscope."""
    with gzip.open(PEER, "rt") as file:
        table = np.loadtxt(file, delimiter=",", skiprows=1, usecols=READ)
    text = (CONTROL / "experiment.toml").read_text().split("[[run]]")[0]
    gyro = load_experiment(CONTROL).gyro
    folder.mkdir()
    for i, use in enumerate(uses, 1):
        t, crv = record(table[:, 0], table[:, 1:], gyro, np.random.default_rng(i))
        rows = np.column_stack([t, np.degrees(crv)])
        header = "t_s,wx_deg_s,wy_deg_s,wz_deg_s"
        np.savetxt(folder / f"run0{i}.csv", rows, fmt="%.4f", delimiter=",", header=header, comments="")
        text += (
            f'[[run]]\nid = "0{i}"\nfile = "run0{i}.csv"\nuse = "{use}"\nrelease_tilt_rad = 0.117\n'
            "block_turned_deg = 0\n"
        )
    (folder / "experiment.toml").write_text(text)
    return folder


@pytest.mark.slow
def test_the_radius_of_its_feet_is_missing(tmp_path):
    """A millimetre; from one release it cannot be told from sides that are two thousandths shorter, and is so told."""
    found = diagnose(recorded(tmp_path / "lammps"))
    assert found.verdict in ("named", "indicated", "class")
    assert "rounded_feet" in found.effects and len(found.effects) <= 3
    held = {k: found.error[k]["holdout"] for k in ("baseline", "with_effect")}
    assert held["with_effect"] < held["baseline"] and held["with_effect"] < 1.05 * found.error["noise_floor"]
