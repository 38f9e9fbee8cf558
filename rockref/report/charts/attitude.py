"""The block's posture over time, as three angles that can be exaggerated one by one."""

from __future__ import annotations

import numpy as np

from rockref.model.rotation import exponential

# decided: rounding and noise of the gyroscope let an integrated attitude wander by some 3 um at a corner in a second.
TOUCHING = 1e-5


def integrated(Lambda_0: np.ndarray, t: np.ndarray, crv: np.ndarray) -> np.ndarray:
    """Return the rotations (N, 3, 3), body to plate, to which rates crv (N, 3) rad/s at t (N,) s lead from Lambda_0.

    Each interval turns by the mean of the rates at its ends.
    """
    turns = exponential(0.5 * (crv[1:] + crv[:-1]) * np.diff(t)[:, np.newaxis])
    found = np.empty((len(t), 3, 3))
    found[0] = Lambda_0
    for k, turn in enumerate(turns):
        found[k + 1] = found[k] @ turn
    return found


def angles(Lambda: np.ndarray) -> np.ndarray:
    """Return tilt, roll and turn, (N, 3) rad, with Lambda (N, 3, 3) = Rx(tilt) Ry(roll) Rz(turn)."""
    tilt = np.arctan2(-Lambda[:, 1, 2], Lambda[:, 2, 2])
    roll = np.arcsin(np.clip(Lambda[:, 0, 2], -1.0, 1.0))
    turn = np.unwrap(np.arctan2(-Lambda[:, 0, 1], Lambda[:, 0, 0]))
    return np.stack((tilt, roll, turn), axis=-1)


def lowest_points(Lambda: np.ndarray, P: np.ndarray) -> np.ndarray:
    """Return which of the points P (n, 3) m, body axes, lie within 10 um of the lowest, (N, n) bool, by attitude."""
    heights = Lambda[:, 2, :] @ P.T
    return heights <= heights.min(axis=1, keepdims=True) + TOUCHING
