"""The restitution passport: what an engine's knobs make of an impact. A table, no verdict."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.conformance.physics.adapter import Engine, Lost
from rockref.conformance.physics.scene import Scene, Start, box, down, sphere, turn
from rockref.conformance.physics.trial import G

#: Decided: 8 kg at 1 m/s, the density of water for the cube; the centre of mass above the contact, so that no rotation
#: takes energy.
MASS, SPEED = 8.0, 1.0  # kg, m/s
BALL, CUBE = sphere(0.1, MASS, 0.5), box((0.2, 0.2, 0.2), MASS, 0.5)
EDGE = turn("y", np.pi / 4)
CORNER = turn("y", float(np.arctan(np.sqrt(2)))) @ turn("z", np.pi / 4)
#: Shape: the body, its attitude, the height of its centre at touch over half a side or the radius.
DROPS: dict[str, tuple[Scene, np.ndarray, float]] = {
    "sphere": (BALL, np.eye(3), 1.0),
    "flat": (CUBE, np.eye(3), 1.0),
    "edge": (CUBE, EDGE, float(np.sqrt(2))),
    "corner": (CUBE, CORNER, float(np.sqrt(3))),
}
#: The impact comes at these parts of a step: an engine with a fixed step answers each in another way.
PHASES = (0.1, 0.3, 0.5, 0.7, 0.9)
#: Rebounds from 1 m/s last at most 2 v / g = 0.2 s.
WATCHED = 0.25  # s
#: Every step is recorded so long, which holds an impact of 50 Hz; then a row a millisecond.
NEAR = 0.02  # s


def drop(engine: Engine, shape: str, phase: float) -> dict[str, float]:
    """Return restitution, contact time [s] and depth [m] of one impact that begins `phase` of a step after a row.

    The restitution comes from the height of the rebound: velocities near a contact are the solver's.
    """
    scene, R, high = DROPS[shape]
    touch = high * float(scene.half[0])
    gap = (2 + phase) * engine.step * SPEED
    start = Start(np.array([0.0, 0.0, touch + gap]), R, np.array([0.0, 0.0, -SPEED]), np.zeros(3))
    times = rows(engine.step)
    z = engine.run(scene, start, times, down(G)).x[:, 2]
    first = int(np.argmax(z < touch)) if np.any(z < touch) else int(np.argmin(z[times < NEAR]))
    apex = float(np.max(z[first:])) - touch
    before = SPEED * SPEED + 2 * G * gap
    after = np.flatnonzero(z[first:] >= touch)
    duration = float(times[first + after[0]] - times[first]) if len(after) and after[0] else float("nan")
    return {
        "e": float(np.sqrt(max(2 * G * apex, 0.0) / before)),
        "time": duration,
        "depth": max(touch - float(np.min(z)), 0.0),
    }


def rows(step: float) -> np.ndarray:
    """Return the instants: every step through the impact, then a row a millisecond."""
    near, stride = round(NEAR / step), max(1, round(1e-3 / step))
    return np.concatenate([np.arange(near), np.arange(near, round(WATCHED / step) + 1, stride)]) * step


def passport(engine: Engine) -> dict[str, dict[str, float]]:
    """Return, for each shape, median and range of the restitution over the phases, contact time and depth.

    e, low, high : restitution;  time [s], nan where the body does not leave;  depth [m], the largest
    """
    table = {}
    for shape in DROPS:
        try:
            found = [drop(engine, shape, phase) for phase in PHASES]
        except Lost:
            table[shape] = dict.fromkeys(("e", "low", "high", "time", "depth"), float("nan"))
            continue
        e = [one["e"] for one in found]
        table[shape] = {
            "e": float(np.median(e)), "low": min(e), "high": max(e),
            "time": float(np.median([one["time"] for one in found])), "depth": max(one["depth"] for one in found),
        }  # fmt: skip
    return table


def all_passports(adapter: Any) -> dict[str, dict[str, dict[str, float]]]:
    """Return the passports of an adapter: of its settings, then of the further knobs that it lists."""
    found = {name: passport(Engine(adapter, name)) for name in adapter.settings}
    return found | {name: passport(Engine(adapter, name, knobs)) for name, knobs in adapter.passport.items()}
