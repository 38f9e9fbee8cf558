"""Experiments made by the model itself, in memory: what is put in is known."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from rockref import Model, simulate
from rockref.measure import Experiment, Gyro, Run, record

DEGREE = np.pi / 180.0
GYRO = Gyro(sample_rate=1000.0, noise=0.05 * DEGREE, bandwidth=300.0, resolution=0.01 * DEGREE)


def recorded(
    model: Model, tilt: float, duration: float, turned: bool = False, rng: np.random.Generator | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Times and rates of one release of the model, as the gyroscope shows it; without `rng` no noise."""
    response = simulate(model, duration=duration, output_rate=4000.0, engine="auto", theta_0=tilt, turned=turned)
    return record(response.t, response.W, GYRO, rng, model.active_effects())


def experiment(
    model: Model,
    runs: list[dict],
    duration: float = 1.6,
    uncertainty: float = 0.0014,
    noisy: bool = False,
    name: str = "synthetic",
) -> Experiment:
    """An experiment whose runs are releases of `model`; a run may have tilt, true_tilt, turned, use."""
    made = []
    for k, given in enumerate(runs):
        tilt = given.get("tilt", 0.117)
        turned = given.get("turned", False)
        rng = np.random.default_rng(k) if noisy else None
        t, crv = recorded(model, given.get("true_tilt", tilt), duration, turned, rng)
        made.append(
            Run(
                id=f"{k + 1:02d}",
                file=f"run{k + 1:02d}.csv",
                use=given.get("use", "fit"),
                release_tilt=tilt,
                block_turned=np.pi if turned else 0.0,
                t=t,
                crv=crv,
                sha256=f"{k:064x}",
            )
        )
    return Experiment(
        path=Path(name),
        name=name,
        kind="release",
        baseline="eight_points",
        mass=model.mass,
        width=model.width,
        height=model.height,
        tilt_uncertainty=uncertainty,
        gyro=GYRO,
        runs=tuple(made),
    )


def with_run(e: Experiment, k: int, crv: np.ndarray) -> Experiment:
    """The experiment with the rates of one run replaced."""
    runs = list(e.runs)
    runs[k] = replace(runs[k], crv=crv)
    return replace(e, runs=tuple(runs))
