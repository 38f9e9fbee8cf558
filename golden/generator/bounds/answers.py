"""What every piece of a backend has to answer, by `exact`: flat inputs in, named results out."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from golden.independent import exact, exact_run
from golden.independent.exact import Point
from golden.independent.exact_run import Body, Moment
from rockref.conformance.vectors.fields import branch_of, part

PROPERTIES = ("K_N", "C_N", "K_T", "C_T", "mu_0", "mu")


def derived(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Apply G1, G2, P1 to P3."""
    names = ("mass", "K_N", "K_T", "beta_int", "beta_ext", "mu_int", "mu_ext")
    made = exact.properties(**{k: q[k] for k in names}, m=m)
    size = {k: q[k] for k in ("width", "depth", "height")}
    return {
        "inertia": exact.cuboid_inertia(q["mass"], **size),
        "P": exact.contact_points(**size, delta_long=q["delta_long"], delta_diag=q["delta_diag"], m=m),
        **made,
    }


def release(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Apply R1."""
    x, Lambda = exact_run.release(q["mass"], q["g"], q["P"], q["K_N"], q["theta_0"], m)
    return {"x": x, "Lambda": Lambda}


def kinematics(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Apply K1 for n points."""
    motions = [exact.kinematics(q["x"], q["Lambda"], q["v"], q["W"], P) for P in q["P"]]
    return {k: [getattr(k_, k) for k_ in motions] for k in ("r", "u", "xi", "xi_rate", "v_slide")}


def contact_law(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Apply N1, N2, T1 to T6."""
    point = Point(*(q[k] for k in PROPERTIES))
    memory = (q["u_t"], q["v_slide"], q["s"], q["anchored"], q["sliding"])
    t = exact.contact(q["xi"], q["xi_rate"], *memory, point, m)
    trace = {f"trace.{k}": getattr(t, k) for k in ("s_trial", "F_trial", "threshold")}
    return {k: getattr(t, k) for k in ("F_N", "F_T", "s", "touching", "sliding")} | trace


def assemble(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Apply A1 to A3."""
    force, moment, T = exact.resultants(q["Lambda"], q["r"], q["F"], q["mass"], q["g"])
    return {"force": force, "moment": moment, "T": T}


def rotate(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Return the exponential of I3."""
    return {"Lambda": exact.exponential(q["Theta"], m)}


def integrate(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Apply I1 to I5, loads prescribed."""
    half = exact.first_half(q["x"], q["v"], q["Lambda"], q["W"], q["a"], q["T"], q["h"], q["inertia"], m)
    v, W = exact.second_half(q["v"], q["a"], q["T"], q["a_next"], q["T_next"], q["h"], q["inertia"], half)
    shown = {k: getattr(half, k) for k in ("x", "Theta", "Lambda", "v_predicted", "W_predicted")}
    return shown | {"v": v, "W": W}


def body_of(q: dict[str, Any]) -> Body:
    """Return the block on its points."""
    made = [Point(*row) for row in zip(*(q[k] for k in PROPERTIES), strict=True)]
    return Body(q["mass"], q["inertia"], q["g"], q["P"], made)


def start_of(q: dict[str, Any]) -> Moment:
    """Return the start state."""
    later: dict[str, Any] = {k: q.get(k) for k in ("a", "T", "F")}
    return Moment(*(q[k] for k in ("x", "v", "Lambda", "W", "s", "anchored", "sliding")), **later)


def step(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Return one full step from a state that brings a, T and F; F and s taken apart by what the points do."""
    after = exact_run.step(body_of(q), exact_run.started(body_of(q), start_of(q), m), q["step"], m)
    found = {k: getattr(after, k) for k in ("x", "v", "Lambda", "W", "anchored", "sliding", "a", "T")}
    branch = branch_of(after.anchored, after.sliding)
    for name, whole in (
        ("F_N", after.F),
        ("F_stick", after.F),
        ("F_slip", after.F),
        ("s_stick", after.s),
        ("s_slip", after.s),
    ):
        found[name] = part(name, np.array(whole, object), branch).tolist()
    return found


def rows_of(q: dict[str, Any], m: Any) -> Iterator[Moment]:
    """Return the rows of a run: the nearest steps to the instants i / output_rate, up to the last whole step."""
    steps = round(float(q["duration"]) / float(q["step"]))
    every = 1 / (float(q["output_rate"]) * float(q["step"]))
    wanted = [math.floor(i * every + 0.5) for i in range(math.floor(steps / every + 1e-9) + 1)]
    return exact_run.run(body_of(q), start_of(q), q["step"], wanted, m)


def pattern(anchored: Iterable[bool], sliding: Iterable[bool]) -> str:
    """Return what every foot does: open -, sticking s, sliding S."""
    return "".join("-" if not on else "S" if slides else "s" for on, slides in zip(anchored, sliding, strict=True))


def patterns(q: dict[str, Any], m: Any) -> list[str]:
    """Return what the feet do in every row."""
    return [pattern(row.anchored, row.sliding) for row in rows_of(q, m)]


def simulate(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Return a short run; `x@1` is x in the row after the first."""
    found: dict[str, Any] = {}
    for i, row in enumerate(rows_of(q, m)):
        found |= {f"{k}@{i}": getattr(row, k) for k in ("W", "x", "Lambda", "F", "anchored")}
        found |= {f"{k}@{i}": part(k, np.array(row.F, object), {}).tolist() for k in ("F_N", "F_T")}
        found[f"x_T@{i}"] = row.x[:2]
    return found


def channel(q: dict[str, Any], m: Any) -> dict[str, Any]:
    """Apply M1 on a history."""
    return {"crv_deg_s": [exact.channel(W, m.pi) for W in q["W"]]}


ANSWERS = {
    f.__name__: f
    for f in (derived, release, kinematics, contact_law, assemble, rotate, integrate, step, simulate, channel)
}
