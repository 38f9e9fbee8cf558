"""The vectors of effects (LE): one short run, or one record, for every effect of the catalogue at its typical size.

Values: the law's text in longdouble. Bars: 8 times the largest deviation of the float64 run and of runs with all
inputs moved by an ulp and the points in random order; plus an ulp. They hold a second implementation to the first to
rounding; they are no second route to the physics.
"""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from typing import Any

import numpy as np

from rockref.conformance import claims
from rockref.conformance.maker import runs
from rockref.conformance.maker.bars import FACTOR, ulp
from rockref.conformance.maker.drawing import table_3_1
from rockref.conformance.maker.scenes import WINDOW_RATE, WINDOWS, corners_only, scenes, standing
from rockref.conformance.maker.small import rounded_up, stored
from rockref.conformance.maker.trajectories import window_inputs
from rockref.conformance.vectors import SCHEMA, problem_of
from rockref.effects.catalogue import IN_STEP_ORDER, measured
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
#: A record for the sensor: 200 samples at 2 kHz of rates like those of the block [s, rad/s].
T = np.arange(200) / 2000.0


def record() -> np.ndarray:
    """Rates (N, 3) [deg/s] with a jump, as an impact makes it."""
    d = random.Random(90)
    waves = [
        sum(d.uniform(-10, 10) * np.sin(d.uniform(20, 300) * T + d.uniform(0, 6)) for _ in range(3)) for _ in "XYZ"
    ]
    return np.stack(waves, axis=-1) + np.where(T > 0.05, 1.0, 0.0)[:, None] * np.array([40.0, -15.0, 25.0])


def inputs_at(scene: str, instant: float) -> dict[str, Any]:
    """The inputs of a short run at an instant of a scene."""
    window = next(w for w in WINDOWS if (w.scene, w.instant) == (scene, instant))
    return window_inputs(window) | {"duration": DURATION, "output_rate": WINDOW_RATE}


def four_falling() -> dict[str, Any]:
    """The inputs of a short run of the block on four corners, 16 um above the plate and falling on it."""
    q = standing(corners_only(table_3_1()), 2.0**-16, v=FALLING, W=TURNING)
    return q | {"step": 1e-5, "duration": DURATION, "output_rate": WINDOW_RATE}


def of_run(effect: Any, q: dict[str, Any]) -> tuple[dict[str, Any], float]:
    """Expected rows with bars, and by how many bars the run without the effect is off."""

    def rows(q_: dict[str, Any], dtype: Any = None, plain: bool = False) -> Any:
        problem = problem_of(q_)
        return run(problem if plain else claims.with_effect(problem, effect), engine="numpy", dtype=dtype)

    right, rng = rows(q, np.longdouble), random.Random(91)
    # The points stay in their order: effects address feet by place.
    members = [rows(q)] + [rows(runs.allowed(runs.moved(q, rng))) for _ in range(MEMBERS)]
    without, expect, off = rows(q, plain=True), {}, 0.0
    for name in claims.ROWS:
        value = np.asarray(getattr(right, name), float)
        apart = [np.abs(np.asarray(getattr(m, name), np.longdouble) - getattr(right, name)) for m in members]
        # One bar a quantity, its largest: components near zero are no better known than the others.
        width = FACTOR * float(np.max(apart)) + float(np.max(ulp(value)))
        expect[name] = stored(value) | {"bar": rounded_up(np.array([width]))[0]}
        off = max(off, float(np.max(np.abs(getattr(without, name) - value)) / width))
    return expect, off


def of_sensor(effect: Any, crv: np.ndarray) -> tuple[dict[str, Any], float]:
    """Expected record with bars, and by how many bars the rates themselves are off."""
    wide = np.degrees(measured((effect,), T, np.radians(crv)))
    rng = random.Random(92)
    shifts = [np.array([rng.choice((-1, 0, 1)) for _ in range(crv.size)]).reshape(crv.shape) for _ in range(MEMBERS)]
    members = [np.degrees(measured((effect,), T, np.radians(crv + s * ulp(crv)))) for s in shifts]
    width = FACTOR * max(float(np.max(np.abs(m - wide))) for m in members) + float(np.max(ulp(wide)))
    entry = stored(wide) | {"bar": rounded_up(np.array([width]))[0]}
    return {"crv_deg_s": entry}, float(np.max(np.abs(crv - wide)) / width)


def entry(number: int, kind: Any, sets: dict[str, Any]) -> dict[str, Any] | None:
    """The vector of an effect; None where nothing that is asked resolves it."""
    effect = kind.typical()
    head = {"id": f"LE-{number:04d}", "layer": "LE", "effect": kind.id, "parameters": effect.values()}
    if kind.question == "sensor":
        crv = record()
        expect, off = of_sensor(effect, crv)
        inputs: dict[str, Any] = {"t": T, "crv_deg_s": crv}
        made: tuple[Any, ...] = ("sensor", inputs, expect, off, "record")
    elif kind.id in OF_FOUR:
        q = four_falling()
        made = ("effect", q, *of_run(effect, q), "four corners, falling")
    else:
        found = []
        for place in PLACES:
            q = inputs_at(*place)
            found.append(("effect", q, *of_run(effect, q), f"{place[0]} at {place[1]:g} s"))
            if found[-1][3] >= ENOUGH:
                break
        made = max(found, key=lambda f: f[3])
    piece, inputs, expect, off, where = made
    if off < LEAST:
        return None
    shared = sets.setdefault(where, {k: stored(v) for k, v in inputs.items()})
    assert shared == {k: stored(v) for k, v in inputs.items()}
    facts = {"piece": piece, "set": where, "expect": expect, "resolving": {"absent": float(f"{min(off, 1e99):.2g}")}}
    return head | facts | {"route": "longdouble, the same text"}


def document(say: Callable[[str], None]) -> bytes:
    """The file LE.json."""
    scenes()
    entries: list[dict[str, Any]] = []
    sets: dict[str, Any] = {}
    for number, kind in enumerate(IN_STEP_ORDER, 1):
        try:
            made = entry(number, kind, sets)
        except Exception as e:
            say(f"LE: {kind.id} has no vector ({type(e).__name__}: {e})")
            continue
        if made is None:
            say(f"LE: {kind.id} is not resolved")
        else:
            entries.append(made)
    lines = ",\n".join(json.dumps(e, ensure_ascii=False, separators=(",", ":")) for e in entries)
    head = json.dumps({"schema": SCHEMA, "layer": "LE", "sets": sets}, ensure_ascii=False, separators=(",", ":"))
    return (head[:-1] + ',\n"vectors":[\n' + lines + "\n]}\n").encode()
