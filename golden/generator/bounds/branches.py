"""The branch that a vector exercises: which case of the law its inputs fall into, in fifty digits.

A branch is stated where the law itself has cases (the series of the exponential, the pivots of the release), and else
by which terms of the equation are at work: a term that is zero is not tested.
"""

from __future__ import annotations

from typing import Any

import mpmath

from golden.generator.bounds.answers import patterns, release
from golden.generator.bounds.arithmetic import converted
from golden.generator.bounds.bars import FIFTY, Case
from golden.independent import exact

#: Below this angle [rad] sin(q)/q rounds to one in float64: q^2/6 < 2^-53.
TINY = float(mpmath.sqrt(mpmath.mpf(6) * mpmath.mpf(2) ** -53))
#: Where the law takes the longer series [rad], and from where on an angle is near a half turn [rad].
SHORT_SERIES, NEAR_HALF_TURN = 0.01, 2.95
#: Forces cancel where no component of their sum is above this share of the largest component.
CANCELLED = 2.0**-20


def some(numbers: Any) -> bool:
    """Return whether any number of nested lists is not zero."""
    return any(map(some, numbers)) if isinstance(numbers, list) else numbers != 0


def turn(Theta: list, m: Any) -> str:
    """Return size of a rotation increment Theta (3,) [rad], by the ways in which its exponential can be computed."""
    angle = m.sqrt(exact.dot(Theta, Theta))
    if angle == 0:
        return "none"
    sizes = ((TINY, "tiny"), (SHORT_SERIES, "short series"), (NEAR_HALF_TURN, "long series"))
    return next((name for limit, name in sizes if angle <= limit), "near a half turn")


def leaning(Lambda: list) -> bool:
    """Return whether body axes differ from plate axes: Lambda (3, 3) is not the identity."""
    return some([[c - (i == j) for j, c in enumerate(row)] for i, row in enumerate(Lambda)])


def derived(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Return cross-section; external feet above and below the internal plane; which feet damp and rub more."""
    ends = {name: ("external" if q[f"{k}_ext"] > q[f"{k}_int"] else "internal") for name, k in
            (("more damping", "beta"), ("more friction", "mu"))}  # fmt: skip
    raised = q["delta_long"]
    return {
        "cross-section": "square" if q["width"] == q["depth"] else "oblong",
        "raised": [i for i, d in enumerate(raised) if d > 0],
        "lowered": [i for i, d in enumerate(raised) if d < 0],
        **ends,
    }


def released(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Return the feet that stand in the plate, and whether they are equally stiff."""
    posture = release(q, m)
    places = [exact.kinematics(posture["x"], posture["Lambda"], 3 * [0], 3 * [0], P) for P in q["P"]]
    pivots = [i for i, k in enumerate(places) if k.xi > 0]
    return {"pivots": pivots, "equally stiff": len({q["K_N"][i] for i in pivots}) == 1}


def kinematics(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Return terms at work, feet in the plate, feet that approach it."""
    motions = [exact.kinematics(q["x"], q["Lambda"], q["v"], q["W"], P) for P in q["P"]]
    return {
        "leaning": leaning(q["Lambda"]),
        "moving": some(q["v"]),
        "turning": some(q["W"]),
        "in the plate": [i for i, k in enumerate(motions) if k.xi >= 0],
        "approaching": [i for i, k in enumerate(motions) if k.xi_rate > 0],
    }


def assemble(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Return feet that carry a force, axes along which forces act, whether the sum cancels, whether the body axes are
    turned."""
    columns = [list(column) for column in zip(*q["F"], strict=True)]
    largest = max(abs(f) for column in columns for f in column)
    sums = [abs(sum(column)) for column in columns]
    return {
        "loaded": [i for i, F in enumerate(q["F"]) if some(F)],
        "axes": "".join(name for name, column in zip("xyz", columns, strict=True) if some(column)),
        "cancels": bool(largest) and max(sums) <= CANCELLED * largest,
        "leaning": leaning(q["Lambda"]),
    }


def rotate(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Return size of the increment."""
    return {"turn": turn(q["Theta"], m)}


def integrate(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Return terms at work, size of the increment, kind of inertia."""
    J = q["inertia"]
    half = exact.first_half(q["x"], q["v"], q["Lambda"], q["W"], q["a"], q["T"], q["h"], J, m)
    acts = [k for k in ("v", "a", "a_next", "W", "T", "T_next") if some(q[k])]
    acts += ["W x J W"] if some(exact.cross(q["W"], half.JW)) else []
    products = some([J[i][j] for i in range(3) for j in range(3) if i != j])
    ball = len({J[i][i] for i in range(3)}) == 1
    return {
        "acts": acts,
        "turn": turn(half.Theta, m),
        "inertia": "products" if products else "ball" if ball else "principal axes",
    }


def channel(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Return samples in which body axes are not plate axes, and the signs of the rates in each."""
    return {
        "leaning": [i for i, Lambda in enumerate(q["Lambda"]) if leaning(Lambda)],
        "signs": ["".join("+" if w > 0 else "-" if w < 0 else "0" for w in W) for W in q["W"]],
    }


def simulate(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Return what every foot does in every row: open -, sticking s, sliding S."""
    return {"rows": patterns(q, m)}


BRANCHES = {"release": released} | {
    f.__name__: f for f in (derived, kinematics, assemble, rotate, integrate, channel, simulate)
}


def branch(case: Case) -> dict[str, Any]:
    """Return the branch of a question: the one that it brings, or what its inputs say."""
    q = {k: converted(v, FIFTY.number) for k, v in case.inputs.items()}
    return case.branch or BRANCHES[case.piece](q, FIFTY)
