"""Questions of L2 (assembly) and L3 (rotation and integrator)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from golden.generator.bounds.bars import Case
from golden.generator.questions.drawing import Draw, diagonal, normalised, rotation, table_3_1, turned

UPRIGHT = np.eye(3)
J_BLOCK = diagonal(2.1484375, 2.25, 0.0901336669921875)
J_TOP = diagonal(0.5, 1.25, 2.0)


def assembly() -> Iterator[Case]:
    """Yield A1 to A3: no force, one force, eight; upright and leaning; forces that nearly cancel."""
    d = Draw(30)
    P = table_3_1()["P"]
    force, moment = {"force": ("A1", "A1")}, {"force": ("A1", "A1"), "moment": ("A2", "A2"), "T": ("A2", "A3")}

    def ask(
        rule: str, fields: dict, flags: tuple[str, ...], F: np.ndarray, Lambda: np.ndarray = UPRIGHT, **other: float
    ) -> Case:
        inputs = {"Lambda": Lambda, "r": turned(Lambda, P[: len(F)]), "F": F, "mass": 54.0, "g": 9.81, **other}
        return Case(rule, "L2", "assemble", inputs, fields, flags)

    yield ask("A1", force, ("weight alone",), np.zeros((8, 3)))
    for i in range(3):
        yield ask("A1", force, ("one force",), 256.0 * np.eye(3)[i : i + 1])
    for _ in range(4):
        yield ask("A1", force, ("eight forces",), d.vectors(2000, 8))
    for i in range(3):
        yield ask("A2", moment, ("one force",), 256.0 * np.eye(3)[i : i + 1])
    for _ in range(5):
        yield ask("A2", moment, ("eight forces", "upright"), d.vectors(2000, 8))
    pair = d.vectors(2000, 4)
    yield ask("A2", moment, ("forces nearly cancel", "upright"), np.concatenate([pair, -pair]))
    leaning = {"T": ("A3", "A3"), "moment": ("A2", "A2")}
    for i in range(3):
        yield ask("A3", leaning, ("eight forces", "leaning"), d.vectors(2000, 8), rotation(0.75 * np.eye(3)[i]))
    for angle in (0.1, 0.2, 1.0, 3.0):
        for _ in range(2):
            yield ask("A3", leaning, ("eight forces", "leaning"), d.vectors(2000, 8), d.rotation(angle))
    yield ask("A1", force, ("weight alone", "another gravity"), np.zeros((8, 3)), g=3.75)
    yield ask("A1", force, ("weight alone", "another mass"), np.zeros((8, 3)), mass=37.5)


#: Angles [rad] of the exponential, on both sides of where a series may be exchanged for another.
SIZES = (
    (1e-9, "tiny"), (6.5e-6, "one step"), (1e-5, "one step"), (1e-4, "small"), (1e-3, "small"), (0.008, "small"),
    (0.0099, "small"), (0.0101, "small"), (0.03, "small"), (0.1, "moderate"), (0.3, "moderate"), (1.0, "moderate"),
    (2.0, "moderate"), (3.0, "near a half turn"), (3.140625, "near a half turn"), (3.14159, "near a half turn"),
)  # fmt: skip


def exponentials() -> Iterator[Case]:
    """Yield I3, the exponential: zero, tiny, about the switch between series, moderate, near a half turn."""
    d = Draw(31)
    fields = {"Lambda": ("I3", "I3")}

    def ask(flag: str, Theta: np.ndarray) -> Case:
        return Case("I3", "L3", "rotate", {"Theta": Theta}, fields, (flag,))

    for i in range(3):
        yield ask("about an axis", np.eye(3)[i] * 0.5)
    for size, flag in SIZES:
        yield ask(flag, size * normalised(d.vector(1)))


#: The rule of each result of a step under prescribed loads.
RULES = {"x": "I1", "Theta": "I2", "Lambda": "I3", "v_predicted": "S1", "W_predicted": "S1", "v": "I4", "W": "I5"}
J_FULL = np.array([[1.0, 0.25, -0.125], [0.25, 1.5, 0.0625], [-0.125, 0.0625, 0.75]])


def integrated(rule: str, names: str, *flags: str, **changes: Any) -> Case:
    """Return a step under prescribed loads, from rest at the origin but for the changes."""
    q: dict[str, Any] = dict.fromkeys(("x", "v", "W", "a", "T", "a_next", "T_next"), np.zeros(3))
    q = {"x": q["x"], "v": q["v"], "Lambda": np.eye(3)} | q | {"h": 2.0**-16, "inertia": J_BLOCK} | changes
    return Case(rule, "L3", "integrate", q, {k: (RULES[k], RULES[k]) for k in names.split()}, flags)


def steps() -> Iterator[Case]:
    """Yield I1 to I5 with prescribed loads: each rule by itself, then the torque-free top and steady spins."""
    d = Draw(32)
    yield from poses(d)
    yield from rates(d)


def poses(d: Draw) -> Iterator[Case]:
    """Yield I1 to I3: where a step ends, and how far it turns."""
    yield integrated("I1", "x", "moving", x=d.vector(0.5), v=d.vector(1))
    yield integrated("I1", "x", "falling", a=np.array([0, 0, -9.8125]))
    for h in (2.0**-16, 1e-5, 2.0**-10):
        yield integrated("I1", "x", "moving and falling", x=d.vector(2.0**-10), v=d.vector(1), a=d.vector(20), h=h)
    under = "spinning under a moment"
    for h in (1e-5, 2.0**-10):
        yield integrated("I2", "Theta", "turned by a moment", T=d.vector(300), h=h)
        yield integrated("I2", "Theta", "torque-free", W=d.vector(20), h=h, inertia=J_TOP)
        yield integrated("I2", "Theta", under, W=d.vector(5), T=d.vector(300), h=h, inertia=J_TOP)
    loads: dict[str, Any] = {"W": d.vector(5), "T": d.vector(300)}
    yield integrated("I2", "Theta", under, "oblique inertia", h=2.0**-10, inertia=J_FULL, **loads)
    for i in range(3):
        yield integrated("I3", "Lambda", "steady spin", W=np.eye(3)[i] * 3.0, Lambda=d.rotation(0.5), h=2.0**-10)
    for h in (1e-5, 2.0**-10, 2.0**-5):
        ball: dict[str, Any] = {"W": d.vector(6), "Lambda": d.rotation(0.5), "inertia": diagonal(1.0, 1.0, 1.0)}
        yield integrated("I3", "Lambda", "spinning", "ball", h=h, **ball)


def rates(d: Draw) -> Iterator[Case]:
    """Yield S1, I4, I5: the velocities that are predicted, and those at the end of a step."""
    for h in (1e-5, 2.0**-10):
        q = {"v": d.vector(1), "a": d.vector(20), "W": d.vector(3), "T": d.vector(300), "h": h}
        yield integrated("S1", "v_predicted W_predicted", "predicted velocities", **q)
    q = {"v": d.vector(1), "a": d.vector(20), "W": d.vector(8), "T": d.vector(30), "h": 2.0**-8, "inertia": J_TOP}
    yield integrated("S1", "v_predicted W_predicted", "predicted velocities", **q)
    for h in (1e-5, 2.0**-10, 2.0**-6):
        yield integrated("I4", "v", "accelerated", v=d.vector(1), a=d.vector(30), a_next=d.vector(30), h=h)
    yield integrated("I5", "W", "old moment alone", T=d.vector(300), h=2.0**-10)
    yield integrated("I5", "W", "new moment alone", T_next=d.vector(300), h=2.0**-10)
    for i in range(3):
        yield integrated("I5", "W", "steady spin", W=np.eye(3)[i] * 3.0, h=2.0**-8, inertia=J_TOP)
    for h in (1e-5, 2.0**-10, 2.0**-6, 2.0**-4):
        W = d.vector(20) if h < 0.01 else d.vector(6)
        yield integrated("I5", "W", "torque-free top", W=W, h=h, inertia=J_TOP)
    for h, J, more in (
        (1e-5, J_TOP, ()),
        (2.0**-10, J_TOP, ()),
        (2.0**-8, J_TOP, ()),
        (2.0**-10, J_FULL, ("oblique inertia",)),
    ):
        loads = {"W": d.vector(5), "T": d.vector(300), "T_next": d.vector(300)}
        yield integrated("I5", "W", "spinning under a moment", *more, h=h, inertia=J, **loads)


def no_rotation() -> Iterator[Case]:
    """Yield I3 of the vector that is exactly zero: nothing is moved, and nothing is divided by nothing."""
    fields = {"Lambda": ("I3", "I3")}
    yield Case("I3", "L3", "rotate", {"Theta": np.zeros(3)}, fields, ("zero",), on_surface=True)


def hardly_turned() -> Iterator[Case]:
    """Yield I3 of turns far below a nanoradian: they are turns."""
    d = Draw(33)
    for size in (2.0**-30, 2.0**-34):
        fields = {"Lambda": ("I3", "I3")}
        yield Case("I3", "L3", "rotate", {"Theta": size * normalised(d.vector(1))}, fields, ("tiny",))
