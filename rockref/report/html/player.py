"""What the player on the page shows: the block measured and modelled, side by side, frame by frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.discover.compare.models import MeasuredRun, RunComparison
from rockref.model.response import Response
from rockref.report.charts.attitude import angles, integrated, lowest_points
from rockref.report.html.encoding import packed

# decided: twenty frames in the fastest clatter seen (25 Hz); the eye sees more only in slow motion, where 2 ms is fine.
FRAME_RATE = 500.0


@dataclass(frozen=True)
class Player:
    """The data of one player: ``title``, ``sentence`` for those who do not see it, ``data`` for the script."""

    title: str
    sentence: str
    data: dict[str, Any]


def player(m: MeasuredRun, results: Sequence[tuple[str, RunComparison]], until: float | None = None) -> Player:
    """Return a player of one run and what models make of it, up to `until` s (or the end of the record)."""
    run = m.run
    assert run.t is not None and run.crv is not None
    end = float(run.t[-1]) if until is None else min(until, float(run.t[-1]))
    times = np.arange(0.0, end, 1.0 / FRAME_RATE)
    first = results[0][1].aligned.response
    P = np.asarray(first.problem.points.P, dtype=np.float64)
    attitude = integrated(first.Lambda[0], run.t, run.crv)
    lowest = lowest_points(attitude, P)[_nearest(run.t, times)]
    bodies = [_body("measured", _between(run.t, angles(attitude), times), lowest, estimated=True)]
    for name, r in results:
        response = r.aligned.response
        own = times - r.shift
        touched = _touched(response.anchored, _nearest(response.t, own))
        bodies.append(_body(name, _between(response.t, angles(response.Lambda), own), touched, estimated=False))
    data = {
        "step": 1.0 / FRAME_RATE,
        "frames": len(times),
        "box": _box(first),
        "points": [{"name": n, "at": p.tolist()} for n, p in zip(first.problem.points.names, P, strict=True)],
        "bodies": bodies,
        "impacts": m.features.impacts.times.tolist(),
    }
    names = " and ".join(["measured", *(name for name, _ in results)])
    sentence = (
        f"Run {run.id} in motion, {names} side by side. Out-of-plane angles are exaggerated. A filled foot touches the "
        "plate; for the measured block, whose feet nobody saw, a ring marks the lowest by the attitude integrated from "
        "the gyroscope."
    )
    return Player(f"Run {run.id} in motion", sentence, data)


def replay(response: Response, title: str, stretch: tuple[float, float]) -> Player:
    """Return a player of one computed run, in a stretch [s], a frame a row."""
    rows = (response.t >= stretch[0]) & (response.t <= stretch[1])
    t = response.t[rows]
    P = np.asarray(response.problem.points.P, dtype=np.float64)
    touched = response.anchored[rows]
    data = {
        "step": float(t[-1] - t[0]) / max(len(t) - 1, 1),
        "frames": len(t),
        "box": _box(response),
        "points": [{"name": n, "at": p.tolist()} for n, p in zip(response.problem.points.names, P, strict=True)],
        "bodies": [_body("simulated", angles(response.Lambda[rows]), touched, estimated=False)],
        "impacts": [],
        # A block on a moving plate leans to all sides, as far as the eye sees, and slowly.
        "start": float(t[0]),
        "times": 1,
        "speed": 1,
    }
    sentence = (
        f"The block in motion from {t[0]:.2f} to {t[-1]:.2f} s. A filled foot touches the plate; how far the block "
        "slides is not shown."
    )
    return Player(f"{title}, in motion", sentence, data)


def _nearest(t: np.ndarray, times: np.ndarray) -> np.ndarray:
    """Return the rows of t (N,) s, in even steps, nearest to times (M,) s."""
    step = float(t[-1] - t[0]) / (len(t) - 1)
    return np.clip(np.rint((times - t[0]) / step).astype(int), 0, len(t) - 1)


def _between(t: np.ndarray, values: np.ndarray, times: np.ndarray) -> np.ndarray:
    """Return values (N, 3) at t (N,) s at the instants times (M,) s, (M, 3), straight between rows."""
    return np.stack([np.interp(times, t, column) for column in values.T], axis=-1)


def _touched(anchored: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Return which points touched between each frame and the next, (frames, n) bool: a contact may be shorter."""
    counts = np.concatenate((np.zeros((1, anchored.shape[1]), int), np.cumsum(anchored, axis=0)))
    ends = np.maximum(np.append(rows[1:], len(anchored)), rows + 1)
    return counts[ends] > counts[rows]


def _box(response: Response) -> list[float]:
    """Return width, depth and height of the block, m, as its contact points span them."""
    P = np.asarray(response.problem.points.P)
    return [float(np.ptp(P[:, 0])), float(np.ptp(P[:, 1])), float(2.0 * np.abs(P[:, 2]).max())]


def _body(name: str, posture: np.ndarray, touching: np.ndarray, *, estimated: bool) -> dict[str, Any]:
    """Return one block: angles packed, contacts as one bit a point."""
    turn_0 = float(np.pi * np.round(posture[0, 2] / np.pi))
    posture = posture - np.array([0.0, 0.0, turn_0])
    bits = (touching * (1 << np.arange(touching.shape[1]))).sum(axis=1)
    return {
        "name": name,
        "turned": turn_0,
        "angles": [packed(posture[:, k]) for k in range(3)],
        "touching": packed(bits.astype(np.float64), 1.0),
        "estimated": estimated,
    }
