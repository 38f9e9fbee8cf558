"""Questions to those who show `simulate` only (L5s): runs of one or two steps, each laid out so that one rule decides.

The first row shows the contact rules at the start state itself, the later ones the integrator. Feet on the plate, or
the block in
free flight; soft feet where the step is to be long.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from rockref.conformance.maker.bars import Case
from rockref.conformance.maker.drawing import HEIGHT, Draw, diagonal, rotation, table_3_1
from rockref.conformance.maker.scenes import EVEN, at_rest

#: Half of the height, and feet that are 2^-17 m (8 micrometres) in the plate.
UP, IN = HEIGHT / 2, 2.0**-17
Z = np.array([0.0, 0.0, 1.0])


def ask(
    fields: dict[str, str], flag: str, steps: int, x: Any, Lambda: Any = None, made: dict | None = None, **changes: Any
) -> Case:
    """A run of so many steps from a state; `made` replaces properties, `changes` the memory and the step."""
    q = table_3_1(delta_long=EVEN) | {k: np.full(8, float(v)) for k, v in (made or {}).items()}
    rates = {k: np.array(changes.pop(k), float) for k in ("v", "W") if k in changes}
    q = at_rest(q, x, np.eye(3) if Lambda is None else Lambda, **rates) | changes
    h = q.pop("step", 2.0**-17)
    q |= {"step": h, "duration": steps * h, "output_rate": 1 / h}
    rule = next(iter(fields.values()))
    return Case(
        rule, "L5s", "simulate", q, {k: (r, r) for k, r in fields.items()}, (flag, f"{steps} step(s)"), set="even feet"
    )


def standing(depth: float = IN) -> np.ndarray:
    """Upright, the internal feet `depth` in the plate, the external ones clear of it."""
    return np.array([0.0, 0.0, UP - depth])


def held(u: np.ndarray) -> dict[str, Any]:
    """Anchors so far from the feet (upright at the origin), per foot."""
    P = table_3_1(delta_long=EVEN)["P"]
    return {"s": P[:, :2] + u, "anchored": np.array([False] * 4 + [True] * 4)}


GLUE = {"mu": 1024.0, "mu_0": 1024.0}


def normal() -> Iterator[Case]:
    """N1, N2, K1, T5: what the first row shows without friction."""
    row = {"F_N@0": "N1"}
    yield ask(row, "standing", 1, standing())
    yield ask(row, "compressing", 1, standing(), v=-0.125 * Z)
    yield ask(row, "partial rebound", 1, standing(), v=2.0**-6 * Z)
    yield ask(row, "would-be tension", 1, standing(), v=0.5 * Z)
    for rate in (-1.0, -16.0):
        yield ask({"F_N@0": "N2"}, "above the plate, approaching", 1, standing(-(2.0**-20)), v=rate * Z)
    motion = {"F_N@0": "K1"}
    deep = standing(2.0**-12)
    for i in range(3):
        yield ask(motion, "turning", 1, deep, W=0.25 * np.eye(3)[i])
    lean = rotation((0.0005, 0.001, 0.4))
    for i in range(3):
        yield ask(motion, "leaning and turning", 1, deep, lean, W=0.25 * np.eye(3)[i])
    yield ask(
        {"F_T@0": "T5"}, "touch-down far from the old anchor", 1, standing(), s=np.full((8, 2), 2.0**-10), made=GLUE
    )


def friction() -> Iterator[Case]:
    """T1 to T4: what the first row shows of friction, and what the next row shows of the moved anchor."""
    d = Draw(50)
    for _ in range(2):
        yield ask({"F_T@0": "T1"}, "spring", 1, standing(), made=GLUE, **held(d.vectors(1e-5, 8, 2)))
        yield ask(
            {"F_T@0": "T1"},
            "damper",
            1,
            standing(),
            made=GLUE,
            **held(np.zeros((8, 2))),
            v=[d.between(-0.1, 0.1), 0.0625, 0],
        )
    for _ in range(2):
        tip = np.array([0.8, 0.6]) * 2.0**-17 * 1.2 * 0.25
        yield ask(
            {"F_T@0": "T2"}, "oblique, just inside", 1, standing(), made={"mu": 0.25, "mu_0": 0.25}, **held(tip * 0.99)
        )
        yield ask(
            {"F_T@0": "T2"}, "oblique, just outside", 1, standing(), made={"mu": 0.25, "mu_0": 0.25}, **held(tip * 1.01)
        )
    between = np.array([0.8, 0.6]) * 2.0**-17 * 1.2 * 0.25 * 1.5
    pair = {"mu": 0.25, "mu_0": 0.5}
    yield ask({"F_T@0": "T6"}, "between the cones, stuck", 1, standing(), made=pair, **held(between))
    slid = np.array([False] * 4 + [True] * 4)
    yield ask({"F_T@0": "T6"}, "between the cones, slid", 1, standing(), made=pair, sliding=slid, **held(between))
    for _ in range(3):
        v = [d.between(-0.25, 0.25), d.between(-0.25, 0.25), 0]
        yield ask({"F_T@0": "T3"}, "sliding", 1, standing(), v=v, sliding=slid, **held(d.vectors(2e-5, 8, 2)))
        yield ask(
            {"F_T@2": "T4"}, "the anchor slides along", 2, standing(), v=v, sliding=slid, **held(d.vectors(2e-5, 8, 2))
        )
    # Sticking again: a sudden stop of the foot shows where its anchor has been left.
    yield ask(
        {"F_T@2": "T4"},
        "the anchor that is left",
        2,
        standing(),
        W=[0, 0, 3.0],
        **held(d.vectors(1e-5, 8, 2)),
        made={"C_T": 0.0},
    )


def flight() -> Iterator[Case]:
    """I1 to I5 far above the plate, on soft feet with long steps."""
    d = Draw(51)
    soft = {"K_N": 100.0, "K_T": 100.0, "C_N": 1.0, "C_T": 1.0}
    high = np.array([0.5, -0.25, 8.0])
    top = diagonal(0.5, 1.25, 2.0)

    def fly(fields: dict[str, str], flag: str, steps: int = 1, **changes: Any) -> Case:
        return ask(fields, flag, steps, high, made=soft, **({"step": 2.0**-10, "inertia": top} | changes))

    for v in ((0, 0, 0), (1.0, -0.5, 0.25)):
        yield fly({"x@1": "I1"}, "falling", v=v)
        yield fly({"x@2": "I4"}, "falling", 2, v=v)
    for i in range(3):
        yield fly({"Lambda@1": "I3"}, "steady spin", W=3.0 * np.eye(3)[i], Lambda=d.rotation(0.5))
    yield fly(
        {"Lambda@1": "I3"},
        "spinning ball",
        W=d.vector(6),
        Lambda=d.rotation(0.5),
        inertia=diagonal(1.0, 1.0, 1.0),
        step=2.0**-5,
    )
    for h in (2.0**-10, 2.0**-6):
        yield fly({"Lambda@1": "I2"}, "torque-free top", W=d.vector(8), Lambda=d.rotation(0.5), step=h)
        yield fly({"W@1": "I5"}, "torque-free top", W=d.vector(8), Lambda=d.rotation(0.5), step=h)


def pushed() -> Iterator[Case]:
    """A1 to A3, S1, I5: forces and moments of the feet, seen in the next row."""
    d = Draw(52)
    lean, roll = rotation((0.0008, 0.0, 0.0)), rotation((0.0006, 0.0004, 1.0))
    deep = standing(2.0**-12)
    yield ask({"x@1": "A1"}, "pushed up", 1, deep)
    yield ask({"x@1": "A1"}, "pushed sideways", 1, deep, made=GLUE, **held(np.full((8, 2), 2.0**-16)))
    yield ask({"W@1": "A2"}, "pushed at one side", 1, deep, lean)
    yield ask({"W@1": "A2"}, "pushed sideways", 1, deep, made=GLUE, **held(np.full((8, 2), 2.0**-16)))
    yield ask({"W@1": "A3"}, "pushed, turned about the height", 1, deep, roll)
    yield ask({"W@1": "A3"}, "pushed sideways, turned about the height", 1, deep, roll, v=[0.25, 0.125, 0])
    yield ask({"F_N@1": "S1"}, "the second evaluation", 1, standing(), v=-0.125 * Z, W=[0.5, -0.25, 0])
    yield ask({"F_N@1": "S1"}, "the second evaluation", 1, deep, lean, v=-0.25 * Z, W=d.vector(0.25))
    yield ask({"W@1": "I5"}, "pushed while spinning", 1, deep, lean, W=[0.25, 0.5, 4.0])


def all_short() -> Iterator[Case]:
    """Every question of L5s."""
    for group in (normal, friction, flight, pushed):
        yield from group()
