"""Short runs (L5s) for who sees no forces, and for other integrators: springs alone, a block that hardly turns, feet
that slide straight on, so that a moment, a lever, a velocity or an anchor that is wrong shows under its own name.

They stand behind all others; `place` says between which they are judged.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from golden.generator.bounds.bars import Case
from golden.generator.questions.drawing import Draw, diagonal, rotation, table_3_1, turned
from golden.generator.questions.scenes import EVEN
from golden.generator.short_runs.alone import SHARES
from golden.generator.short_runs.basic import ASIDE, GLUE, ICE, IN, Z, ask, held, placed, standing
from golden.generator.short_runs.memory import on_one_foot

SPRINGS = ICE | {"C_N": 0.0}
DEEP = 2.0**-12
#: The block does not turn by anything, whatever the moment [kg m2].
STURDY = diagonal(2.0**26, 2.0**26, 2.0**26)
C_T = float(table_3_1(delta_long=EVEN)["C_T"][4])


def by_place(case: Case) -> Case:
    """Return the case with places alone in the stead of forces: attitudes show moments, too."""
    gone = {k for k in case.instead if k.startswith("Lambda")}
    fields = {k: v for k, v in case.fields.items() if k not in gone}
    return replace(case, fields=fields, instead={k: v for k, v in case.instead.items() if k not in gone})


def tilted() -> Iterator[tuple[float, Case]]:
    """Yield A2, A3 by springs alone, about X and about Y; K1 by the place of a block with one foot down."""
    for place, rule, lean in (
        (34.1, "A2", rotation((0.0008, 0.0, 0.0))),
        (34.2, "A2", rotation((0.0, 0.0008, 0.0))),
        (35.1, "A3", rotation((0.0006, 0.0004, 1.0))),
    ):
        yield place, ask({"Lambda@1": rule}, "pushed at one side by springs alone", 1, standing(DEEP), lean, SPRINGS)
    lean = rotation((0.02, -0.03, 0.6))
    at = on_one_foot(lean, 2.0**-13)
    yield 29.65, by_place(ask({"F_N@0": "K1"}, "one foot down, on springs alone", 1, at, lean, SPRINGS))
    turning: Any = {"W": [0.5, -0.25, 1.0]}
    yield 29.68, by_place(ask({"F_N@0": "K1"}, "one foot down, turning, seen by place", 1, at, lean, ICE, **turning))


def above() -> Iterator[tuple[float, Case]]:
    """Yield N2 of feet that stay above the plate for many steps."""
    hovering: Any = {"v": -(2.0**-10) * Z}
    yield (
        18.2,
        ask({"F_N@0": "N2"}, "above the plate, hardly approaching", 1, standing(-(2.0**-20)), made=ICE, **hovering),
    )


def tied() -> Iterator[tuple[float, Case]]:
    """Yield T1 of a block that hardly turns, and of feet that slid; A2 of springs alone; K1 of a turned block."""
    d = Draw(73)
    pulled: Any = {"v": [d.between(0.02, 0.1), d.between(-0.1, -0.02), 0.0]}
    own = held(d.vectors(1e-5, 8, 2))
    yield 45.5, by_place(ask({"F_T@0": "T1"}, "spring and damper, it hardly turns", 1, standing(), made=GLUE,
                             inertia=STURDY, **pulled, **own))  # fmt: skip
    slid: Any = {"sliding": np.array([False] * 4 + [True] * 4), **own}
    yield 49.85, ask({"F_T@0": "T1"}, "spring and damper of feet that slid", 1, standing(), made=GLUE, **pulled, **slid)
    each = held(d.vectors(1e-5, 8, 2))
    yield 63.6, ask({"Lambda@1": "A2"}, "dragged by springs alone", 1, standing(DEEP), made=GLUE | {"C_T": 0.0}, **each)
    round_ = rotation((0.0, 0.0, 0.7))
    P = table_3_1(delta_long=EVEN)["P"]
    here: Any = {"s": turned(round_, P)[:, :2] + ASIDE, "anchored": np.array([False] * 4 + [True] * 4)}
    yield 51.5, ask({"F_T@0": "K1"}, "dragged, turned about the height", 1, standing(), round_, GLUE, **pulled, **here)


def straight() -> Iterator[tuple[float, Case]]:
    """Yield T3 of feet that slide straight on, pulled by a damper that alone is beyond the cone.

    Wherever the anchor is left, the force is the same.
    """
    here = held(np.zeros((8, 2)))
    one, pair = {"mu": 0.25, "mu_0": 0.25}, {"mu": 0.25, "mu_0": 0.5}
    # Three times the cone, in a direction of whole numbers.
    v = 3 * 0.5 * IN * 6e7 / C_T * np.array([0.8, -0.6, 0.0])
    slow: Any = {"inertia": STURDY, **here}
    yield 51.7, ask({"F_T@0": "T3"}, "sliding straight on", 1, standing(), made=one, v=v, **slow)
    yield 51.8, ask({"F_T@0": "T3"}, "sliding straight on, beyond both cones", 1, standing(), made=pair, v=v, **slow)
    sinking = v - 0.0625 * Z
    yield 51.9, ask({"F_T@0": "T3"}, "sliding straight on, sinking", 1, standing(), made=one, v=sinking, **slow)


def unevenly() -> Iterator[tuple[float, Case]]:
    """Yield A2 of an upright block on unlike springs: its levers are where they are, whichever way they turn."""
    unlike = SPRINGS | {"K_N": 6e7 * SHARES}
    yield 33.8, ask({"Lambda@1": "A2"}, "pushed unevenly by springs alone", 1, standing(DEEP), made=unlike)


def askew() -> Iterator[Case]:
    """Yield all of them."""
    return placed(tilted, above, tied, straight, unevenly)
