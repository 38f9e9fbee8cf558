"""Short runs (L5s) of more feet than eight that remember, of feet each with its own load, or its own flag, of rows at a
rate that is not whole, of digits of the sum; of velocities that turn back, of feet by a block that tilts or turns.

They stand behind all others; `place` says between which they are judged.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from golden.generator.bounds.bars import Case
from golden.generator.questions.drawing import Draw, table_3_1
from golden.generator.questions.scenes import EVEN
from golden.generator.short_runs.alone import DRIFT, SHARES, fly
from golden.generator.short_runs.basic import ASIDE, GLUE, ICE, IN, WEIGHTLESS, Z, ask, held, placed, standing
from golden.generator.short_runs.habits import ALL, DEEP, TWELVE, on_other_feet

P = table_3_1(delta_long=EVEN)["P"]


def rate() -> Iterator[tuple[float, Case]]:
    """Yield S2 of rows at a rate that is far from a whole number of hertz."""
    drift: Any = {"v": DRIFT, "g": WEIGHTLESS, "step": 2.0**-4, "every": 5.7}
    fields = {f"x_T@{i}": "S2" for i in (1, 2)}
    yield 0.85, fly(fields, "rows at 2.8 hertz", 12, **drift)


def more_feet() -> Iterator[tuple[float, Case]]:
    """Yield T5 of twelve feet, each with its own anchor."""
    case = ask({"F_T@0": "T5"}, "twelve feet, each with its own anchor", 1, standing(), made=GLUE)
    s = TWELVE[:, :2] + ASIDE + Draw(93).vectors(1e-5, len(TWELVE), 2)
    yield 49.52, on_other_feet(case, TWELVE, s=s, anchored=np.ones(len(TWELVE), bool))


def own_cones() -> Iterator[tuple[float, Case]]:
    """Yield T6 of eight feet, each near the cone of its own load: no two carry the same."""
    K_N, slid = 6e7 * SHARES, np.array([True, True, False, False] * 2)
    made = {"mu": 0.25, "mu_0": 0.5, "C_N": 0.0, "C_T": 0.0, "K_N": K_N}
    limit = np.where(slid, 0.25, 0.5) * K_N * -(DEEP[2] + P[:, 2])
    stretch = np.array([0.8, 1.2] * 4) * limit / table_3_1(delta_long=EVEN)["K_T"]
    some: Any = held(stretch[:, None] * [0.8, 0.6]) | {"anchored": ALL, "sliding": slid}
    yield 62.05, ask({"F_T@0": "T6"}, "eight feet, each near the cone of its load", 1, DEEP, made=made, **some)


def sums() -> Iterator[tuple[float, Case]]:
    """Yield A1 of forces with all their bits, after a long step; I4 of what the start brings, up and down, too."""
    deep = standing(Draw(94, 53).between(2e-4, 3e-4))
    yield 30.2, ask({"x@1": "A1"}, "pushed up, all bits, a long step", 1, deep, made=ICE, step=2.0**-15)
    pulled: Any = {"g": WEIGHTLESS, "a": np.array([3.0, -2.0, 1.5]), "T": np.zeros(3), "F": np.zeros((8, 3))}
    yield 8.055, fly({"x@2": "I4"}, "pulled up by what the start brings, the second step", 2, v=DRIFT, **pulled)


def tilting() -> Iterator[tuple[float, Case]]:
    """Yield K1 of friction while the block tilts: feet move along the plate by their height under the centre."""
    here: Any = held(np.zeros((8, 2)))
    for i, axis in enumerate("XY"):
        tilt: Any = {"W": 0.25 * np.eye(3)[i], "made": GLUE, **here}
        yield 51.1 + i / 10, ask({"F_T@0": "K1"}, f"tilting about {axis}", 1, standing(), **tilt)


def flags_of_their_own() -> Iterator[tuple[float, Case]]:
    """Yield T6 of eight feet between their cones, some of which slid; and of eight that stick there, step by step."""
    made = {"mu": 0.25, "mu_0": 0.5, "C_N": 0.0, "C_T": 0.0}
    cone = 0.25 * 6e7 * -(DEEP[2] + P[:, 2]) / table_3_1(delta_long=EVEN)["K_T"]
    between: Any = held(1.5 * cone[:, None] * [0.8, 0.6]) | {"anchored": ALL, "made": made}
    slid = np.array([True, False, False, True, False, True, False, False])
    yield 62.06, ask({"F_T@0": "T6"}, "between the cones, each slid or not", 1, DEEP, sliding=slid, **between)
    fields = {f"F_T@{i}": "T6" for i in (1, 2)}
    yield 64.475, ask(fields, "eight feet stick on, between the cones", 3, DEEP, **between)


def turning_back() -> Iterator[tuple[float, Case]]:
    """Yield I4 of velocities that change their signs in a step: thrown up, and pulled back by what the start brings."""
    h = 2.0**-10
    yield 8.056, fly({"x@2": "I4"}, "thrown up, and falling", 2, v=9.81 * h / 2 * Z)
    a = np.array([3.0, -2.0, 1.5])
    pulled: Any = {"g": WEIGHTLESS, "a": a, "T": np.zeros(3), "F": np.zeros((8, 3))}
    yield 8.057, fly({"x@2": "I4"}, "pulled back by what the start brings", 2, v=-a * h / 4, **pulled)


def unpressed() -> Iterator[tuple[float, Case]]:
    """Yield T5 of feet that touch and do not push: they touch."""
    yield 44.2, ask({"anchored@0": "T5"}, "touching without a load", 1, standing(), made=ICE, v=0.5 * Z)


def anew_and_turned() -> Iterator[tuple[float, Case]]:
    """Yield K1 of feet that touch anew under a block that drifts and turns: their springs show where they have gone."""
    turning: Any = {"v": [0.0625, -0.03125, 0.0], "W": [0.0, 0.0, 2.0], "made": GLUE | {"C_T": 0.0}}
    flag = "touching anew while it turns, a step later, springs alone"
    yield 68.7, ask({"F_T@1": "K1"}, flag, 2, standing(4 * IN), **turning)


def several() -> Iterator[Case]:
    """Yield all of them."""
    return placed(
        rate, more_feet, own_cones, sums, tilting, flags_of_their_own, turning_back, unpressed, anew_and_turned
    )
