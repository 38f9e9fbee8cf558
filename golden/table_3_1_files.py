"""The golden files of Table 3.1: what stands in them, and how they are read."""

from __future__ import annotations

import gzip
import json
from pathlib import Path
from typing import NamedTuple

import numpy as np

import rockref
from rockref.model.problem import Problem
from rockref.model.response import Response
from rockref.model.rotation import quaternion

FOLDER = Path(__file__).resolve().parents[1] / "tests/golden/table_3_1"
SCHEMA = 1
#: Up to the last row before the second main impact, 1.33570 s at the step of the source.
END = 1.3355
OUTPUT_RATE = 2000.0
#: The source's step, which the scheme files pin; and that of the converged solution.
SCHEME_STEP, CONVERGED_STEP = 1e-5, 1.25e-8
#: Steps of the runs that tell what that of the converged solution still leaves: all divide the 0.5 ms between rows.
COARSER_STEPS = (2.5e-8, 5e-8, 6.25e-8, 8e-8, 1e-7, 1.25e-7)
KINDS = ("scheme", "converged")


def problem(step: float) -> Problem:
    """Table 3.1 from release."""
    return rockref.Model.table_3_1().problem(duration=END, step=step, output_rate=OUTPUT_RATE)


def columns(names: tuple[str, ...]) -> list[str]:
    """Names of the numeric columns, with their units."""
    forces = [f"f{axis}_{name}_N" for name in names for axis in "xyz"]
    return ["wx_deg_s", "wy_deg_s", "wz_deg_s", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz", *forces]


def values(response: Response) -> np.ndarray:
    """Return the numeric columns of a response, (..., T, 10 + 3 n), float64."""
    forces = response.F.reshape(response.F.shape[:-2] + (-1,))
    table = np.concatenate([response.crv, response.x, quaternion(response.Lambda), forces], axis=-1)
    return np.ascontiguousarray(table, dtype=float)


class Golden(NamedTuple):
    """t (T,) [s]; values and bars (T, columns); contact (T, n): 1, 0, or -1 where the runs of the maker disagree."""

    t: np.ndarray
    values: np.ndarray
    bars: np.ndarray
    contact: np.ndarray


def text(path: Path) -> list[list[str]]:
    """Cells of a table, without its header."""
    with gzip.open(path, "rt", encoding="ascii") as f:
        return [line.rstrip("\n").split(",") for line in f][1:]


def read(kind: str, folder: Path = FOLDER) -> Golden:
    """Read the golden files of one kind, "scheme" or "converged"."""
    rows, bars = text(folder / f"{kind}.csv.gz"), text(folder / f"{kind}_bars.csv.gz")
    contact = np.array([[{"0": 0, "1": 1, "?": -1}[flag] for flag in row[1]] for row in rows])
    numbers = np.array([[float(cell) for cell in row[2:]] for row in rows])
    return Golden(
        np.array([float(row[0]) for row in rows]),
        numbers,
        np.array([[float(cell) for cell in row[1:]] for row in bars]),
        contact,
    )


def described(folder: Path = FOLDER) -> dict:
    """Read `schema.json`."""
    return json.loads((folder / "schema.json").read_text())
