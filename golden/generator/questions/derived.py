"""Questions of L0 (what follows from the parameters, the release posture) and L7 (the measured channel)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from golden.generator.bounds.bars import Case
from golden.generator.questions.drawing import (
    DELTA_DIAG,
    DELTA_LONG,
    MASS,
    TABLE,
    THETA_0,
    Draw,
    G,
    table_3_1,
)

FIELDS = {
    "inertia": ("G1", "G1"),
    "P": ("G2", "G2"),
    "K_N": ("P1", "P1"),
    "K_T": ("P1", "P1"),
    "C_N": ("P2", "P2"),
    "C_T": ("P3", "P3"),
    "mu_0": ("P3", "P3"),
    "mu": ("P3", "P3"),
}


def parameters(width: float, depth: float, height: float, **changes: float) -> dict:
    """Return inputs of `derived`."""
    q = {"mass": MASS, "width": width, "depth": depth, "height": height, **TABLE}
    return q | {"delta_long": np.array(DELTA_LONG), "delta_diag": DELTA_DIAG} | changes


def derived() -> Iterator[Case]:
    """Yield G1, G2, P1 to P3: each rule has its vectors, on Table 3.1 and on blocks whose three sides differ."""
    d = Draw(10)
    questions = [parameters(0.1, 0.1, 0.688), parameters(0.125, 0.0625, 0.75), parameters(0.25, 0.5, 0.625, mass=80.0)]
    for _ in range(2):
        q = parameters(d.between(0.05, 0.2), d.between(0.05, 0.2), d.between(0.4, 0.9), mass=d.between(10, 90))
        q |= {k: d.between(0.5, 1.5) * v for k, v in TABLE.items()} | {"delta_long": d.vector(1e-4, 4)}
        questions.append(q | {"delta_diag": d.between(2e-3, 9e-3)})
    for rule in ("G1", "G2", "P1", "P2", "P3"):
        for i, q in enumerate(questions):
            flags = ("table 3.1",) if i == 0 else ("three sides",)
            fields = {k: v for k, v in FIELDS.items() if v[0] == rule}
            yield Case(rule, "L0", "derived", q, fields, flags)


def released(q: dict, theta: float, flag: str) -> Case:
    """Apply R1 of a block on its points by Table 3.1, changed, at that tilt [rad]."""
    inputs = {k: q[k] for k in ("mass", "P", "K_N")} | {"g": q.get("g", G), "theta_0": theta}
    return Case("R1", "L0", "release", inputs, {"x": ("R1", "R1"), "Lambda": ("R1", "R1")}, (flag,))


def stiffened(q: dict) -> dict:
    """Return the same with stiffnesses of which hardly two are alike."""
    return q | {"K_N": q["K_N"] * np.array([1, 1.5, 1, 1.25, 0.75, 1, 1, 2])}


def release() -> Iterator[Case]:
    """Yield R1: both pivots bear half the weight, on even and uneven feet and stiffnesses."""
    base = table_3_1()
    yield released(base, THETA_0, "table 3.1")
    yield released(table_3_1(delta_long=(0.0, 2e-4, 1e-4, 0.0)), 0.09375, "uneven feet")
    yield released(stiffened(base), 0.0625, "uneven stiffness")


def inner_pivots() -> Iterator[Case]:
    """Yield R1 where external feet are so high that the block leans on internal ones: on one, on two."""
    yield released(table_3_1(delta_long=(0.0, 8e-4, 1e-4, 0.0)), 0.09375, "an internal pivot")
    yield released(stiffened(table_3_1(delta_long=(9e-4, 8e-4, 0.0, 0.0))), 0.09375, "two internal pivots")


def elsewhere() -> Iterator[Case]:
    """Yield R1 of another mass, under another gravity: what is not looked at when the source's numbers stand in the
    code."""
    yield released(table_3_1() | {"mass": 37.5, "g": 3.75}, THETA_0, "another mass and gravity")


def channel() -> Iterator[Case]:
    """Yield M1: histories of five samples, the block upright and well tilted."""
    d = Draw(17)
    for angle, size in ((0.0, 1.0), (0.2, 1.0), (0.2, 1e-3), (1.0, 20.0), (3.0, 0.5)):
        inputs = {"W": d.vectors(size, 5), "Lambda": np.stack([d.rotation(angle) for _ in range(5)])}
        yield Case("M1", "L7", "channel", inputs, {"crv_deg_s": ("M1", "M1")}, (f"tilt up to {angle:g} rad",))
