"""Experiments of the blind test: simulate the runs of a drawn block and write the folder that an experimenter has."""

from __future__ import annotations

import copy
import gzip
import io
import os
from collections.abc import Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np

from rockref.blind.cases import faulty, hidden, scaling, unlisted
from rockref.blind.cases.blocks import NEAR, OTHER, Runs, Setup, other_block
from rockref.blind.simulator import recorder
from rockref.blind.simulator.release import simulate
from rockref.blind.simulator.world import DEGREE, World, build

#: Wire: what its length scatters from run to run, rad.
JITTER = 0.02 * DEGREE
#: RMS by which an effect has to change the first record of another block, in noise widths; decided: over some thousand
#: rows that is a thousand units of log-likelihood, of which a refit of the block may take most. A block that does not
#: slide has nothing to tell of its friction: what nobody could see is no test of who looks.
SEEN = 1.0
#: Blocks that are drawn for a case before an effect that none of them shows is hidden in the last.
ATTEMPTS = 20
#: Effects that show as the experimenter's baseline, or as stops that are a share of the largest rate.
ALWAYS_SEEN = ("foot_defects", "gyro_saturation")
Table = tuple[np.ndarray, np.ndarray]


def setup_that_shows(effects: Sequence[tuple[str, float]], seed: int) -> Setup:
    """Draw another block, its instrument and campaign, again until every effect (id, size) alone shows in it."""
    for attempt in range(ATTEMPTS):
        setup = other_block(seed, [id for id, _ in effects], attempt)
        seen = [id in ALWAYS_SEEN or trace(setup, id, size, seed) >= SEEN for id, size in effects]
        if all(seen):
            break
    return setup


def trace(setup: Setup, id: str, size: float, seed: int) -> float:
    """Return the RMS, in noise widths, by which an effect alone changes the first record of a setup of its own."""
    assert setup.parameters is not None
    records = []
    for hides in (False, True):
        world, rng = _world(setup, setup.parameters), np.random.default_rng([int(seed), 5])
        if hides:
            (hidden.EFFECTS.get(id) or unlisted.EFFECTS[id])(world, rng, size, False, {})
        world.sensor.noise, world.sensor.resolution = 0.0, 1e-12
        first = replace(setup, runs=setup.runs[:1])
        ((_, rates),), _ = _record(first, world, setup.parameters["theta_0"], [], np.random.default_rng(seed), rng)
        records.append(rates)
    return float(np.sqrt(np.mean((records[1] - records[0]) ** 2))) / setup.sensor.noise


def make_case(
    folder: Path | str,
    effects: Sequence[str | tuple[str, float]] | None = None,
    seed: int = 0,
    *,
    name: str | None = None,
    setup: Setup | None = None,
    runs: Runs | None = None,
    seconds: float | None = None,
    other_form: bool | None = None,
    spread: float = 0.10,
    values: dict[str, dict[str, float]] | None = None,
    fault: str | None = None,
) -> dict[str, Any]:
    """Write one experiment folder and return its truth, which is not written.

    Parameters
    ----------
    folder : made if missing. `name` : of the experiment; the folder's name by default.
    effects : ids of listed or unlisted effects, each alone or with a size (1: typical); None or empty: a control.
    seed : of everything that is drawn.
    setup : block, instrument and campaign; the source's by default. `runs`, `seconds` : instead of the setup's.
    other_form : whether another functional form hides behind the name; None: by chance, 3 in 10.
    spread : of the parameters about Table 3.1 (log-normal), where the setup has none of its own.
    values : parameters of an effect that are set and not drawn, by effect and name.
    fault : of the records, an id of :mod:`rockref.blind.cases.faulty`.

    Raises KeyError for an effect or a fault that is not known.
    """
    folder, setup = Path(folder), setup or Setup()
    setup = replace(setup, runs=tuple(runs or setup.runs), seconds=seconds or setup.seconds)
    rng, sensor_rng = (np.random.default_rng([int(seed), k]) for k in (1, 2))
    wanted = [(e, 1.0) if isinstance(e, str) else (str(e[0]), float(e[1])) for e in effects or ()]
    parameters = setup.parameters_by(rng, spread)
    world = _world(setup, parameters)
    found = []
    for id, size in wanted:
        draw = hidden.EFFECTS.get(id) or unlisted.EFFECTS[id]
        form = bool(rng.random() < 0.3) if other_form is None else other_form
        found.append({"id": id, "size": size, **draw(world, rng, size, form, (values or {}).get(id, {}))})
    tables, truths = _record(setup, world, parameters["theta_0"], found, rng, sensor_rng)
    name = name or folder.name
    truth: dict[str, Any] = {"name": name, "seed": int(seed), "effects": found}
    if fault is not None:
        uses = [use for _, use, _, _ in setup.runs]
        tables, truth["fault"] = faulty.spoil(fault, tables, uses, np.random.default_rng([int(seed), 3]))
    four = any(id == "foot_defects" for id, _ in wanted)
    _write(folder, name, "four_points" if four else "eight_points", setup, tables)
    block = {"family": OTHER if setup.is_other else NEAR} | asdict(setup.block)
    return truth | {"block": block, "parameters": parameters, "runs": truths}


def _world(setup: Setup, parameters: dict[str, float]) -> World:
    """Return the block of a setup on its plate, with what is typical of hidden effects there."""
    world, scale = build(parameters, setup.block), scaling.scale_of(setup.block, parameters)
    world.sensor = copy.deepcopy(setup.sensor)
    world.factors = scaling.factors(scale) if setup.is_other else {}
    for slot, unit in scaling.REFERENCES.items():
        world[slot] *= getattr(scale, unit) if setup.is_other else 1.0
    return world


def _record(
    setup: Setup,
    world: World,
    theta_0: float,
    effects: list[dict[str, Any]],
    rng: np.random.Generator,
    sensor_rng: np.random.Generator,
) -> tuple[list[Table], list[dict[str, Any]]]:
    """Return tables (t [s], rates [rad/s]) of all runs, and what is true of each: its tilt [rad], what befell it
    alone."""
    tables, truths = [], []
    for number, (id, _use, stated, turned) in enumerate(setup.runs):
        jitter = JITTER * rng.normal()
        tilt = stated * theta_0 / setup.nominal_tilt + jitter
        one = copy.deepcopy(world)
        own: dict[str, float] = {}
        for change in world.each_run:
            own.update(change(one, rng, number))
        need = recorder.seconds_needed(one.sensor, setup.seconds)
        rates = simulate(one, tilt, turned, np.ceil(need * 100) / 100)
        if one.sensor.range < 0:  # a share of the largest rate of the first run
            world.sensor.range = one.sensor.range = -one.sensor.range * float(np.abs(rates).max())
            for effect in effects:
                if "range" in effect["parameters"]:
                    effect["parameters"]["range"] = one.sensor.range
        tables.append(recorder.record(rates, one.sensor, setup.seconds, sensor_rng))
        truths.append({"id": id, "tilt": tilt, **own})
    return tables, truths


def _write(folder: Path, name: str, baseline: str, setup: Setup, tables: Sequence[Table]) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    # At one kilohertz three digits tell the time; at most other rates six.
    digits = "%.3f" if setup.sensor.sample_rate == 1000 else "%.6f"
    for (id, *_), (t, rates) in zip(setup.runs, tables, strict=True):
        text = io.StringIO()
        text.write("t_s,wx_deg_s,wy_deg_s,wz_deg_s\n")
        np.savetxt(text, np.column_stack([t, rates / DEGREE]), fmt=[digits, "%.2f", "%.2f", "%.2f"], delimiter=",")
        # No time and no name in the head: the same bytes whenever it is made.
        _put(folder / f"run{id}.csv.gz", gzip.compress(text.getvalue().encode(), 6, mtime=0))
    _put(folder / "experiment.toml", _head(name, baseline, setup).encode())  # last: a folder with this file is whole


def _head(name: str, baseline: str, setup: Setup) -> str:
    """Return the text of experiment.toml: what an experimenter knows."""
    block, sensor = setup.block, setup.sensor
    head = f"""name = "{name}"
kind = "release"
baseline = "{baseline}"

[block]
mass_kg = {block.mass}
width_m = {block.width:.3f}
height_m = {block.height:.3f}

[release]
tilt_uncertainty_rad = {setup.tilt_uncertainty:g}

[gyro]
sample_rate_hz = {sensor.sample_rate:.0f}
noise_deg_s = {sensor.noise / DEGREE:.3g}
bandwidth_hz = {sensor.low_pass:.0f}
resolution_deg_s = {sensor.resolution / DEGREE:.3g}
"""
    for id, use, tilt, turned in setup.runs:
        head += f"""
[[run]]
id = "{id}"
file = "run{id}.csv.gz"
use = "{use}"
release_tilt_rad = {tilt:g}
block_turned_deg = {180 if turned else 0}
"""
    return head


def _put(path: Path, content: bytes) -> None:
    beside = path.with_name(path.name + f".{os.getpid()}.part")
    beside.write_bytes(content)
    os.replace(beside, path)
