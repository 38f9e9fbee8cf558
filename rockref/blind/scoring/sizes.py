"""How far the size of an effect that a verdict states is from the true one."""

from __future__ import annotations

import math
from typing import Any

FEET = tuple(f"foot{i}" for i in (1, 2, 3, 4))
AXES = ("x", "y", "z")
#: Per effect: what makes its size, and the value at which it is absent. RATIO: compared as a quotient, since it is
#: absent at infinity. Shape parameters (a time, a range, a sliding speed) are not its size and are not here.
RATIO = math.inf
ABSENT: dict[str, dict[str, float]] = {
    "hertzian_contact": {"exponent": 1.0},
    "hunt_crossley_contact": {"a": 0.0},
    "hysteretic_contact": {"kappa": 0.0},
    "adhesion": {"force": 0.0},
    "uneven_foot_stiffness": dict.fromkeys(FEET, 1.0),
    "uneven_foot_damping": dict.fromkeys(FEET, 1.0),
    "uneven_foot_friction": dict.fromkeys(FEET, 1.0),
    "stribeck_friction": {"ratio": 1.0},
    "viscous_friction": {"c": 0.0},
    "load_dependent_friction": {"exponent": 0.0},
    "spin_friction": {"radius": 0.0},
    "rolling_resistance": {"lever": 0.0},
    "foot_defects": {f"delta_long{i}": 0.0 for i in (1, 2, 3, 4)},
    "rounded_feet": {"radius": 0.0},
    "uneven_contact_normals": {f"{a}{i}": 0.0 for i in (1, 2, 3, 4) for a in "xy"},
    "mass_eccentricity": dict.fromkeys(AXES, 0.0),
    "inertia_deviation": dict.fromkeys(("xx", "yy", "zz"), 1.0),
    "dimension_deviation": dict.fromkeys(("width", "depth", "height"), 1.0),
    "quadratic_drag": {"c": 0.0},
    "cable_restraint": {"k": 0.0},
    "lingering_wire_pull": {"force": 0.0},
    "base_vibration": {"amplitude": 0.0},
    "plate_tilt": {"x": 0.0, "y": 0.0},
    "compliant_support": {"frequency": RATIO},
    "release_velocity": dict.fromkeys(AXES, 0.0),
    "gyro_misalignment": dict.fromkeys(AXES, 0.0),
    "gyro_scale": dict.fromkeys(AXES, 1.0),
    "gyro_drift": {f"bias_{a}": 0.0 for a in AXES},
    "gyro_bandwidth": {"frequency": RATIO},
    "gyro_saturation": {"range": RATIO},
    "clock_error": {"rate": 1.0},
}


def stated(amplitudes: Any, effect: str) -> dict[str, dict[str, float]]:
    """Return what a verdict says of an effect: parameter -> value, low, high (where given). Keys are
    "effect.parameter"."""
    found = {}
    for key, entry in (amplitudes or {}).items():
        id, dot, name = str(key).partition(".")
        if dot and id == effect and isinstance(entry, dict) and isinstance(entry.get("value"), (int, float)):
            found[name] = entry
    return found


def size_error(effect: str, truth: dict[str, float], said: dict[str, dict[str, float]]) -> float | None:
    """Return relative error of the size of an effect, or None where the verdict does not state all of it.

    Of several components it is the length of the error over the length of the truth, each counted from its absence. For
    factors of the feet logarithms less their mean are compared, because a common factor is the baseline's stiffness,
    damping or friction.
    """
    names = ABSENT[effect]
    if any(name not in truth or name not in said for name in names):
        return None
    true, got = [truth[n] for n in names], [float(said[n]["value"]) for n in names]
    if not all(map(math.isfinite, got)):
        return None
    if tuple(names) == FEET:
        if min(got) <= 0:
            return None
        true, got = _unlike(true), _unlike(got)
    elif RATIO in names.values():
        true, got = [math.log(v) for v in true], [math.log(max(v, 1e-30)) for v in got]
        return abs(math.expm1(got[0] - true[0]))
    else:
        absent = list(names.values())
        true = [t - a for t, a in zip(true, absent, strict=True)]
        got = [g - a for g, a in zip(got, absent, strict=True)]
    return math.dist(true, got) / math.hypot(*true)


def covered(effect: str, truth: dict[str, float], said: dict[str, dict[str, float]]) -> list[bool]:
    """Return for every parameter of the effect's size with a stated interval: whether the truth lies inside."""
    found = []
    for name in ABSENT[effect]:
        entry = said.get(name, {})
        if name in truth and isinstance(entry.get("low"), (int, float)) and isinstance(entry.get("high"), (int, float)):
            found.append(entry["low"] <= truth[name] <= entry["high"])
    return found


def _unlike(factors: list[float]) -> list[float]:
    logs = [math.log(f) for f in factors]
    mean = sum(logs) / len(logs)
    return [v - mean for v in logs]
