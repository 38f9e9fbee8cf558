"""Free flight of tossed bodies: which frames it has, and the state at the first frame with its uncertainty."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rockref.measure.records.toss import Toss
from rockref.model.rotation import exponential, inverse, logarithm

#: Fewest and most frames of a flight that are used. Decided: three are needed for a velocity with a residual; after
#: 0.3 s at 148 Hz drag and small torques are no longer small against the noise.
LEAST, MOST = 3, 44
#: Rounds of the fit of a turn; each takes the error of the last one times half the angle of the flight, 0.4 at most.
ROUNDS = 6
#: Noise of a pose where a flight has too few frames to show its own: 0.03 mm and 0.03 deg, as the public tosses have.
NOISE_X, NOISE_TURN = 3e-5, 5e-4


class Poses(NamedTuple):
    """Poses of B tosses side by side: t (F,) [s]; x (B, F, 3) [m]; Lambda (B, F, 3, 3); frames (B,) how many are
    measured (the last one is repeated behind them); v, W (B, 3) as stated at the first frame, or differences."""

    t: np.ndarray
    x: np.ndarray
    Lambda: np.ndarray
    frames: np.ndarray
    v: np.ndarray
    W: np.ndarray

    @property
    def measured(self) -> np.ndarray:
        """Return (B, F) bool, whether a frame is measured."""
        return np.arange(len(self.t)) < self.frames[:, None]


def side_by_side(tosses: Sequence[Toss], rate: float) -> Poses:
    """Stack tosses of one camera rate [Hz] as arrays."""
    frames = np.array([toss.frames for toss in tosses])
    F = int(frames.max())
    x, Lambda = np.empty((len(tosses), F, 3)), np.empty((len(tosses), F, 3, 3))
    v, W = np.empty((len(tosses), 3)), np.empty((len(tosses), 3))
    for i, toss in enumerate(tosses):
        n = toss.frames
        x[i, :n], x[i, n:] = toss.x, toss.x[-1]
        Lambda[i, :n], Lambda[i, n:] = toss.Lambda, toss.Lambda[-1]
        if toss.v is not None and toss.W is not None:
            v[i], W[i] = toss.v[0], toss.W[0]
        else:
            v[i] = (toss.x[1] - toss.x[0]) * rate
            W[i] = logarithm(toss.Lambda[0].T @ toss.Lambda[1]) * rate
    return Poses(np.arange(F) / rate, x, Lambda, frames, v, W)


def lowest(x: np.ndarray, Lambda: np.ndarray, P: np.ndarray) -> np.ndarray:
    """Return height of the lowest of the body points P (n, 3) [m]; x (..., 3), Lambda (..., 3, 3) -> (...)."""
    return x[..., 2] + np.min(Lambda[..., 2, :] @ P.T, axis=-1)


def flight_frames(poses: Poses, P: np.ndarray, clearance: float) -> np.ndarray:
    """Return how many frames pass before a body point P (n, 3) comes closer than `clearance` [m] to z = 0, (B,).

    A contact may begin and end between two frames: a flight also ends with the frame from which a point, as fast as it
    came, would be closer in the next one.
    """
    low = lowest(poses.x, poses.Lambda, P)
    near = first_true(low < clearance, poses.frames)
    due = first_true(2 * low[:, 1:] - low[:, :-1] < clearance, poses.frames) + 2
    return np.clip(np.minimum(near, due), LEAST, np.minimum(MOST, poses.frames))


def first_true(found: np.ndarray, otherwise: np.ndarray) -> np.ndarray:
    """Return number of the first true column of every row (B, F), or `otherwise` (B,)."""
    return np.where(found.any(axis=1), found.argmax(axis=1), otherwise)


@dataclass(frozen=True)
class Starts:
    """States at the first frame: x, v (B, 3) of the centre of mass; Lambda (B, 3, 3); W (B, 3) body axes.

    covariance : (B, 12, 12) of (x, turn in body axes, v, W) [m, rad, m/s, rad/s].  used : (B,) frames.
    residual_x, residual_turn : (B,) RMS of what the flight leaves [m, rad].
    """

    x: np.ndarray
    v: np.ndarray
    Lambda: np.ndarray
    W: np.ndarray
    covariance: np.ndarray
    used: np.ndarray
    residual_x: np.ndarray
    residual_turn: np.ndarray


def ballistic_starts(poses: Poses, used: np.ndarray, gravity: np.ndarray, inertia: np.ndarray) -> Starts:
    """Start states by least squares: a parabola for the centre of mass, a torque-free turn for the body.

    Parameters
    ----------
    poses : of the centre of mass and the principal or any body axes.
    used : (B,) frames of free flight.  gravity : (3,) or (B, 3) [m/s2].  inertia : (3, 3) [kg m2], body axes.

    The turn is exp(W t + A t^2/2 + (A'/6 + W x A/12) t^3), A = J^-1 (J W x W): Euler's equations and the exponential of
    their solution (Magnus) to third order. Over 0.15 s and 10 rad/s the next order is below 1e-4 rad.
    """
    n = int(used.max())
    t = poses.t[:n]
    weight = (np.arange(n) < used[:, None]).astype(float)
    s0, s1, s2 = weight.sum(1), weight @ t, weight @ (t * t)
    determinant = s0 * s2 - s1 * s1
    line = np.empty((len(used), 2, 2))  # inverse of the normal matrix of (value, slope)
    line[:, 0, 0], line[:, 1, 1] = s2 / determinant, s0 / determinant
    line[:, 0, 1] = line[:, 1, 0] = -s1 / determinant

    fall = np.broadcast_to(gravity, (len(used), 3))[:, None] * (t * t / 2)[:, None]
    straight = poses.x[:, :n] - fall
    x, v = _line(straight, weight, t, line)
    left_x = (straight - x[:, None] - v[:, None] * t[:, None]) * weight[..., None]

    J_inverse = inverse(inertia)
    Lambda = poses.Lambda[:, 0].copy()
    last = np.maximum(used - 1, 1)
    ends = poses.Lambda[np.arange(len(used)), last]
    W = logarithm(Lambda.swapaxes(-1, -2) @ ends) / t[last][:, None]
    for _ in range(ROUNDS):
        A = np.cross(W @ inertia.T, W) @ J_inverse.T
        A_rate = (np.cross(A @ inertia.T, W) + np.cross(W @ inertia.T, A)) @ J_inverse.T
        third = A_rate / 6 + np.cross(W, A) / 12
        turn = W[:, None] * t[:, None] + A[:, None] * (t * t / 2)[:, None] + third[:, None] * (t**3)[:, None]
        model = Lambda[:, None] @ exponential(turn)
        # What is left, in the body axes of the start: the same axes in which a small turn of the start acts.
        left = logarithm(poses.Lambda[:, :n] @ model.swapaxes(-1, -2))
        left = left @ Lambda
        d_turn, d_W = _line(left, weight, t, line)
        Lambda = Lambda @ exponential(d_turn)
        W = W + d_W
    left_turn = (left - d_turn[:, None] - d_W[:, None] * t[:, None]) * weight[..., None]
    free = np.maximum(3 * (s0 - 2), 1)
    sigma_x = np.sqrt(np.sum(left_x**2, axis=(1, 2)) / free)
    sigma_turn = np.sqrt(np.sum(left_turn**2, axis=(1, 2)) / free)
    covariance = _covariance(line, np.maximum(sigma_x, NOISE_X), np.maximum(sigma_turn, NOISE_TURN))
    return Starts(x, v, Lambda, W, covariance, used, sigma_x, sigma_turn)


def _line(values: np.ndarray, weight: np.ndarray, t: np.ndarray, line: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return value at zero and slope of straight lines through (B, n, 3), two (B, 3)."""
    b0 = np.einsum("bf,bfi->bi", weight, values)
    b1 = np.einsum("bf,f,bfi->bi", weight, t, values)
    return line[:, 0, :1] * b0 + line[:, 0, 1:] * b1, line[:, 1, :1] * b0 + line[:, 1, 1:] * b1


def _covariance(line: np.ndarray, sigma_x: np.ndarray, sigma_turn: np.ndarray) -> np.ndarray:
    C = np.zeros((len(line), 12, 12))
    for first, sigma in ((0, sigma_x), (3, sigma_turn)):
        for i in range(3):
            for a, row in enumerate((first + i, first + 6 + i)):
                for b, column in enumerate((first + i, first + 6 + i)):
                    C[:, row, column] = sigma**2 * line[:, a, b]
    return C


def raw_starts(poses: Poses, v: np.ndarray, W: np.ndarray) -> Starts:
    """Start states that are the first frame as it is, with velocities v, W (B, 3): the published way."""
    B = len(v)
    C = np.broadcast_to(np.diag([NOISE_X**2] * 3 + [NOISE_TURN**2] * 3 + [0.03**2] * 3 + [0.1**2] * 3), (B, 12, 12))
    zero = np.zeros(B)
    return Starts(poses.x[:, 0], v, poses.Lambda[:, 0], W, C, np.ones(B, int), zero, zero)


def displaced(starts: Starts, d: np.ndarray) -> Starts:
    """Return the starts moved by d (B, 12): position, turn in body axes, velocity, body rates."""
    return replace(
        starts, x=starts.x + d[:, :3], Lambda=starts.Lambda @ exponential(np.ascontiguousarray(d[:, 3:6])),
        v=starts.v + d[:, 6:9], W=starts.W + d[:, 9:12],
    )  # fmt: skip
