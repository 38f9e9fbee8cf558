"""Logs as loggers of others write them, made from the records of an experiment folder.

The layouts are those of public descriptions: phyphox (phyphox.org/wiki, Data export), Sensor Logger
(github.com/tszheichoi/awesome-sensor-logger), MT Manager and DOT (manuals of Movella), MPU6050_raw
(github.com/jrowberg/i2cdevlib), and plain serial output of an Arduino sketch.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from rockref.measure import Experiment, Run

STANDING = 1.2  # [s] before the release
# A chip that lies on its side: its x axis along Z, its y axis along -X, its z axis along -Y of the block.
TURN = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
ZERO = np.array([0.31, -0.22, 0.12])  # [deg/s] what the chip shows at rest
AXES = "-y,-z,x"


def chip_record(run: Run, noise: float = 0.05, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Times (N,) s since the logger was switched on, and the chip's rates (N, 3) deg/s, standing part included."""
    assert run.t is not None and run.crv is not None
    rng = np.random.default_rng(seed)
    step = float(np.median(np.diff(run.t)))
    count = round(STANDING / step)
    still = 0.01 * np.rint(noise * rng.standard_normal((count, 3)) / 0.01)
    rates = np.vstack([still, np.degrees(run.crv)])
    return np.arange(len(rates)) * step, rates @ TURN.T + ZERO


def gravity(run: Run, t: np.ndarray) -> np.ndarray:
    """What an accelerometer shows (N, 3) m/s2 of a block that stands; its motion is left out."""
    tilt = run.release_tilt or 0.0
    up = np.array([0.0, -np.sin(tilt), np.cos(tilt)])
    rng = np.random.default_rng(1)
    return 9.81 * up @ TURN.T + 0.02 * rng.standard_normal((len(t), 3))


def phyphox(run: Run) -> str:
    t, chip = chip_record(run)
    head = '"Time (s)","Gyroscope x (rad/s)","Gyroscope y (rad/s)","Gyroscope z (rad/s)","Absolute (rad/s)"'
    rad = np.radians(chip)
    rows = np.column_stack([t + 0.0137, rad, np.linalg.norm(rad, axis=1)])
    return "\n".join([head, *(",".join(f"{v:.9E}" for v in row) for row in rows)]) + "\n"


def phyphox_comma(run: Run) -> str:
    """The same with tabs and decimal commas, as for a spreadsheet."""
    return phyphox(run).replace(",", "\t").replace(".", ",")


def sensor_logger(run: Run) -> str:
    t, chip = chip_record(run)
    rows = zip(t, np.radians(chip), strict=True)
    lines = [f"{1727600000000000000 + round(s * 1e9)},{s:.7f},{z:.8f},{y:.8f},{x:.8f}" for s, (x, y, z) in rows]
    return "\n".join(["time,seconds_elapsed,z,y,x", *lines]) + "\n"


def mt_manager(run: Run) -> str:
    t, chip = chip_record(run)
    acc = gravity(run, t)
    head = "PacketCounter\tSampleTimeFine\tAcc_X\tAcc_Y\tAcc_Z\tGyr_X\tGyr_Y\tGyr_Z"
    lines = [
        f"{(65000 + k) % 65536}\t{1234567 + round(s * 1e4)}\t" + "\t".join(f"{v:.6f}" for v in (*a, *w))
        for k, (s, a, w) in enumerate(zip(t, acc, np.radians(chip), strict=True))
    ]
    top = ["// Start Time: Unknown", "// Update Rate: 1000.0Hz", "// Filter Profile: General (50.1)", head]
    return "\n".join([*top, *lines]) + "\n"


def xsens_dot(run: Run) -> str:
    t, chip = chip_record(run)
    head = "PacketCounter,SampleTimeFine,Euler_X,Euler_Y,Euler_Z,Acc_X,Acc_Y,Acc_Z,Gyr_X,Gyr_Y,Gyr_Z"
    lines = [
        f"{k},{4294960000 + round(s * 1e6):d},0.0,0.0,0.0," + ",".join(f"{v:.6f}" for v in (*a, *w))
        for k, (s, a, w) in enumerate(zip(t, gravity(run, t), chip, strict=True))
    ]
    return "\n".join(["DeviceTag:,Dot 1", "FirmwareVersion:,2.0.0", "OutputRate:,1000 Hz", "", head, *lines]) + "\n"


def arduino(run: Run) -> str:
    """Counts of an MPU-6050 at 250 deg/s, micros() since the start, and the greeting of the sketch."""
    t, chip = chip_record(run)
    acc = np.rint(gravity(run, t) / 9.81 * 16384)
    counts = np.rint(chip * 131)
    lines = [",".join(f"{v:.0f}" for v in (812345 + s * 1e6, *a, *w)) for s, a, w in zip(t, acc, counts, strict=True)]
    return "\n".join(["MPU6050 connection successful", "micros,ax,ay,az,gx,gy,gz", *lines]) + "\n"


def mpu_raw(run: Run) -> str:
    t, chip = chip_record(run)
    acc, counts = np.rint(gravity(run, t) / 9.81 * 16384), np.rint(chip * 65.5)
    return "".join("a/g:\t" + "\t".join(f"{v:.0f}" for v in (*a, *w)) + "\n" for a, w in zip(acc, counts, strict=True))


def semicolons(run: Run) -> str:
    """Milliseconds, rad/s, semicolons and decimal commas."""
    t, chip = chip_record(run)
    lines = [
        ";".join([f"{1e3 * s:.0f}", *(f"{v:.6f}" for v in w)]).replace(".", ",")
        for s, w in zip(t, np.radians(chip), strict=True)
    ]
    return "\n".join(["time/ms;gx/(rad/s);gy/(rad/s);gz/(rad/s)", *lines]) + "\n"


def dated(run: Run) -> str:
    """Dates in the place of a time, spaces in names, degrees."""
    t, chip = chip_record(run)
    stamps = np.datetime64("2026-03-01T10:00:00") + np.rint(t * 1e6).astype("timedelta64[us]")
    lines = [f"{s}," + ",".join(f"{v:.4f}" for v in w) for s, w in zip(stamps, chip, strict=True)]
    return "\n".join(["Timestamp,Angular velocity X (°/s),Angular velocity Y (°/s),Angular velocity Z (°/s)", *lines])


LAYOUTS: dict[str, Callable[[Run], str]] = {
    f.__name__: f
    for f in (phyphox, phyphox_comma, sensor_logger, mt_manager, xsens_dot, arduino, mpu_raw, semicolons, dated)
}


def write_logs(experiment: Experiment, folder: Path, layout: str) -> list[Path]:
    """Write the runs of a loaded experiment as a logger of this layout would have."""
    folder.mkdir(parents=True, exist_ok=True)
    ending = "txt" if layout in ("mt_manager", "mpu_raw", "phyphox_comma") else "csv"
    paths = [folder / f"log{run.id}.{ending}" for run in experiment.runs]
    for path, run in zip(paths, experiment.runs, strict=True):
        path.write_text(LAYOUTS[layout](run), encoding="utf-8")
    return paths
