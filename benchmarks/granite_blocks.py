"""Two granite blocks on a shake table: public tests, read from where the user has them.

582 tests, each with two outcomes; the source is the virtual shake robot of Chen et al., Seismica 3 (2024), doi
10.26443/seismica.v3i1.692. The data are GPL-3.0 and no part of this package: `VARIABLE` names their folder.
"""

from __future__ import annotations

import os
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError

#: The environment variable that names the folder.
VARIABLE = "ROCKREF_GRANITE"
#: Names of the outcomes, a column a block.
FELL = ("fell_sp1", "fell_sp2")
# Units of one count and rates, as the folder's page states them.
ACCELERATION_COUNT = 2e-4 * 9.81  # m/s2; the accelerometer is positive against the displacement
DISPLACEMENT_COUNT = 2e-5  # m
ACCELERATION_RATE, DISPLACEMENT_RATE = 200.0, 50.0  # Hz
# decided: the accelerometer leads by 11 degrees at 2 Hz and by 22 at 1 Hz. Below, the displacement is smooth; but a
# table that pitches is felt by the accelerometer and the block, not by the displacement. Vary it.
CROSSOVER = 2.0  # Hz
#: The break in the dates of the campaign, as YYYYMMDD.
AFTER_BREAK = 20210801
# decided: order 2, run forward and backward, so that no phase is added.
ORDER = 2


@dataclass(frozen=True)
class GraniteBlocks:
    """The folder: `tests`, a row a test; records read when they are asked for."""

    folder: Path
    tests: Any

    def clean(self) -> Any:
        """Return the tests that have a record and were not aborted: those whose PGA in the sheets is no plan."""
        return self.tests[(self.tests.record == 1) & (self.tests.pga_is_nominal == 0)].reset_index(drop=True)

    def block(self, number: int) -> dict[str, Any]:
        """Return what is known of block 1 or 2 from its mesh: masses, inertia, corners; units in `blocks.toml`."""
        return tomllib.loads((self.folder / "blocks.toml").read_text(encoding="utf-8"))[f"sp{number}"]

    def base_motion(self, test: int, crossover: float = CROSSOVER) -> BaseMotion:
        """Return the table's motion of a test along x, positive with the displacement, at 200 Hz.

        Above the crossover [Hz] it is the accelerometer's, below it the second derivative of the displacement: the
        accelerometer is not flat below some 2 Hz. The two filters add up to one. A crossover of 0 takes the
        accelerometer alone. Raises InputError E-GRANITE where the test has no record.
        """
        from scipy.interpolate import CubicSpline
        from scipy.signal import butter, sosfiltfilt

        with np.load(self.folder / "records.npz") as records:
            name = f"{test:03d}"
            if f"{name}_main" not in records:
                raise InputError("E-GRANITE", f"test {test}", "has no record", "Choose one whose column record is 1.")
            main = -ACCELERATION_COUNT * records[f"{name}_main"].astype(float)
            displacement = DISPLACEMENT_COUNT * records[f"{name}_displacement"].astype(float)
        if crossover:
            t = np.arange(len(main)) / ACCELERATION_RATE
            times = np.arange(len(displacement)) / DISPLACEMENT_RATE
            # The last samples may lie beyond the slower grid; there the displacement stands.
            second = CubicSpline(times, displacement)(np.minimum(t, times[-1]), 2) * (t <= times[-1])
            low = butter(ORDER, crossover, fs=ACCELERATION_RATE, output="sos")
            main = main + sosfiltfilt(low, second - main)
        a = np.zeros((len(main), 3))
        a[:, 0] = main
        return BaseMotion(t_0=0.0, dt=1.0 / ACCELERATION_RATE, a=a, name=name)


def load_granite(folder: str | os.PathLike[str] | None = None) -> GraniteBlocks:
    """Read the table of tests from a folder, or from the one that the environment names. Raises InputError E-FOLDER."""
    import pandas as pd

    named = folder if folder is not None else os.environ.get(VARIABLE)
    cure = f"Get the data (see the page on granite blocks) and name their folder: {VARIABLE}=FOLDER."
    if not named:
        raise InputError("E-FOLDER", VARIABLE, "no folder is named", cure)
    path = Path(named)
    missing = [name for name in ("outcomes.csv", "records.npz", "blocks.toml") if not (path / name).is_file()]
    if missing:
        raise InputError("E-FOLDER", str(path), f"holds no {missing[0]}", cure)
    return GraniteBlocks(path, pd.read_csv(path / "outcomes.csv"))


def sessions(tests: Any) -> np.ndarray:
    """Return 0 for tests before the campaign's break of thirty days, 1 for those after it (n,).

    The break lies between 13 July and 12 August 2021. The blocks may have been set up anew; nothing is written down.
    """
    return (tests.date.to_numpy(int) > AFTER_BREAK).astype(int)


def sizes(tests: Any) -> np.ndarray:
    """Return PGA [g] and PGV/PGA [s] of the sheets (n, 2): what the regression of the source knows of a motion."""
    return tests[["pga_sheet_g", "pgv_over_pga_sheet_s"]].to_numpy(float)


def record_sizes(tests: Any) -> np.ndarray:
    """Return PGA below 10 Hz [g] and PGV [m/s] of the displacement (n, 2): what the record itself knows."""
    return tests[["pga_below_10hz_g", "pgv_displacement_m_s"]].to_numpy(float)
