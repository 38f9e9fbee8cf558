"""Differences along directions, where two numbers undo each other exactly."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover.fit.directions import SOFTENED, axes, moved, softened, spread_about, way
from rockref.discover.hypotheses.parameter import Parameter

FREE = SimpleNamespace(least=-np.inf, most=np.inf, scale="linear", run=None)
SAMPLES = 6000


class Product:
    """Innovations that know the product of two factors, exp(z0 + z1), and a third number."""

    def __init__(self):
        rng = np.random.default_rng(5)
        self.patterns = rng.choice([-1.0, 1.0], size=(2, 1, SAMPLES, 1))
        self.noise = 0.1 * rng.standard_normal((1, SAMPLES, 1))

    def coarsely_at(self, parameters, points):
        return np.array([
            (np.exp(z[0] + z[1]) - 1) * self.patterns[0] + z[2] * self.patterns[1] + self.noise for z in points
        ])  # fmt: skip


def found(rounds, z=(0.4, -0.4, 0.0)):
    """The spread about a point, from a first covariance that is far too small where two numbers undo each other."""
    product, parameters, z = Product(), (FREE,) * 3, np.array(z)
    r = product.coarsely_at(parameters, [z])[0]
    covariance = softened(np.diag([SAMPLES, SAMPLES, SAMPLES]) + np.eye(3))
    for _ in range(rounds):
        spread = spread_about(product, parameters, z, r, covariance)
        covariance = spread.covariance(SOFTENED)
    return spread


def test_along_a_ridge_the_width_is_that_of_the_prior():
    covariance = found(3).covariance(1.0)
    apart = np.array([1.0, -1.0, 0.0])
    # The data know the sum alone; the difference of two standard normal numbers has the variance 2.
    assert apart @ covariance @ apart == pytest.approx(2.0, rel=1e-3)


def test_across_it_the_width_is_that_of_the_data():
    covariance = found(3).covariance(1.0)
    together = np.array([1.0, 1.0, 0.0])
    # One value tells the sum to one; the robust weight of small innovations is one within 1 %, and the ends of a
    # difference see the exponential bend by another per cent.
    assert together @ covariance @ together == pytest.approx(1 / SAMPLES, rel=0.03)
    assert covariance[2, 2] == pytest.approx(1 / SAMPLES, rel=0.03)


def test_a_number_that_is_known_beyond_rounding_has_a_direction():
    # The level at which a gyroscope clips is told by every clipped sample; the computed variance may be below zero.
    ends = np.array([axis.end for axis in axes((FREE,) * 3, np.diag([1e-4, 1e-6, -2.5e-26]))])
    assert np.linalg.matrix_rank(ends, tol=0.0) == 3
    assert np.isfinite(ends).all()


def test_the_matrix_is_the_inverse_of_the_covariance():
    spread = found(1)
    assert np.allclose(spread.matrix() @ spread.covariance(1.0), np.eye(3), atol=1e-8)


def test_numbers_of_a_run_move_in_all_runs_at_once():
    """One number that two runs share, and one of each: two directions, of which the second moves both runs' own."""
    patterns = np.random.default_rng(7).choice([-1.0, 1.0], size=(2, SAMPLES, 1))
    asked = []

    class Runs:
        def coarsely_at(self, parameters, points):
            asked.append(len(points))
            return np.array(
                [[(z[0] + z[1 + i]) * patterns[0] + 0.5 * z[0] * patterns[1] for i in (0, 1)] for z in points]
            )

    parameters = [FREE, *(SimpleNamespace(**{**vars(FREE), "run": i}) for i in (0, 1))]
    # of one unit of each: the sums of squares of what each number does in the two runs, and of its prior
    H = SAMPLES * np.array([[2.5, 1.0, 1.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0]]) + np.eye(3)
    z = np.zeros(3)
    spread = spread_about(Runs(), parameters, z, Runs().coarsely_at(parameters, [z])[0], softened(H))
    assert asked == [1, 4]
    assert np.count_nonzero(np.abs(spread.J).sum(axis=(2, 3)), axis=1).tolist() == [2, 1, 1]
    # the patterns are orthogonal within 1/sqrt(SAMPLES); robust weights of innovations of zero are one
    assert np.allclose(spread.matrix(), H, rtol=1e-9, atol=2 * SAMPLES**0.5)


FLAT = Parameter("beta", lambda model, value: model, 0.0, scale="log_uniform", low=0.02, high=0.7)
PLAIN = Parameter("foot", lambda model, value: model, 1.0, 0.4, scale="log")


def test_a_move_is_straight_in_the_logarithm_of_a_number_with_a_flat_prior():
    z = np.array([-0.8, 0.3])
    logs = [np.log(FLAT.value(moved((FLAT, PLAIN), z, np.array([d, 0.0]))[0])) for d in (-0.4, 0.0, 0.4)]
    assert logs[2] - logs[1] == pytest.approx(logs[1] - logs[0], rel=1e-9)


def test_a_way_leads_where_a_move_ends():
    z, d = np.array([-0.8, 0.3]), np.array([0.37, -1.1])
    end = moved((FLAT, PLAIN), z, d)
    assert way((FLAT, PLAIN), z, end) == pytest.approx(d, rel=1e-9)
    # Small moves are moves of z itself.
    assert moved((FLAT, PLAIN), z, 1e-6 * d) == pytest.approx(z + 1e-6 * d, abs=1e-11)


def test_a_move_ends_at_the_limits():
    ends = [moved((FLAT,), np.array([0.0]), np.array([d]))[0] for d in (-50.0, 50.0)]
    assert ends == pytest.approx([FLAT.least, FLAT.most])
