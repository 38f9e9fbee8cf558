"""Damped steps stay within the ranges."""

import numpy as np
import pytest

from rockref.identify.descent import damped_steps


@pytest.mark.parametrize("corner", [0.0, 1.0])
def test_from_a_corner_from_which_every_slope_leads_out_there_is_no_step(corner):
    """The first unknown is held at once, and then the second, which would have followed it inwards."""
    J = np.linalg.cholesky(np.array([[1.0, 0.9], [0.9, 1.0]])).T
    sign = 1.0 if corner == 0 else -1.0
    r = sign * np.linalg.solve(J.T, [1.0, 0.85])
    free = -np.linalg.solve(J.T @ J, J.T @ r)
    assert sign * free[0] < 0 < sign * free[1]
    np.testing.assert_array_equal(damped_steps(J, r, np.full(2, corner), [0.0])[0], np.full(2, corner))


def test_what_is_held_at_its_end_lets_the_others_take_their_best_step():
    J, z = np.array([[1.0, 0.5], [0.0, 1.0]]), np.array([0.0, 0.5])
    r = np.array([0.4, 0.3])
    step = damped_steps(J, r, z, [0.0])[0]
    # With the first unknown at zero the second is a least squares of its own.
    best = 0.5 - J[:, 1] @ r / (J[:, 1] @ J[:, 1])
    np.testing.assert_allclose(step, [0.0, best], rtol=1e-9)
