"""Questions of L1: where one point is (K1), and what the plate does to it (N1, N2, T1 to T6).

Every group shows one rule and keeps the others out of sight: the normal rules are asked without friction, the trial
force under a friction coefficient of a thousand, the cone without history, and so on.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from golden.generator.bounds.bars import FIFTY, Case, answer
from golden.generator.questions.drawing import Draw

#: C_N and C_T of an internal foot by Table 3.1, rounded to few bits.
FOOT = {"K_N": 6e7, "C_N": 17088.0, "K_T": 5e7, "C_T": 15584.0, "mu_0": 0.25, "mu": 0.25}
ZERO = np.zeros(2)
#: Friction so large that only a wrong decision, never a wrong force, ends the sticking.
GLUED = {"mu_0": 1024.0, "mu": 1024.0}
N1, N2, T5 = ("N1", "N1"), ("N2", "N2"), ("T5", "T5")
#: Friction above the plate: who shows a trial force there has an empty cone around it, and lets nothing through.
EMPTY = ("T5", "T2")
STICK = {"F_T": ("T1", "T3"), "trace.F_trial": ("T1", "T1"), "sliding": ("T2", "T2")}
SLIDE = {"F_T": ("T3", "T3"), "sliding": ("T2", "T2"), "s": ("T4", "T4")}


def ask(
    rule: str, fields: dict[str, tuple[str, str]], flags: tuple[str, ...], on_surface=False, **changes: Any
) -> Case:
    """Return a question about one point that has compressed the plate by 10 micrometres, with changes."""
    q: dict[str, Any] = {"xi": 2.0**-17, "xi_rate": 0.0, "u_t": ZERO, "v_slide": ZERO, "s": ZERO}
    q |= {"anchored": True, "sliding": False, **FOOT, **changes}
    case = Case(rule, "L1", "contact_law", q, fields, flags, on_surface)
    everything = {k: ("", "") for k in ("F_N", "F_T", "s", "touching", "sliding", "trace.F_trial", "trace.threshold")}
    found = answer(Case(rule, "L1", "contact_law", q, everything), FIFTY)
    case.branch = {k: found[k] for k in ("touching", "sliding")}
    case.branch["tension cut"] = bool(q["xi"] >= 0 and q["K_N"] * q["xi"] + q["C_N"] * q["xi_rate"] < 0)
    size, limit = float(FIFTY.sqrt(sum(f * f for f in found["trace.F_trial"]))), float(found["trace.threshold"])
    gaps = [abs(q["xi"]) / 1e-5, abs(size - limit) / max(size, limit) if limit else 1.0]
    case.margin = float(f"{min(gaps):.3g}")
    return case


def normal() -> Iterator[Case]:
    """Yield N1: loading, rest, partial rebound, rebound with would-be tension; N2: above the plate."""
    d = Draw(20)
    fields = {"F_N": N1, "touching": T5}
    for _ in range(8):
        yield ask("N1", fields, ("compressing",), xi=d.decade(1e-7, 1e-4), xi_rate=d.decade(1e-3, 1))
    for _ in range(3):
        yield ask("N1", fields, ("at rest",), xi=d.decade(1e-7, 1e-4))
    for share in (0.1, 0.4, 0.7, 0.9):
        xi = d.decade(1e-6, 1e-4)
        yield ask("N1", fields, ("rebound",), xi=xi, xi_rate=-d.between(share, share + 0.05) * xi * 6e7 / 17088)
    for share in (1.01, 1.3, 2.0, 8.0, 50.0):
        xi = d.decade(1e-6, 1e-4)
        yield ask("N1", fields, ("rebound", "would-be tension"), xi=xi, xi_rate=-share * xi * 6e7 / 17088)
    for _ in range(3):
        made = {"K_N": d.decade(1e5, 1e9), "C_N": d.decade(1e2, 1e6)}
        yield ask("N1", fields, ("other foot",), xi=d.decade(1e-6, 1e-4), xi_rate=d.decade(1e-3, 1), **made)
    yield ask("N1", fields, ("undamped",), xi=1.5e-5, xi_rate=-0.5, C_N=0.0)
    yield ask("N1", fields, ("tiny",), xi=2.0**-830, xi_rate=2.0**-820)
    yield ask("N1", {"F_N": N1}, ("touching",), on_surface=True, xi=0.0)
    fields = {"F_N": N2, "touching": T5, "sliding": T5}
    for gap, rate in ((1e-7, 0.5), (1e-6, 0.25), (1e-5, 1.0), (1e-3, 16.0), (0.25, 2000.0)):
        yield ask("N2", fields, ("above the plate", "approaching"), xi=-gap * d.between(0.8, 1.2), xi_rate=rate)
    for gap in (1e-12, 1e-6, 1e-3):
        yield ask("N2", fields, ("above the plate", "receding"), xi=-gap * d.between(0.8, 1.2), xi_rate=-0.25)
    # Above the plate the spring pulls where the gap is wide: the branch alone keeps the force at zero there.
    yield ask("N2", fields, ("above the plate", "at rest"), xi=-3e-5)
    stretched = {"s": np.array([2.0**-16, -(2.0**-17)]), "v_slide": np.array([0.125, 0.25])}
    fields["F_T"] = EMPTY
    yield ask("N2", fields, ("above the plate", "sliding"), xi=-2e-6, xi_rate=0.5, sliding=True, **stretched)


def anchors() -> Iterator[Case]:
    """Yield T5: an anchor that is kept, one that is set anew, one that dies."""
    d = Draw(21)
    kept = {"s": ("T5", "T4"), "trace.s_trial": T5, "touching": T5, "sliding": ("T2", "T2")}
    for i in range(6):
        s, u_t = d.vector(1e-5, 2), d.vector(1e-5, 2)
        v = d.vector(0.03, 2) if i % 2 else ZERO
        yield ask("T5", kept, ("stick", "anchor kept"), xi=d.decade(1e-6, 1e-4), s=s, u_t=u_t, v_slide=v, **GLUED)
    born = {"F_T": T5, "s": T5, "trace.s_trial": T5, "touching": T5, "sliding": ("T2", "T2")}
    for i in range(6):
        stale = d.vector(1e-4, 2) if i else np.array([2.0**-30, 0.0])
        place = {"s": stale, "u_t": d.vector(1e-4, 2), "xi_rate": d.decade(1e-3, 0.3)}
        yield ask("T5", born, ("stick", "touch-down"), xi=d.decade(1e-8, 1e-5), anchored=False, **place, **GLUED)
    gone = {"F_T": EMPTY, "touching": T5, "sliding": T5}
    for sliding in (False, True):
        memory = {"s": d.vector(1e-4, 2), "u_t": d.vector(1e-4, 2), "v_slide": d.vector(0.25, 2), "sliding": sliding}
        yield ask("T5", gone, ("lift-off",), xi=-d.decade(1e-8, 1e-5), xi_rate=-0.125, **memory)


def trial() -> Iterator[Case]:
    """Yield T1: spring alone, damper alone, both, in many directions; glued."""
    d = Draw(22)
    e_x, e_y = np.array([1.0, 0.0]), np.array([0.0, 1.0])
    for axis in (e_x, -e_x, e_y, -e_y):
        yield ask("T1", STICK, ("stick", "spring"), u_t=2.0**-18 * axis, **GLUED)
        yield ask("T1", STICK, ("stick", "damper"), v_slide=2.0**-6 * axis, **GLUED)
    for _ in range(8):
        q = {"u_t": d.vector(1e-5, 2), "s": d.vector(1e-5, 2), "v_slide": d.vector(0.05, 2)}
        yield ask("T1", STICK, ("stick", "spring and damper"), xi=d.decade(1e-6, 1e-4), **q, **GLUED)
    for _ in range(3):
        made = {"K_T": d.decade(1e5, 1e9), "C_T": d.decade(1e2, 1e6), "u_t": d.vector(1e-7, 2), "s": d.vector(1e-7, 2)}
        yield ask("T1", STICK, ("stick", "other foot"), v_slide=d.vector(1e-3, 2), **made, **GLUED)


def towards(direction: float, ratio: float, F_N: float, mu: float) -> np.ndarray:
    """Return stretch s - u at which the trial force has `ratio` times the size of the cone, in that direction [rad]."""
    size = ratio * mu * F_N / FOOT["K_T"]
    return size * np.array([math.cos(direction), math.sin(direction)])


DECIDED = {"sliding": ("T2", "T2"), "trace.threshold": ("T6", "T6")}
#: Sizes of the trial force against the cone.
RATIOS = (
    (0.5, "inside"), (0.9, "inside"), (1 - 2.0**-20, "just inside"), (1 + 2.0**-20, "just outside"), (1.1, "outside"),
    (1.3, "outside"),
)  # fmt: skip


def cone() -> Iterator[Case]:
    """Yield T2: inside, just inside, just outside, outside; with the damper's part; then its edges."""
    d, decided = Draw(23), DECIDED
    for ratio, where in RATIOS:
        for direction in (0.1, 0.75, 2.5, 4.0, 5.2):
            xi = d.decade(1e-6, 1e-4)
            fields = decided | ({"F_T": ("T1", "T3")} if ratio < 1 else {"F_T": ("T3", "T3")})
            s = towards(direction, ratio, xi * 6e7, 0.25)
            yield ask("T2", fields, ("stick" if ratio < 1 else "slip", where, "oblique"), xi=xi, s=s)
    # The damper has its part in the cone: sinking, the cone is wider than the spring makes it; rising, narrower.
    for rate, ratio in ((0.5, 1.25), (0.5, 1.75), (-0.5, 0.75), (-0.5, 0.25)):
        xi = d.decade(1e-6, 1e-4)
        xi_rate = rate * xi * FOOT["K_N"] / FOOT["C_N"]
        fields = decided | {"F_T": ("T1", "T3") if ratio < 1 + rate else ("T3", "T3")}
        s = towards(d.between(0.1, 1.4), ratio, xi * 6e7, 0.25)
        flags = ("stick" if ratio < 1 + rate else "slip", "sinking" if rate > 0 else "rising")
        yield ask("T2", fields, flags, xi=xi, xi_rate=xi_rate, s=s)
    # Pulled by spring and damper against each other: the sum is inside, each alone is outside; and the other way round.
    for spring, damper, flag in ((1.5, -1.0, "stick"), (0.7, 0.6, "slip")):
        F_N, mu = 2.0**-17 * 6e7, 0.25
        v = -damper * mu * F_N / FOOT["C_T"] * np.array([0.6, 0.8])
        yield ask(
            "T2",
            decided,
            (flag, "spring and damper"),
            s=spring * mu * F_N / FOOT["K_T"] * np.array([0.6, 0.8]),
            v_slide=v,
        )
    yield from edges()


def edges() -> Iterator[Case]:
    """Yield T2, T3: on the cone; at its tip; too small to be squared."""
    decided = DECIDED
    surface = {"K_N": 2.0**26, "K_T": 2.0**26, "xi": 5 * 2.0**-19, "mu": 0.5, "mu_0": 0.5}
    for sign in (1, -1):
        s = sign * np.array([3.0, 4.0]) * 2.0**-20
        yield ask("T2", {"sliding": ("T2", "T2")}, ("stick", "on the cone"), on_surface=True, s=s, **surface)
    empty = {"F_T": ("T3", "T3")}
    yield ask("T3", empty, ("stick", "zero trial force"), on_surface=True)
    yield ask("T3", empty, ("stick", "zero trial force", "zero normal force"), on_surface=True, xi=0.0)
    yield ask("T3", empty, ("stick", "zero trial force", "no friction"), on_surface=True, mu=0.0, mu_0=0.0)
    tip = {"xi_rate": -0.5, "s": np.array([2.0**-17, 2.0**-18])}
    yield ask("T3", SLIDE, ("slip", "zero normal force"), **tip)
    yield ask("T3", SLIDE, ("slip", "zero normal force"), v_slide=np.array([-0.125, 0.5]), **tip)
    # The square of 2^-560 is no double: a length by squares would be zero and stick.
    small = {"xi": 2.0**-700, "s": np.array([3.0, 4.0]) * 2.0**-590}
    yield ask("T2", decided | {"F_T": ("T3", "T3")}, ("slip", "tiny"), **small)
    yield ask("T2", decided | {"F_T": ("T3", "T3")}, ("slip", "tiny"), xi=2.0**-900, s=np.array([0.0, 1.0]) * 2.0**-600)


def two_coefficients() -> Iterator[Case]:
    """Yield T6: mu_0 above mu, between the two cones and on either side, for points that stuck and points that slid."""
    d = Draw(24)
    made = {"mu_0": 0.5, "mu": 0.25}
    for ratio, sliding in ((1.5, False), (1.5, True), (1.05, False), (1.05, True), (1.95, False), (1.95, True)):
        for _ in range(2):
            xi = d.decade(1e-6, 1e-4)
            s = towards(d.between(0, 6.2), ratio, xi * 6e7, 0.25)
            fields = {"sliding": ("T6", "T6"), "trace.threshold": ("T6", "T6")}
            if sliding:
                fields["F_T"] = ("T3", "T3")
            yield ask(
                "T6", fields, ("slip" if sliding else "stick", "between the cones"), xi=xi, s=s, sliding=sliding, **made
            )
    # Sinking at such a rate that the damper doubles the normal force.
    for ratio, sliding in ((3.0, False), (3.0, True)):
        xi = d.decade(1e-6, 1e-4)
        s, rate = towards(d.between(0, 6.2), ratio, xi * 6e7, 0.25), xi * FOOT["K_N"] / FOOT["C_N"]
        fields = {"sliding": ("T6", "T6"), "trace.threshold": ("T6", "T6")}
        flags = ("slip" if sliding else "stick", "between the cones", "sinking")
        yield ask("T6", fields, flags, xi=xi, xi_rate=rate, s=s, sliding=sliding, **made)
    for ratio in (2.2, 3.0):
        s = towards(d.between(0, 6.2), ratio, 2.0**-17 * 6e7, 0.25)
        yield ask("T3", SLIDE, ("slip", "outside both cones"), s=s, **made)


def whatever_else() -> Iterator[Case]:
    """Yield T6 between the cones of feet that rise or sink, and that are dragged on or back: nothing but what they did
    before decides which cone is theirs."""
    d = Draw(27)
    fields = {"sliding": ("T6", "T6"), "trace.threshold": ("T6", "T6")}
    for share, dragged in ((-0.4, 0.0), (-0.2, 0.5), (0.3, -0.5), (-0.3, -0.4), (0.0, 0.5), (0.0, -0.5)):
        for slid in (False, True):
            xi, way = d.decade(1e-6, 1e-4), d.between(0, 6.2)
            F_N = (1 + share) * xi * FOOT["K_N"]
            # Spring and damper together pull by one and a half times the smaller cone.
            s, v = towards(way, 1.5 - dragged, F_N, 0.25), -towards(way, dragged, F_N, 0.25) * FOOT["K_T"] / FOOT["C_T"]
            rate = share * xi * FOOT["K_N"] / FOOT["C_N"]
            flags = ("slip" if slid else "stick", "between the cones", "moving")
            yield ask("T6", fields, flags, xi=xi, xi_rate=rate, s=s, v_slide=v, sliding=slid, mu_0=0.5, mu=0.25)


def sliding() -> Iterator[Case]:
    """Yield T3 and T4: the force that remains, and the anchor that follows; with and without damper; in many
    directions."""
    d = Draw(25)
    for i in range(14):
        xi = d.decade(1e-6, 1e-4)
        s = towards(d.between(0, 6.2), d.between(1.2, 6), xi * 6e7, 0.25)
        v = d.vector(0.02, 2) if i % 2 else ZERO
        fields, flags = dict(SLIDE), ("slip", "spring and damper" if i % 2 else "spring")
        yield ask(
            "T3" if i < 8 else "T4", fields, flags, xi=xi, u_t=d.vector(1e-3, 2), s=s, v_slide=v, sliding=i % 3 == 0
        )
    for _ in range(4):
        q = {"v_slide": d.vector(0.5, 2), "anchored": False, "s": d.vector(1e-4, 2), "u_t": d.vector(1e-3, 2)}
        yield ask("T4", SLIDE, ("slip", "touch-down"), xi=d.decade(1e-7, 1e-5), xi_rate=d.decade(1e-3, 0.1), **q)
    for _ in range(4):
        q = {"v_slide": d.vector(0.5, 2), "s": d.vector(1e-4, 2), "u_t": d.vector(1e-4, 2), "sliding": True}
        yield ask("T3", SLIDE, ("slip", "established"), xi=d.decade(1e-6, 1e-5), xi_rate=d.between(-0.01, 0.1), **q)


def where() -> Iterator[Case]:
    """Yield K1: at rest, moving, turning about each axis, leaning, all at once; two points each."""
    d = Draw(26)
    fields = {k: ("K1", "K1") for k in ("r", "u", "xi", "xi_rate", "v_slide")}
    P = np.array([[0.046875, 0.03125, -0.34375], [-0.046875, 0.0625, -0.34375]])
    rest = {"x": np.array([0.0, 0.0, 0.34375]), "Lambda": np.eye(3), "v": np.zeros(3), "W": np.zeros(3), "P": P}

    def ask_where(flag: str, **changes: Any) -> Case:
        return Case("K1", "L1", "kinematics", rest | changes, fields, (flag,))

    yield ask_where("displaced", x=np.array([0.5, -0.25, 0.34375 - 2.0**-17]))
    yield ask_where("moving", v=np.array([0.5, -0.25, -0.125]))
    for i in range(3):
        yield ask_where("turning", W=np.eye(3)[i] * 0.75)
    lean = d.rotation(0.2)
    yield ask_where("leaning", Lambda=lean)
    for i in range(3):
        yield ask_where("leaning and turning", Lambda=lean, W=np.eye(3)[i] * 0.75)
    for _ in range(4):
        q = {"x": d.vector(0.5), "Lambda": d.rotation(1.0), "v": d.vector(1), "W": d.vector(3)}
        yield ask_where("all at once", **q, P=d.vectors(0.4, 2))


def all_points() -> Iterator[Case]:
    """Yield every question of L1."""
    for group in (where, normal, anchors, trial, cone, two_coefficients, sliding):
        yield from group()
