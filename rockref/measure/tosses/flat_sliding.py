"""Friction of a face that slides flat: from how fast the block slows down, without a contact model."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from rockref.measure.tosses.flight import Poses
from rockref.measure.tosses.impact_balance import Measured

#: Height of the fourth-lowest corner below which a face lies flat [m]; decided: drawn corners of the public tosses
#: rest at -1.1 mm, and a face that rocks lifts a corner by some millimetres.
FLAT = 2e-3
#: Frames of one parabola, and frames after the face came down that are not used (it still rocks); decided: 9 frames at
#: 148 Hz give a deceleration to 0.1 m/s2 with the noise of the public tosses.
PIECE, SETTLING = 9, 2
#: Classes of sliding speed [m/s]; below the first one the block may come to rest within a piece.
SPEEDS = (0.06, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7)
#: Fewest pieces of a class.
LEAST = 5


def flat_pieces(poses: Poses, P: np.ndarray) -> np.ndarray:
    """Return (n, 3): number of the toss, speed [m/s] and deceleration along the motion [m/s2] of pieces of flat
    sliding."""
    heights = poses.x[..., 2:3] + poses.Lambda[..., 2, :] @ P.T
    flat = np.sort(heights, axis=-1)[..., min(3, len(P) - 1)] < FLAT
    t = (np.arange(PIECE) - PIECE // 2) * poses.t[1]
    fit = np.linalg.pinv(np.stack([np.ones(PIECE), t, t * t / 2], axis=1))
    found = []
    for i, n in enumerate(poses.frames):
        down = int(n) - int(np.argmin(flat[i, :n][::-1])) if not flat[i, :n].all() else 0
        for first in range(down + SETTLING, int(n) - PIECE + 1, PIECE):
            _, v, a = fit @ poses.x[i, first : first + PIECE, :2]
            speed = float(np.hypot(*v))
            if speed > SPEEDS[0]:
                found.append((i, speed, -float(a @ v) / speed))
    return np.array(found).reshape(-1, 3)


def sliding_friction(poses: Poses, P: np.ndarray, g: float) -> Measured:
    """Return coefficient of friction of a flat face by speed: medians of deceleration over g, with their standard
    errors."""
    pieces = flat_pieces(poses, P)
    values = {}
    for low, high in pairwise(SPEEDS):
        mu = pieces[(pieces[:, 1] > low) & (pieces[:, 1] <= high), 2] / g
        if len(mu) >= LEAST:
            spread = 1.4826 * np.median(np.abs(mu - np.median(mu)))
            # 1.2533: standard error of a median over that of a mean, for normal errors.
            values[f"{low:g} to {high:g} m/s"] = (float(np.median(mu)), float(1.2533 * spread / np.sqrt(len(mu))), "1")
    scatter = float(np.std(pieces[:, 2] / g)) if len(pieces) else math.nan
    return Measured(values, len(np.unique(pieces[:, 0])), scatter)


def rest_height(poses: Poses, P: np.ndarray) -> float:
    """Return median height of the four lowest drawn corners in the last frame [m]: of bodies that came to lie flat."""
    last = np.arange(len(poses.x)), poses.frames - 1
    heights = np.sort(poses.x[last][:, 2:3] + poses.Lambda[last][:, 2, :] @ P.T, axis=-1)[:, :4]
    flat = np.ptp(heights, axis=1) < FLAT
    return float(np.median(heights[flat].mean(axis=1))) if flat.any() else 0.0
