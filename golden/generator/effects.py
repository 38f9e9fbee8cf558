"""The vectors of effects (LE): one short run, or one record, for every effect of the catalogue at its typical size, and
a second one where that leaves parameters idle.

Values: the law's text in longdouble. Bars: 8 times the largest deviation of the float64 run and of runs with all
inputs moved by an ulp and the points in random order; plus an ulp. They hold a second implementation to the first to
rounding; they are no second route to the physics.

`branch` says what every foot does in every row (of a record: which axes the effect changes, and in how many samples),
and which parameters are at work: one that is zero, or that no number depends on, is not tested.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from golden.generator import runs
from golden.generator.bounds.answers import pattern
from golden.generator.bounds.bars import FACTOR, ulp
from golden.generator.questions.drawing import table_3_1
from golden.generator.questions.scenes import WINDOW_RATE, WINDOWS, corners_only, scenes, standing
from golden.generator.small_layers import rounded_up, stored, written
from golden.generator.trajectories import window_inputs
from rockref.conformance.judge import claims
from rockref.conformance.vectors import SCHEMA, problem_of
from rockref.conformance.vectors.claim import with_effect
from rockref.effects.catalogue import EFFECTS, IN_STEP_ORDER, measured
from rockref.engines import run

#: Runs are this long [s]; rows every 0.2 ms. Members of the ensemble.
DURATION, MEMBERS = 2e-3, 8
#: Where an effect is looked for, in this order; the first that resolves it well is taken.
PLACES = (("table_3_1", 0.52), ("spinning", 0.415), ("table_3_1", 0.5), ("table_3_1", 0.0), ("two_coefficients", 0.3))
ENOUGH, LEAST = 1e6, 100.0
#: An effect that makes eight points of four is looked for where four corners come down flat on the plate, sliding and
#: turning: each of the eight touches, carries and slides within the run, so that each of its numbers shows. Coming down
#: at 0.6 m/s they go 0.2 mm deep, twice the height of the highest corner.
OF_FOUR, FALLING, TURNING = ("foot_defects",), (0.125, 0.0625, -0.6), (0.0625, -0.03125, 0.5)
#: Second vectors, for the parameters that are not at work in the first: what differs from the typical size (typical
#: sizes are zero there), and the effects whose parameters belong to single feet, which all have to come down.
FURTHER: dict[str, dict[str, float]] = {
    "inertia_deviation": {"xy": 0.03, "xz": -0.02, "yz": 0.01},
    "uneven_foot_stiffness": {},
    "uneven_foot_damping": {},
    "uneven_foot_friction": {},
    "uneven_contact_normals": {},
    "cable_restraint": {"height": 0.25},
    "base_vibration": {"direction": 0.75, "phase": 0.5},
    "gyro_misalignment": {"xy": 0.02, "xz": -0.01, "yz": 0.015},
    "gyro_bandwidth": {"delay": 0.002},
}
#: The same for parameters that came later, in the order in which they came: a number once given stays. A wire's
#: evenness shows where its time is the shortest plausible one: the vector lasts two milliseconds.
LATER: dict[str, dict[str, float]] = {
    "uneven_foot_stiffness": {"tangential_share": 0.5},
    "lingering_wire_pull": {"tau": 0.01, "evenness": 0.5},
    "uneven_contact_normals": {"turning_share": 0.5},
    "spin_friction": {"sliding_share": 0.5},
    "hysteretic_contact": {"curved_share": 0.5},
    "gyro_saturation": {"softness": 0.5},
    "uneven_foot_damping": {"normal_share": 0.5},
    "compliant_support": {"pitch": 0.5},
    "rounded_feet": {"foot1": 0.75, "foot2": 1.5, "foot3": 0.625, "foot4": 1.25},
    "cable_restraint": {"stiffening": 0.5, "reference": 1e-5},
    "base_vibration": {"phase": 0.5, "harmonic_cosine": 0.5, "harmonic_sine": -0.25},
    "foot_defects": {"diag1": 0.75, "diag2": 1.5, "diag3": 0.625, "diag4": 1.25},
    "clock_error": {"growth": 0.5},
}
OF_ALL_FEET = (
    "uneven_foot_stiffness", "uneven_foot_damping", "uneven_foot_friction", "uneven_contact_normals", "rounded_feet",
)  # fmt: skip
#: A parameter is at work where this share less of it moves the vector by `LEAST` bars. Decided: small enough that the
#: effect stays what it is, and millions of bars for each parameter that acts.
SHARE = 0.1
#: A record for the sensor: 200 samples at 2 kHz of rates like those of the block [s, rad/s].
T = np.arange(200) / 2000.0


def record() -> np.ndarray:
    """Return rates (N, 3) [deg/s] with a jump, as an impact makes it."""
    d = random.Random(90)
    waves = [
        sum(d.uniform(-10, 10) * np.sin(d.uniform(20, 300) * T + d.uniform(0, 6)) for _ in range(3)) for _ in "XYZ"
    ]
    return np.stack(waves, axis=-1) + np.where(T > 0.05, 1.0, 0.0)[:, None] * np.array([40.0, -15.0, 25.0])


def inputs_at(scene: str, instant: float) -> dict[str, Any]:
    """Return the inputs of a short run at an instant of a scene."""
    window = next(w for w in WINDOWS if (w.scene, w.instant) == (scene, instant))
    return window_inputs(window) | {"duration": DURATION, "output_rate": WINDOW_RATE}


def four_falling() -> dict[str, Any]:
    """Return the inputs of a short run of the block on four corners, 16 um above the plate and falling on it."""
    return falling(corners_only(table_3_1()))


def falling(q: dict[str, Any]) -> dict[str, Any]:
    """Return the inputs of a short run of a block that comes down flat, sliding and turning."""
    q = standing(q, 2.0**-16, v=FALLING, W=TURNING)
    return q | {"step": 1e-5, "duration": DURATION, "output_rate": WINDOW_RATE}


def less(effect: Any) -> dict[str, Any]:
    """Return the effect with each of its parameters smaller by `SHARE`, by name; without those that are zero or not
    given."""
    return {k: replace(effect, **{k: v * (1 - SHARE)}) for k, v in effect.values().items() if v}


def of_run(effect: Any, q: dict[str, Any]) -> tuple[dict[str, Any], float, dict[str, Any]]:
    """Return expected rows with bars, by how many bars the run without the effect is off, and the branch."""

    def rows(q_: dict[str, Any], dtype: Any = None, by: Any = effect) -> Any:
        problem = problem_of(q_)
        return run(problem if by is None else with_effect(problem, by), engine="numpy", dtype=dtype)

    right, rng = rows(q, np.longdouble), random.Random(91)
    # The points stay in their order: effects address feet by place.
    members = [rows(q)] + [rows(runs.allowed(runs.moved(q, rng))) for _ in range(MEMBERS)]
    others = {"": rows(q, by=None)} | {k: rows(q, by=other) for k, other in less(effect).items()}
    expect, off = {}, dict.fromkeys(others, 0.0)
    for name in claims.ROWS:
        value = np.asarray(getattr(right, name), float)
        apart = [np.abs(np.asarray(getattr(m, name), np.longdouble) - getattr(right, name)) for m in members]
        # One bar a quantity, its largest: components near zero are no better known than the others.
        width = FACTOR * float(np.max(apart)) + float(np.max(ulp(value)))
        expect[name] = stored(value) | {"bar": rounded_up(np.array([width]))[0]}
        for k, other in others.items():
            off[k] = max(off[k], float(np.max(np.abs(getattr(other, name) - value)) / width))
    absent = off.pop("")
    feet = [pattern(*row) for row in zip(right.anchored, right.sliding, strict=True)]
    return expect, absent, {"rows": feet, "at work": at_work(off)}


def at_work(off: dict[str, float]) -> list[str]:
    """Return the parameters that move a vector, by how many bars each does."""
    return [k for k, moved in off.items() if moved >= LEAST]


def of_sensor(effect: Any, crv: np.ndarray) -> tuple[dict[str, Any], float, dict[str, Any]]:
    """Return expected record with bars, by how many bars the rates themselves are off, and the branch."""

    def shown(by: Any) -> np.ndarray:
        return np.degrees(measured((by,), T, np.radians(crv)))

    wide = shown(effect)
    rng = random.Random(92)
    shifts = [np.array([rng.choice((-1, 0, 1)) for _ in range(crv.size)]).reshape(crv.shape) for _ in range(MEMBERS)]
    members = [np.degrees(measured((effect,), T, np.radians(crv + s * ulp(crv)))) for s in shifts]
    width = FACTOR * max(float(np.max(np.abs(m - wide))) for m in members) + float(np.max(ulp(wide)))
    entry = stored(wide) | {"bar": rounded_up(np.array([width]))[0]}
    off = {k: float(np.max(np.abs(shown(other) - wide)) / width) for k, other in less(effect).items()}
    changed = np.sum(np.abs(crv - wide) > width, axis=0).tolist()
    branch = {"samples changed": dict(zip("XYZ", changed, strict=True)), "at work": at_work(off)}
    return {"crv_deg_s": entry}, float(np.max(np.abs(crv - wide)) / width), branch


#: What is made of an effect: piece, inputs, expected results, bars by which it is resolved, branch, name of the inputs.
Made = tuple[str, dict[str, Any], dict[str, Any], float, dict[str, Any], str]


def made(effect: Any) -> Made:
    """Return question and answer for an effect, at the first place that resolves it well."""
    if effect.question == "sensor":
        crv = record()
        return "sensor", {"t": T, "crv_deg_s": crv}, *of_sensor(effect, crv), "record"
    if effect.id in OF_FOUR:
        q = four_falling()
        return "effect", q, *of_run(effect, q), "four corners, falling"
    found: list[Made] = []
    for place in PLACES:
        q = inputs_at(*place)
        found.append(("effect", q, *of_run(effect, q), f"{place[0]} at {place[1]:g} s"))
        if found[-1][3] >= ENOUGH:
            break
    return max(found, key=lambda f: f[3])


def made_further(kind: Any, changes: dict[str, float]) -> tuple[Any, Made]:
    """Return a further vector of an effect: with what is typically none, or with all feet coming down."""
    effect = replace(kind.typical(), **changes)
    if kind.id not in OF_ALL_FEET:
        return effect, made(effect)
    q = falling(table_3_1())
    return effect, ("effect", q, *of_run(effect, q), "eight feet, falling")


def entry(number: int, effect: Any, answer: Made, sets: dict[str, Any]) -> dict[str, Any] | None:
    """Return the vector of an effect; None where nothing that is asked resolves it."""
    piece, inputs, expect, off, branch, where = answer
    if off < LEAST:
        return None
    shared = sets.setdefault(where, {k: stored(v) for k, v in inputs.items()})
    assert shared == {k: stored(v) for k, v in inputs.items()}
    head = {"id": f"LE-{number:04d}", "layer": "LE", "effect": effect.id, "parameters": effect.values()}
    facts = {"piece": piece, "set": where, "expect": expect, "branch": branch}
    resolving = {"absent": float(f"{min(off, 1e99):.2g}")}
    return head | facts | {"resolving": resolving, "route": "longdouble, the same text"}


def effects() -> Iterator[tuple[Any, Callable[[], tuple[Any, Made]]]]:
    """Yield every kind of effect, and how its vector is made: the typical ones, then the further vectors."""
    for kind in IN_STEP_ORDER:
        yield kind, partial(lambda kind: (kind.typical(), made(kind.typical())), kind)
    further = [(kind, FURTHER[kind.id]) for kind in IN_STEP_ORDER if kind.id in FURTHER]
    further += [(EFFECTS[id], parameters) for id, parameters in LATER.items()]
    for kind, parameters in further:
        yield kind, partial(made_further, kind, parameters)


def idle(entries: list[dict[str, Any]]) -> list[str]:
    """Return parameters that are at work in no vector."""
    asked = {f"{e['effect']} {name}" for e in entries for name in e["parameters"]}
    return sorted(asked - {f"{e['effect']} {name}" for e in entries for name in e["branch"]["at work"]})


def document(say: Callable[[str], None]) -> bytes:
    """Return the file LE.json."""
    scenes()
    entries: list[dict[str, Any]] = []
    sets: dict[str, Any] = {}
    for number, (kind, make) in enumerate(effects(), 1):
        try:
            found = entry(number, *make(), sets)
        except Exception as e:
            say(f"LE: {kind.id} has no vector ({type(e).__name__}: {e})")
            continue
        if found is None:
            say(f"LE: {kind.id} is not resolved")
        else:
            entries.append(found)
    for name in idle(entries):
        say(f"LE: {name} is at work in no vector")
    return written({"schema": SCHEMA, "layer": "LE", "sets": sets, "vectors": entries})
