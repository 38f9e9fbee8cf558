"""Planar drops of a square without a contact model: balance of momenta over first impacts on one corner.

Needs a folder that `rockref import planardrops` has made; seconds.
"""

from __future__ import annotations

import argparse

import numpy as np

from rockref.measure.records.toss import Toss
from rockref.measure.tosses.impact_balance import Impacts, corner_ratios, energy_change
from rockref.measure.tosses.load import load_tosses

G = 9.81
# decided: six frames before and four to eight after an impact show velocities to a per cent.
BEFORE, LEAST, MOST = 6, 4, 8
# decided: the corner that strikes lies 5 mm below the next one, or both strike between two frames.
ALONE = 5e-3
# decided: a corner within 1 mm of the table touches; a flight leaves 5 mrad at most.
NEAR, LEFT = 1e-3, 5e-3


def turned(angle: np.ndarray) -> np.ndarray:
    """Return rotations about +y (..., 3, 3) by angles [rad]."""
    c, s, o = np.cos(angle), np.sin(angle), np.zeros_like(angle)
    return np.stack([np.stack([c, o, s], -1), np.stack([o, o + 1.0, o], -1), np.stack([-s, o, c], -1)], -2)


def impact(toss: Toss, corners: np.ndarray, hand: int) -> tuple[np.ndarray, ...] | None:
    """Return velocities, rates and lever of a drop's first impact; None where both flights or one corner are not clear.

    hand : -1 reverses x, to see whether the balance tells the hand of the axes
    """
    angle = np.unwrap(np.arctan2(toss.Lambda[:, 0, 2], toss.Lambda[:, 2, 2]))
    x, z, h = hand * toss.x[:, 0], toss.x[:, 2], toss.t[1]
    low = (z[:, None] + turned(angle)[:, 2, :] @ corners.T).min(1)
    due = np.r_[False, 2 * low[1:] - low[:-1] < NEAR] | (low < NEAR)
    f = int(np.argmax(due)) + 1
    after = np.flatnonzero(due[f + 2 :])
    e = min(f + 1 + MOST, len(z), f + 2 + (int(after[0]) if len(after) else MOST))
    if f < BEFORE or e - f - 1 < LEAST:
        return None
    spans = [(np.arange(f - BEFORE, f) - f) * h, (np.arange(f + 1, e) - f) * h]
    pieces = [slice(f - BEFORE, f), slice(f + 1, e)]
    lines = [
        [np.polyfit(t, y, 1) for y in (x[at], z[at] + 0.5 * G * t**2, angle[at])]
        for t, at in zip(spans, pieces, strict=True)
    ]
    left = max(np.std(angle[at] - np.polyval(a[2], t)) for t, at, a in zip(spans, pieces, lines, strict=True))
    change = lines[1][1][0] - lines[0][1][0]
    # The two parabolas meet at the mean time of the impulse.
    t = -(lines[1][1][1] - lines[0][1][1]) / change
    L = turned(np.polyval(lines[0][2], t))
    heights = np.sort((L @ corners.T)[2])
    if left > LEFT or change < 0.2 or abs(t) > 2 * h or heights[1] - heights[0] < ALONE:
        return None
    r = L @ corners[int((L @ corners.T)[2].argmin())]
    v1, v2 = (np.array([a[0][0], 0.0, a[1][0] - G * t]) for a in lines)
    W1, W2 = (np.array([0.0, a[2][0], 0.0]) for a in lines)
    return v1, v2, L, W1, W2, r


def main() -> None:
    """Print what the impacts say, for x as imported and reversed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder")
    tosses = load_tosses(parser.parse_args().folder)
    corners = 0.5 * tosses.width * np.array([[a, 0.0, b] for a in (-1, 1) for b in (-1, 1)])
    uniform = tosses.width**2 / 6
    for hand, name in ((1, "x as imported"), (-1, "x reversed")):
        found = [one for toss in tosses.tosses if (one := impact(toss, corners, hand)) is not None]
        v1, v2, L, W1, W2, r = (np.array(part) for part in zip(*found, strict=True))
        none = np.zeros(len(r))
        k = Impacts(v1, v2, L, L, W1, W2, none.astype(int), r, none, none)
        tip = np.abs(r[:, 0]) < 0.2 * tosses.width
        change = (W2 - W1)[tip, 1]
        left = change - np.cross(r, v2 - v1)[tip, 1] / uniform
        ratios = {key: f"{v:.3f} +- {se:.3f}" for key, (v, se, _) in corner_ratios(k).values.items()}
        gains = energy_change(k, np.full(3, uniform))
        print(
            f"{name}: {len(r)} impacts; on {tip.sum()} tips the rate changes by {np.median(np.abs(change)):.1f} rad/s, "
            f"and the balance leaves {np.median(np.abs(left)):.1f}; {ratios}; {(gains > 0).sum()} gain energy, "
            f"median {np.median(gains):.3f}"
        )


if __name__ == "__main__":
    main()
