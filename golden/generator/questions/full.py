"""Questions whose numbers have all their bits, and those of feet that touch anew, that slid, that are deep (L1 to L3).

Who computes with fewer bits than a double is not seen where the numbers that are asked for have few themselves.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from golden.generator.bounds.bars import Case
from golden.generator.questions.drawing import Draw, diagonal, table_3_1, turned
from golden.generator.questions.point import FOOT, GLUED, N1, STICK, T5, ask, towards

ALL = ("all bits",)


def contact() -> Iterator[Case]:
    """Yield N1, T5, T1, T6, T3 of one foot."""
    d = Draw(60, 53)
    for _ in range(3):
        q = {"u_t": d.vector(1e-5, 2), "s": d.vector(1e-5, 2), "v_slide": d.vector(0.05, 2)}
        yield ask("T1", STICK, ("stick", "spring and damper", *ALL), xi=d.decade(1e-6, 1e-4), **q, **GLUED)
    # Rising slowly enough that the foot still presses.
    for share in (0.5, 1.5, -0.5):
        xi = d.decade(1e-6, 1e-5)
        falling = {"xi": xi, "xi_rate": share * xi * FOOT["K_N"] / FOOT["C_N"], "u_t": d.vector(1e-4, 2)}
        yield ask("N1", {"F_N": N1, "touching": T5}, ("first touch", *ALL), anchored=False, **falling)
    for xi in (3.5e-4, 7e-4, 1.5e-3):
        yield ask("N1", {"F_N": N1}, ("deep", *ALL), xi=xi, xi_rate=d.between(-0.2, 0.2))
    pair = {"mu_0": 0.5, "mu": 0.25}
    traced = {"trace.s_trial": T5, "trace.F_trial": ("T1", "T1"), "trace.threshold": ("T6", "T6")}
    for ratio in (0.6, 1.5, 4.0):
        xi, u_t = d.decade(1e-6, 1e-5), d.vector(1e-4, 2)
        s = u_t + towards(d.between(0, 6.2), ratio, xi * FOOT["K_N"], 0.25)
        fields = traced | {"F_T": ("T1", "T3") if ratio < 1 else ("T3", "T3")}
        yield ask("T5", fields, ("slid before", *ALL), xi=xi, u_t=u_t, s=s, sliding=True, **pair)
    # A new foot between the cones: it has not slid, wherever it was. The damper alone pulls.
    for _ in range(2):
        xi = d.decade(1e-5, 1e-4)
        v = towards(d.between(0, 6.2), 1.5, xi * FOOT["K_N"], 0.25) * FOOT["K_T"] / FOOT["C_T"]
        fields = {"sliding": ("T6", "T6"), "trace.threshold": ("T6", "T6")}
        yield ask("T6", fields, ("first touch", "between the cones", *ALL), xi=xi, v_slide=v, anchored=False, **pair)


def where() -> Iterator[Case]:
    """Yield K1 of a block that leans and turns."""
    d = Draw(61, 53)
    fields = {k: ("K1", "K1") for k in ("r", "u", "xi", "xi_rate", "v_slide")}
    for _ in range(2):
        q = {"x": d.vector(0.5), "Lambda": d.rotation(1.0), "v": d.vector(1), "W": d.vector(3)}
        yield Case("K1", "L1", "kinematics", q | {"P": d.vectors(0.4, 2)}, fields, ("all at once", *ALL))


def points() -> Iterator[Case]:
    """Yield all of L1."""
    yield from contact()
    yield from where()
    d = Draw(68, 53)
    none = {"mu_0": 0.0, "mu": 0.0, "s": d.vector(1e-5, 2), "xi": d.decade(1e-6, 1e-5)}
    yield ask("T3", {"F_T": ("T3", "T3")}, ("slip", "no friction", *ALL), **none)
    yield from hardly_loaded()


def eight_places() -> Iterator[Case]:
    """Yield K1 of eight points, no two alike: a slip of one of them, or of its neighbour, shows."""
    d = Draw(92, 53)
    fields = {k: ("K1", "K1") for k in ("r", "u", "xi", "xi_rate", "v_slide")}
    q = {"x": d.vector(0.5), "Lambda": d.rotation(1.0), "v": d.vector(1), "W": d.vector(3)}
    yield Case("K1", "L1", "kinematics", q | {"P": d.vectors(0.4, 8)}, fields, ("eight points", "all at once", *ALL))


def hardly_loaded() -> Iterator[Case]:
    """Yield N1 of feet that carry from a newton down to a tenth of a micronewton: a tolerance of a code's own shows
    there."""
    d = Draw(69, 53)
    for xi in (8e-9, 1e-10, 1e-12, 2e-15):
        at = xi * d.between(0.8, 1.2)
        yield ask("N1", {"F_N": N1, "touching": T5}, ("hardly loaded", *ALL), xi=at)
        rate = 0.5 * at * FOOT["K_N"] / FOOT["C_N"]
        yield ask("N1", {"F_N": N1, "touching": T5}, ("hardly loaded", "compressing", *ALL), xi=at, xi_rate=rate)


def assembly() -> Iterator[Case]:
    """Yield A1 to A3: eight forces; one foot down, the block leaning."""
    d = Draw(62, 53)
    P = table_3_1()["P"]
    force, moment, T = {"force": ("A1", "A1")}, {"moment": ("A2", "A2")}, {"T": ("A3", "A3")}

    def sums(rule: str, fields: dict, flags: tuple[str, ...], Lambda: np.ndarray, feet: Any) -> Case:
        F = np.zeros((8, 3))
        F[feet] = d.vectors(2000, len(F[feet]))
        inputs = {"Lambda": Lambda, "r": turned(Lambda, P), "F": F, "mass": d.between(30, 80), "g": 9.81}
        return Case(rule, "L2", "assemble", inputs, fields, (*flags, *ALL))

    every, upright = slice(None), np.eye(3)
    for _ in range(2):
        yield sums("A1", force, ("eight forces",), upright, every)
        yield sums("A2", moment, ("eight forces", "upright"), upright, every)
        yield sums("A3", moment | T, ("eight forces", "leaning"), d.rotation(1.0), every)
    for foot in (2, 5):
        fields = force | moment | T
        yield sums("A3", fields, ("one foot down", "leaning"), d.rotation(0.2), slice(foot, foot + 1))


def steps() -> Iterator[Case]:
    """Yield I1 to I5, S1 under prescribed loads, and the exponential."""
    d = Draw(63, 53)
    yield Case("I3", "L3", "rotate", {"Theta": d.vector(0.5)}, {"Lambda": ("I3", "I3")}, ("moderate", *ALL))
    rules = {"x": "I1", "Theta": "I2", "Lambda": "I3", "v_predicted": "S1", "W_predicted": "S1", "v": "I4", "W": "I5"}
    for rule, names in (("I1", "x"), ("I2", "Theta"), ("I3", "Lambda"), ("I4", "v"), ("I5", "W")):
        q: dict[str, Any] = {k: d.vector(1) for k in ("x", "v")} | {k: d.vector(20) for k in ("a", "a_next")}
        q |= {"W": d.vector(5), "T": d.vector(30), "T_next": d.vector(30), "Lambda": d.rotation(0.5)}
        q |= {"h": 2.0**-10, "inertia": diagonal(0.5, 1.25, 2.0)}
        fields = {k: (rules[k], rules[k]) for k in names.split()}
        yield Case(rule, "L3", "integrate", q, fields, ("spinning under a moment", *ALL))
