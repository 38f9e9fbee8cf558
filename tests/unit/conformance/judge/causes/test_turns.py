"""What turns are off by tells the increment from the exponential; what falls are off by, the velocity."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.call import ask
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.backends.rule_set import law
from rockref.conformance.judge.causes.falls import TOO_FAR, free, rule_of_a_fall
from rockref.conformance.judge.causes.slips import exponential
from rockref.conformance.judge.causes.turns import angular_acceleration, rule_of_a_turn
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
