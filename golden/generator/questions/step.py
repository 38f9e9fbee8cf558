"""Questions of L4: one full step from a state of a run, one for every pattern of contact and sliding that occurs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from golden.generator.bounds.answers import body_of, start_of
from golden.generator.bounds.arithmetic import Doubles, converted
from golden.generator.bounds.bars import Case
from golden.generator.questions.drawing import orthonormal, table_3_1
from golden.generator.questions.scenes import Scene, released, scenes
from golden.independent import exact, exact_run
from rockref.conformance.vectors import problem_of
from rockref.engines import run

#: Scenes in which the patterns are looked for.
LOOKED_AT = (
    "table_3_1", "out_of_plane", "spinning", "two_coefficients", "planar", "four_points", "oblique_inertia", "slide",
    "static", "drop",
)  # fmt: skip
#: Occurrences of a pattern among which the one farthest from a switching surface is taken.
CANDIDATES = 8
FIELDS = {
    "x": "I1",
    "Lambda": "I3",
    "F_N": "S1",
    "anchored": "T5",
    "sliding": "T2",
    "F_stick": "T1",
    "s_stick": "T5",
    "F_slip": "T3",
    "s_slip": "T4",
    "a": "A1",
    "T": "A2",
    "v": "I4",
    "W": "I5",
}
STATE = ("x", "v", "Lambda", "W", "s", "anchored", "sliding")


def states(scene: Scene) -> Any:
    """Return the scene with a row for every step."""
    problem = problem_of(scene.inputs)
    return run(replace(problem, output_rate=1 / scene.step), engine="auto")


def at_row(scene: Scene, response: Any, row: int) -> dict[str, Any]:
    """Return inputs of a step from that row, with a and T as its point forces make them."""
    q = scene.q | {k: np.array(getattr(response, k)[row]) for k in STATE}
    q["Lambda"] = orthonormal(q["Lambda"])
    F = np.array(response.F[row])
    numbers = {k: converted(q[k], float) for k in ("mass", "g", "Lambda", "P")}
    levers = [exact.apply(numbers["Lambda"], P) for P in numbers["P"]]
    force, _, T = exact.resultants(numbers["Lambda"], levers, F.tolist(), numbers["mass"], numbers["g"])
    a = [f / numbers["mass"] for f in force]
    return (
        q
        | {"F": F, "a": np.array(a), "T": np.array(T), "step": scene.step}
        | {"duration": scene.step, "output_rate": 1e5}
    )


def margin(q: dict[str, Any]) -> float:
    """Return relative distance of the step from its nearest switching surface: contact, tension cut, cone, over all
    points."""
    numbers = {k: converted(v, float) for k, v in q.items()}
    body, state = body_of(numbers), start_of(numbers)
    m = Doubles
    half = exact.first_half(state.x, state.v, state.Lambda, state.W, state.a, state.T, numbers["step"], body.J, m)
    least = 1.0
    touches, *_ = exact_run.evaluate(body, state, half.x, half.Lambda, half.v_predicted, half.W_predicted, m)
    for touch, P, point in zip(touches, body.P, body.made, strict=True):
        k = exact.kinematics(half.x, half.Lambda, half.v_predicted, half.W_predicted, P)
        least = min(least, abs(k.xi) / 1e-6)
        if touch.touching:
            spring, damper = point.K_N * k.xi, point.C_N * k.xi_rate
            least = min(least, abs(spring + damper) / (abs(spring) + abs(damper)))
            size, limit = m.hypot(*touch.F_trial), touch.threshold
            if limit:
                least = min(least, abs(size - limit) / (size + limit))
    return least


def patterns(response: Any) -> dict[bytes, np.ndarray]:
    """Return every pattern of contact and sliding, and the rows from which a step leads to it."""
    code = response.anchored.astype(np.uint8) + (response.anchored & response.sliding)
    found: dict[bytes, list[int]] = {}
    for row, pattern in enumerate(code[1:]):
        found.setdefault(pattern.tobytes(), []).append(row)
    return {k: np.array(rows) for k, rows in found.items()}


def steps() -> Iterator[Case]:
    """Yield one question per pattern, from the scene where it comes first."""
    seen: set[bytes] = set()
    for name in LOOKED_AT:
        yield from of_scene(scenes()[name], seen)


def elsewhere() -> Iterator[Case]:
    """Yield questions of another block under another gravity: a code that has the source's numbers in its step is
    seen."""
    block = table_3_1() | {"mass": 60.0, "g": 3.75}
    yield from of_scene(Scene("elsewhere", "60 kg, 3.75 m/s2", released(block), 0.05, whole=False), set())


def of_scene(scene: Scene, seen: set[bytes]) -> Iterator[Case]:
    """Yield one question per pattern of a scene that is not among the `seen` ones, to which they are added."""
    name, response = scene.id, states(scene)
    for pattern, rows in patterns(response).items():
        if pattern not in seen:
            seen.add(pattern)
            some = rows[np.linspace(0, len(rows) - 1, min(CANDIDATES, len(rows))).round().astype(int)]
            asked = [at_row(scene, response, int(row)) for row in some]
            margins = [margin(q) for q in asked]
            best = int(np.argmax(margins))
            kinds = {0: "open", 1: "stick", 2: "slip"}
            branch = {kind: [i for i, c in enumerate(pattern) if kinds[c] == kind] for kind in ("stick", "slip")}
            fields = {k: (rule, rule) for k, rule in FIELDS.items() if k[2:] not in branch or branch[k[2:]]}
            flags = (name, f"t = {response.t[some[best]]:.5f} s", "".join("-sS"[c] for c in pattern))
            # A pattern that is met on a switching surface only, to rounding, cannot be told from its neighbour.
            if margins[best] > 1e-7:
                yield Case(
                    "S1", "L4", "step", asked[best], fields, flags, branch=branch, set=name, margin=margins[best]
                )
