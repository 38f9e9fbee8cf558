"""Experiments of the blind test: simulate the runs of a drawn block and write the folder that an experimenter has."""

from __future__ import annotations

import copy
import gzip
import io
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rockref.blind.cases import hidden, outsiders
from rockref.blind.simulator import kernel, posture, recorder
from rockref.blind.simulator.slots import G
from rockref.blind.simulator.world import HEIGHT, MASS, NOMINAL_TILT, WIDTH, World, build, draw_parameters

STEP = 5e-6
SECONDS = 5.0
#: Wire: what its length scatters from run to run, rad.
JITTER = 0.02 * recorder.DEGREE
#: id, use, stated tilt [rad], turned
RUNS = (
    ("01", "fit", NOMINAL_TILT, False),
    ("02", "fit", NOMINAL_TILT, False),
    ("03", "holdout", NOMINAL_TILT, False),
    ("04", "fit", 0.098, False),
    ("05", "holdout", 0.108, False),
    ("06", "fit", NOMINAL_TILT, True),
)


def simulate(
    world: World, tilt: float, turned: bool = False, seconds: float = SECONDS, step: float = STEP
) -> np.ndarray:
    """Body rates (N, 3) [rad/s] at `recorder.FINE` lines a second of a block released at `tilt` [rad]."""
    x, R, pivots = posture.stand(world, tilt, turned)
    q = posture.quaternion(R)
    w = world.kick.copy()
    v = np.zeros(3)
    if np.any(w):
        foot = 0.5 * (world.points[pivots[0]] + world.points[pivots[1]]) + np.array([0, 0, world.kick_at])
        v = -np.cross(R @ w, R @ foot)
    hung, hung_v = _hang(world, x, R)
    v_hung = v + np.cross(R @ w, hung - x)
    hung_v[:] = v_hung
    every = round(1.0 / (recorder.FINE * step))
    rows = round(seconds * recorder.FINE) + 1
    rates = np.empty((rows, 3))
    kernel.run(
        x, v, q, w, world.J, np.linalg.inv(world.J), world.mass, np.ascontiguousarray(world.points),
        np.ascontiguousarray(world.props), world.g, np.zeros(4), hung, hung_v, (rows - 1) * every, step, every, rates,
    )  # fmt: skip
    if not np.all(np.isfinite(rates)):
        raise FloatingPointError("the simulated block left the plate: draw a smaller effect")
    return rates


def _hang(world: World, x: np.ndarray, R: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Place and velocity of the mass that hangs inside, at rest under its weight."""
    if not world["hung_m"]:
        return x.copy(), np.zeros(3)
    weight = R.T @ np.array([0, 0, -world["hung_m"] * world["gravity"]])
    stiffness = world.g[[G["hung_kx"], G["hung_ky"], G["hung_kz"]]]
    return x + R @ (weight / stiffness + np.array([0, 0, world["hung_z"]])), np.zeros(3)


def make_case(
    folder: Path | str,
    effects: Sequence[str | tuple[str, float]] | None = None,
    seed: int = 0,
    *,
    name: str | None = None,
    runs: Sequence[tuple[str, str, float, bool]] = RUNS,
    other_form: bool | None = None,
    seconds: float = SECONDS,
    spread: float = 0.10,
    values: dict[str, dict[str, float]] | None = None,
) -> dict[str, Any]:
    """Write one experiment folder and return its truth, which is not written.

    Parameters
    ----------
    folder : made if missing. `name` : of the experiment; the folder's name by default.
    effects : ids of hidden effects or of outsiders, each alone or with a size (1: typical); None or empty: a control.
    seed : of everything that is drawn.
    runs : id, use, stated tilt [rad], turned.
    other_form : whether another functional form hides behind the name; None: by chance, 3 in 10.
    seconds : length of a record [s]. spread : of the baseline's parameters (log-normal).
    values : parameters of an effect that are set and not drawn, by effect and name.

    Raises KeyError for an effect that is not known.
    """
    folder = Path(folder)
    rng, sensor_rng = (np.random.default_rng([int(seed), k]) for k in (1, 2))
    wanted = [(e, 1.0) if isinstance(e, str) else (str(e[0]), float(e[1])) for e in effects or ()]
    parameters = draw_parameters(rng, spread)
    four = any(id == "foot_defects" for id, _ in wanted)
    world = build(parameters)
    found = []
    for id, size in wanted:
        draw = hidden.EFFECTS.get(id) or outsiders.OUTSIDERS[id]
        form = bool(rng.random() < 0.3) if other_form is None else other_form
        found.append({"id": id, "size": size, **draw(world, rng, size, form, (values or {}).get(id, {}))})
    tables, truths = [], []
    for number, (id, _use, stated, turned) in enumerate(runs):
        jitter = JITTER * rng.normal()
        tilt = stated * parameters["theta_0"] / NOMINAL_TILT + jitter
        one = copy.deepcopy(world)
        own: dict[str, float] = {}
        for change in world.each_run:
            own.update(change(one, rng, number))
        need = recorder.seconds_needed(one.sensor, seconds)
        rates = simulate(one, tilt, turned, np.ceil(need * 100) / 100)
        if one.sensor.range < 0:  # a share of the largest rate of the first run
            world.sensor.range = one.sensor.range = -one.sensor.range * float(np.abs(rates).max())
            for effect in found:
                if "range" in effect["parameters"]:
                    effect["parameters"]["range"] = one.sensor.range
        tables.append((id, recorder.record(rates, one.sensor, seconds, sensor_rng)))
        truths.append({"id": id, "tilt": tilt, **own})
    name = name or folder.name
    _write(folder, name, "four_points" if four else "eight_points", runs, tables)
    return {"name": name, "seed": int(seed), "effects": found, "parameters": parameters, "runs": truths}


def _write(folder: Path, name: str, baseline: str, runs: Sequence[tuple], tables: list) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for id, (t, rates) in tables:
        text = io.StringIO()
        text.write("t_s,wx_deg_s,wy_deg_s,wz_deg_s\n")
        np.savetxt(
            text, np.column_stack([t, rates / recorder.DEGREE]), fmt=["%.3f", "%.2f", "%.2f", "%.2f"], delimiter=","
        )
        # No time and no name in the head: the same bytes whenever it is made.
        _put(folder / f"run{id}.csv.gz", gzip.compress(text.getvalue().encode(), 6, mtime=0))
    head = f"""name = "{name}"
kind = "release"
baseline = "{baseline}"

[block]
mass_kg = {MASS}
width_m = {WIDTH:.3f}
height_m = {HEIGHT:.3f}

[release]
tilt_uncertainty_rad = 0.0014

[gyro]
sample_rate_hz = {recorder.SAMPLE_RATE}
noise_deg_s = 0.05
bandwidth_hz = {recorder.BANDWIDTH:.0f}
resolution_deg_s = 0.01
"""
    for id, use, tilt, turned in runs:
        head += f"""
[[run]]
id = "{id}"
file = "run{id}.csv.gz"
use = "{use}"
release_tilt_rad = {tilt:g}
block_turned_deg = {180 if turned else 0}
"""
    _put(folder / "experiment.toml", head.encode())  # last: a folder with this file is whole


def _put(path: Path, content: bytes) -> None:
    beside = path.with_name(path.name + f".{os.getpid()}.part")
    beside.write_bytes(content)
    os.replace(beside, path)
