"""From a logger's files to an experiment folder that rockref reads.

Run it in an empty folder: ``python own_experiment.py`` writes `logger/` (what a logger might have exported; here it is
simulated) and makes `my_block/` of it. Then: ``rockref compare my_block``. What is to be changed for records of your
own stands in capitals, in `read` and in `body_rates`.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from rockref import Model, simulate
from rockref.measure import load_experiment, record
from rockref.measure.records.release import Gyro
from rockref.measure.signals.signal import growth_rate

# The block, with scale and rule; the gyroscope's data sheet.
MASS, WIDTH, HEIGHT = 30.1, 0.080, 0.600
GYRO = {"sample_rate_hz": 500, "bandwidth_hz": 150, "resolution_deg_s": 0.01}
TILT_UNCERTAINTY = 0.0015  # [rad] 1 mm of wire, 0.67 m above the pivots
# Of each run: file of the logger, use, tilt at the release [rad], turn of the block [deg].
RUNS = {
    "01": ("rec_0001.txt", "fit", 0.1050, 0),
    "02": ("rec_0002.txt", "fit", 0.1050, 0),
    "03": ("rec_0003.txt", "holdout", 0.0950, 0),
    "04": ("rec_0004.txt", "fit", 0.1050, 180),
}


def read(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Time (N,) s and the chip's rates (N, 3) deg/s from one file: semicolons, decimal commas, milliseconds, rad/s."""
    text = path.read_text(encoding="utf-8").replace(",", ".")
    rows = np.loadtxt(text.splitlines()[1:], delimiter=";")
    return rows[:, 0] / 1000, np.degrees(rows[:, 1:4])


def body_rates(chip: np.ndarray) -> np.ndarray:
    """Rates about X (main), Y (transverse), Z (height) of the block from the chip's (N, 3).

    This chip is mounted with its x axis along -Y, its y axis along X and its z axis along Z.
    """
    gx, gy, gz = chip.T
    return np.stack([gy, -gx, gz], axis=-1)


def release(t: np.ndarray, wx: np.ndarray, noise: float) -> float:
    """The instant of the release [s]: where the arc A sinh(p (t - t0)) of a block on its edge begins.

    Looked for in steps of 0.1 ms, with the first quarter of a second after the rate has left the noise. The low-pass of
    the gyroscope delays what it shows by sqrt(2)/(2 pi bandwidth), which is taken off.
    """
    p = growth_rate(WIDTH, HEIGHT)
    moving = t[np.argmax(np.convolve(np.abs(wx), np.ones(9) / 9, "same") > 5 * noise)]
    rows = (t > moving) & (t < moving + 0.25)
    candidates = np.arange(moving - 0.1, moving + 0.02, 1e-4)
    arcs = np.sinh(p * (t[rows] - candidates[:, None]))
    size = arcs @ wx[rows] / np.sum(arcs**2, axis=1)
    left = np.sum((size[:, None] * arcs - wx[rows]) ** 2, axis=1)
    return float(candidates[np.argmin(left)]) - 2**0.5 / (2 * np.pi * GYRO["bandwidth_hz"])


def convert(logger: Path, folder: Path) -> None:
    """Write the experiment folder: a table for each run, and experiment.toml."""
    folder.mkdir(exist_ok=True)
    noises, tables, samples = [], [], []
    for name, (file, use, tilt, turned) in RUNS.items():
        t, chip = read(logger / file)
        rates = body_rates(chip)
        rest = rates[t < t[0] + 0.4]  # the wire still holds
        noise = float(rest.std(axis=0).mean())
        rates -= rest.mean(axis=0)  # what a gyroscope at rest shows is its offset
        t = t - release(t, rates[:, 0], noise)
        kept = t >= 0
        rows = np.column_stack([t, rates])[kept]
        header = "t_s,wx_deg_s,wy_deg_s,wz_deg_s"
        np.savetxt(folder / f"run{name}.csv", rows, "%.4f,%.3f,%.3f,%.3f", header=header, comments="")
        noises.append(noise)
        samples.append(len(rest))
        tables.append(
            f'[[run]]\nid = "{name}"\nfile = "run{name}.csv"\nuse = "{use}"\n'
            f"release_tilt_rad = {tilt}\nblock_turned_deg = {turned}\n"
        )
    sheet = "\n".join(f"{key} = {value}" for key, value in GYRO.items())
    head = (
        f'name = "{folder.name}"\nkind = "release"\nbaseline = "eight_points"\n\n'
        f"[block]\nmass_kg = {MASS}\nwidth_m = {WIDTH}\nheight_m = {HEIGHT}\n\n"
        f"[release]\ntilt_uncertainty_rad = {TILT_UNCERTAINTY}\n\n"
        f"[gyro]\n{sheet}\nnoise_deg_s = {np.mean(noises):.3f}\n"
        f"zero_uncertainty_deg_s = {np.mean(noises) / min(samples) ** 0.5:.4f}\n"
    )
    (folder / "experiment.toml").write_text("\n".join([head, *tables]), encoding="utf-8")


def play_the_logger(logger: Path) -> None:
    """Write the files that a logger might have exported: a simulated block, half a second of rest before each release.

    Leave it out where you have records.
    """
    logger.mkdir(exist_ok=True)
    sides = {"mass": MASS, "width": WIDTH, "depth": WIDTH, "height": HEIGHT}
    block = Model.table_3_1().replace(**sides, beta_ext=0.21, delta_long=(3e-5, 7e-5, 5e-5, 2e-5), delta_diag=5e-3)
    gyro = Gyro(500.0, np.radians(0.06), 150.0, np.radians(0.01))
    rng = np.random.default_rng(1)
    for file, _, tilt, turned in RUNS.values():
        theta_0 = tilt + rng.normal(0.0, 3e-4)
        moved = simulate(block, duration=2.0, engine="auto", theta_0=theta_0, turned=bool(turned))
        rest, early = np.zeros((1000, 3)), np.arange(-1000, 0) / 2000
        t, W = record(np.concatenate([early, moved.t]), np.concatenate([rest, moved.W]), gyro, rng)
        X, Y, Z = (W + np.radians([0.31, -0.12, 0.05])).T
        rows = np.column_stack([1000 * (t + 0.5), -Y, X, Z])
        text = "\n".join("{:.0f};{:.6f};{:.6f};{:.6f}".format(*row).replace(".", ",") for row in rows)
        (logger / file).write_text("time/ms;gx/(rad/s);gy/(rad/s);gz/(rad/s)\n" + text + "\n", encoding="utf-8")


if __name__ == "__main__":
    play_the_logger(Path("logger"))
    convert(Path("logger"), Path("my_block"))
    for notice in load_experiment("my_block").notices:
        print(notice)
    print("my_block is an experiment folder")
