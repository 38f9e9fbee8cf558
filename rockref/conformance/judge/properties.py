"""L6: what every backend must satisfy, at states that nobody has chosen. Needs hypothesis.

Each property is a sentence of mechanics; hypothesis draws the states and looks for the smallest one that breaks it.
The tolerances are those of rounding: so many ulps of the largest term, with the number of operations behind them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from rockref.conformance.backends.call import as_mapping, has, raised
from rockref.conformance.judge.negligible import ANGLE, FORCE, MOMENT
from rockref.conformance.vectors import trajectory
from rockref.model.problem import Problem, State

#: Relative rounding of a handful of operations, 64 ulps; a wrong term changes the result by many orders more.
ROUNDING = 64 * np.finfo(float).eps
#: Height of the centre of mass [m] with the internal feet 5 micrometres in the plate.
STANDING = 0.344 - 5e-6
FOOT = {"K_N": 6e7, "C_N": 17088.0, "K_T": 5e7, "C_T": 15584.0}


@dataclass(frozen=True)
class PropertyCheck:
    """One property: its sentence, whether it held for all examples, and the smallest one that broke it."""

    name: str
    holds: bool
    note: str = ""


def plane(size: float) -> st.SearchStrategy[np.ndarray]:
    """Return plane vectors."""
    part = st.floats(-size, size, allow_subnormal=False)
    return st.tuples(part, part).map(np.array)


def space(size: float) -> st.SearchStrategy[np.ndarray]:
    """Return space vectors."""
    part = st.floats(-size, size, allow_subnormal=False)
    return st.tuples(part, part, part).map(np.array)


POINTS = st.fixed_dictionaries(
    {
        "xi": st.floats(-1e-4, 1e-4, allow_subnormal=False),
        "xi_rate": st.floats(-1, 1, allow_subnormal=False),
        "u_t": plane(1e-3),
        "v_slide": plane(0.5),
        "s": plane(1e-3),
        "anchored": st.booleans(),
        "sliding": st.booleans(),
        "mu": st.floats(0.01, 1.0),
    }
)


def point(q: dict[str, Any]) -> dict[str, Any]:
    """Return inputs of the contact law: a foot of Table 3.1 with one coefficient; who is not anchored does not
    slide."""
    return q | FOOT | {"mu_0": q["mu"], "sliding": q["sliding"] and q["anchored"]}


def upright(run: str, z: float, steps: int, v: Any = (0, 0, 0), W: Any = (0, 0, 0)) -> Problem:
    """Return the block of a shipped run, upright at height z [m], with these rates, for so many steps of 1e-5 s."""
    problem = trajectory(run).problem
    start = State.at_rest(np.array([0.0, 0.0, z]), np.eye(3), problem.points.n, np.array(v, float), np.array(W, float))
    return replace(problem, start=start, duration=steps * problem.step, output_rate=1 / problem.step)


def no_tension(backend: Any, q: dict[str, Any]) -> None:
    """Assert that the normal force never pulls, and is zero above the plate."""
    F_N = float(as_mapping(backend.contact_law(**point(q)), "contact_law")["F_N"])
    assert F_N >= 0, f"F_N = {F_N}"
    assert q["xi"] >= 0 or F_N == 0, f"F_N = {F_N} at xi = {q['xi']}"


def inside_the_cone(backend: Any, q: dict[str, Any]) -> None:
    """Assert that friction is never larger than mu F_N."""
    out = as_mapping(backend.contact_law(**point(q)), "contact_law")
    size, limit = float(np.hypot(*out["F_T"])), q["mu"] * float(out["F_N"])
    assert size <= limit * (1 + ROUNDING) + FORCE, f"|F_T| = {size}, mu F_N = {limit}"


def anchor_fits_the_force(backend: Any, q: dict[str, Any]) -> None:
    """Assert that after the step spring to the anchor and damper give the friction force, sticking or sliding."""
    # A foot that is exactly at the plate may be held to be open: a conforming backend has > for >= there.
    if q["xi"] <= 0:
        return
    p = point(q)
    out = as_mapping(backend.contact_law(**p), "contact_law")
    spring, damper = -p["K_T"] * (q["u_t"] - np.asarray(out["s"])), -p["C_T"] * q["v_slide"]
    # The spring is the difference of two places: each is rounded, and multiplied by the stiffness.
    scale = p["K_T"] * (np.abs(q["u_t"]).max() + np.abs(out["s"]).max()) + np.abs(damper).max()
    off = np.abs(spring + damper - np.asarray(out["F_T"])).max()
    assert off <= ROUNDING * scale + FORCE, f"spring + damper is off by {off} N"


def same_in_every_direction(backend: Any, q: dict[str, Any]) -> None:
    """Assert that the plate, turned by a quarter about the vertical, answers with the turned force."""

    def quarter(a: np.ndarray) -> np.ndarray:
        return np.array([-a[1], a[0]])

    turned = q | {k: quarter(q[k]) for k in ("u_t", "v_slide", "s")}
    one, other = (as_mapping(backend.contact_law(**point(p)), "contact_law") for p in (q, turned))
    off = np.abs(quarter(np.asarray(one["F_T"])) - np.asarray(other["F_T"])).max()
    assert off <= ROUNDING * np.abs(one["F_T"]).max() + FORCE, f"off by {off} N"


def rotations_are_rotations(backend: Any, Theta: np.ndarray) -> None:
    """Assert that exp(Theta^) is orthogonal, and exp(-Theta^) undoes it."""
    there, back = (np.asarray(as_mapping(backend.rotate(Theta=t), "rotate")["Lambda"]) for t in (Theta, -Theta))
    off = max(np.abs(there @ there.T - np.eye(3)).max(), np.abs(there @ back - np.eye(3)).max())
    assert off <= max(ROUNDING, ANGLE), f"off by {off}"


def free_flight_keeps_momentum(backend: Any, W: np.ndarray) -> None:
    """Assert that far above the plate the angular momentum in plate axes stays, in a run of 20 steps."""
    problem = upright("table_3_1", 2.0, 20, W=W)
    out = as_mapping(backend.simulate(problem), "simulate")
    J = problem.block.inertia
    momentum = np.array([L @ (J @ w) for L, w in zip(np.asarray(out["Lambda"]), np.asarray(out["W"]), strict=True)])
    off = np.abs(momentum - momentum[0]).max()
    assert off <= max(20 * ROUNDING * np.abs(J @ W).max(), MOMENT), f"momentum drifts by {off} kg m2/s"


def mirrored(backend: Any, v: np.ndarray) -> None:
    """Assert that a run mirrored at the plane y-z is the mirrored run: an upright block, pushed."""
    mirror = np.array([-1.0, 1.0, 1.0])
    one, other = (
        as_mapping(backend.simulate(upright("planar", STANDING, 10, v=u)), "simulate") for u in (v, v * mirror)
    )
    # Feet in another order meet another order of sums: the rounding of forces of a kilonewton on 54 kg in ten steps.
    off = np.abs(np.asarray(one["x"]) * mirror - np.asarray(other["x"])).max()
    assert off <= 1e-13, f"off by {off} m"


def apart(backend: Any, W: np.ndarray) -> float:
    """Return by how much the rates of two runs of one problem differ [rad/s], five steps on the feet."""
    problem = upright("table_3_1", STANDING, 5, W=W)
    one, other = (np.asarray(as_mapping(backend.simulate(problem), "simulate")["W"], float) for _ in range(2))
    return 0.0 if np.array_equal(one, other) else float(np.max(np.abs(one - other)))


def deterministic(backend: Any, W: np.ndarray) -> None:
    """Assert that the same question has the same answer, to rounding."""
    off = apart(backend, W)
    assert off <= ANGLE, f"two runs of the same problem differ by {off} rad/s"


def bit_by_bit(backend: Any) -> str:
    """Return a remark where two runs of one problem differ in their bits; "" where they do not."""
    # Rates of nearly nothing show the last bits of a moment.
    off = max(apart(backend, np.array(W)) for W in ((3e-9, -2e-9, 1e-9), (-7e-9, 4e-9, 2e-9), (1e-9, 9e-9, -6e-9)))
    return f"Two runs of one problem differ in their bits, by up to {off:.2g} rad/s in five steps." if off else ""


PROPERTIES: tuple[tuple[str, Callable[[Any, Any], None], st.SearchStrategy[Any]], ...] = (
    ("contact_law", no_tension, POINTS),
    ("contact_law", inside_the_cone, POINTS),
    ("contact_law", anchor_fits_the_force, POINTS),
    ("contact_law", same_in_every_direction, POINTS),
    ("rotate", rotations_are_rotations, space(1.8)),
    ("simulate", free_flight_keeps_momentum, space(5.0)),
    ("simulate", mirrored, space(0.2)),
    ("simulate", deterministic, space(1.0)),
)


def judge_properties(backend: Any, examples: int = 100) -> list[PropertyCheck]:
    """Return all properties whose piece the backend shows, with so many examples each; the same examples every time."""
    return [judge_one(backend, rule, drawn, examples) for piece, rule, drawn in PROPERTIES if has(backend, piece)]


def judge_one(
    backend: Any, rule: Callable[[Any, Any], None], drawn: st.SearchStrategy[Any], examples: int
) -> PropertyCheck:
    """Return one property."""
    quiet = settings(
        max_examples=examples,
        derandomize=True,
        database=None,
        deadline=None,
        suppress_health_check=list(HealthCheck),
        phases=(Phase.explicit, Phase.generate, Phase.shrink),
    )

    @quiet
    @given(drawn)
    def holds(q: Any) -> None:
        try:
            rule(backend, q)
        except SystemExit as e:
            raise RuntimeError(f"asked to end the program ({e})") from e

    sentence = (rule.__doc__ or rule.__name__).splitlines()[0].removeprefix("Assert that ")
    try:
        holds()
    except Exception as e:  # the backend may raise anything
        return PropertyCheck(sentence, False, raised(e))
    return PropertyCheck(sentence, True)
