"""A pose that is wrong in a whole step alone: by the increment, or by what is multiplied with it."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge.causes.whole_steps import by_a_moment_that_is_turned, off_by_the_acceleration
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import verdict
from rockref.model.rotation import exponential


class Sorted(NumpyEngine):
    """The law, whose steps take the principal moments in order of size."""

    def step(self, problem):
        J = np.diag(np.linalg.eigvalsh(problem.block.inertia))
        return super().step(replace(problem, block=replace(problem.block, inertia=J)))


def test_other_moments_in_the_step_speak_of_the_increment():
    v = verdict(judge(Sorted(), ["L0", "L1", "L2", "L3", "L4", "L7"]))
    assert v.rule == "I2" and v.check.name == "Lambda"


@pytest.mark.parametrize(("angle", "size", "is_turned"), [(0.1, 1.0, True), (0.1, 1.01, False), (0.0, 1.0, False)])
def test_a_moment_as_large_that_points_another_way_is_turned(angle, size, is_turned):
    vector = vectors.layer("L4")[0]
    q = vector.inputs
    h, J, W = q["step"], q["inertia"], q["W"]
    T = size * exponential(np.array([0.0, 0.0, angle])) @ q["T"]
    Theta = h * W + h * h / 2 * np.linalg.solve(J, T - np.cross(W, J @ W))
    assert by_a_moment_that_is_turned(vector, q["Lambda"] @ exponential(Theta)) == is_turned


@pytest.mark.parametrize(("size", "by_acceleration"), [(0.5, True), (100.0, False)])
def test_what_the_acceleration_cannot_do_speaks_of_the_rotation(size, by_acceleration):
    vector = vectors.layer("L4")[0]
    q, right = vector.inputs, vector.expect["Lambda"].value
    moments = np.linalg.eigvalsh(q["inertia"])
    reach = q["step"] ** 2 * (np.linalg.norm(q["T"]) + moments[-1] * q["W"] @ q["W"]) / moments[0]
    off = right @ exponential(np.array([size * reach, 0.0, 0.0]))
    assert off_by_the_acceleration(vector, off) == by_acceleration
    assert not off_by_the_acceleration(vector, 1.001 * right), "it is no rotation"
