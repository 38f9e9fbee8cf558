"""Where a toss is in its course, and how the error grows over each part."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.discover.tosses.errors import Errors
from rockref.measure.tosses.flight import Poses

#: The parts of a toss in their order.
STRETCHES = ("flight", "first impact", "second and third impact", "further impacts", "sliding", "rest")
#: Height of the lowest corner [m] below which the block touches, and above which it is off again; decided: the rest
#: height scatters by 0.5 mm, and a block that leaves rises by some millimetres.
TOUCH, OFF = 1.0e-3, 2.0e-3
#: Height within which four corners are on the plate together [m], and speed below which the block rests [m/s].
FLAT, STILL = 3.0e-3, 0.015


def stretch_of(poses: Poses, P: np.ndarray) -> np.ndarray:
    """Return (B, F) number of the stretch of every frame, -1 behind the end; poses over the plate, P (n, 3) body points
    [m].

    An impact lasts to the next one: it owns the flight that it causes. Sliding: a face lies flat and moves. The corners
    are taken from the measured rest: the height at which the block comes to lie is zero.
    """
    heights = poses.x[..., 2:3] + poses.Lambda[..., 2, :] @ P.T
    last = heights[np.arange(len(heights)), poses.frames - 1]
    settled = np.min(last, axis=1)
    # Decided: a block that ends more than 4 mm from the plate did not come to rest, its height tells nothing.
    heights = heights - np.where(np.abs(settled) < 4e-3, settled, 0.0)[:, None, None]
    low, fourth = np.min(heights, axis=-1), np.sort(heights, axis=-1)[..., min(3, P.shape[0] - 1)]
    speed = np.linalg.norm(np.gradient(poses.x, poses.t, axis=1), axis=-1)
    found = np.full(low.shape, -1)
    for i in range(len(low)):
        impacts, touching = 0, False
        n = int(poses.frames[i])
        for f in range(n):
            if not touching and low[i, f] < TOUCH:
                touching, impacts = True, impacts + 1
            elif touching and low[i, f] > OFF:
                touching = False
            found[i, f] = 0 if impacts == 0 else 1 if impacts == 1 else 2 if impacts <= 3 else 3
        flat = fourth[i, :n] < FLAT
        # Flat to the end: from the last frame back to the first that is not.
        begin = n - int(np.argmin(flat[::-1])) if not flat.all() else 0
        found[i, begin:n] = 4
        still = speed[i, :n] < STILL
        rest = n - int(np.argmin(still[::-1])) if not still.all() else 0
        found[i, max(begin, rest) : n] = 5
    return found


def by_stretch(found: np.ndarray, e: Errors) -> list[dict[str, Any]]:
    """Return per stretch: share of the frames, mean error, and its growth from the first to the last frame."""
    rows = []
    for k, name in enumerate(STRETCHES):
        here = found == k
        if not here.any():
            continue
        growth: dict[str, list[float]] = {"position_percent": [], "rotation_deg": []}
        for i in np.flatnonzero(here.any(axis=1)):
            frames = np.flatnonzero(here[i])
            # From the frame before: an impact's own jump belongs to it.
            first, end = max(frames[0] - 1, 0), frames[-1]
            growth["position_percent"].append(100 * (e.position_at[i, end] - e.position_at[i, first]))
            growth["rotation_deg"].append(e.rotation_at[i, end] - e.rotation_at[i, first])
        rows.append(
            {
                "stretch": name,
                "tosses": int(here.any(axis=1).sum()),
                "frames_percent": round(100 * float(here.sum() / (found >= 0).sum()), 1),
                "position_percent": round(100 * float(np.mean(e.position_at[here])), 2),
                "rotation_deg": round(float(np.mean(e.rotation_at[here])), 2),
                "growth": {key: round(float(np.mean(values)), 2) for key, values in growth.items()},
            }
        )
    return rows
