"""Downhill steps with limits and several tries."""

import numpy as np
import pytest

from rockref.discover.fit.parameter import Parameter
from rockref.discover.tosses import descent


def slopes_of(A, b, z):
    """Of residuals A z - b, six to a frame."""
    r = (A @ z - b).reshape(-1, 2, 3)
    return descent.Slopes(r, A.reshape(-1, 2, 3, A.shape[1]), np.ones((len(r), 2)), np.full(A.shape[1], 1e6), 1)


def problem(seed=0, rows=60, columns=4):
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(rows, columns))
    return A, A @ np.array([0.3, -0.2, 0.5, 0.1])


def test_one_step_ends_at_the_minimum_of_squares():
    A, b = problem()
    z = np.zeros(4)
    wide = np.full(4, 10.0)
    found, least = descent.best_way(
        slopes_of(A, b, z), z, lambda t: float(np.sum((A @ t - b) ** 2)), float(b @ b), -wide, wide
    )
    # The least damping is 1e-4: what is left of the squares is its square.
    assert least < 1e-6 * float(b @ b)
    assert found == pytest.approx([0.3, -0.2, 0.5, 0.1], abs=1e-3)


def test_a_parameter_at_its_limit_stays_and_the_others_go_on():
    A, b = problem()
    low, high = np.full(4, -10.0), np.array([10.0, 10.0, 0.0, 10.0])
    z = np.zeros(4)
    found, _ = descent.best_way(slopes_of(A, b, z), z, lambda t: float(np.sum((A @ t - b) ** 2)), np.inf, low, high)
    assert found[2] == 0.0
    rest = np.linalg.lstsq(np.delete(A, 2, axis=1), b, rcond=None)[0]
    assert np.delete(found, 2) == pytest.approx(rest, abs=1e-3)


def test_where_nothing_helps_it_stays():
    A, b = problem()
    z = np.ones(4)
    wide = np.full(4, 10.0)
    found, least = descent.best_way(slopes_of(A, b, z), z, lambda t: 1.0 + float(np.any(t != z)), 1.0, -wide, wide)
    assert np.array_equal(found, z) and least == 1.0


def test_frames_whose_slopes_are_huge_steer_less():
    A, b = problem()
    lying = A.copy()
    lying[:6] *= 50  # one frame at which another corner strikes: its slopes hold for nothing
    z, wide = np.zeros(4), np.full(4, 10.0)
    slopes = slopes_of(lying, b, z)
    away = []
    for steep in (3.0, 1e9):
        H, g = slopes.normal_equations(z, steep)
        away.append(np.linalg.norm(descent.step_of(H, g, 1e-4, z, -wide, wide) - [0.3, -0.2, 0.5, 0.1]))
    assert away[0] < 0.5 * away[1]


def test_limits_are_those_of_quantities_and_of_priors():
    def keep(model, value):
        return model

    parameters = (
        Parameter("a", keep, 1.0, 0.1, prior=3.0, low=0.95, high=2.0),
        Parameter("b", keep, 1.0, 0.1, log=True, prior=2.0, low=0.0),
    )
    low, high = descent.limits(parameters)
    assert low == pytest.approx([-0.5, -4.0]) and high == pytest.approx([6.0, 4.0])


def test_differences_look_inside_at_a_limit():
    J = descent.derivatives(lambda z: np.array([z @ z]), np.array([1.0, 2.0]), np.array([5.0]), np.array([1.0, 9.0]))
    assert J[0] == pytest.approx([2 - descent.DIFFERENCE, 4 + descent.DIFFERENCE])
    only = descent.derivatives(
        lambda z: np.array([z @ z]), np.array([1.0, 2.0]), np.array([5.0]), np.array([1.0, 9.0]), 1
    )
    assert only.shape == (1, 1) and only[0, 0] == J[0, 1]
