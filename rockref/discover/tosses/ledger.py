"""Energy over the stretches of tosses: as measured, and as a model has it, by the same differences of poses."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.tosses.body import in_the_step
from rockref.discover.tosses.predict import Prediction, gravity_of
from rockref.discover.tosses.stretches import STRETCHES
from rockref.measure.tosses.flight import Poses
from rockref.model.rotation import logarithm

#: Share of what a toss loses altogether by which its energy must rise over a stretch to count as a gain; decided:
#: poses with the noise of the public tosses give the energy of a frame to half a percent.
GAIN = 0.02


def energies(x: np.ndarray, Lambda: np.ndarray, dt: float, model: Model) -> np.ndarray:
    """Return (B, F) kinetic and potential energy [J] half a frame before every frame; the first one is that of the
    second.

    x (B, F, 3) of the centre of mass [m], Lambda (B, F, 3, 3), over the plate; dt between frames [s]. The difference of
    two frames is the velocity in their middle to second order; so is the mean of their heights.
    """
    block, _ = in_the_step(model).body()
    v = np.diff(x, axis=1) / dt
    W = logarithm(Lambda[:, :-1].swapaxes(-1, -2) @ Lambda[:, 1:]) / dt
    moving = float(block.mass) * np.sum(v**2, axis=-1) / 2 + np.einsum("bfi,ij,bfj->bf", W, block.inertia, W) / 2
    lifted = -float(block.mass) * ((x[:, 1:] + x[:, :-1]) / 2 @ gravity_of(model, float(block.g)))
    E = moving + lifted
    return np.concatenate([E[:, :1], E], axis=1)


def losses(E: np.ndarray, found: np.ndarray) -> np.ndarray:
    """Return (B, number of stretches) energy lost in each stretch [J], NaN where a toss has none; found (B, F) their
    numbers.

    The state before a stretch is that of the interval that ends before its first frame: a contact that begins between
    two frames is not in it.
    """
    lost = np.full((len(E), len(STRETCHES)), np.nan)
    for i, row in enumerate(found):
        n = int(np.sum(row >= 0))
        begins = [0, *(np.flatnonzero(np.diff(row[:n])) + 1), n]
        for first, end in zip(begins, begins[1:], strict=False):
            before, after = E[i, max(first - 1, 0)], E[i, end - 1]
            lost[i, row[first]] = np.nan_to_num(lost[i, row[first]]) + before - after
    return lost


def ledger(model: Model, predicted: Prediction, poses: Poses, found: np.ndarray) -> dict[str, dict[str, float]]:
    """Return per stretch the mean share [%] of the energy that a toss loses altogether, measured and in the model.

    Both with the model's body and frames, and both in parts of what the measured toss loses. gains : tosses whose
    measured energy rises over the stretch by more than `GAIN` of it.
    """
    dt = float(poses.t[1])
    both = []
    for x, Lambda in ((poses.x, poses.Lambda), (predicted.x, np.nan_to_num(predicted.Lambda))):
        both.append(losses(energies(*predicted.frames.to_body(x, Lambda), dt, model), found))
    measured, modelled = (part / np.nansum(both[0], axis=1)[:, None] for part in both)
    rows: dict[str, dict[str, Any]] = {}
    for k, name in enumerate(STRETCHES):
        here = np.isfinite(measured[:, k])
        if here.any():
            rows[name] = {
                "measured_percent": round(100 * float(np.mean(measured[here, k])), 2),
                "model_percent": round(100 * float(np.nanmean(modelled[here, k])), 2),
                "gains": int(np.sum(measured[here, k] < -GAIN)),
            }
    return rows
