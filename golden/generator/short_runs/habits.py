"""Short runs (L5s) for what programs do of themselves: they put slow bodies to rest, count eight feet, remember the run
before, show flags a row late, take small turns for none, add turns up, and leave a force where a foot has opened.

They stand behind all others; `place` says between which they are judged. Three are asked one after another.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from golden.generator.bounds.bars import Case
from golden.generator.questions.drawing import Draw, diagonal, rotation, table_3_1
from golden.generator.questions.scenes import EVEN, PER_POINT
from golden.generator.short_runs.alone import DRIFT, SHARES, TIP, UNLOADED, fly
from golden.generator.short_runs.askew import C_T
from golden.generator.short_runs.basic import ASIDE, GLUE, ICE, IN, UP, WEIGHTLESS, Z, ask, held, placed, standing

#: So slow that engines take a body for one at rest [m/s, rad/s]; the way of a step still has all its digits.
SLOW = 2.0**-22
ALL = np.ones(8, bool)
#: All eight feet are down.
DEEP = standing(2.0**-12)


def slowly() -> Iterator[tuple[float, Case]]:
    """Yield S2 and I4, I3 and I5 of a block that drifts and turns by less than a micrometre a second."""
    drift = np.array(DRIFT) * SLOW
    fields = {"x_T@1": "S2", "x_T@2": "I4"}
    yield 0.9, fly(fields, "drifting by less than a micrometre a second", 2, v=drift, **UNLOADED)
    spun: Any = {"inertia": diagonal(1.0, 1.0, 1.0), "W": Draw(80).vector(4) * SLOW}
    fields = {"Lambda@1": "I3", "Lambda@2": "I5"}
    yield 8.65, fly(fields, "a ball that hardly turns", 2, **spun, **UNLOADED)


def small_turns() -> Iterator[tuple[float, Case]]:
    """Yield I3 of turns between those of a long step and those whose squares round away."""
    ball: Any = {"inertia": diagonal(1.0, 1.0, 1.0), "W": Draw(81).vector(4)}
    for place, h in ((8.7, 2.0**-13), (8.71, 2.0**-18)):
        yield place, fly({"Lambda@1": "I3"}, "spinning ball, a small turn", step=h, **ball)


#: Four feet of their own, and these behind the eight.
MORE = np.array([[0.03125, 0, 0], [-0.0625, 0.0078125, 0], [0, 0.046875, 0], [0.015625, -0.03125, 0]]) - UP * Z
TWELVE = np.concatenate([table_3_1(delta_long=EVEN)["P"], MORE])


def on_other_feet(case: Case, P: np.ndarray, **memory: np.ndarray) -> Case:
    """Return the same question of a block on other feet; `memory`: what they remember, nothing by default."""
    n = len(P)
    feet = {k: np.full(n, case.inputs[k][0]) for k in PER_POINT if k != "P"}
    feet |= {"s": np.zeros((n, 2)), "anchored": np.zeros(n, bool), "sliding": np.zeros(n, bool)} | memory
    return replace(case, inputs=case.inputs | feet | {"P": P, "names": [f"foot {i}" for i in range(n)]})


def other_numbers() -> Iterator[tuple[float, Case]]:
    """Yield N1 of a block that sinks on twelve feet, and on three: their forces, or the next row."""
    for place, P, flag in ((22.91, TWELVE, "twelve"), (22.92, MORE[:3], "three")):
        sinking = ask({"F_N@0": "N1"}, f"{flag} feet, compressing", 1, standing(), made=ICE, v=-0.125 * Z)
        yield place, on_other_feet(sinking, P)


def flags() -> Iterator[tuple[float, Case]]:
    """Yield S2 of flags: in which row feet touch that come down."""
    # Half-way between two steps, whatever the integrator makes of the fall.
    v = -0.125 * Z
    above = standing(-1.5 * 0.125 * 2.0**-17)
    rows = {f"anchored@{i}": "S2" for i in (1, 2, 3)}
    yield 18.6, ask(rows, "the row in which feet touch", 3, above, made=ICE, stand=False, v=v)


def tied() -> Iterator[tuple[float, Case]]:
    """Yield T5 of springs alone under a block that turns: the anchors do not."""
    turning: Any = {"W": [0.25, -0.5, 2.0], "made": GLUE | {"C_T": 0.0}, **held(np.full((8, 2), 2.0**-18))}
    yield 64.1, ask({"F_T@1": "T5"}, "anchors stay while the block turns, springs alone", 2, standing(), **turning)


def one_after_another() -> Iterator[tuple[float, Case]]:
    """Yield T3, T6, T5: a run at whose end all feet slide, one whose feet stick, and one whose feet touch anew. Who
    forgets to forget what the run before left has other coefficients, and other anchors."""
    pair = {"mu": 0.25, "mu_0": 0.5}
    here = held(np.zeros((8, 2))) | {"anchored": ALL}
    # Three times the cone of the deepest feet.
    v = 3 * 0.5 * 32 * IN * 6e7 / C_T * np.array([0.8, -0.6, 0.0])
    yield 54.6, ask({"F_T@0": "T3"}, "all feet slide to the end", 2, DEEP, made=pair, v=v, sliding=ALL, **here)
    # The shallow feet are 2^-12 - 5e-5 deep; the deep ones hold more.
    near = held(TIP * 32 * 1.2) | {"anchored": ALL}
    yield 62.3, ask({"F_T@0": "T6"}, "between the cones, after a run that slid", 1, DEEP, made=pair, **near)
    anew: Any = {"v": [0.0625, -0.03125, 0.0], "made": GLUE}
    yield 45.1, ask({"F_T@0": "T5"}, "touching anew, after a run whose feet were tied", 1, DEEP, **anew)


def turned_and_tied() -> Iterator[tuple[float, Case]]:
    """Yield I5 of a body that has turned by a radian since the start, and T1 of friction below a newton."""
    d = Draw(82, 53)
    top: Any = {"W": d.vector(8), "Lambda": d.rotation(0.5), "step": 2.0**-7, "every": 16.0}
    yield 16.8, fly({"W@1": "I5"}, "torque-free top, turned by a radian", 16, **top)
    hardly: Any = {"v": [d.between(1e-6, 2e-6), -1e-6, 0.0], "every": 2.0, **held(d.vectors(1e-9, 8, 2))}
    yield 49.9, ask({"F_T@0": "T1"}, "spring and damper below a newton", 2, standing(), made=GLUE, **hardly)


def let_go() -> Iterator[tuple[float, Case]]:
    """Yield N2 of feet without dampers, which open while their springs push: nothing is left of their forces."""
    made = ICE | {"K_N": 2.0**17, "K_T": 2.0**17, "C_N": 0.0}
    flag = "opening while the springs push"
    yield 22.95, ask({"F_N@1": "N2"}, flag, 2, standing(2.0**-13), made=made, step=2.0**-10, v=Z)


def turned_twice() -> Iterator[tuple[float, Case]]:
    """Yield I3 of the second turn of a top: turns about other axes do not add up."""
    d = Draw(83, 53)
    top: Any = {"W": d.vector(8), "Lambda": d.rotation(0.5), "step": 2.0**-7}
    yield 16.9, fly({"Lambda@2": "I3"}, "torque-free top, the second turn", 2, **top)


def rising() -> Iterator[tuple[float, Case]]:
    """Yield T1 of feet that rise while they are dragged: the damper of friction does not ask for the direction."""
    up: Any = {"v": [0.0625, -0.03125, 2.0**-8], **held(Draw(84).vectors(1e-5, 8, 2))}
    yield 49.95, ask({"F_T@0": "T1"}, "spring and damper while rising", 1, standing(), made=GLUE, **up)


def pulled_back() -> Iterator[tuple[float, Case]]:
    """Yield T4 of feet that slide for one step, and are pulled back: where the anchor has been left.

    From the static threshold, and from less than half a micrometre beyond the only one.
    """
    way = np.array([0.8, 0.6, 0.0])
    for place, share, mu_0, flag in (
        (73.2, 3.0, 0.5, "slides for a step from the static threshold"),
        (73.3, 1.2, 0.25, "slides for a step by less than half a micrometre"),
    ):
        made = {"mu": 0.25, "mu_0": mu_0, "C_T": 0.0}
        yield place, ask({"F_T@1": "T4"}, flag, 2, standing(), made=made, v=0.0625 * way, **held(TIP * share))


def loads() -> Iterator[tuple[float, Case]]:
    """Yield A1 of a block that falls while it turns, I4 of one that the start alone pulls sideways."""
    turning: Any = {"v": DRIFT, "W": Draw(85).vector(4), "Lambda": rotation((0.3, -0.2, 0.5))}
    yield 6.6, fly({"x@1": "A1"}, "falling while it turns", **turning)
    pulled: Any = {"g": WEIGHTLESS, "a": np.array([3.0, -2.0, 1.5]), "T": np.zeros(3), "F": np.zeros((8, 3))}
    yield 8.05, fly({"x_T@2": "I4"}, "pulled by what the start brings, the second step", 2, v=DRIFT, **pulled)


def thrown_up() -> Iterator[tuple[float, Case]]:
    """Yield N2 of feet that leave the plate in a step at whose end they come down again: they are open, and damp
    nothing."""
    made = ICE | {"K_N": 100.0, "K_T": 100.0, "C_N": 1.0}
    # Up by three quarters of what gravity takes away in a step.
    up: Any = {"step": 2.0**-10, "g": 1024.0, "v": 0.75 * Z, **held(np.zeros((8, 2)))}
    yield 22.96, ask({"F_N@1": "N2"}, "open after a step, and coming down", 2, standing(2.0**-13), made=made, **up)


def in_flight() -> Iterator[tuple[float, Case]]:
    """Yield I1 of a leaning block: its velocity is the plate's; A1 of a fall of four steps: none is like the others
    where loads add up."""
    oblique = rotation((0.3, -0.2, 0.5))
    drift: Any = {"v": Draw(87, 53).vector(1), "g": WEIGHTLESS, "Lambda": oblique}
    yield 4.65, fly({"x@1": "I1"}, "drifting without a weight, leaning", **drift)
    pulled: Any = {"a": -9.81 * Z, "T": np.zeros(3), "F": np.zeros((8, 3))}
    for place, v in ((8.06, DRIFT), (8.07, (-2.0, 4.0, 8.0))):
        yield place, fly({"x@4": "A1"}, "falling, four steps", 4, v=v, **pulled)


def sliding_on() -> Iterator[tuple[float, Case]]:
    """Yield T6 of eight feet that slide on between the cones, each its own way: who asks whether a foot slides by the
    force that sliding leaves decides by a rounding."""
    # Dampers beyond both cones; a step later every spring is stretched by less than what lies between them.
    fast: Any = {"v": [-1.1, -0.9, 0.0], "W": [0.0, 0.0, 3.0], **held(Draw(86).vectors(1e-6, 8, 2)), "anchored": ALL}
    made = {"mu": 0.25, "mu_0": 0.5}
    fields = {f"F_T@{i}": "T6" for i in (1, 2, 3)}
    yield 64.48, ask(fields, "eight feet slide on, between the cones", 4, DEEP, made=made, **fast)


def at_once() -> Iterator[tuple[float, Case]]:
    """Yield I3 of a ball that hardly turns, and brings no loads; T2 of feet that slide in the step in which they touch;
    T6 between the cones of feet that rise and of feet that sink."""
    spun: Any = {"inertia": diagonal(1.0, 1.0, 1.0), "W": Draw(88).vector(4) * SLOW}
    yield 8.66, fly({"Lambda@1": "I3"}, "a ball that hardly turns, falling", **spun)
    # Three times the cone of the deepest feet, by dampers alone: wherever the anchors are, they pull by nothing.
    v = 3 * 0.25 * 32 * IN * 6e7 / C_T * np.array([-0.6, 0.8, 0.0])
    made = {"mu": 0.25, "mu_0": 0.25, "K_T": 1.0}
    yield 60.8, ask({"F_T@0": "T2"}, "touching anew, and sliding", 1, DEEP, made=made, v=v)
    # A damper takes a quarter of the normal force, or adds one.
    for place, share, slid in ((62.12, 0.75, False), (62.14, 1.25, True)):
        up = (1 - share) * IN * 6e7 / float(table_3_1(delta_long=EVEN)["C_N"][4])
        some: Any = {"v": up * Z, "sliding": ALL & slid, **held(TIP * 1.5 * share)}
        flag = f"between the cones, {'sinking, slid' if slid else 'rising, stuck'}"
        yield place, ask({"F_T@0": "T6"}, flag, 1, standing(), made={"mu": 0.25, "mu_0": 0.5}, **some)


def pushed_for_long() -> Iterator[tuple[float, Case]]:
    """Yield N1 of numbers that have all their bits, for who shows no forces: a long step shows more digits of them."""
    d = Draw(89, 53)
    # No two feet are alike: they turn the block, too.
    made = ICE | {"K_N": d.between(5e7, 6e7) * SHARES, "C_N": d.between(1e4, 2e4) * SHARES}
    long: Any = {"made": made, "step": 2.0**-14}
    for place, flag, v in ((22.71, "standing", 0.0), (22.72, "compressing", d.between(0.1, 0.2))):
        deep = standing(d.between(1e-3, 2e-3))
        yield place, ask({"F_N@0": "N1"}, f"{flag}, all bits, a long step", 1, deep, v=-v * Z, **long)


def eight_feet() -> Iterator[tuple[float, Case]]:
    """Yield N1, T1, T6, T3 of all eight feet, no two alike: the outer ones have constants of their own, too."""
    made = ICE | {"K_N": 6e7 * SHARES, "C_N": 16384.0 * SHARES}
    yield 22.61, ask({"F_N@0": "N1"}, "eight feet, each of its own make", 1, DEEP, made=made, v=-0.125 * Z)
    made = GLUE | {"K_T": 5e7 * SHARES, "C_T": 16384.0 * SHARES}
    way = np.array([2.0**-18, -(2.0**-17)]) * np.ones((8, 1))
    pulled: Any = {"v": [0.0625, -0.03125, 0.0], **held(way), "anchored": ALL}
    yield 49.51, ask({"F_T@0": "T1"}, "eight feet, each of its own make", 1, DEEP, made=made, **pulled)
    each = {"mu": SHARES, "mu_0": SHARES}
    # A long step for those that slide: after sixteen steps they show more than their sliding forces.
    for place, rule, share, flag, h in (
        (62.21, "T6", 1.2, "", 2.0**-17),
        (62.41, "T3", 16.0, ", far outside", 2.0**-14),
    ):
        some, says = held(TIP * 32 * share) | {"anchored": ALL}, f"eight feet, each with its own coefficient{flag}"
        yield place, ask({"F_T@0": rule}, says, 1, DEEP, made=each, step=h, **some)


def in_later_rows() -> Iterator[tuple[float, Case]]:
    """Yield S1 of a third evaluation: its velocities are not those of the second; T5 of feet that touched anew: they
    are tied to where they did, and not to an anchor of before."""
    yield 33.1, ask({"F_N@2": "S1"}, "the third evaluation", 3, standing(), made=ICE, v=-0.125 * Z)
    anew: Any = {"s": ASIDE + np.full((8, 2), 2.0**-10), "v": [0.0625, -0.03125, 0.0], "made": GLUE}
    flag = "touch-down far from the old anchor, a step later"
    yield 64.405, ask({"F_T@1": "T5"}, flag, 2, standing(), **anew)


def habits() -> Iterator[Case]:
    """Yield all of them."""
    return placed(
        slowly, small_turns, other_numbers, flags, tied, one_after_another, turned_and_tied, let_go, turned_twice,
        rising, pulled_back, loads, thrown_up, in_flight, sliding_on, at_once, pushed_for_long,
        eight_feet, in_later_rows,
    )  # fmt: skip
