"""At rest: on a flat plate, on a slope below the friction angle, near that angle."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.finding import Finding, judged
from rockref.conformance.physics.scene import Gravity, Start
from rockref.conformance.physics.trial import CUBE, G, Trial

#: A millimetre in ten seconds (decided): what a user sees as creep.
CREEP = 1e-4  # m/s
#: Decided: rates that no eye sees; sound engines stay below a tenth of them.
RATE, SPEED = 2e-3, 1e-3  # rad/s, m/s
DURATION, WATCHED = 10.0, 5.0  # s


def inclined(angle: float, way: np.ndarray) -> tuple[float, float, float]:
    """Return gravity on a slope of `angle` [rad] that falls along `way` (2,), a unit vector."""
    a, c = G * np.sin(angle), G * np.cos(angle)
    return (float(a * way[0]), float(a * way[1]), float(-c))


def raised(angle: float, way: np.ndarray, first: float = 0.5, lasting: float = 0.5) -> Gravity:
    """Return gravity that turns from the vertical to a slope in twenty steps within `lasting` seconds.

    A jump would overshoot: springs under a sudden load swing to twice its deflection.
    """
    flat = [(0.0, (0.0, 0.0, -G))]
    return flat + [(first + lasting * k / 20, inclined(angle * (k + 1) / 20, way)) for k in range(20)]


def rest(trial: Trial) -> Finding:
    """Check that a cube stays where it is for ten seconds, flat and at half the friction angle."""
    way = np.array([1.0, 0.0])
    worst: dict[str, float] = {}
    start = Start.at_rest((0.0, 0.0, CUBE.half[2]))
    times = np.concatenate([[DURATION - WATCHED], np.linspace(DURATION - WATCHED, DURATION, 51)[1:]])
    for name, angle in (("flat", 0.0), ("slope", 0.5 * np.arctan(CUBE.friction))):
        motion = trial.engine.run(CUBE, start, times, raised(angle, way))
        creep = float(np.linalg.norm((motion.x[-1] - motion.x[0])[:2]) / WATCHED)
        rate = float(np.max(np.linalg.norm(motion.omega, axis=1)))
        speed = float(np.max(np.linalg.norm(motion.v, axis=1)))
        worst |= {f"creep {name}": creep, f"rate {name}": rate, f"speed {name}": speed}
    creep = max(worst["creep flat"], worst["creep slope"])
    where = "on the slope" if worst["creep slope"] >= worst["creep flat"] else "on the flat plate"
    rate, speed = (max(worst[f"{k} flat"], worst[f"{k} slope"]) for k in ("rate", "speed"))
    seen, cause = "", ""
    if creep > CREEP:
        seen, cause = f"the cube creeps {where} at {1e3 * creep:.2g} mm/s", "creep"
    elif rate > RATE or speed > SPEED:
        seen, cause = f"the cube trembles at rest, with up to {rate:.2g} rad/s and {1e3 * speed:.2g} mm/s", "rattling"
    return judged("rest", not seen, f"creep {creep:.1g} m/s, {rate:.1g} rad/s, {speed:.1g} m/s", "0",
                  f"{CREEP:g} m/s, {RATE:g} rad/s, {SPEED:g} m/s", seen, cause, worst)  # fmt: skip


#: Below the friction angle by this share, and above: a percent of friction changes the acceleration there by 17 %, so
#: the acceleration is no verdict, and whether the cube goes is one.
NEAR = 0.05
#: A cube that slides at 1.05 of the angle gains 0.2 m/s in a second; one that holds and creeps, far below 0.01 m/s.
GOES = 0.01  # m/s
#: Where the cube is judged: along its sides, and along its diagonal.
WAYS = {"along its sides": np.array([1.0, 0.0]), "along its diagonal": np.array([1.0, 1.0]) / np.sqrt(2)}


def slope(trial: Trial) -> Finding:
    """Check that a cube holds at 0.95 of the friction angle and goes at 1.05, along its sides and its diagonal."""
    angle, start = np.arctan(CUBE.friction), Start.at_rest((0.0, 0.0, CUBE.half[2]))
    numbers, seen, cause = {}, [], ""
    for name, way in WAYS.items():
        for share in (1 - NEAR, 1 + NEAR):
            motion = trial.engine.run(CUBE, start, np.array([2.0]), raised(share * angle, way))
            speed = float(motion.v[0, :2] @ way)
            numbers[f"{share:.2f} {name}"] = speed
            if share < 1 and speed > GOES:
                seen.append(f"below the friction angle the cube runs away {name}, with {speed:.2g} m/s after a second")
                cause = cause or ("pyramid_inside" if "diagonal" in name else "friction")
            if share > 1 and speed < GOES:
                seen.append(f"above the friction angle the cube holds {name}")
                cause = cause or ("pyramid_outside" if "diagonal" in name else "friction")
    measured = ", ".join(f"{speed:.2g}" for speed in numbers.values()) + " m/s"
    return judged("slope", not seen, measured, "holds, goes; holds, goes", f"{GOES:g} m/s after 1 s", "; ".join(seen),
                  cause, numbers)  # fmt: skip
