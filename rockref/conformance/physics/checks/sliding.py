"""Sliding to a stop, along the sides of a plate and across them."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.finding import Finding, judged, percent
from rockref.conformance.physics.scene import Start, down, turn
from rockref.conformance.physics.theory import sliding
from rockref.conformance.physics.trial import SLIDER, G, Trial, crossing

SPEED = 1.0  # m/s
#: Direction of the velocity and turn of the body about z, both from the world's x axis [deg].
CASES = {"along": (0.0, 0.0), "at 22.5 deg": (22.5, 0.0), "along the diagonal": (45.0, 0.0), "turned body": (0.0, 45.0)}
#: Slope of the plate under load shifts weight to the front: below half a percent; and one step of speed.
DISTANCE = 0.005
SIDEWAYS = 0.005


def slide(trial: Trial) -> Finding:
    """Check distance and time of a slider until it stops, in four directions."""
    D, T = sliding(SPEED, SLIDER.friction, G)
    bar = DISTANCE + trial.engine.step / T
    rest = trial.settle(SLIDER).start
    numbers: dict[str, float] = {}
    for name, (way, body) in CASES.items():
        start = rest if not body else trial.settle(SLIDER, turn("z", np.radians(body))).start
        numbers |= one(trial, start, np.radians(way), name, D, T)
    seen, cause = said(numbers, bar)
    straight, across = numbers["distance along"], numbers["distance along the diagonal"]
    side = max(abs(numbers[f"sideways {name}"]) for name in CASES)
    measured = f"distance {percent(straight)} along, {percent(across)} across; sideways {percent(side)[1:]}"
    return judged("slide", not seen, measured, f"{D:.4f} m, {T:.4f} s", f"{percent(bar)[1:]}, sideways "
                  f"{percent(SIDEWAYS)[1:]}", seen, cause, numbers)  # fmt: skip


def one(trial: Trial, rest: Start, way: float, name: str, D: float, T: float) -> dict[str, float]:
    """Return the deviations of distance and time, and the sideways way over the distance, of one slide."""
    along, across = np.array([np.cos(way), np.sin(way), 0]), np.array([-np.sin(way), np.cos(way), 0])
    times = trial.rows(2 * T, 2e-3)
    motion = trial.engine.run(SLIDER, rest._replace(v=SPEED * along, omega=np.zeros(3)), times, down(G))
    gone = motion.x - rest.x
    speed = motion.v @ along
    # The last tenth of the speed is left out of the time: there friction may be regularised.
    slow = crossing(times, speed, 0.1 * SPEED)
    return {
        f"distance {name}": float(gone[-1] @ along / D - 1),
        f"time {name}": slow / (0.9 * T) - 1,
        f"sideways {name}": float(np.max(np.abs(gone @ across)) / D),
    }


def said(numbers: dict[str, float], bar: float) -> tuple[str, str]:
    """Return what is seen, and the cause: a pyramid shows along a diagonal alone, another friction everywhere."""
    off = {name: numbers[f"distance {name}"] for name in CASES}
    worst = max(off, key=lambda name: abs(off[name]))
    side = max(CASES, key=lambda name: abs(numbers[f"sideways {name}"]))
    seen = ""
    if abs(off[worst]) > bar:
        where = "with the body turned" if worst == "turned body" else worst
        seen = f"the box slides {abs(100 * off[worst]):.2g} % {'too far' if off[worst] > 0 else 'too short'} {where}"
    elif abs(numbers[f"sideways {side}"]) > SIDEWAYS:
        seen = f"the box leaves its straight way by {100 * numbers[f'sideways {side}']:.2g} % of the distance ({side})"
    elif max(abs(numbers[f"time {name}"]) for name in CASES) > 3 * bar:  # the last tenth shows the bar three times
        seen = "the box stops after the right distance and at another time"
    if not seen:
        return "", ""
    diagonal = off["along the diagonal"]
    if abs(off["along"]) < 0.1 and diagonal > 0.2:
        return seen, "pyramid_inside"
    if abs(off["along"]) < 0.1 and diagonal < -0.15:
        return seen, "pyramid_outside"
    return seen, "friction"
