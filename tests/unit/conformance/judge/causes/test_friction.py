"""What a wrong friction force tells beside its own rule: the decision, the trial force, the sum."""

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.call import ask
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge.causes.friction import rule_of_friction
from rockref.conformance.judge.causes.rows_of_the_law import rows_of_the_law
from rockref.conformance.judge.compare_answer import Check, compare
from rockref.model.contact import point_kinematics, trial_force


def asked(layer, flag):
    """The first vector with this flag, and the law's answer, its arrays free to be changed."""
    vector = next(v for v in vectors.layer(layer) if flag in v.flags)
    return vector, {k: np.array(a) if isinstance(a, np.ndarray) else a for k, a in ask(NumpyEngine(), vector).items()}


def named(answers, name):
    """The rule that the first failure of a result speaks of."""
    checks = [c for vector, out in answers for c in compare(vector, out)]
    return rule_of_friction(answers, checks, next(c for c in checks if c.failed and c.name == name))[0]


def trial(q):
    k = point_kinematics(q["x"], q["Lambda"], q["v"], q["W"], q["P"])
    return trial_force(k.u[:, :2], np.where(q["anchored"][:, None], q["s"], k.u[:, :2]), k.v_slide, q["K_T"], q["C_T"])


@pytest.mark.parametrize(("share", "rule"), [(1.0, "T2"), (0.5, "T3")])
def test_a_sliding_foot_that_shows_its_trial_force_is_held_to_stick(share, rule):
    vector, out = asked("L5s", "oblique, far outside")
    out["F"][0, :, :2] += share * (trial(vector.inputs) - out["F"][0, :, :2]) * (out["F"][0, :, 2:] > 0)
    assert named([(vector, out)], "F_T@0") == rule


@pytest.mark.parametrize(("share", "rule"), [(1.0, "T2"), (0.5, "T1")])
def test_a_sticking_foot_that_shows_the_sliding_force_is_made_to_slide(share, rule):
    vector, out = asked("L5s", "spring and damper, it hardly turns")
    F_T, F_N = trial(vector.inputs), out["F"][0, :, 2]
    length = np.maximum(np.hypot(*F_T.T), 1e-300)
    out["F"][0, :, :2] = share * (vector.inputs["mu"] * F_N / length)[:, None] * F_T
    assert named([(vector, out)], "F_T@0") == rule


@pytest.mark.parametrize(("added", "rule"), [(0.0, "T1"), (10.0, "T5")])
def test_a_force_without_the_damper_s_part_is_a_wrong_trial_force(added, rule):
    """Feet that touch anew have no spring: without the damper nothing is left, and what is left is another anchor's."""
    vector, out = asked("L5s", "touching anew, after a run whose feet were tied")
    out["F"][0, :, :2] = added * np.array([[1.0, 0.0], [0.0, 1.0]] * 4)
    assert named([(vector, out)], "F_T@0") == rule


@pytest.mark.parametrize(("share", "rule"), [(1.0, "T2"), (0.0, "T1")])
def test_a_foot_that_is_held_to_stick_shows_its_trial_force(share, rule):
    vector = next(v for v in vectors.layer("L1") if {"slip", "touch-down"} <= set(v.flags))
    q = vector.inputs
    out = ask(NumpyEngine(), vector) | {"sliding": False, "F_T": -share * q["C_T"] * np.asarray(q["v_slide"])}
    assert named([(vector, out)], "sliding") == rule


@pytest.mark.parametrize(("turned", "rule"), [(0.0, "A1"), (1e-6, "T1")])
def test_friction_that_moves_the_block_wrongly_and_turns_it_rightly_is_summed_wrongly(turned, rule):
    answers = [asked("L5s", flag) for flag in ("damper", "spring and damper, all bits")]
    for _, out in answers:
        del out["F"]
        out["x"][1, 0] += 1e-9
        out["Lambda"][1] += turned
    assert named(answers, "x@1") == rule


@pytest.mark.parametrize(("size", "rule"), [(1.0, "T3"), (1.1, "T2")])
def test_sliding_forces_of_the_right_size_speak_of_their_direction(size, rule):
    answers, told = [], []
    for vector in vectors.layer("L5s"):
        out, rows = ask(NumpyEngine(), vector), rows_of_the_law(vector.id)
        slides = rows[0].feet["slides"] if rows and rows[0].feet is not None else np.zeros(1, bool)
        dragged = slides & (np.hypot(*np.asarray(out["F"])[0, :, :2].T) > 0)
        if "F_T@0" in vector.expect and np.any(dragged):
            F = np.array(out["F"])
            F[0, dragged, :2] = size * F[0, dragged, 1::-1] * [1, -1]
            out, told = dict(out) | {"F": F}, [*told, vector.id]
        answers.append((vector, out))
    check = Check(told[0], "L5s", "T2", "F_T@0", "outside", float("inf"))
    assert rule_of_friction(answers, [], check)[0] == rule


@pytest.mark.parametrize(("late", "rule"), [(True, "S1"), (False, "T5")])
def test_friction_of_the_row_before_speaks_of_the_evaluation(late, rule):
    vector, out = asked("L5s", "anchors stay while the block turns, springs alone")
    out["F"][1, :, :2] = out["F"][0, :, :2] * (1.0 if late else 0.5)
    assert named([(vector, out)], "F_T@1") == rule


@pytest.mark.parametrize(("share", "rule"), [(1.0, "T2"), (1e-3, "T5")])
def test_friction_above_the_plate_that_is_no_trial_force_is_that_of_a_foot_that_nobody_asks(share, rule):
    vector = next(v for v in vectors.layer("L1") if v.id == "L1-N2-0049")
    q = vector.inputs
    out = ask(NumpyEngine(), vector) | {"F_T": -share * q["C_T"] * np.asarray(q["v_slide"])}
    assert named([(vector, out)], "F_T") == rule
