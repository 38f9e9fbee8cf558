"""The score test on quadratics that are known."""

import numpy as np
import pytest

from rockref.discover.selection.score_test import ScoreTest, predicted_gain


def test_the_gain_of_one_step_is_that_of_the_quadratic():
    H, g = np.array([[4.0, 1.0], [1.0, 3.0]]), np.array([1.0, -2.0])
    exact = 0.5 * g @ np.linalg.solve(H, g)
    # A damping of a thousandth takes off its square of the gain.
    assert predicted_gain(H, g) == pytest.approx(exact, rel=1e-5)


def test_an_effect_gains_what_the_own_numbers_do_not_take_up():
    own, effects = 2, ("alike", "apart", "idle")
    J = np.random.default_rng(1).standard_normal((5, 400))
    J[2] = J[0] + 1e-3 * J[2]  # hardly told from the first number of the model
    r = 0.5 * J[0] + 0.4 * J[3]
    H, g = J @ J.T + np.eye(5), J @ r
    test = ScoreTest(H, g, own, {e: np.array([own + k]) for k, e in enumerate(effects)})
    gains = {p.effect: p.gain for p in test.gains()}
    # What remains of r beside the model is 0.4 of one direction of 400 values: half of 0.16 times 400.
    assert gains["apart"] == pytest.approx(32, rel=0.2)
    assert abs(gains["alike"]) < 1 and abs(gains["idle"]) < 1
    assert test.gains()[0].effect == "apart"
