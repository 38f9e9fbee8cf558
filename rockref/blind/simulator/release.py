"""One release: a world stands, is let go, and its body rates are told."""

from __future__ import annotations

import numpy as np

from rockref.blind.simulator import kernel, posture, recorder
from rockref.blind.simulator.slots import G
from rockref.blind.simulator.world import World

STEP = 5e-6
SECONDS = 5.0


def simulate(
    world: World, tilt: float, turned: bool = False, seconds: float = SECONDS, step: float = STEP
) -> np.ndarray:
    """Return body rates (N, 3) [rad/s] at `recorder.FINE` lines a second of a block released at `tilt` [rad]."""
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
