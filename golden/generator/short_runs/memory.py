"""Short runs (L5s) of feet that slid, of one foot alone, of deep and of frictionless feet, of a start with its own
forces; and of numbers with all their bits. They stand behind all others; `place` says between which they are judged.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from golden.generator.bounds.bars import Case
from golden.generator.questions.drawing import Draw, rotation, table_3_1, turned
from golden.generator.questions.scenes import EVEN
from golden.generator.short_runs.alone import TIP, fly
from golden.generator.short_runs.basic import (
    ASIDE,
    GLUE,
    ICE,
    SLID,
    SOFT,
    WEIGHTLESS,
    Z,
    ask,
    held,
    placed,
    standing,
)

P = table_3_1(delta_long=EVEN)["P"]
PAIR = {"mu": 0.25, "mu_0": 0.5}


def on_one_foot(Lambda: np.ndarray, depth: float) -> np.ndarray:
    """Return where the block stands (3,) [m] whose lowest foot is so deep [m] in the plate."""
    return np.array([*ASIDE, -float(np.min(turned(Lambda, P)[:, 2])) - depth])


def of_all_bits() -> Iterator[tuple[float, Case]]:
    """Yield I1, I3, N1, T1, K1, A1, A2 where the numbers have all their bits."""
    d = Draw(64, 53)
    q: Any = {"v": d.vector(1), "W": d.vector(3), "Lambda": d.rotation(0.5)}
    yield 8.2, fly({"x@1": "I1"}, "falling, all bits", **q)
    yield 12.5, fly({"Lambda@1": "I3"}, "turning, all bits", step=2.0**-6, inertia=np.diag([1.0, 1.0, 1.0]), **q)
    deep = d.between(2e-5, 4e-5)
    yield 22.7, ask({"F_N@0": "N1"}, "compressing, all bits", 1, standing(deep), made=ICE, v=-d.between(0.1, 0.2) * Z)
    pulled: Any = {"v": [d.between(0.02, 0.1), d.between(0.02, 0.1), 0.0], **held(d.vectors(1e-5, 8, 2))}
    yield 49.7, ask({"F_T@0": "T1"}, "spring and damper, all bits", 1, standing(deep), made=GLUE, **pulled)
    lean = d.rotation(0.001)
    yield 29.2, ask({"F_N@0": "K1"}, "leaning and turning, all bits", 1, standing(2.0**-11), lean, made=ICE,
                    stand=False, W=d.vector(0.25))  # fmt: skip
    roll = rotation((0.0007, 0.0003, 0.7))
    yield 42.05, ask({"W@1": "A2"}, "pushed at one side, all bits", 1, standing(2.0**-12), roll, made=ICE)


def on_a_single_foot() -> Iterator[tuple[float, Case]]:
    """Yield K1, A2, A3 where one foot alone is down, of a block that leans and turns."""
    for place, Theta in ((29.4, (0.02, 0.03, 0.4)), (29.6, (-0.03, 0.015, -0.7))):
        lean = rotation(Theta)
        x, W = on_one_foot(lean, 2.0**-13), [0.25, -0.5, 1.0]
        yield place, ask({"F_N@0": "K1"}, "one foot down, turning", 1, x, lean, made=ICE, stand=False, W=W)
        yield place + 6, ask({"Lambda@1": "A2"}, "one foot down", 1, x, lean, made=ICE)
        yield place + 12.7, ask({"W@1": "A3"}, "one foot down, turning", 1, x, lean, made=ICE, W=W)
    dragged = {"s": turned(lean, P)[:, :2] + ASIDE + 2.0**-15, "anchored": np.ones(8, bool)}
    yield 64.5, ask({"W@1": "A2"}, "one foot down, dragged", 1, x, lean, made=GLUE, **dragged)


def in_the_plate() -> Iterator[tuple[float, Case]]:
    """Yield N1 of deep feet; T3 where there is no friction; A2 of feet that slide with stretched springs."""
    yield 22.5, ask({"F_N@0": "N1"}, "a millimetre deep", 1, standing(2.0**-10), made=ICE)
    far = held(np.array([[2.0**-15, 2.0**-16]] * 8))
    yield 29.7, ask({"F_T@0": "T3"}, "no friction, anchors far away", 1, standing(), made=ICE, stand=False, **far)
    own = held(Draw(65).vectors(2e-3, 8, 2))
    one = {"mu": 0.25, "mu_0": 0.25}
    yield (
        73.7,
        ask({"W@1": "A2"}, "sliding, with stretched springs", 1, standing(2.0**-12), made=one, sliding=SLID, **own),
    )


def feet_that_slid() -> Iterator[tuple[float, Case]]:
    """Yield T6, T5 of feet that touch for the first time, and of feet that slid, opened, and touch again."""
    # The damper alone pulls a new foot, by one and a half times mu F_N.
    F_N = 2.0**-17 * 6e7
    v = -1.5 * 0.25 * F_N / float(table_3_1(delta_long=EVEN)["C_T"][4]) * np.array([0.8, 0.6, 0.0])
    yield 61.5, ask({"F_T@0": "T6"}, "between the cones, the first touch", 1, standing(), made=PAIR, v=v)
    hop: Any = {"step": 2.0**-10, "g": 1024.0, "made": SOFT | PAIR, "v": [0.3, 0.2, 1.0], "sliding": SLID}
    yield 68.5, ask({"F_T@2": "T5"}, "slid, a hop, between the cones", 3, standing(2.0**-13), **hop, **held(TIP * 1e4))


def start_with_its_own() -> Iterator[tuple[float, Case]]:
    """Yield S2: the start brings a, T and F that are not those of its pose."""
    own: Any = {"a": np.array([3.0, -2.0, 1.5]), "T": np.array([4.0, -3.0, 2.0]), "F": np.full((8, 3), 8.0)}
    yield 4.3, fly({"F@0": "S2"}, "the forces that the start brings", stand=False, **own)
    yield (
        16.6,
        fly({"Lambda@1": "I2"}, "turned by the moment that the start brings", W=np.array([1.0, -2.0, 3.0]), **own),
    )
    stand: Any = {"made": ICE, **own}
    yield 42.6, ask({"x@1": "S2"}, "standing, with a force of its own", 1, standing(2.0**-12), **stand)


def told_apart() -> Iterator[tuple[float, Case]]:
    """Yield I1, N1, T5, A2, T6: what comes before others that show the same mistake under another name."""
    drift: Any = {"v": Draw(66, 53).vector(1), "g": WEIGHTLESS}
    yield 4.6, fly({"x@1": "I1"}, "drifting, all bits", **drift)
    yield 22.55, ask({"F_N@0": "N1"}, "a millimetre deep, in fast rebound", 1, standing(2.0**-10), made=ICE, v=0.5 * Z)
    own = held(Draw(67).vectors(1e-5, 8, 2))
    slid: Any = {"made": GLUE, "sliding": SLID, **own}
    yield 49.8, ask({"F_T@0": "T5"}, "slid until now: the anchor is kept", 1, standing(), **slid)
    yield 63.5, ask({"Lambda@1": "A2"}, "dragged, each foot its own way", 1, standing(2.0**-12), made=GLUE, **own)
    # The damper pulls beyond both cones; a step later the foot has moved by a third of the one.
    slides: Any = {"v": [-0.08, -0.06, 0.0], "sliding": SLID, **held(TIP)}
    yield 64.47, ask({"F_T@1": "T6"}, "slides on, between the cones", 2, standing(), made=PAIR, **slides)


def memory() -> Iterator[Case]:
    """Yield all of them."""
    return placed(of_all_bits, on_a_single_foot, in_the_plate, feet_that_slid, start_with_its_own, told_apart)
