"""Attitude from rates, and its three angles."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rockref.model.rotation import exponential
from rockref.report.charts.attitude import angles, integrated, lowest_points


def turn(axis, angle):
    half = exponential(0.5 * angle * np.eye(3)[axis])
    return half @ half


@given(st.floats(-1.4, 1.4), st.floats(-1.4, 1.4), st.floats(-3.0, 3.0))
def test_angles_are_those_of_the_three_turns(tilt, roll, spin):
    Lambda = turn(0, tilt) @ turn(1, roll) @ turn(2, spin)
    assert angles(Lambda[np.newaxis])[0] == pytest.approx([tilt, roll, spin], abs=1e-9)


def test_steady_rates_turn_about_their_axis():
    t = np.arange(501) / 1000.0
    W = np.array([0.3, -0.2, 0.5])
    start = turn(0, -0.117)
    Lambda = integrated(start, t, np.tile(W, (len(t), 1)))
    # 500 products of rotations that are right to rounding each.
    assert Lambda[-1] == pytest.approx(start @ exponential(0.5 * W), abs=1e-12)


def test_turn_does_not_jump_when_it_passes_half_a_turn():
    Lambda = np.stack([turn(2, a) for a in np.linspace(3.0, 3.3, 31)])
    assert np.ptp(angles(Lambda)[:, 2]) == pytest.approx(0.3, abs=1e-12)


def test_lowest_points_are_those_under_the_lean():
    P = np.array([[0.05, 0.05, -0.3], [-0.05, 0.05, -0.3], [-0.05, -0.05, -0.3], [0.05, -0.05, -0.3]])
    leaning = turn(0, -0.1)
    assert lowest_points(leaning[np.newaxis], P)[0].tolist() == [True, True, False, False]
