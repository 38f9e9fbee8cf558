"""A planar rocking block in closed form, and experiment folders made from it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

WIDTH, HEIGHT, MASS, TILT = 0.100, 0.688, 54.0, 0.117
RADIUS, ALPHA = 0.5 * math.hypot(WIDTH, HEIGHT), math.atan2(WIDTH, HEIGHT)
P = math.sqrt(0.75 * 9.81 / RADIUS)
DATA = Path(__file__).resolve().parents[3] / "data" / "experiments"


@dataclass(frozen=True)
class Rocking:
    """Linear arcs (Housner 1963): impact times, rates just before and after, apex angles (with sign), and w(t)."""

    times: np.ndarray
    before: np.ndarray
    after: np.ndarray
    apexes: np.ndarray
    sign: int

    def rate(self, t: np.ndarray) -> np.ndarray:
        """Rate about X at t (N,), rad/s."""
        w = (ALPHA - abs(self.apexes[0])) * P * np.sinh(P * t)
        for k, time in enumerate(self.times):
            s = t - time
            arc = self.after[k] * np.cosh(P * s) - ALPHA * P * np.sinh(P * s)
            w = np.where(s >= 0.0, (-1) ** k * arc, w)
        return self.sign * w

    def crv(self, t: np.ndarray) -> np.ndarray:
        """Rates (N, 3), nothing out of the plane."""
        return np.stack((self.rate(t), np.zeros_like(t), np.zeros_like(t)), axis=-1)


def rocking_block(tilt: float = TILT, restitution: float = 0.969, count: int = 12, sign: int = 1) -> Rocking:
    angle, time = tilt, 0.0
    times, before, after, apexes = [], [], [], [-sign * tilt]
    for k in range(count):
        quarter = math.acosh(ALPHA / (ALPHA - angle)) / P
        time += quarter if k == 0 else 2.0 * quarter
        rate = P * math.sqrt(ALPHA**2 - (ALPHA - angle) ** 2)
        times.append(time)
        before.append(rate)
        after.append(restitution * rate)
        angle = ALPHA - math.sqrt(ALPHA**2 - (restitution * rate / P) ** 2)
        apexes.append(sign * (-1) ** k * angle)
    return Rocking(np.array(times), np.array(before), np.array(after), np.array(apexes), sign)


@pytest.fixture(scope="session")
def rocking():
    """Return the function that makes a planar rocking block in closed form."""
    return rocking_block


@pytest.fixture(scope="session")
def sensed():
    """Return the function that makes what a gyroscope records of it: (t, crv) with noise from a seed."""
    from rockref.measure.gyroscope import record
    from rockref.measure.records.release import Gyro

    def make(motion: Rocking, duration: float = 3.0, seed: int | None = 0, noise: float = 8.7e-4, shift: float = 0.0):
        fine = np.arange(0.0, duration, 1.0 / 20000.0)
        crv = np.where(fine[:, None] >= shift, motion.crv(np.maximum(fine - shift, 0.0)), 0.0)
        gyro = Gyro(sample_rate=1000.0, noise=noise, bandwidth=300.0, resolution=0.01 * math.pi / 180.0)
        return record(fine, crv, gyro, None if seed is None else np.random.default_rng(seed))

    return make


HEAD = """
name = "made"
kind = "release"
baseline = "eight_points"

[block]
mass_kg = 54.0
width_m = 0.100
height_m = 0.688

[release]
tilt_uncertainty_rad = 0.0014

[gyro]
sample_rate_hz = 500
noise_deg_s = 0.05
bandwidth_hz = 200
resolution_deg_s = 0.01
"""
RUN = """
[[run]]
id = "{id}"
file = "{file}"
use = "{use}"
release_tilt_rad = 0.117
block_turned_deg = {turned}
"""


def table_text(t: np.ndarray, crv_deg: np.ndarray, header: str = "t_s,wx_deg_s,wy_deg_s,wz_deg_s") -> str:
    rows = np.column_stack((t, crv_deg))
    return header + "\n" + "".join(f"{a:.6f},{b:.2f},{c:.2f},{d:.2f}\n" for a, b, c, d in rows)


def signal_500hz(seed: int = 0, sign: int = 1, duration: float = 1.5) -> tuple[np.ndarray, np.ndarray]:
    """Times (N,) s and noisy rates (N, 3) deg/s of a good run at 500 Hz."""
    t = np.arange(0.0, duration, 0.002)
    rng = np.random.default_rng(seed)
    return t, np.degrees(rocking_block(sign=sign).crv(t)) + 0.05 * rng.standard_normal((len(t), 3))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A good experiment of two runs, one to fit and one held out with the block turned."""
    runs = RUN.format(id="01", file="run01.csv", use="fit", turned=0)
    runs += RUN.format(id="02", file="run02.csv", use="holdout", turned=180)
    (tmp_path / "experiment.toml").write_text(HEAD + runs, encoding="utf-8")
    (tmp_path / "run01.csv").write_text(table_text(*signal_500hz()), encoding="utf-8")
    (tmp_path / "run02.csv").write_text(table_text(*signal_500hz(1, sign=-1)), encoding="utf-8")
    return tmp_path


@pytest.fixture(scope="session")
def good_signal():
    """Return the function that makes times and rates in deg/s of a good run at 500 Hz."""
    return signal_500hz


@pytest.fixture(scope="session")
def as_table():
    """Return the function that writes times and rates in deg/s as the text of a table."""
    return table_text


@pytest.fixture(scope="session")
def shipped():
    """Return the folder of the shipped experiments."""
    return DATA
