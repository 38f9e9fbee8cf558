"""More short runs (L5s), for mistakes that show in runs alone and that the first ones let through or misnamed.

They stand at the end of the file, so that the others keep their numbers; `place` says between which of them they are
judged.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from golden.generator.bounds.bars import Case
from golden.generator.questions.drawing import Draw, diagonal, rotation
from golden.generator.short_runs.basic import (
    GLUE,
    GONE,
    ICE,
    SOFT,
    WEIGHTLESS,
    Z,
    ask,
    held,
    placed,
    standing,
)

#: The start brings a force evaluation: nothing pulls.
UNLOADED: Any = {"g": WEIGHTLESS, "a": np.zeros(3), "T": np.zeros(3), "F": np.zeros((8, 3))}
HIGH = np.array([0.5, -0.25, 8.0])
DRIFT = (1.0, -0.5, 0.25)
OBLIQUE = np.array([[1.0, 0.25, -0.125], [0.25, 1.5, 0.0625], [-0.125, 0.0625, 0.75]])
#: Eight coefficients, stiffnesses or dampings, no two alike, as shares.
SHARES = np.array([5.0, 6.0, 7.0, 8.0, 1.0, 2.0, 3.0, 4.0]) / 8
#: The trial force of a foot that is held so far away is a quarter of the normal force of a foot 2^-17 m deep.
TIP = np.array([0.8, 0.6]) * 2.0**-17 * 1.2 * 0.25


def fly(fields: dict[str, str], flag: str, steps: int = 1, **changes: Any) -> Case:
    """Make a run far above the plate, with long steps."""
    long: Any = {"step": 2.0**-10, "inertia": diagonal(0.5, 1.25, 2.0)}
    return ask(fields, flag, steps, HIGH, made=ICE | GONE, **(long | changes))


def afloat() -> Iterator[tuple[float, Case]]:
    """Yield I3, S2, A1 before everything else: at rest, drifting, without loads, rows between steps."""
    oblique = rotation((0.3, -0.2, 0.5))
    yield 0.2, fly({"Lambda@1": "I3"}, "at rest: it does not turn", Lambda=oblique, **UNLOADED)
    yield 0.4, fly({"x_T@1": "S2"}, "drifting, the start brings that nothing pulls", v=DRIFT, **UNLOADED)
    yield 0.6, fly({"x_T@2": "A1"}, "drifting: no force where no foot touches", 2, v=DRIFT, **UNLOADED)
    rows = {f"x_T@{i}": "S2" for i in (1, 2, 3)}
    yield 0.8, fly(rows, "a row every 2.6 steps: the nearest step", 12, v=DRIFT, g=WEIGHTLESS, every=2.6)


def tops() -> Iterator[tuple[float, Case]]:
    """Yield I2, I5 with products of inertia."""
    d = Draw(54)
    for place, fields, h in ((16.2, {"Lambda@1": "I2"}, 2.0**-6), (16.4, {"W@1": "I5"}, 2.0**-10)):
        spun: Any = {"W": d.vector(8), "Lambda": d.rotation(0.5), "step": h, "inertia": OBLIQUE}
        yield place, fly(fields, "torque-free top with products of inertia", **spun)


def feet() -> Iterator[tuple[float, Case]]:
    """Yield N1, A2, S1 of feet on ice: shallow, hardly loaded, each of its own make, lifting while others press."""
    yield 22.2, ask({"F_N@0": "N1"}, "a micrometre deep, compressing", 1, standing(2.0**-20), made=ICE, v=-0.125 * Z)
    yield 22.4, ask({"F_N@0": "N1"}, "loaded by less than a newton", 1, standing(2.0**-26), made=ICE)
    own = ICE | {"K_N": 6e7 * SHARES, "C_N": 16384.0 * SHARES}
    yield 22.6, ask({"F_N@0": "N1"}, "every foot of its own make", 1, standing(), made=own, v=-0.125 * Z)
    yield 35.5, ask({"Lambda@1": "A2"}, "spinning on ice", 1, standing(2.0**-12), made=ICE, W=2.0 * Z)
    rocking: Any = {"W": [0.5, 0.4375, 0.0]}
    yield 42.2, ask({"F_N@0": "N1"}, "a foot lifts while others press", 1, standing(), made=ICE, **rocking)
    yield 42.4, ask({"F_N@1": "S1"}, "the second evaluation, hardly moving", 2, standing(2.0**-19), made=ICE)


def strangers() -> Iterator[tuple[float, Case]]:
    """Yield T1, T6 where no two feet remember the same, before all others that look at feet with anchors; A1 of a block
    that is not the source's, and of one that leans; an even push; what begins to slide, and what almost does; an anchor
    that outlives a moment without a load."""
    # All eight are held: a foot without a trial force would speak of T3.
    own = held(Draw(55).vectors(1e-5, 8, 2)) | {"anchored": np.ones(8, bool)}
    yield 22.8, ask({"F_T@0": "T1"}, "every foot with its own anchor", 1, standing(2.0**-12), made=GLUE, **own)
    pair = {"mu": 0.25, "mu_0": 0.5}
    some: Any = {"sliding": np.array([False] * 4 + [True, False, False, True]), **held(TIP * 1.5)}
    yield 62.1, ask({"F_T@0": "T6"}, "between the cones, two feet slid", 1, standing(), made=pair, **some)
    yield 30.5, ask({"x@1": "A1"}, "a lighter block, pushed up", 1, standing(2.0**-12), made=ICE, mass=37.5)
    yield 6.5, fly({"x@1": "A1"}, "falling, leaning", v=DRIFT, Lambda=rotation((0.3, -0.2, 0.5)))
    yield 30.7, ask({"Lambda@1": "A2"}, "pushed up evenly: it does not turn", 1, standing(2.0**-12), made=ICE)
    far = held(TIP * 12)
    yield 54.5, ask({"F_T@0": "T3"}, "stuck until now, far outside both cones", 1, standing(), made=pair, **far)
    one = {"mu": 0.25, "mu_0": 0.25}
    for place, share, where in ((60.3, 1 - 2.0**-20, "inside"), (60.6, 1 + 2.0**-20, "outside")):
        near = held(TIP * share)
        yield place, ask({"F_T@0": "T2"}, f"oblique, a millionth {where}", 1, standing(), made=one, **near)
    cut: Any = {"step": 2.0**-10, "g": 1024.0, "made": SOFT | GLUE, "v": [0.25, 0.125, 0.0625]}
    here = held(np.zeros((8, 2)))
    yield 73.5, ask({"F_T@1": "T5"}, "no load for a moment: the anchor stays", 2, standing(2.0**-13), **cut, **here)


def friction() -> Iterator[tuple[float, Case]]:
    """Yield T1, T6, T3 where no two feet have the same constants."""
    own = GLUE | {"K_T": 5e7 * SHARES, "C_T": 16384.0 * SHARES}
    pulled: Any = {"v": [0.0625, -0.03125, 0.0], **held(np.array([2.0**-18, -(2.0**-17)]) * np.ones((8, 1)))}
    yield 49.5, ask({"F_T@0": "T1"}, "every foot of its own make", 1, standing(), made=own, **pulled)
    each = {"mu": SHARES, "mu_0": SHARES}
    yield 62.2, ask({"F_T@0": "T6"}, "every foot with its own coefficient", 1, standing(), made=each, **held(TIP * 1.2))
    far = held(TIP * 16)
    yield (
        62.4,
        ask({"F_T@0": "T3"}, "every foot with its own coefficient, far outside", 1, standing(), made=each, **far),
    )


def alone() -> Iterator[Case]:
    """Yield all of them."""
    return placed(afloat, tops, feet, friction, strangers)
