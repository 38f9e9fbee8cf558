"""Short runs (L5s) that tell mistakes apart of which others show a trace under another name: where the feet are,
Euler's equations and the exponential, the second evaluation of friction, anchors and flags that outlive a step.

They stand behind all others; `place` says between which they are judged.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from golden.generator.bounds.bars import Case
from golden.generator.questions.drawing import Draw, diagonal, rotation, turned
from golden.generator.short_runs.alone import DRIFT, TIP, UNLOADED, fly
from golden.generator.short_runs.basic import (
    ASIDE,
    GLUE,
    ICE,
    SLID,
    SOFT,
    WEIGHTLESS,
    ask,
    held,
    placed,
    standing,
)
from golden.generator.short_runs.memory import PAIR, P, on_one_foot


def turning() -> Iterator[tuple[float, Case]]:
    """Yield I3 where Euler's equations have no part, then I2 where they are all that is left.

    A step so short that the square of it rounds away shows the side and the sense of the increment; a ball, upright,
    shows the exponential. A steady spin of a leaning block adds the axes in which the gyroscopic moment is made.
    """
    d = Draw(70)
    lean = d.rotation(0.5)
    yield 8.4, fly({"Lambda@1": "I3"}, "turning by a billionth", W=d.vector(4), Lambda=lean, step=2.0**-30)
    ball: Any = {"inertia": diagonal(1.0, 1.0, 1.0), "W": d.vector(4)}
    for place, h in ((8.5, 2.0**-5), (8.6, 2.0**-9)):
        yield place, fly({"Lambda@1": "I3"}, "spinning ball, upright", step=h, **ball)
    yield 8.8, fly({"Lambda@1": "I2"}, "steady spin of a leaning block", W=[3.0, 0.0, 0.0], Lambda=lean)


def places() -> Iterator[tuple[float, Case]]:
    """Yield K1 by which feet touch, before any force is looked at; T2 of a foot that is hardly stretched on ice."""
    lean = rotation((0.0008, 0.0005, 0.4))
    # They slide, so that who exchanges the flags of touching and sliding shows the same.
    slippery: Any = {"made": {"mu": 0.0, "mu_0": 0.0}, "v": [0.0625, -0.03125, 0.0]}
    yield 18.5, ask({"anchored@0": "K1"}, "which feet touch, leaning", 1, standing(), lean, stand=False, **slippery)
    hardly = held(np.array([[0.6, 0.8]] * 8) * 2.0**-27)
    yield 29.8, ask({"F_T@0": "T2"}, "no friction, anchors nearby", 1, standing(), made=ICE, **hardly)


def second_evaluation() -> Iterator[tuple[float, Case]]:
    """Yield A3 and S1 of the forces after a step, where the start brings none, and where one foot alone is dragged."""
    roll, springs = rotation((0.0006, 0.0004, 1.0)), ICE | {"C_N": 0.0}
    spun: Any = {"W": [0.0, 0.0, 4.0], **UNLOADED}
    yield (
        40.5,
        ask({"W@1": "A3"}, "pushed after a step while spinning", 1, standing(2.0**-12), roll, made=springs, **spun),
    )
    # The last foot is down, so that who keeps one anchor for all feet has the right one.
    lean = rotation((0.002, 0.003, 0.4))
    tied: Any = {"s": turned(lean, P)[:, :2] + ASIDE, "anchored": np.ones(8, bool)}
    moving: Any = {"v": [0.0625, 0.03125, 0.0], "W": [0.25, -0.5, 1.0]}
    at = on_one_foot(lean, 2.0**-16)
    yield (
        64.2,
        ask({"F_T@1": "S1"}, "the second evaluation, one foot dragged", 2, at, lean, made=GLUE, **tied, **moving),
    )


def memory() -> Iterator[tuple[float, Case]]:
    """Yield T5 and T6 in the next row: every anchor its own, a new one after the smallest hop, a foot that sticks
    again."""
    own = held(Draw(71).vectors(1e-5, 8, 2))
    yield 64.4, ask({"F_T@1": "T5"}, "every anchor stays its own", 2, standing(), made=GLUE, **own)
    # It slid; it sticks; as the spring is stretched on, the static coefficient holds it.
    again: Any = {"v": [-0.08, -0.06, 0.0], "sliding": SLID, **held(TIP * 0.9)}
    made = PAIR | {"C_T": 0.0}
    yield 64.45, ask({"F_T@1": "T6"}, "sticks again, then between the cones", 2, standing(), made=made, **again)
    hop: Any = {"step": 2.0**-10, "g": 0.125, "made": SOFT | GLUE, "v": [0.25, 0.125, 2.0**-13]}
    here = held(np.zeros((8, 2)))
    yield 68.2, ask({"F_T@2": "T5"}, "a hop of less than 50 nm", 3, standing(2.0**-26), **hop, **here)


def long_steps() -> Iterator[tuple[float, Case]]:
    """Yield A1 without a weight; A2, T1, T2 for who shows no forces: after a long step the next row shows more
    digits."""
    # The longest step, a power of two, that stiff feet bear; 2 mm deep, as forces show by depth and (h omega)^2.
    d, long, deep = Draw(72, 53), 2.0**-14, 2.0**-9
    yield 4.55, fly({"x@1": "A1"}, "drifting without a weight", v=DRIFT, g=WEIGHTLESS)
    lean = d.rotation(0.05)
    at = on_one_foot(lean, deep)
    yield 35.7, ask({"Lambda@1": "A2"}, "pushed at one corner, a long step", 1, at, lean, made=ICE, step=long)
    pulled: Any = {"v": [d.between(0.02, 0.1), d.between(0.02, 0.1), 0.0], **held(d.vectors(1e-3, 8, 2))}
    yield (
        49.75,
        ask({"F_T@0": "T1"}, "spring and damper, a long step", 1, standing(deep), made=GLUE, step=long, **pulled),
    )
    near: Any = {"made": {"mu": 0.25, "mu_0": 0.25}, "step": long, **held(TIP * 256 * (1 + 2.0**-13))}
    yield 60.7, ask({"F_T@0": "T2"}, "oblique, a ten-thousandth outside, a long step", 1, standing(deep), **near)


def apart() -> Iterator[Case]:
    """Yield all of them."""
    return placed(turning, places, second_evaluation, memory, long_steps)
