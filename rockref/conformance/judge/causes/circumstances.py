"""Which rule all wrong friction forces have in common: what every foot that is wrong does, and none that is right.

The short runs are experiments: in each row every foot touches anew or is tied, has a stretched spring or a damper that
works, sticks or slides, slid before or did not. A rule is believed where the circumstance in which it speaks is met
wherever friction is wrong, and hardly anywhere where friction is right. Where forces are not shown, a row stands for
its feet: the next row shows whether all of them were right.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector, layer, problem_of
from rockref.engines import run
from rockref.model.assembly import body_moment, resultant_force, resultant_moment
from rockref.model.contact import norm, point_kinematics, touch, trial_force

#: A share of the trial force below which spring or damper is no circumstance, and of the forces of a row from which on
#: one is wrong. Decided: far above rounding; in single precision an anchor is off by more.
SHARE, WRONG = 1e-3, 1e-7
#: Coordinates that differ by so many ulps of a metre are the same: what right programs differ by within three steps.
SAME = 16 * float(np.finfo(float).eps)
#: A circumstance is believed from this agreement on, where that of the rule it overrules is less by this factor.
#: Decided: where friction is wrong the circumstance of its rule agrees by 0.8 or more, those of others by half as much.
CLEAR, LESS = 0.8, 0.7

Feet = Mapping[str, np.ndarray]
Circumstance = Callable[[Feet], np.ndarray]
#: Circumstances by rule, in words and as flags (n,) of feet; the first of those that agree equally well is believed.
CIRCUMSTANCES: tuple[tuple[str, str, Circumstance], ...] = (
    ("T5", "feet touch anew", lambda f: f["new"]),
    ("T5", "stretched feet stand beside one that touches anew", lambda f: f["spring"] & f["company"]),
    ("T1", "dampers of friction work", lambda f: f["damper"]),
    ("T1", "springs of friction are stretched", lambda f: f["spring"]),
    ("T1", "dampers of sticking feet work", lambda f: f["damper"] & ~f["slides"]),
    ("T1", "springs of sticking feet are stretched", lambda f: f["spring"] & ~f["slides"]),
    ("T2", "feet slide", lambda f: f["slides"]),
    ("T2", "feet begin or cease to slide", lambda f: f["slides"] != f["slid"]),
    ("T6", "feet that slid are between the cones", lambda f: f["between"] & f["slid"]),
    ("T6", "feet that stuck are between the cones", lambda f: f["between"] & ~f["slid"]),
    ("T3", "feet slide", lambda f: f["slides"]),
    ("T3", "feet slide on", lambda f: f["slides"] & f["slid"]),
    ("T3", "feet begin to slide", lambda f: f["slides"] & ~f["slid"]),
    ("T4", "feet slid in the step before", lambda f: f["moved"]),
    ("S1", "a step comes before", lambda f: f["later"]),
)
#: Rules that another circumstance may overrule. Of normal forces and their kinematics the runs have vectors enough.
MAY_BE_ANOTHER = ("T5", "T1", "T2", "T6", "T3", "T4", "S1", "I4", "I5")
IN_COMMON = "Forces are wrong where {}, and hardly anywhere else."


@dataclass(frozen=True)
class Row:
    """One row of the law's run: x (3,) [m], Lambda (3, 3), W (3,) [rad/s], F (n, 3) [N], and flags of its feet that
    touch; None in `feet` where the row has no evaluation of its own."""

    x: np.ndarray
    Lambda: np.ndarray
    W: np.ndarray
    F: np.ndarray
    feet: Feet | None


@lru_cache
def rows_of_the_law(id_: str) -> tuple[Row, ...]:
    """Return the rows of a short run; none where they lie several steps apart."""
    vector = next(v for v in layer("L5s") if v.id == id_)
    q, problem = vector.inputs, problem_of(vector.inputs)
    if problem.step * problem.output_rate < 1 - 1e-9:
        return ()
    r = run(problem, engine="numpy")
    found = []
    for i in range(len(r.t)):
        before = problem.start if i == 0 else Memory(*(getattr(r, k)[i - 1] for k in ("s", "anchored", "sliding")))
        v, W = (r.v[0], r.W[0]) if i == 0 else predicted(problem, r, i - 1)
        feet = None if i == 0 and q.get("F") is not None else flags(problem, r, i, before, v, W)
        found.append(Row(r.x[i], r.Lambda[i], r.W[i], r.F[i], feet))
    return tuple(found)


@dataclass(frozen=True)
class Memory:
    """What feet remember: s (n, 2) [m], anchored and sliding (n,)."""

    s: np.ndarray
    anchored: np.ndarray
    sliding: np.ndarray


def predicted(problem: Any, r: Any, i: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the velocities with which the forces of the row after the i-th are evaluated (S1)."""
    block, J = problem.block, problem.block.inertia
    a = resultant_force(r.F[i], block.mass, block.g) / block.mass
    arms = point_kinematics(r.x[i], r.Lambda[i], r.v[i], r.W[i], problem.points.P).r
    T = body_moment(r.Lambda[i], resultant_moment(arms, r.F[i]))
    A = np.linalg.solve(J, T - np.cross(r.W[i], J @ r.W[i]))
    return r.v[i] + problem.step * a, r.W[i] + problem.step * A


def flags(problem: Any, r: Any, i: int, before: Any, v: np.ndarray, W: np.ndarray) -> Feet:
    """Return what the feet of a row do, by name, (n,) bool; of feet that touch alone.

    before : what they remember; v [m/s], W [rad/s] : velocities of the evaluation
    """
    p = problem.points
    k = point_kinematics(r.x[i], r.Lambda[i], v, W, p.P)
    s, touching = touch(k.xi, k.u[:, :2], before.s, before.anchored)
    whole = trial_force(k.u[:, :2], s, k.v_slide, p.K_T, p.C_T)
    size, damper = norm(whole), norm(p.C_T[:, None] * k.v_slide)
    spring, F_N = norm(p.K_T[:, None] * (k.u[:, :2] - s)), r.F[i][:, 2]
    slid, new = np.asarray(before.sliding, bool), ~np.asarray(before.anchored, bool)
    found = {
        "new": new, "company": ~new & np.any(new & touching), "spring": spring > SHARE * size,
        "damper": damper > SHARE * size, "slides": r.sliding[i], "slid": slid & ~new, "moved": slid & ~new & (i > 0),
        "between": (p.mu * F_N < size) & (size <= p.mu_0 * F_N), "later": np.full(len(F_N), i > 0),
    }  # fmt: skip
    return {name: np.asarray(a, bool)[touching] for name, a in found.items()} | {"touching": touching}


def experiments(vector: Vector, out: dict[str, Any]) -> Iterator[tuple[Feet, bool]]:
    """Yield the feet of one run up to the first row in which one is wrong, and whether they are: each foot by itself
    where forces are shown, else all of a row together."""
    rows = rows_of_the_law(vector.id)
    for i, row in enumerate(rows):
        if not same(out, "x", i, row.x) or not same(out, "Lambda", i, row.Lambda):
            return
        off = wrong_feet(out, i, row) if out.get("F") is not None else wrong_row(out, i, rows)
        if off is None or row.feet is None:
            if off is None or np.any(off):
                return
            continue
        touching = row.feet["touching"]
        for j in range(np.sum(touching)) if out.get("F") is not None else [slice(None)]:
            one = {name: np.atleast_1d(a[j]) for name, a in row.feet.items() if name != "touching"}
            yield one, bool(np.any(off[touching][j]))
        if np.any(off):
            return


def same(out: dict[str, Any], key: str, i: int, right: np.ndarray) -> bool:
    """Return whether a quantity of a row is that of the law, but for rounding."""
    try:
        return bool(np.all(np.abs(np.asarray(out[key], float)[i] - right) <= SAME * max(1.0, np.max(np.abs(right)))))
    except (KeyError, TypeError, ValueError, IndexError):
        return False


def wrong_feet(out: dict[str, Any], i: int, row: Row) -> np.ndarray | None:
    """Return which friction forces of a row are wrong, (n,); None where the normal forces are, or none can be read."""
    try:
        got = np.asarray(out["F"], float)[i]
        off = np.abs(got - row.F) > WRONG * max(float(np.max(np.abs(row.F))), 1.0)
    except (TypeError, ValueError, IndexError):
        return None
    return None if np.any(off[:, 2]) or not np.all(np.isfinite(got)) else np.any(off[:, :2], axis=-1)


def wrong_row(out: dict[str, Any], i: int, rows: Sequence[Row]) -> np.ndarray | None:
    """Return for each foot whether forces of a row are wrong, as the rows after it show; None where none does."""
    turns = same(out, "W", i, rows[i].W)
    if i + 1 == len(rows):
        return None if turns else np.ones(len(rows[i].F), bool)
    right = turns and same(out, "x", i + 1, rows[i + 1].x) and same(out, "Lambda", i + 1, rows[i + 1].Lambda)
    return np.full(len(rows[i].F), not right)


def rule_in_common(answers: Sequence[tuple[Vector, dict[str, Any]]], check: Check, rule: str) -> tuple[str, str]:
    """Return the rule whose circumstance is met where friction is wrong and not where it is right, and a sentence;
    `rule` itself unless another explains clearly more, and the failure that is told, too."""
    if check.layer != "L5s" or not check.weighed or rule not in MAY_BE_ANOTHER:
        return rule, ""
    of_runs = [(v.id, list(experiments(v, out))) for v, out in answers if v.layer == check.layer]
    wrong, right = ([feet for _, of in of_runs for feet, off in of if off is which] for which in (True, False))
    if len(wrong) < 2:
        return rule, ""
    scores = [(agreement(meets, wrong, right), n) for n, (_, _, meets) in enumerate(CIRCUMSTANCES)]
    own = max((s for s, n in scores if CIRCUMSTANCES[n][0] == rule), default=agreement(always, wrong, right))
    best, n = max(scores, key=lambda pair: (pair[0], -pair[1]))
    believed, words, meets = CIRCUMSTANCES[n]
    told = any(off and np.any(meets(feet)) for id_, of in of_runs if id_ == check.vector for feet, off in of)
    return (believed, IN_COMMON.format(words)) if told and best >= CLEAR and own <= LESS * best else (rule, "")


def always(feet: Feet) -> np.ndarray:
    """Return that every foot meets it: the circumstance of a rule that speaks wherever feet touch."""
    return np.ones_like(feet["later"])


def agreement(meets: Circumstance, wrong: Sequence[Feet], right: Sequence[Feet]) -> float:
    """Return how well a circumstance agrees with what is wrong, 0 to 1 (Ochiai's coefficient).

    It is the geometric mean of the share of what is wrong that meets it, and of the share that is wrong of what does.
    """
    guilty, innocent = (sum(bool(np.any(meets(feet))) for feet in of) for of in (wrong, right))
    return guilty / np.sqrt(len(wrong) * (guilty + innocent)) if guilty else 0.0
