"""Common slips, told in words before a rule is named: units, signs, axes, a rotation transposed, rows a row late.

All answers to one result of one piece are held against what a slip makes of the expected ones. A slip is told where it
explains every number of them, to a millionth.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import permutations
from typing import Any

import numpy as np

from rockref.conformance.judge.compare_answer import LOOK, Check, weighed_in_bars
from rockref.conformance.vectors import Vector, problem_of
from rockref.conformance.vectors.fields import Missing, result

#: A slip explains a number to this share of the largest of its result. Decided: far above rounding, far below a slip.
SAME = 1e-6
#: An answer is off where it differs by this share. Decided.
OFF = 1e-3
#: Ratios with a name: what was given, in the place of what.
RATIOS = (
    (180 / np.pi, "degrees for radians"), (np.pi / 180, "radians for degrees"), (-1.0, "the other sign"),
    (1e3, "a thousandth of the unit (mm for m)"), (1e-3, "a thousand times the unit (km for m)"),
    (1e6, "a millionth of the unit (um for m)"), (9.81, "a g too much (N for kg)"),
    (1 / 9.81, "a g missing (kg for N)"),
    (2.0, "twice"), (0.5, "half"), (8.0, "eight times: once for each foot"), (1 / 8, "an eighth: shared by the feet"),
    (2 * np.pi, "rad/s for turns"), (1 / (2 * np.pi), "turns for rad/s"),
)  # fmt: skip
AXES = "XYZ"
#: Vectors in body axes, and in plate axes, by result.
IN_BODY, IN_PLATE = ("W", "T", "crv_deg_s", "W_predicted", "Theta"), ("x", "v", "moment", "force", "r")


@dataclass(frozen=True)
class Pair:
    """One expected result and what was given: `before` the row before it, `start` and `Lambda` the poses that belong
    to it; None where there are none. `apart`: rows lie several steps apart, and of the step before nothing is known."""

    name: str
    expected: np.ndarray
    got: np.ndarray
    failed: bool
    before: np.ndarray | None = None
    start: np.ndarray | None = None
    Lambda: np.ndarray | None = None
    apart: bool = False


#: What a slip makes of a pair's expected result (None: it says nothing of it), and the slip in words.
Slip = tuple[Callable[[Pair], "np.ndarray | None"], str]


def pairs_of(vector: Vector, out: dict[str, Any], failed: set[str]) -> Iterator[Pair]:
    """Yield the numbers of one vector with their answers."""
    apart = float(vector.inputs.get("step", 1.0)) * float(vector.inputs.get("output_rate", 1.0)) < 1 - 1e-9
    for name, e in vector.expect.items():
        try:
            got = np.asarray(result(name, out, vector.branch), float)
        except (Missing, TypeError, ValueError, IndexError):
            continue
        if e.value.dtype == bool or got.shape != e.value.shape or not np.all(np.isfinite(got)):
            continue
        base, _, row = name.partition("@")
        before = None
        if row and int(row) > 0:
            known = vector.expect.get(f"{base}@{int(row) - 1}")
            origin = vector.inputs.get(base.removesuffix("_T")) if int(row) == 1 else None
            before = known.value if known else None if origin is None else np.asarray(origin)[..., : len(e.value)]
        start = vector.inputs.get("Lambda")
        yield Pair(name, e.value, got, name in failed, before, start, _pose(vector, row), apart)


def _pose(vector: Vector, row: str) -> np.ndarray | None:
    """Return the pose that belongs to a result: that of its row, or of the inputs."""
    known = vector.expect.get(f"Lambda@{row}") if row else None
    return known.value if known else vector.inputs.get("Lambda")


def ratio(factor: float) -> Callable[[Pair], np.ndarray | None]:
    """Return the expected result times a factor; a rotation by so many times the angle."""

    def made(p: Pair) -> np.ndarray | None:
        if p.expected.shape[-2:] != (3, 3):
            return factor * p.expected
        if p.name.partition("@")[0] != "Lambda":
            return factor * p.expected
        start = np.eye(3) if p.start is None else p.start
        turn = rotation_vector(start.T @ p.expected)
        return None if not np.any(turn) else start @ exponential(factor * turn)

    return made


def rotation_vector(R: np.ndarray) -> np.ndarray:
    """Return the vector (3,) [rad] whose exponential is a rotation (3, 3)."""
    axial = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    size = float(np.sqrt(axial @ axial))
    return axial if size < 1e-12 else axial / size * np.arctan2(size, (np.trace(R) - 1) / 2)


def exponential(Theta: np.ndarray) -> np.ndarray:
    """Return exp(Theta^) (3, 3) of a vector of any size but zero: the law's own refuses whole turns in a step."""
    x, y, z = Theta
    H, size = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]), np.sqrt(Theta @ Theta)
    return np.eye(3) + np.sin(size) / size * H + 2 * (np.sin(size / 2) / size) ** 2 * H @ H


def axes(order: Sequence[int], signs: Sequence[int]) -> Callable[[Pair], np.ndarray | None]:
    """Return the axes in another order, with signs."""

    def made(p: Pair) -> np.ndarray | None:
        if p.expected.shape[-1:] != (3,) or p.name.partition("@")[0] in ("Lambda", "inertia"):
            return None
        return p.expected[..., list(order)] * np.array(signs)

    return made


def transposed(p: Pair) -> np.ndarray | None:
    """Return a rotation the other way."""
    return np.swapaxes(p.expected, -1, -2) if p.name.partition("@")[0] == "Lambda" else None


def quaternion_order(shift: int) -> Callable[[Pair], np.ndarray | None]:
    """Return a rotation whose quaternion is read with its scalar at the other end."""
    from rockref.model.rotation import from_quaternion, quaternion

    def made(p: Pair) -> np.ndarray | None:
        if p.name.partition("@")[0] != "Lambda":
            return None
        return from_quaternion(np.roll(quaternion(p.expected), shift, axis=-1))

    return made


def turned(names: tuple[str, ...], back: bool) -> Callable[[Pair], np.ndarray | None]:
    """Return components in the other axes."""

    def made(p: Pair) -> np.ndarray | None:
        if p.name.partition("@")[0] not in names or p.Lambda is None:
            return None
        Lambda = np.swapaxes(p.Lambda, -1, -2) if back else p.Lambda
        if Lambda.ndim == 2:
            return p.expected @ Lambda.T
        return np.einsum("nij,nj->ni", Lambda, p.expected)

    return made


def row_late(p: Pair) -> np.ndarray | None:
    """Return the row before; what was given, where nothing is known of it."""
    if p.name == "crv_deg_s":
        return np.concatenate([p.got[:1], p.expected[:-1]])
    return p.got if p.apart else p.before


def slips() -> Iterator[Slip]:
    """Yield all slips, the plainest first."""
    yield transposed, "got is the transpose of what is expected: the rotation the other way"
    for factor, words in RATIOS:
        yield ratio(factor), f"got/expected = {factor:.6g}: {words}"
    for shift in (1, -1):
        yield (
            quaternion_order(shift),
            "got is the rotation of the quaternion with its scalar at the other end (wxyz, xyzw)",
        )
    for order in list(permutations(range(3)))[1:]:
        fixed = [i for i in range(3) if order[i] == i]
        a, b = (AXES[i] for i in range(3) if i not in fixed) if fixed else ("", "")
        said = f"{a} and {b} exchanged" if fixed else "in the order " + " ".join(AXES[i] for i in order)
        yield axes(order, (1, 1, 1)), f"got are the components {said}"
    for i in range(3):
        signs = [-1 if k == i else 1 for k in range(3)]
        yield axes((0, 1, 2), signs), f"got has {AXES[i]} with the other sign"
        yield axes((0, 1, 2), [-s for s in signs]), f"got has all but {AXES[i]} with the other sign"
    yield turned(IN_BODY, False), "got = Lambda expected: plate axes for body axes"
    yield turned(IN_BODY, True), "got = Lambda^T expected: turned back where nothing is to be turned"
    yield turned(IN_PLATE, True), "got = Lambda^T expected: body axes for plate axes"
    yield row_late, "got are the numbers of the row before: a row late"


def explains(slip: Slip, pairs: list[Pair]) -> bool:
    """Return whether a slip gives every number that was given, and the right ones do not."""
    seen = 0
    for p in pairs:
        made = slip[0](p)
        if made is None or made.shape != p.got.shape:
            return False
        size = float(np.max(np.abs(p.expected), initial=0.0))
        scale = max(size, float(np.max(np.abs(made), initial=0.0)))
        if np.max(np.abs(p.got - made), initial=0.0) > SAME * scale:
            return False
        seen += bool(np.max(np.abs(made - p.expected), initial=0.0) > OFF * size > 0)
    # One number by itself may be anything by chance.
    return seen >= 2


def told(answers: list[tuple[Vector, dict[str, Any]]], checks: list[Check]) -> str:
    """Return the slip that explains all answers to a result that is outside, in words; "" where there is none."""
    failed: dict[str, set[str]] = {}
    for c in checks:
        if c.failed and c.weighed:
            failed.setdefault(c.vector, set()).add(c.name)
    groups: dict[tuple[str, str], list[Pair]] = {}
    for vector, out in answers:
        for p in pairs_of(vector, out, failed.get(vector.id, set())):
            groups.setdefault((vector.piece, p.name.partition("@")[0]), []).append(p)
    found = []
    for (piece, base), pairs in groups.items():
        if any(p.failed for p in pairs):
            words = next((s[1] for s in slips() if explains(s, pairs)), "")
            count = sum(p.got.size for p in pairs)
            found += [f"{base} of {piece}: {words}, in all {count} numbers"] if words else []
    return "; ".join(found[:2])


def evaluated_anew(vector: Vector, out: dict[str, Any]) -> bool:
    """Return whether the answer to a run is that of a start whose own a, T and F were not taken."""
    from rockref.engines import run

    if vector.piece != "simulate" or vector.inputs.get("a") is None:
        return False
    problem = problem_of(vector.inputs)
    anew = vars(run(replace(problem, start=replace(problem.start, a=None, T=None, F=None)), engine="numpy"))
    for name, e in vector.expect.items():
        if e.bar is None or e.instead_of:
            continue
        try:
            got, other = (np.asarray(result(name, q, vector.branch), float) for q in (out, anew))
            if np.max(weighed_in_bars(got, other, e.bar, 0.0)[0]) > LOOK:
                return False
        except (Missing, TypeError, ValueError, IndexError):
            return False
    return True
