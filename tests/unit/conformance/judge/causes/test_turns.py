"""What turns are off by tells the increment from the exponential; what falls are off by, the velocity."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.call import ask
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.backends.rule_set import law
from rockref.conformance.judge.causes.falls import TOO_FAR, TURNED_OFF, free, rule_of_a_fall
from rockref.conformance.judge.causes.rows_of_the_law import rows_of_the_law
from rockref.conformance.judge.causes.slips import exponential, rotation_vector
from rockref.conformance.judge.causes.turns import angular_acceleration, rule_of_a_turn, rule_of_no_rotation
from rockref.conformance.judge.compare_answer import Check
from tests.unit.conformance.judge.causes.hidden_runs import Hidden, verdict_on_hidden


def turned(off):
    """Answers to all runs above the plate that turn, the first step by `off` (W, A, step) [rad]."""
    found = []
    for v in [v for v in vectors.layer("L5s") if free(v) and np.any(v.inputs["W"])]:
        q, out = v.inputs, dict(ask(NumpyEngine(), v))
        Theta = off(q["W"], angular_acceleration(q), q["step"])
        out["Lambda"] = np.array(out["Lambda"])
        out["Lambda"][1] = q["Lambda"] @ exponential(Theta)
        found.append((v, out))
    return found


@pytest.mark.parametrize(
    ("off", "rule"),
    [
        (lambda W, A, h: h * W, "I2"),
        (lambda W, A, h: h * W + h / 2 * A, "I2"),
        (lambda W, A, h: h * W + h * h / 2 * A + h * h * np.cross(A, W), "I3"),
        (lambda W, A, h: h * W * (1 + 1e-3) + h * h / 2 * A, "I3"),
    ],
)
def test_what_points_along_the_angular_acceleration_speaks_of_the_increment(off, rule):
    assert rule_of_a_turn(turned(off), "I3")[0] == rule


def after_a_step(resting, turning):
    """Answers to all short runs of two rows, turned in the first step by shares of the law's turn."""
    found = []
    for v in [v for v in vectors.layer("L5s") if len(rows_of_the_law(v.id)) > 1]:
        out, rows = dict(ask(NumpyEngine(), v)), rows_of_the_law(v.id)
        share = turning(v) if np.any(v.inputs["W"]) else resting(v)
        if share != 1 and np.any(rows[1].Lambda != rows[0].Lambda):
            out["Lambda"] = np.array(out["Lambda"])
            Theta = rotation_vector(rows[0].Lambda.T @ rows[1].Lambda)
            out["Lambda"][1] = rows[0].Lambda @ exponential(share * Theta) if share else rows[0].Lambda
        found.append((v, out))
    return found


def leans(v):
    """Whether the block of a run leans at the start."""
    return bool(np.any(v.inputs["Lambda"] != np.eye(3)))


@pytest.mark.parametrize(
    ("resting", "turning", "rule"),
    [
        (lambda v: 1.0, lambda v: 0.7, "I2"),
        (lambda v: 1.0, lambda v: 0.0, "I2"),
        (lambda v: 0.7, lambda v: 0.7, "I3"),
        (lambda v: 1.0, lambda v: 0.7 if leans(v) else 1.0, "I3"),
        (lambda v: 0.7 if leans(v) else 1.0, lambda v: 0.7, "I3"),
    ],
)
def test_turns_from_rest_that_are_right_speak_of_the_increment(resting, turning, rule):
    assert rule_of_a_turn(after_a_step(resting, turning), "I3")[0] == rule


@pytest.mark.parametrize(
    ("name", "off", "rule"), [("L5s", 1e-4, "I3"), ("L5s", 1e-6, "T1"), ("LS", 1e-4, "T1"), ("LS", 100.0, "I3")]
)
def test_an_attitude_that_is_no_rotation_speaks_of_no_other_rule(name, off, rule):
    vector = vectors.layer(name)[0]
    Lambda = np.stack([np.eye(3), (1 + off) * np.eye(3)])
    check = Check(vector.id, name, "T1", "x@1", "outside", got=1.0)
    assert rule_of_no_rotation([(vector, {"Lambda": Lambda})], [], check)[0] == rule
    assert rule_of_no_rotation([(vector, {"Lambda": Lambda[::-1]})], [], check)[0] == "T1", "as the start is"


def test_other_rules_are_left():
    assert rule_of_a_turn(turned(lambda W, A, h: h * W), "I5") == ("I5", "")


def test_an_attitude_that_is_no_rotation_speaks_of_the_exponential():
    answers = [
        (v, out | {"Lambda": out["Lambda"] * (1 + 1e-6)}) for v, out in turned(lambda W, A, h: h * W + h * h / 2 * A)
    ]
    assert rule_of_a_turn(answers, "I3") == ("I3", "")


@pytest.mark.parametrize(("second", "rule"), [(1e-9, "A2"), (0.0, "I3")])
def test_turns_that_are_right_where_the_start_brings_its_moment_speak_of_a_moment_of_no_foot(second, rule):
    answers = []
    for v, out in turned(lambda W, A, h: (h - h * h / 20) * W + h * h / 2 * A):
        if v.inputs.get("T") is not None:
            out = dict(ask(NumpyEngine(), v))
            out["Lambda"] = np.array(out["Lambda"])
            out["Lambda"][2:] += second
        answers.append((v, out))
    assert rule_of_a_turn(answers, "I3")[0] == rule


def test_a_fall_that_is_off_by_more_than_a_weight_makes_speaks_of_the_velocity():
    def start(rules, problem):
        q = problem.start
        return law().start(rules, replace(problem, start=replace(q, v=np.squeeze(q.Lambda @ q.v[..., None], -1))))

    hidden = Hidden(start=start)
    answers = [(v, ask(hidden, v)) for v in vectors.layer("L5s")]
    assert rule_of_a_fall(answers, "A1") == ("I1", TOO_FAR)
    found = verdict_on_hidden(start=start)
    assert found.rule == "I1", (found.rule, found.says, found.check)


@pytest.mark.parametrize(("rule", "words", "carried"), [("I1", TURNED_OFF, 0.0), ("A1", "", 1e-3)])
def test_falls_that_are_off_where_the_block_turns_speak_of_the_place(rule, words, carried):
    """Places that turn about the origin; with blocks that do not turn carried aside as well, nothing is told."""
    answers = []
    for v in vectors.layer("L5s"):
        q, out = v.inputs, dict(ask(NumpyEngine(), v))
        steps = np.arange(len(out["x"]))[:, None]
        off = q["step"] * np.cross(q["W"], q["x"]) + carried * (not np.any(q["W"])) * q["step"]
        answers.append((v, out | {"x": out["x"] + steps**2 * off}))
    assert rule_of_a_fall(answers, "A1") == (rule, words)
