"""The vectors of a plate that moves (LB): short runs in which every mistake of `wrong_base_motion` shows.

Values: the law's text in longdouble. They are taken only where a second route agrees within the bars: the same load as
an effect of the run, from a record that is read by rational numbers. Bars as those of effects (`effects`).
"""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from golden.generator import runs
from golden.generator.bounds.answers import pattern
from golden.generator.bounds.bars import FACTOR, ulp
from golden.generator.effects import LEAST, MEMBERS
from golden.generator.questions.drawing import table_3_1
from golden.generator.questions.scenes import HEIGHT, at_rest
from golden.generator.small_layers import rounded_up, stored
from rockref.conformance.judge.causes.wrong_base_motion import OF_BASE, planted
from rockref.conformance.judge.shaken import ROWS
from rockref.conformance.vectors import SCHEMA, flat, problem_of
from rockref.engines import run
from rockref.model.base_motion import BaseMotion
from rockref.model.problem import Problem
from rockref.model.rotation import exponential

#: Runs of 120 steps; a row every eighth.
STEP, STEPS, EVERY = 2.0**-17, 120, 8
#: Members of the catalogue of scenes: title, height of the inner feet [m], rotation vector, rates, start [s].
SCENES = (
    ("feet that slide and land", 2.0**-17, (0.002, -0.001, 0.6), (0.0625, -0.03125, 0.5), 0.0),
    ("leaning in the air", 0.25, (0.3, -0.2, 0.5), (3.1, 4.7, -2.3), 0.0),
    ("a late start, the record under way", -(2.0**-19), (0.0, 0.0, -1.1), (0.0, 0.0, 0.25), 0.7109375),
)


def record(seed: int, start: float) -> BaseMotion:
    """Return three different components in all their bits, seven samples, the last not zero, no time a multiple of a
    step."""
    d = random.Random(seed)
    a = np.array([[d.uniform(-9, 9), d.uniform(-5, 5), d.uniform(-3, 3)] for _ in range(7)])
    return BaseMotion(start + (0.00011931 if start == 0 else -0.00024617), 0.00010437, a)


def inputs(scene: tuple[Any, ...], seed: int) -> dict[str, Any]:
    """Return the inputs of a run: Table 3.1 with a centre of mass out of the middle, in a pose near the plate or far
    above."""
    _, gap, vector, W, start = scene
    q = table_3_1()
    q["P"] = q["P"] + np.array([0.0071, -0.0113, 0.0])
    q = at_rest(q, (0.1, -0.2, HEIGHT / 2 + gap), exponential(np.array(vector)), v=(0.0625, -0.125, -0.25), W=W)
    times = {"t": start, "step": STEP, "duration": STEPS * STEP, "output_rate": 1 / (EVERY * STEP)}
    base = record(seed, start)
    return q | times | {"base": {"t_0": base.t_0, "dt": base.dt, "a": base.a}}


def by_rational_numbers(base: BaseMotion, t: float, problem: Problem, Lambda: Any) -> tuple[Any, Any]:
    """Return the load of B1, from a record that is read by rational numbers: the second route."""
    place = (Fraction(t) - Fraction(base.t_0)) / Fraction(base.dt)
    k = place.numerator // place.denominator
    a = [Fraction(0)] * 3
    if 0 <= place <= len(base.a) - 1:
        here, there = base.a[k], base.a[min(k + 1, len(base.a) - 1)]
        a = [
            Fraction(float(p)) * (1 - (place - k)) + Fraction(float(q)) * (place - k)
            for p, q in zip(here, there, strict=True)
        ]
    F = -problem.block.mass * np.array([float(c) for c in a])
    return F, 0 * F


def moved(q: dict[str, Any], rng: random.Random) -> dict[str, Any]:
    """Return the inputs with every number moved by an ulp at most, those of the record too."""
    a = q["base"]["a"]
    shift = np.array([rng.choice((-1, 0, 1)) for _ in range(a.size)]).reshape(a.shape)
    rest = runs.allowed(runs.moved({k: v for k, v in q.items() if k != "base"}, rng))
    return rest | {"base": q["base"] | {"a": a + shift * ulp(a)}}


def made(number: int, scene: tuple[Any, ...]) -> dict[str, Any]:
    """Return a vector; raises ValueError where the routes differ, or nothing shows."""
    q = inputs(scene, 100 + number)
    problem, rng = problem_of(q), random.Random(200 + number)
    right = run(problem, engine="numpy", dtype=np.longdouble)
    members = [run(problem, engine="numpy")] + [run(problem_of(moved(q, rng)), engine="numpy") for _ in range(MEMBERS)]
    witness = run(planted(problem, by_rational_numbers), engine="numpy")
    with np.errstate(all="ignore"):
        wrong = {m.id: run(planted(problem, m.load), engine="numpy") for m in OF_BASE}
    expect, off = {}, dict.fromkeys(wrong, 0.0)
    for name in ROWS:
        wide = getattr(right, name)
        value = np.asarray(wide, float)
        apart = [float(np.max(np.abs(np.asarray(getattr(m, name), np.longdouble) - wide))) for m in members]
        width = FACTOR * max(apart) + float(np.max(ulp(value)))
        if np.max(np.abs(getattr(witness, name) - value)) > width:
            raise ValueError(f"LB-{number:04d}: {name} differs between the two routes")
        expect[name] = stored(value) | {"bar": rounded_up(np.array([width]))[0]}
        for id_, other in wrong.items():
            off[id_] = max(off[id_], float(np.max(np.abs(getattr(other, name) - value)) / width))
    shown = {k: float(f"{min(v, 1e99):.2g}") for k, v in off.items() if v >= LEAST}
    feet = [pattern(*row) for row in zip(right.anchored, right.sliding, strict=True)]
    own = {k: stored(v) for k, v in flat(replace(problem, base=None)).items()}
    return {
        "id": f"LB-{number:04d}", "layer": "LB", "rule": "B1", "title": scene[0], "inputs": own,
        "base": {k: stored(v) for k, v in q["base"].items()}, "expect": expect, "branch": {"rows": feet},
        "resolving": shown, "route": "longdouble, the same text; the load by rational numbers",
    }  # fmt: skip


def document() -> dict[str, Any]:
    """Return the file LB.json. Raises ValueError where a mistake of the list shows in no vector."""
    vectors = [made(i, scene) for i, scene in enumerate(SCENES, 1)]
    unseen = {m.id for m in OF_BASE} - {id_ for v in vectors for id_ in v["resolving"]}
    if unseen:
        raise ValueError(f"LB: {', '.join(sorted(unseen))} are not resolved")
    says = {m.id: m.says for m in OF_BASE}
    return {"schema": SCHEMA, "layer": "LB", "mistakes": says, "vectors": vectors}
