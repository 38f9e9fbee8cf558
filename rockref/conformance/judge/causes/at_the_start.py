"""What is wrong of the start alone: loads that it brings, its own force evaluation, where feet and anchors are.

A start may bring the loads of an evaluation before it. Otherwise the first evaluation makes them, once, with the
velocities of the start: what only that one does otherwise is the run's own (S2), and no rule of the forces.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rockref.conformance.judge.causes.data_flow import wrong_places
from rockref.conformance.judge.causes.rows_of_the_law import Row, off, rows_of_the_law, same
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector, problem_of
from rockref.model.assembly import body_moment, resultant_force, resultant_moment
from rockref.model.contact import norm, point_kinematics
from rockref.model.errors import InputError
from rockref.model.integrator import first_evaluation, prepared_inertia, step
from rockref.model.problem import Problem, State

Answers = Sequence[tuple[Vector, dict[str, Any]]]
#: So many runs, or feet, have to show it. Decided.
SOME, FEET = 2, 3
#: This share of the runs with wrong first rows has to be explained. Decided.
MOST = 2 / 3
#: How near two anchors are to be one [m]. Decided: a thousandth of what those of short runs lie apart.
NEAR = 1e-9
#: A coefficient of friction beyond every cone, as short runs have it. Decided.
HELD = 2.0**20
BROUGHT = "Runs whose start brings its loads are wrong, and no others: the loads that it brings are not taken."
ONCE = "From its own first row on every run is the law's: the first evaluation alone is another one."
OF_OTHERS = "Springs of friction pull from the anchors of other feet."
ELSEWHERE = "Springs are stretched by the same whatever else feet do, and those of feet that touched anew once the \
block has turned: feet are not where they should be."


def runs_of(answers: Answers) -> Iterator[tuple[Vector, dict[str, Any], tuple[Row, ...]]]:
    """Yield the short runs of the law's own scheme of which every step is a row, whose forces have the right shape."""
    for vector, out in answers:
        rows = rows_of_the_law(vector.id) if vector.layer == "L5s" else ()
        F = out.get("F")
        if len(rows) > 1 and (F is None or has_shape(F, (len(rows), *rows[0].F.shape))):
            yield vector, out, rows


def has_shape(a: Any, shape: tuple[int, ...]) -> bool:
    """Return whether something is numbers of a shape."""
    try:
        return np.asarray(a, float).shape == shape
    except (TypeError, ValueError):
        return False


def loads_are_not_taken(answers: Answers) -> bool:
    """Return whether all short runs that are wrong bring their loads, some of them, and others are right."""
    wrong, right = [], 0
    for vector, out, rows in runs_of(answers):
        # Rates round more than places do; wrong ones show in the next attitude.
        if {kind for _, kind in wrong_places(out, rows)} - {"W"}:
            wrong.append(vector.inputs.get("a") is not None)
        else:
            right += vector.inputs.get("a") is None
    return len(wrong) >= SOME and all(wrong) and right >= SOME


def rule_of_brought_loads(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return S2, and a sentence, where nothing is wrong but runs whose start brings its loads; the rule that is told
    and "" elsewhere."""
    vector = next((v for v, _ in answers if v.id == check.vector), None)
    if vector is None or check.layer != "L5s" or vector.inputs.get("a") is None:
        return check.rule, ""
    return ("S2", BROUGHT) if loads_are_not_taken(answers) else (check.rule, "")


def rule_of_the_first_evaluation(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return S2, and a sentence, where forces of first rows are wrong, of tied feet, too, and runs go on from them as
    the law does: that which is told, most of those that are wrong, and all in which no foot may slide for it; the rule
    that is told and "" elsewhere."""
    if check.layer != "L5s" or not check.name.startswith("F") or not check.name.endswith("@0"):
        return check.rule, ""
    explained: set[str] = set()
    asked, tied = 0, False
    for vector, out, rows in runs_of(answers):
        wrong = off(out, 0, rows[0])
        brought = vector.inputs.get("a") is not None or rows[0].feet is None
        if brought or wrong is None or not np.any(wrong):
            continue
        asked += 1
        if decides(vector, rows[0]):
            continue
        if not np.all(np.isfinite(np.asarray(out["F"], float)[0])) or not goes_on(vector, out):
            return check.rule, ""
        tied |= bool(np.any(wrong[np.asarray(vector.inputs["anchored"], bool)]))
        explained.add(vector.id)
    sure = tied and len(explained) >= max(FEET, MOST * asked) and check.vector in explained
    return ("S2", ONCE) if sure else (check.rule, "")


def decides(vector: Vector, row: Row) -> bool:
    """Return whether other forces of a first row may make other feet slide: no cone holds all, and some pull."""
    held, on_ice = np.all(vector.inputs["mu_0"] >= HELD), not np.any(vector.inputs["mu_0"])
    return row.feet is None or bool(np.any(row.feet["slides"])) or not (held or on_ice)


def goes_on(vector: Vector, out: dict[str, Any]) -> bool:
    """Return whether the second row of a run is what the law makes of its first forces."""
    try:
        right = a_step_on(problem_of(vector.inputs), np.asarray(out["F"], float)[0])
    except InputError:  # such forces turn it too far in a step
        return False
    row = Row(right.x, right.Lambda, right.W, np.asarray(right.F), None)
    places = same(out, "x", 1, row.x) and same(out, "Lambda", 1, row.Lambda)
    wrong = off(out, 1, row)
    return places and wrong is not None and not np.any(wrong)


def a_step_on(problem: Problem, F: np.ndarray) -> State:
    """Return the state a step after a start whose forces are other ones, (n, 3) [N]."""
    with np.errstate(all="ignore"):
        state, block = first_evaluation(problem), problem.block
        levers = point_kinematics(state.x, state.Lambda, state.v, state.W, problem.points.P).r
        T = body_moment(state.Lambda, resultant_moment(levers, F))
        state = replace(state, a=resultant_force(F, block.mass, block.g) / block.mass, T=T, F=F)
        return step(problem, state, prepared_inertia(block))


@dataclass(frozen=True)
class Tied:
    """Feet of a first row that are tied, and held whatever pulls: their numbers (m,), anchors of all feet s (n, 2) [m];
    which have a wrong friction (m,), and where springs that pull so are tied, pulled_from (m, 2) [m]."""

    numbers: np.ndarray
    s: np.ndarray
    wrong: np.ndarray
    pulled_from: np.ndarray

    @property
    def displaced(self) -> np.ndarray:
        """Return by how much anchors are elsewhere than they should be, (m, 2) [m]."""
        return self.pulled_from - self.s[self.numbers]


def tied_feet(vector: Vector, out: dict[str, Any], row: Row) -> Tied | None:
    """Return the tied feet of a first row that are held; None where their friction is not shown."""
    q, wrong = vector.inputs, off(out, 0, row)
    if wrong is None or row.feet is None or np.any(wrong[:, 2]) or not np.all(q["mu_0"] >= HELD):
        return None
    k = point_kinematics(q["x"], q["Lambda"], q["v"], q["W"], q["P"])
    F, K_T = np.asarray(out["F"], float)[0][:, :2], q["K_T"][:, None]
    asked = row.feet["touching"] & ~row.feet["new"] & ~row.feet["slides"] & np.all(np.isfinite(F), axis=-1)
    pulled_from = k.u[:, :2] + (F + q["C_T"][:, None] * k.v_slide) / K_T
    return Tied(np.flatnonzero(asked), q["s"], np.any(wrong[asked, :2], axis=-1), pulled_from[asked])


def rule_of_tied_feet(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return T5 where springs of friction pull from the anchors of other feet, K1 where feet are not where they should
    be, and a sentence; the rule that is told and "" elsewhere."""
    if check.layer != "L5s" or check.name != "F_T@0" or check.rule not in ("T1", "T5"):
        return check.rule, ""
    upright: dict[bytes, list[Tied]] = {}
    of_others = []
    for vector, out, rows in runs_of(answers):
        feet = tied_feet(vector, out, rows[0])
        if feet is None:
            continue
        apart = np.min(norm(feet.pulled_from[:, None] - feet.s[None]), axis=1, initial=np.inf)
        of_others += (apart <= NEAR)[feet.wrong].tolist()
        if np.array_equal(vector.inputs["Lambda"], np.eye(3)):
            upright.setdefault(vector.inputs["P"].tobytes() + feet.numbers.tobytes(), []).append(feet)
    if len(of_others) >= FEET and all(of_others):
        return "T5", OF_OTHERS
    alike = max(upright.values(), key=len, default=[])
    moved = are_displaced_alike(alike) and turned_feet_are_dragged(answers, checks)
    return ("K1", ELSEWHERE) if moved else (check.rule, "")


def are_displaced_alike(found: Sequence[Tied]) -> bool:
    """Return whether the same feet of several runs are pulled by one stretch that is none of theirs."""
    if len(found) < FEET or not len(found[0].numbers):
        return False
    by = np.array([feet.displaced for feet in found])
    return bool(np.min(norm(by[0])) > NEAR and np.max(norm(by - by[0])) <= NEAR)


def turned_feet_are_dragged(answers: Answers, checks: Sequence[Check]) -> bool:
    """Return whether friction of feet that touched anew is wrong after the first row, where springs alone pull and the
    block turns: the anchor is the place of the foot, whatever that is."""
    failed = {c.vector for c in checks if c.failed and c.weighed and not c.name.endswith("@0")}
    return any(v.id in failed and springs_alone_show_the_turn(v) for v, _ in answers if v.piece == "simulate")


def springs_alone_show_the_turn(vector: Vector) -> bool:
    """Return whether all feet of a run touch anew, held and without dampers, under a block that turns."""
    q = vector.inputs
    anew = q.get("F") is None and not np.any(q["anchored"])
    return bool(anew and np.any(q["W"]) and not np.any(q["C_T"]) and np.all(q["mu_0"] >= HELD))
