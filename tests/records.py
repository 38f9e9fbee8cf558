"""Records of many blocks and gyroscopes, honest ones and faulty ones: simulated by the law, sensed by the gyroscope.

An honest record has nothing wrong with it, and the reader must have nothing to say. A fault is a function that takes
times (N,) s and rates (N, 3) deg/s and returns what a logger or a sensor would make of them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rockref.api import Model, simulate
from rockref.measure.gyroscope import record
from rockref.measure.records.release import Gyro

DEGREE = math.pi / 180.0
#: Output rate of a simulation, Hz: a whole part of the steps, above twice the fastest gyroscope's.
FINE = 20000.0


@dataclass(frozen=True)
class Sensed:
    """One record: the block's model, the gyroscope, times (N,) s and rates (N, 3) rad/s as recorded."""

    model: Model
    gyro: Gyro
    t: np.ndarray
    crv: np.ndarray

    @property
    def degrees(self) -> np.ndarray:
        """The rates in deg/s, (N, 3)."""
        return self.crv / DEGREE


def some_block(rng: np.random.Generator, width: float | None = None) -> Model:
    """A block of a width between 2 cm and 2 m, 2.5 to 9 times as high, of wood to steel; stiffness goes with mass."""
    width = float(np.exp(rng.uniform(math.log(0.02), math.log(2.0)))) if width is None else width
    height = width * float(rng.uniform(2.5, 9.0))
    mass = float(np.exp(rng.uniform(math.log(600.0), math.log(7800.0)))) * width**2 * height
    size, heavy = width / 0.1, mass / 54.0
    feet = size * np.array([0.010e-3, 0.040e-3, 0.092e-3, 0.058e-3])
    return Model.table_3_1().replace(
        mass=mass,
        width=width,
        depth=width,
        height=height,
        K_N=6e7 * heavy * float(rng.uniform(0.5, 2.0)),
        K_T=5e7 * heavy,
        mu_int=float(rng.uniform(0.2, 0.5)),
        mu_ext=float(rng.uniform(0.2, 0.5)),
        delta_long=tuple(feet[rng.permutation(4)]),
        delta_diag=6e-3 * size,
        theta_0=math.atan2(width, height) * float(rng.uniform(0.5, 0.85)),
    )


def motion_of(model: Model, swings: float = 8.0) -> tuple[np.ndarray, np.ndarray]:
    """Times (N,) s and body rates (N, 3) rad/s of a release, for so many quarter swings and half a second at least."""
    period = math.sqrt(math.hypot(model.width, model.height) / 9.81)
    response = simulate(model, duration=max(0.5, swings * period), output_rate=FINE, engine="auto")
    return response.t, response.W


def some_gyro(rng: np.random.Generator) -> Gyro:
    """A gyroscope of 100 Hz to 8 kHz, 0.02 to 0.2 deg/s of noise, a resolution of 0.01 to 2 deg/s."""
    rate = float(rng.choice([100.0, 200.0, 400.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0]))
    return Gyro(
        sample_rate=rate,
        noise=DEGREE * float(rng.choice([0.02, 0.05, 0.1, 0.2])),
        bandwidth=rate * float(rng.uniform(0.2, 0.4)),
        resolution=DEGREE * float(rng.choice([0.01, 0.0625, 0.25, 0.5, 1.0, 2.0])),
    )


def sensed(model: Model, gyro: Gyro, rng: np.random.Generator, motion=None) -> Sensed:
    """What `gyro` records of a release of `model`."""
    t, crv = record(*(motion_of(model) if motion is None else motion), gyro, rng)
    return Sensed(model, gyro, t, crv)


def toml_of(model: Model, gyro: Gyro, files: dict[str, float]) -> str:
    """An experiment.toml of runs in `files` (name to release tilt in rad); the first is fitted, the others held out."""
    text = f"""name = "made"
kind = "release"
baseline = "eight_points"

[block]
mass_kg = {model.mass!r}
width_m = {model.width!r}
height_m = {model.height!r}

[release]
tilt_uncertainty_rad = 0.0014

[gyro]
sample_rate_hz = {gyro.sample_rate!r}
noise_deg_s = {gyro.noise / DEGREE:.9g}
bandwidth_hz = {gyro.bandwidth!r}
resolution_deg_s = {gyro.resolution / DEGREE:.9g}
"""
    for number, (name, tilt) in enumerate(files.items(), start=1):
        use = "fit" if number == 1 else "holdout"
        text += f'\n[[run]]\nid = "{number:02d}"\nfile = "{name}"\nuse = "{use}"\n'
        text += f"release_tilt_rad = {tilt!r}\nblock_turned_deg = 0\n"
    return text


def written(folder: Path, made: Sensed, t: np.ndarray | None = None, degrees: np.ndarray | None = None) -> Path:
    """An experiment of one run in `folder`: a record as it is, or with other times (N,) s and rates (N, 3) deg/s."""
    t, degrees = made.t if t is None else t, made.degrees if degrees is None else degrees
    folder.mkdir(parents=True, exist_ok=True)
    toml = toml_of(made.model, made.gyro, {"run01.csv": made.model.parameters.theta_0})
    (folder / "experiment.toml").write_text(toml, encoding="utf-8")
    rows = np.column_stack((t, degrees))
    text = "t_s,wx_deg_s,wy_deg_s,wz_deg_s\n"
    text += "".join(f"{a:.6f},{b:.4f},{c:.4f},{d:.4f}\n" for a, b, c, d in rows)
    (folder / "run01.csv").write_text(text, encoding="utf-8")
    return folder


def burst(rng: np.random.Generator, t: np.ndarray, degrees: np.ndarray, rate: float) -> np.ndarray:
    """A burst of two to nine samples that stand off by a quarter to five times `rate` deg/s, on any axis."""
    w = degrees.copy()
    count, axis = int(rng.integers(2, 10)), int(rng.integers(3))
    first = int(rng.integers(20, len(w) - 30))
    size = rate * float(np.exp(rng.uniform(math.log(0.25), math.log(5.0)))) * rng.choice([-1.0, 1.0])
    level = np.full(count, size) if rng.random() < 0.5 else size * rng.uniform(0.6, 1.6, count)
    middle = w[first - 1, axis]
    # What is written stands off from the motion by this much.
    w[first : first + count, axis] = middle + level + (np.sign(size) * 0.1 * rate)
    return w


def hold(rng: np.random.Generator, t: np.ndarray, degrees: np.ndarray, *, even: bool) -> np.ndarray:
    """Values held for two to nine samples, always as long or not."""
    count = int(rng.integers(2, 10))
    if even:
        rows = np.arange(len(t)) // count * count
    else:
        starts = np.cumsum(rng.integers(max(1, count - 2), count + 2, len(t)))
        rows = starts[np.maximum(np.searchsorted(starts, np.arange(len(t)), side="right") - 1, 0)]
        rows = np.minimum(np.where(np.arange(len(t)) < starts[0], 0, rows), len(t) - 1)
    return degrees[rows]


def stuck(rng: np.random.Generator, t: np.ndarray, degrees: np.ndarray, seconds: float, axes: int) -> np.ndarray:
    """One, two or three channels that stand still for `seconds`, at their last value or at zero."""
    w = degrees.copy()
    columns = rng.permutation(3)[:axes]
    first = int(rng.integers(5, max(6, int(0.8 * len(t)))))
    last = first + int(np.ceil(seconds / (t[1] - t[0]))) + 1
    w[first:last, columns] = w[first, columns] if rng.random() < 0.5 else 0.0
    return w


def wrapped(degrees: np.ndarray, limit: float) -> np.ndarray:
    """Numbers that wrap at plus and minus `limit` deg/s."""
    return np.mod(degrees + limit, 2.0 * limit) - limit
