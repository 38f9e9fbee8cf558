"""Downhill steps with limits and several tries."""

import numpy as np
import pytest

from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.tosses import descent
from rockref.model.errors import InputError


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


def test_where_every_parameter_would_leave_its_range_there_is_no_step():
    z = np.array([0.0, 1.0])
    g = np.array([1.0, -1.0])  # downhill is below the first limit and above the second
    assert np.array_equal(descent.step_of(np.eye(2), g, 0.1, z, np.zeros(2), np.ones(2)), np.zeros(2))
    assert descent.step_of(np.eye(2), -g, 0.0, z, np.zeros(2), np.ones(2)) == pytest.approx([1.0, -1.0])


def test_out_of_a_kink_the_best_single_parameter_leads():
    """Along both together, as the slopes have it, nothing is gained; the second one alone gains most."""
    wide, z = np.full(2, 10.0), np.zeros(2)

    def value(t):
        return 1.0 + 10 * abs(t[0] + t[1]) * (t[0] != 0) * (t[1] != 0) - 0.1 * t[0] - 0.3 * t[1]

    found, least = descent.along_one(z, value, 1.0, -wide, wide)
    assert found == pytest.approx([0.0, descent.PROBE]) and least == pytest.approx(1 - 0.3 * descent.PROBE)
    # At the ends of its range it cannot be moved, and the other one is.
    found, _ = descent.along_one(z, value, 1.0, -wide, np.array([10.0, 0.0]))
    assert found == pytest.approx([descent.PROBE, 0.0])


def test_a_model_that_cannot_be_simulated_is_infinitely_far():
    def value(z):
        if z[0] > 1:
            raise InputError("E-STEP", "step", "is too large", "")
        return 2.0

    safe = descent.guarded(value)
    assert safe(np.array([0.0])) == 2.0 and safe(np.array([2.0])) == np.inf
