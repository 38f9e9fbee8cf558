"""Questions to those who show `simulate` only (L5s): runs of a few steps, each laid out so that one rule decides.

They build on each other, and are judged in this order: free flight, then what the feet do at the start state (the
first row), then how forces move the block, then what the anchors remember. Who gives no forces is asked for the next
row's place and attitude in their stead.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from golden.generator.bounds.bars import Case
from golden.generator.questions.drawing import HEIGHT, Draw, diagonal, rotation, table_3_1
from golden.generator.questions.scenes import EVEN, at_rest

#: Half of the height, and feet that are 2^-17 m (8 micrometres) in the plate.
UP, IN = HEIGHT / 2, 2.0**-17
#: Where the block stands.
ASIDE = np.array([0.25, -0.125])
Z = np.array([0.0, 0.0, 1.0])
#: The internal feet were sliding.
SLID = np.array([False] * 4 + [True] * 4)
#: No force reaches this cone, and no square of one.
GLUE = {"mu": 2.0**40, "mu_0": 2.0**40}
#: Friction that is none, where it is not the question.
ICE = {"mu": 0.0, "mu_0": 0.0, "C_T": 0.0}
SOFT = {"K_N": 100.0, "K_T": 100.0, "C_N": 1.0, "C_T": 1.0}
#: Feet that could push by nothing worth a bar, whatever is wrong with them.
GONE = dict.fromkeys(SOFT, 2.0**-60)


#: A gravity that is worth no bar [m/s2].
WEIGHTLESS = 2.0**-60


def ask(
    fields: dict[str, str],
    flag: str,
    steps: int,
    x: Any,
    Lambda: Any = None,
    made: dict | None = None,
    stand: bool = True,
    **changes: Any,
) -> Case:
    """Return a run of so many steps from a state; `made` replaces properties, `changes` the memory and the step.

    stand : whether the next row stands in for forces that are not shown; `every` among the changes: steps a row
    """
    q = table_3_1(delta_long=EVEN) | {k: np.full(8, v, float) for k, v in (made or {}).items()}
    rates = {k: np.array(changes.pop(k), float) for k in ("v", "W") if k in changes}
    q = at_rest(q, x, np.eye(3) if Lambda is None else Lambda, **rates) | changes
    h, every = q.pop("step", 2.0**-17), q.pop("every", 1.0)
    q |= {"step": h, "duration": steps * h, "output_rate": 1 / (every * h)}
    rule = next(iter(fields.values()))
    instead = stand_ins(fields, steps) if stand else {}
    named = {k: (r, r) for k, r in fields.items()} | {k: (rule, rule) for k in instead}
    return Case(rule, "L5s", "simulate", q, named, (flag, f"{steps} step(s)"), set="even feet", instead=instead)


def stand_ins(fields: dict[str, str], steps: int) -> dict[str, str]:
    """Return what is looked at where forces are not given: the row after them shows what they did."""
    found: dict[str, str] = {}
    for name in fields:
        base, _, row = name.partition("@")
        if base.startswith("F") and int(row) < steps:
            found |= {f"{k}@{int(row) + 1}": name for k in ("x", "Lambda")}
    return found


def standing(depth: float = IN) -> np.ndarray:
    """Place the block upright beside the origin, the internal feet `depth` in the plate, the external ones clear of
    it."""
    return np.array([*ASIDE, UP - depth])


def held(u: np.ndarray) -> Any:
    """Return anchors so far from the feet of the upright block, per foot."""
    P = table_3_1(delta_long=EVEN)["P"]
    return {"s": P[:, :2] + ASIDE + u, "anchored": np.array([False] * 4 + [True] * 4)}


def flight() -> Iterator[Case]:
    """Yield S2, I1 to I5 without feet, far above the plate, with long steps; the weight."""
    d = Draw(51)
    high = np.array([0.5, -0.25, 8.0])
    long: Any = {"step": 2.0**-10, "inertia": diagonal(0.5, 1.25, 2.0)}

    def fly(fields: dict[str, str], flag: str, steps: int = 1, **changes: Any) -> Case:
        return ask(fields, flag, steps, high, made=ICE | GONE, **(long | changes))

    v = (1.0, -0.5, 0.25)
    yield fly({"x_T@1": "S2"}, "drifting sideways", v=v, g=WEIGHTLESS)
    yield fly({"x_T@3": "S2"}, "drifting sideways", 3, v=v, g=WEIGHTLESS)
    # An acceleration that is given, sideways and up: it is not the weight's.
    loads: Any = {"g": WEIGHTLESS, "a": np.array([3.0, -2.0, 1.5]), "T": np.zeros(3), "F": np.zeros((8, 3))}
    yield fly({"x_T@1": "I1"}, "pulled by what the start brings", v=v, **loads)
    yield fly({"x_T@1": "I1"}, "pulled by what the start brings", **loads)
    for g in (9.81, 3.75):
        yield fly({"x@1": "A1"}, "falling", v=v, g=g)
        yield fly({"x@2": "I4"}, "falling", 2, v=v, g=g)
    for i in range(3):
        yield fly({"Lambda@1": "I3"}, "steady spin", W=3.0 * np.eye(3)[i], Lambda=d.rotation(0.5))
    ball: Any = {"inertia": diagonal(1.0, 1.0, 1.0), "step": 2.0**-5}
    yield fly({"Lambda@1": "I3"}, "spinning ball", W=d.vector(6), Lambda=d.rotation(0.5), **ball)
    for h in (2.0**-10, 2.0**-6):
        yield fly({"Lambda@1": "I2"}, "torque-free top", W=d.vector(8), Lambda=d.rotation(0.5), step=h)
        yield fly({"W@1": "I5"}, "torque-free top", W=d.vector(8), Lambda=d.rotation(0.5), step=h)


def normal() -> Iterator[Case]:
    """Yield N2, N1, K1: what the first row shows of feet on ice."""

    def see(rule: str, flag: str, x: np.ndarray, Lambda: Any = None, stand: bool = True, **changes: Any) -> Case:
        return ask({"F_N@0": rule}, flag, 1, x, Lambda, made=ICE, stand=stand, **changes)

    for rate in (-1.0, -16.0):
        yield see("N2", "above the plate, approaching", standing(-(2.0**-20)), v=rate * Z)
    yield see("N1", "standing", standing())
    yield see("N1", "compressing", standing(), v=-0.125 * Z)
    yield see("N1", "partial rebound", standing(), v=2.0**-6 * Z)
    yield see("N1", "would-be tension", standing(), v=0.5 * Z)
    here = held(np.zeros((8, 2)))
    yield ask({"F_T@0": "T3"}, "no trial force", 1, standing(), stand=False, **here)
    # Without forces, K1 is told from A2 and A3 only after these.
    deep = standing(2.0**-12)
    yield see("K1", "leaning", deep, rotation((0.0008, 0.0005, 0.4)), stand=False)
    for i in range(2):
        yield see("K1", "turning", deep, W=0.25 * np.eye(3)[i], stand=False)
    lean = rotation((0.0005, 0.001, 0.4))
    for i in range(3):
        yield see("K1", "leaning and turning", deep, lean, W=0.25 * np.eye(3)[i], stand=False)


def friction() -> Iterator[Case]:
    """Yield T5, T1 to T3, T6: what the first row shows of friction."""
    d = Draw(50)
    here = held(np.zeros((8, 2)))
    lifted: Any = {"made": ICE, "v": 0.5 * Z}
    yield ask({"anchored@1": "T5"}, "standing", 1, standing(), made=ICE)
    yield ask({"anchored@2": "T5"}, "lifting off", 2, standing(2.0**-20), **lifted, **here)
    far = np.full((8, 2), 2.0**-10)
    yield ask({"F_T@0": "T5"}, "touch-down far from the old anchor", 1, standing(), s=ASIDE + far, made=GLUE)
    for _ in range(2):
        yield ask({"F_T@0": "T1"}, "spring", 1, standing(), made=GLUE, **held(d.vectors(1e-5, 8, 2)))
        yield ask({"F_T@0": "T1"}, "damper", 1, standing(), made=GLUE, v=[d.between(-0.1, 0.1), 0.0625, 0], **here)
    yield ask({"F_T@0": "K1"}, "sliding while sinking", 1, standing(), made=GLUE, v=[0.0625, 0.03125, -0.125], **here)
    yield ask({"F_T@0": "K1"}, "turning about the height", 1, standing(), made=GLUE, W=2.0 * Z, **here)
    tip = np.array([0.8, 0.6]) * 2.0**-17 * 1.2 * 0.25
    one, pair = {"mu": 0.25, "mu_0": 0.25}, {"mu": 0.25, "mu_0": 0.5}
    # Far outside every cone, whoever measures it how: what is returned shows the return alone.
    for k, properties in ((8.0, one), (12.0, pair)):
        slid: Any = {"sliding": SLID} if k == 12.0 else {}
        yield ask({"F_T@0": "T3"}, "oblique, far outside", 1, standing(), made=properties, **held(tip * k), **slid)
    # Two ways up to the cone: by the spring, and by the damper against it.
    for _ in range(2):
        v = [d.between(0.125, 0.25), d.between(-0.25, -0.125), 0]
        yield ask({"F_T@0": "T3"}, "sliding", 1, standing(), made=one, v=v, **held(tip * 8))
    yield ask({"F_T@0": "T3"}, "sliding, would-be tension", 1, standing(), made=one, v=0.5 * Z, **held(tip))
    for share, where in ((0.99, "inside"), (1.01, "outside")):
        for turn in (np.eye(2), np.array([[0.0, -1.0], [1.0, 0.0]])):
            yield ask({"F_T@0": "T2"}, f"oblique, just {where}", 1, standing(), made=one, **held(turn @ tip * share))
    yield ask({"F_T@0": "T6"}, "between the cones, stuck", 1, standing(), made=pair, **held(tip * 1.5))
    yield ask({"F_T@0": "T6"}, "between the cones, slid", 1, standing(), made=pair, sliding=SLID, **held(tip * 1.5))


def pushed() -> Iterator[Case]:
    """Yield A1 to A3, S1, I4, I5, and K1 once more: forces and moments of the feet on ice, seen in the next row."""
    d = Draw(52)
    lean, roll = rotation((0.0008, 0.0, 0.0)), rotation((0.0006, 0.0004, 1.0))
    deep = standing(2.0**-12)
    row, springs = {"F_N@1": "S1"}, ICE | {"C_N": 0.0}
    sinking: Any = {"v": -0.125 * Z, "made": ICE}
    yield ask({"x@1": "A1"}, "pushed up", 1, deep, made=ICE)
    yield ask(row, "the second evaluation", 2, standing(), stand=False, **sinking)
    yield ask({"x@2": "I4"}, "pushed up by springs", 2, deep, made=springs, v=-0.25 * Z)
    yield ask(row, "the second evaluation, seen by who sees no forces", 2, standing(), **sinking)
    yield ask({"Lambda@1": "A2"}, "pushed at one side", 1, deep, lean, made=ICE)
    yield ask({"Lambda@1": "A3"}, "pushed, turned about the height", 1, deep, roll, made=ICE)
    for i in range(2):
        yield ask({"F_N@0": "K1"}, "turning, seen by who sees no forces", 1, deep, roll, made=ICE, W=np.eye(3)[i])
    turning: Any = {"W": [0.5, -0.25, 0]}
    yield ask(row, "the second evaluation, turning", 2, standing(), stand=False, **sinking, **turning)
    yield ask(row, "the second evaluation, turning", 2, standing(), lean, made=ICE, stand=False, v=-0.25 * Z,
              W=d.vector(0.25))  # fmt: skip
    yield ask({"W@1": "I5"}, "pushed at one side by springs", 1, deep, lean, made=springs)
    yield ask({"W@1": "I5"}, "pushed by springs while spinning", 1, deep, lean, made=springs, W=[0.25, 0.5, 4.0])
    yield ask(row, "the second evaluation, turning, seen by who sees no forces", 2, standing(), **sinking, **turning)


def dragged() -> Iterator[Case]:
    """Yield A1 to A3 once more: what friction does to the block."""
    deep, sideways = standing(2.0**-12), held(np.full((8, 2), 2.0**-16))
    roll = rotation((0.0006, 0.0004, 1.0))
    yield ask({"x@1": "A1"}, "dragged sideways", 1, deep, made=GLUE, **sideways)
    yield ask({"Lambda@1": "A2"}, "dragged sideways", 1, deep, made=GLUE, **sideways)
    yield ask({"Lambda@1": "A3"}, "dragged sideways, turned about the height", 1, deep, roll, made=GLUE, **sideways)


def anchors() -> Iterator[Case]:
    """Yield T1, T5, T3, T4: what later rows show of anchors that stay, are given up, and move."""
    d = Draw(53)
    here = held(np.zeros((8, 2)))
    yield ask({"F_T@1": "T1"}, "a step later", 2, standing(), made=GLUE, v=[0.125, -0.0625, 0], **here)
    yield ask({"F_T@2": "T5"}, "the anchor stays in the plate", 3, standing(), made=GLUE, W=2.0 * Z, **here)
    hop: Any = {"step": 2.0**-10, "g": 1024.0, "made": SOFT | GLUE, "v": [0.25, 0.125, 1.0]}
    yield ask({"F_T@2": "T5"}, "a hop, and a new anchor", 3, standing(2.0**-13), **hop, **here)
    one = {"mu": 0.25, "mu_0": 0.25}
    along = held(np.full((8, 2), 2.0**-15))
    v = [-0.25, -0.25, -0.125]
    yield ask({"F_T@1": "T3"}, "sliding while sinking", 2, standing(), made=one, v=v, sliding=SLID, **along)
    for _ in range(3):
        v = [d.between(-0.25, 0.25), d.between(-0.25, 0.25), 0]
        far = held(d.vectors(2e-5, 8, 2))
        yield ask({"F_T@2": "T4"}, "the anchor slides along", 3, standing(), v=v, sliding=SLID, **far)
    # Sticking again: a foot that turns back shows where its anchor has been left.
    near = held(d.vectors(1e-5, 8, 2))
    yield ask({"F_T@2": "T4"}, "the anchor that is left", 3, standing(), W=[0, 0, 3.0], made={"C_T": 0.0}, **near)


def placed(*groups: Callable[[], Iterator[tuple[float, Case]]]) -> Iterator[Case]:
    """Yield the questions of groups, each with the place at which it is judged."""
    for group in groups:
        for place, case in group():
            yield replace(case, place=place)


def all_short() -> Iterator[Case]:
    """Yield every question of L5s."""
    for group in (flight, normal, pushed, friction, dragged, anchors):
        yield from group()
