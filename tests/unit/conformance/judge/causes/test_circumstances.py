"""What all wrong friction forces have in common names the rule; what a fall is off by tells place from acceleration."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.call import ask
from rockref.conformance.backends.law import NumpyEngine, RulesBackend
from rockref.conformance.judge.causes.as_if import law
from rockref.conformance.judge.causes.circumstances import (
    CIRCUMSTANCES,
    SLID,
    SLOW,
    rule_in_common,
    rule_of_normal_forces,
    shows_parts,
)
from rockref.conformance.judge.causes.falls import rule_of_a_fall
from rockref.conformance.judge.causes.one_foot import rule_of_one_foot
from rockref.conformance.judge.causes.other_integrators import first_rows
from rockref.conformance.judge.causes.rows_of_the_law import rows_of_the_law, same
from rockref.conformance.judge.causes.steps_of_a_run import step_is_wrong
from rockref.conformance.judge.compare_answer import Check
from tests.unit.conformance.judge.causes.hidden_runs import verdict_on_hidden


@pytest.fixture(scope="module")
def right():
    """The law's answers to all short runs."""
    return [(v, ask(NumpyEngine(), v)) for v in vectors.layer("L5s")]


def with_wrong_friction(answers, meets, hidden):
    """The answers, friction changed in the first row in which a foot meets a circumstance; and a failure that tells.
    Hidden: no forces are shown, and the row after has another place."""
    found, told = [], ""
    for v, out in answers:
        out = {k: np.array(out[k]) for k in ("x", "Lambda", "W", "F")}
        for i, row in enumerate(rows_of_the_law(v.id)):
            off = np.zeros(len(row.F), bool)
            if row.feet is not None:
                off = row.feet["touching"] & meets(row.feet)
            if np.any(off) and (not hidden or i + 1 < len(out["x"])):
                out["F"][i, off, 0] += 1.0
                out["x"][i + 1 :, 0] += 1e-9 * hidden
                told = v.id
                break
        found.append((v, {k: a for k, a in out.items() if k != "F" or not hidden}))
    return found, Check(told, "L5s", "T6", "F_T@0", "outside", float("inf"))


@pytest.mark.parametrize("hidden", [False, True])
@pytest.mark.parametrize(
    "words",
    [
        "feet slid in the step before",
        "stretched feet stand beside one that touches anew",
        "springs of feet that slid are stretched",
        "feet that touch anew slide",
    ],
)
def test_what_all_wrong_forces_have_in_common_names_the_rule(right, words, hidden):
    rule, meets = next((rule, meets) for rule, said, meets in CIRCUMSTANCES if said == words)
    answers, check = with_wrong_friction(right, meets, hidden)
    named, says = rule_in_common(answers, check, "T6")
    assert named == rule and (words in says or says == SLID)


def test_the_rule_that_is_told_stays_where_nothing_explains_more(right):
    rng = np.random.default_rng(5)
    answers, check = with_wrong_friction(right, lambda feet: rng.random(len(feet["new"])) < 0.3, False)
    assert rule_in_common(answers, check, "T6") == ("T6", "")
    answers, check = with_wrong_friction(right, CIRCUMSTANCES[0][2], False)
    assert rule_in_common(answers, replace(check, rule="K1"), "K1") == ("K1", ""), "forces say nothing of levers"


def changed_where(answers, meets, component):
    """The answers, with a component of forces changed in the first row in which a foot meets a circumstance; by run."""
    found, told = [], []
    for v, out in answers:
        F = np.array(out["F"])
        off = [(i, meets(row.feet)) for i, row in enumerate(rows_of_the_law(v.id)) if row.feet is not None]
        for i, feet in [(i, feet) for i, feet in off if np.any(feet)][:1]:
            F[i, feet, component] += 1.0
            told.append(v.id)
        found.append((v, dict(out) | {"F": F}))
    return found, told


def test_dampers_that_are_right_where_the_block_turns_alone_speak_of_the_velocity(right):
    for meets, rule in (
        (lambda f: f["touching"] & f["damper"] & ~f["no drift"] & ~f["slides"], "K1"),
        (lambda f: f["touching"] & f["damper"] & ~f["slides"], "T1"),
    ):
        answers, told = changed_where(right, meets, 0)
        check = Check(told[0], "L5s", "T1", "F_T@0", "outside", float("inf"))
        assert rule_in_common(answers, check, "T1")[0] == rule


@pytest.mark.parametrize(
    ("pushed", "rows"), [("touching", lambda answers: answers), ("pressed", first_rows)],
    ids=["whole runs", "first rows alone, where tension hides dampers"],
)  # fmt: skip
def test_normal_dampers_that_are_right_where_the_block_turns_alone_speak_of_the_rate_of_penetration(
    right, pushed, rows
):
    for meets, rule in (
        (lambda f: f[pushed] & f["push"] & ~f["no fall"], "K1"),
        (lambda f: f[pushed] & f["push"], "N1"),
    ):
        answers, told = changed_where(right, meets, 2)
        check = Check(told[0], "L5s", "N1", "F_N@0", "outside", float("inf"))
        assert rule_of_normal_forces(rows(answers), check, "N1")[0] == rule


@pytest.mark.parametrize(("component", "told_rule", "name"), [(0, "T1", "F_T@0"), (2, "N1", "F_N@0")])
def test_feet_that_move_and_are_wrong_where_no_damper_works_speak_of_the_velocity(right, component, told_rule, name):
    idle = "damper" if component == 0 else "push"

    def moves(f):
        return f["touching"] & ~f["slides"] & (f["drift"] | f["spin"] | f["fall"] | f["tilt"])

    for meets, rule in ((moves, "K1"), (lambda f: f["touching"] & f[idle], told_rule)):
        answers, told = changed_where(right, meets, component)
        check = Check(told[0], "L5s", told_rule, name, "outside", float("inf"))
        ask_ = rule_in_common if component == 0 else rule_of_normal_forces
        assert ask_(answers, check, told_rule)[0] == rule


@pytest.mark.parametrize(("below", "rule"), [(1e-3, "N1"), (np.inf, "K1")])
def test_normal_dampers_that_are_wrong_of_slow_feet_alone_speak_of_the_damper(right, below, rule):
    answers, told = changed_where(right, lambda f: f["touching"] & (f["sinking"] > 0) & (f["sinking"] < below), 2)
    check = Check(told[0], "L5s", "K1", "F_N@0", "outside", float("inf"))
    assert rule_of_normal_forces(answers, check, "K1") == (rule, SLOW if rule == "N1" else "")


def test_an_anchor_that_was_moved_stays_moved_while_the_foot_sticks():
    carried = [row.feet for v in vectors.layer("L5s") for row in rows_of_the_law(v.id) if row.feet is not None]
    assert any(np.any(f["carried"] & ~f["moved"]) for f in carried)
    assert not any(np.any(f["moved"] & ~f["carried"] & f["touching"]) for f in carried)
    assert not any(np.any(f["carried"] & (f["new"] | ~f["touching"])) for f in carried)


def test_rates_are_the_same_where_they_differ_by_what_is_negligible(right):
    vector, out = next((v, out) for v, out in right if rows_of_the_law(v.id))
    row = rows_of_the_law(vector.id)[0]
    for key, off, alike in (("W", 5e-13, True), ("W", 2e-12, False), ("x", 1e-13, False)):
        assert same({key: np.asarray(out[key]) + off}, key, 0, getattr(row, key)) is alike


def test_friction_of_feet_whose_normal_force_is_wrong_speaks_of_that(right):
    answers, told = changed_where(right, lambda f: f["touching"] & f["push"] & f["slid"], 2)
    check = Check(told[-1], "L5s", "T5", "F_T@1", "outside", float("inf"))
    assert rule_of_normal_forces(answers, check, "T5")[0] == "N1"
    for meets, rule in (
        (lambda f: ~f["touching"], "N2"),
        (lambda f: f["push"] | ~f["touching"], "K1"),
        (lambda f: f["later"], "S1"),
    ):
        answers, told = changed_where(right, meets, 2)
        assert rule_of_normal_forces(answers, replace(check, name="F_N@0", vector=told[0]), "N2")[0] == rule


def test_of_one_foot_the_first_result_that_is_wrong_is_told():
    vector = next(v for v in vectors.layer("L1") if {"slip", "touch-down"} <= set(v.flags))
    out, check = RulesBackend().contact_law(**vector.inputs), Check(vector.id, "L1", "T3", "F_T", "outside")
    assert rule_of_one_foot(vector.inputs, out, check) == ("T3", "")
    assert rule_of_one_foot(vector.inputs, out | {"F_N": out["F_N"] + 1.0}, check)[0] == "N1"
    moved = out["trace"] | {"s_trial": out["trace"]["s_trial"] + 1e-6}
    assert rule_of_one_foot(vector.inputs, out | {"trace": moved}, check)[0] == "T5"


def test_a_fall_that_is_right_where_the_start_brings_its_acceleration_speaks_of_the_first_evaluation(right):
    def lost(v, out):
        missing = 0.0 if v.inputs.get("a") is not None else 1e-6
        return out | {"x": out["x"] + missing * np.arange(len(out["x"]))[:, None]}

    assert rule_of_a_fall([(v, lost(v, dict(out))) for v, out in right], "A1")[0] == "S2"


@pytest.mark.parametrize(("power", "rule"), [(1, "I1"), (2, "A1")])
def test_a_fall_that_loses_the_same_way_in_each_step_is_wrong_in_its_place(right, power, rule):
    off = [(v, out | {"x": out["x"] + 1e-6 * np.arange(len(out["x"]))[:, None] ** power}) for v, out in right]
    assert rule_of_a_fall(off, "A1")[0] == rule
    assert rule_of_a_fall(off, "K1") == ("K1", "")


def test_a_fall_that_is_right_after_a_step_and_wrong_after_two_is_wrong_in_its_velocity(right):
    late = [(v, out | {"x": out["x"] + 1e-6 * (np.arange(len(out["x"])) > 1)[:, None]}) for v, out in right]
    assert rule_of_a_fall(late, "A1")[0] == "I4"


def test_places_that_are_wrong_where_turns_are_right_are_no_matter_of_the_clock(right):
    off = [(v, out | {"x": out["x"] + 1e-6 * (np.arange(len(out["x"])) > 0)[:, None]}) for v, out in right]
    assert rule_of_a_fall(off, "S2")[0] == "I1"
    slow = [(v, out | {"Lambda": out["Lambda"] + 1e-6 * bool(np.any(v.inputs["W"]))}) for v, out in off]
    assert rule_of_a_fall(slow, "S2") == ("S2", "")


@pytest.mark.parametrize(("between", "rule"), [(False, "T4"), (True, "T6")])
def test_feet_that_slid_are_told_by_the_anchor_unless_all_are_between_the_cones(right, between, rule):
    """Half of them are right: no circumstance agrees."""
    rng = np.random.default_rng(7)

    def meets(f):
        return f["touching"] & f["moved"] & (f["between"] | (not between)) & (rng.random(len(f["new"])) < 0.5)

    answers, told = changed_where(right, meets, 0)
    check = Check(told[-1], "L5s", "T6", "F_T@1", "outside", float("inf"))
    assert rule_in_common(answers, check, "T6")[0] == rule


@pytest.mark.parametrize(("some", "rule"), [(True, "T5"), (False, "T1")])
def test_stretched_feet_with_the_friction_of_new_ones_have_given_up_their_anchor(right, some, rule):
    """Where all of them have, the spring of friction is missing."""
    answers, told = [], []
    for v, out in right:
        rows, F = rows_of_the_law(v.id), np.array(out["F"])
        feet = rows[0].feet if rows else None
        if feet is not None:
            anew = law(v, {"anchored": False, "sliding": False})["F"][0]
            off = feet["touching"] & ~feet["new"] & feet["spring"] & ((np.arange(len(anew)) % 2 == 0) | (not some))
            F[0, off] = anew[off]
            told += [v.id] * bool(np.any(off))
        answers.append((v, dict(out) | {"F": F}))
    check = Check(told[0], "L5s", "T1", "F_T@0", "outside", float("inf"))
    assert rule_in_common(answers, check, "T1")[0] == rule


@pytest.mark.parametrize(("share", "rule"), [(1.0, "T5"), (0.5, "T1")])
def test_feet_that_slid_and_have_no_spring_are_tied_where_they_are_and_half_a_spring_is_another(right, share, rule):
    def meets(f):
        return f["touching"] & f["slid"] & f["spring"] & shows_parts(f)

    wrong, told = changed_where(right, meets, 0)
    answers = []
    for (v, out), (_, of_the_law) in zip(wrong, right, strict=True):
        feet = rows_of_the_law(v.id)[0].feet if rows_of_the_law(v.id) else None
        if feet is not None:
            sticks, F = meets(feet) & ~feet["slides"], np.array(of_the_law["F"])[0]
            out["F"][0, sticks] = (F + share * (law(v, {"anchored": False, "sliding": False})["F"][0] - F))[sticks]
        answers.append((v, out))
    check = Check(told[0], "L5s", "T5", "F_T@0", "outside", float("inf"))
    assert rule_in_common(answers, check, "T5")[0] == rule


def test_where_the_anchor_of_a_new_foot_is_right_its_trial_force_is_wrong():
    vector = next(v for v in vectors.layer("L1") if {"stick", "touch-down"} <= set(v.flags))
    out, check = RulesBackend().contact_law(**vector.inputs), Check(vector.id, "L1", "T5", "F_T", "outside")
    out["F_T"] = out["F_T"] + 1.0
    assert rule_of_one_foot(vector.inputs, out, check)[0] == "T1"
    assert rule_of_one_foot(vector.inputs, out | {"trace": None}, check)[0] == "T1"
    assert rule_of_one_foot(vector.inputs, out | {"trace": None, "s": None}, check) == ("T5", "")
    moved = out["trace"] | {"s_trial": out["trace"]["s_trial"] + 1e-6}
    assert rule_of_one_foot(vector.inputs, out | {"trace": moved}, check) == ("T5", "")


@pytest.mark.parametrize(("of_velocity", "rule"), [(0.0, "A1"), (0.05, "I4")])
def test_falls_that_gain_more_in_each_step_add_up_loads_unless_velocity_counts(right, of_velocity, rule):
    def fallen(v, out):
        steps, h = np.arange(len(out["x"]))[:, None], v.inputs["step"]
        more = 1 + of_velocity * np.linalg.norm(v.inputs["v"])
        return out | {"x": out["x"] - more * v.inputs["g"] * h**2 * (steps**3 - steps) / 6 * [0, 0, 1]}

    off = [(v, fallen(v, dict(out))) for v, out in right]
    assert rule_of_a_fall(off, "I4")[0] == rule


class Slips(RulesBackend):
    """The law, whose step is wrong where feet are down and have no damper."""

    def step(self, problem):
        out = super().step(problem)
        slips = bool(np.any(out["anchored"])) and not np.any(problem.points.C_N)
        return out | {"F": np.asarray(out["F"]) + 1.0 * slips}


def test_a_step_that_is_wrong_in_a_run_alone_is_asked_by_itself():
    standing = next(v for v in vectors.layer("L5s") if not np.any(v.inputs["C_N"]) and "S" in "".join(v.branch["rows"]))
    assert step_is_wrong(Slips(), standing) and not step_is_wrong(RulesBackend(), standing)
    assert not any(step_is_wrong(Slips(), v) for v in vectors.layer("L5s")[:3])


def test_feet_that_touch_anew_near_their_old_anchors_speak_of_the_anchor(right):
    """Most new feet are right: no circumstance that is met by all of them agrees."""
    dragged = [v for v, _ in right if np.any(v.inputs["mu_0"]) and rows_of_the_law(v.id)]
    first = {v.id: rows_of_the_law(v.id)[0].feet for v in dragged}
    anew = [id_ for id_, feet in first.items() if feet is not None and np.any(feet["touching"] & feet["new"])]
    near = [(v, out) for v, out in right if v.id in anew[-3:]]
    wrong, told = changed_where(near, lambda f: f["touching"] & f["new"], 0)
    answers = [*wrong, *(a for a in right if a[0].id not in {v.id for v, _ in near})]
    check = Check(told[0], "L5s", "T1", "F_T@0", "outside", float("inf"))
    assert rule_in_common(answers, check, "T1")[0] == "T5"


def test_anchors_of_feet_that_slid_are_told_from_those_of_feet_that_stuck():
    def anchor(F_T, u_t, s, v_slide, stick, K_T, C_T):
        stretch = s - u_t
        size = np.maximum(np.sqrt(np.sum(stretch**2, axis=-1, keepdims=True)), 1e-300)
        length = np.sqrt(np.sum(F_T**2, axis=-1, keepdims=True)) / K_T[..., None]
        return np.where(stick[..., None], s, u_t + length * stretch / size)

    found = verdict_on_hidden(anchor=anchor)
    assert found.rule == "T4" and "those of feet that slid" in found.says, (found.rule, found.says, found.check)
