"""Short runs for other integrators alone (LS): what they show of memory and of thresholds lasts for several steps.

What lasts for one step of the law's own scheme is gone when the step goes to zero. Here a foot is without a load,
above the plate, or sliding for a time that other integrators resolve. Most blocks are so sturdy that no moment turns
them: who makes a wrong moment is right there.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from golden.generator.bounds.bars import Case
from golden.generator.questions.drawing import Draw, rotation
from golden.generator.short_runs.alone import fly
from golden.generator.short_runs.askew import C_T, DEEP, SPRINGS, STURDY, by_place
from golden.generator.short_runs.basic import ASIDE, GLUE, ICE, IN, SLID, WEIGHTLESS, Z, ask, held, placed, standing

INNER = np.array([False] * 4 + [True] * 4)
#: Feet that swing once in some ninety steps of 2^-13 s [N/m, N s/m], and whose depth carries the block under `HEAVY`
#: [m, m/s2]: it neither rises nor sinks.
STIFF, DASHPOT, DEPTH = 2.0**22, 2.0**10, 2.0**-15
HEAVY = 4 * STIFF * DEPTH / 54
#: Dashpots that carry more than their springs, for steps of 2^-10 s.
LOOSE = {"K_N": 2.0**12, "K_T": 2.0**12, "C_N": 2.0**9, "C_T": 2.0**9}


def near_the_plate() -> Iterator[tuple[float, Case]]:
    """Yield N2 of feet less than half a micrometre above the plate, which approach and do not reach it."""
    coming: Any = {"v": -0.75 * 2.0**-8 * Z, "made": ICE}
    flag = "half a micrometre above the plate"
    yield 18.25, by_place(ask({"F_N@0": "N2"}, flag, 1, standing(-(2.0**-21)), **coming))


def drifting() -> Iterator[tuple[float, Case]]:
    """Yield S2 of a velocity with all its bits."""
    yield 1.5, fly({"x_T@1": "S2"}, "drifting, all bits", v=Draw(91, 53).vector(1), g=WEIGHTLESS)


def spinning() -> Iterator[tuple[float, Case]]:
    """Yield A3 of a block that is pushed at one side and turns on: the axes of the body turn with it."""
    lean = rotation((0.0006, 0.0004, 1.0))
    spun: Any = {"W": [0.0, 0.0, 64.0], "made": SPRINGS}
    yield (
        30.84,
        ask({"Lambda@1": "A3"}, "pushed at one side by springs alone, spinning", 1, standing(DEEP), lean, **spun),
    )


def tied() -> Iterator[tuple[float, Case]]:
    """Yield T5, A1 of feet that never slide, under a block that no moment turns."""
    sturdy: Any = {"inertia": STURDY, "made": GLUE}
    off_any_grid = standing() + Draw(90, 53).vector(2.0**-12) * [1, 1, 0]
    far = {"s": ASIDE + np.full((8, 2), 2.0**-10)}
    yield 43.06, by_place(ask({"F_T@0": "T5"}, "touching anew, all bits", 1, off_any_grid, **sturdy, **far))
    here = held(np.zeros((8, 2)))
    # Three times the cone, whatever the anchors: of the first row who shows forces is right.
    fast: Any = {"v": 3 * 0.5 * IN * 6e7 / C_T * np.array([0.8, -0.6, 0.0]), "made": {"mu": 0.25, "mu_0": 0.25}}
    slow: Any = {"inertia": STURDY, **here}
    yield 43.12, ask({"x@1": "A1"}, "friction slows a block that slides straight on", 1, standing(), **fast, **slow)
    beside = {"s": here["s"] + 2.0**-14 * ~INNER[:, None], "anchored": INNER}
    drift: Any = {"v": [0.0625, -0.03125, 0.0], **beside}
    flag = "touching anew beside tied feet"
    yield 43.15, by_place(ask({"F_T@0": "T5"}, flag, 1, standing(2.0**-12), **sturdy, **drift))
    turning: Any = {"W": [0.25, -0.5, 2.0], "made": GLUE | {"C_T": 0.0}, "inertia": STURDY}
    near = held(np.full((8, 2), 2.0**-18))
    yield 43.16, ask({"x@1": "T5"}, "anchors stay while a sturdy block turns", 1, standing(), **turning, **near)


def sliding() -> Iterator[tuple[float, Case]]:
    """Yield T4 of feet that slide straight on, stop and are pulled back; T3 of feet that slide along a curve.

    Where the way is straight every direction is right: a wrong anchor shows alone.
    """
    made = {"K_N": STIFF, "K_T": STIFF, "C_N": 0.0, "C_T": DASHPOT, "mu": 0.25, "mu_0": 0.25}
    common: Any = {"made": made, "g": HEAVY, "step": 2.0**-13, "inertia": STURDY, "sliding": SLID}
    way = np.array([0.8, -0.6])
    # It stops after some three steps.
    straight: Any = {"v": [*(0.25 * HEAVY * 3 * 2.0**-13 * way), 0.0], **held(-1.5 * 0.25 * DEPTH * way)}
    yield (
        51.3,
        ask({"x@1": "T4"}, "slides straight on, stops, is pulled back", 1, standing(DEPTH), **common, **straight),
    )
    across = np.array([0.6, 0.8])
    curved: Any = {"v": [*(2.0**-7 * way), 0.0], **held(-1.5 * 0.25 * DEPTH * across)}
    yield 56.05, ask({"x@1": "T3"}, "sliding along a curve", 1, standing(DEPTH), **common, **curved)


def unloaded() -> Iterator[tuple[float, Case]]:
    """Yield T5 of feet that touch without a load for some steps."""
    common: Any = {"g": 8.0, "step": 2.0**-10, "inertia": STURDY}
    up, drift = 6 * 8 * 2.0**-10, np.array([0.25, -0.125, 0.0])
    tied_: Any = {"made": LOOSE | {"mu": 2.0**40, "mu_0": 2.0**40}, "v": drift + up * Z, **held(np.zeros((8, 2)))}
    yield 73.4, ask({"x@1": "T5"}, "no load for some steps: the anchor stays", 1, standing(2.0**-12), **common, **tied_)


def resolved() -> Iterator[Case]:
    """Yield all of them."""
    return placed(near_the_plate, drifting, spinning, tied, sliding, unloaded)
