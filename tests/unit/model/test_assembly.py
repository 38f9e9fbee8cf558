"""From point forces to the body: the order of the sum, and the textbook definitions."""

import numpy as np
import pytest

from rockref.model import assembly, rotation


def memory_orders(batch, n, dtype):
    values = np.random.default_rng(n).normal(size=batch + (n, 3)).astype(dtype)
    values *= dtype(10) ** np.arange(n, dtype=dtype)[:, None]  # unequal sizes: another order gives other bits
    fastest = rotation.empty(batch, (n, 3), dtype)
    fastest[...] = values
    return values, fastest, 2 * fastest, rotation.cross(np.ones_like(fastest), fastest)


@pytest.mark.parametrize("n", [1, 4, 8, 12])
@pytest.mark.parametrize("batch", [(), (1,), (2,), (3,), (1024,), (2, 3), (1, 1)], ids=str)
@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble])
def test_sum_over_points_is_the_sum_from_the_first_to_the_last(n, batch, dtype):
    for a in memory_orders(batch, n, dtype):
        total = a[..., 0, :]
        for i in range(1, n):
            total = total + a[..., i, :]
        assert np.array_equal(assembly.sum_over_points(a), total)
        assert assembly.sum_over_points(a).dtype == dtype


def test_the_order_of_the_sum_matters_here():
    a = memory_orders((50,), 8, np.float64)[0]
    assert not np.array_equal(assembly.sum_over_points(a), assembly.sum_over_points(a[..., ::-1, :]))


def test_no_points_give_no_force():
    assert np.array_equal(assembly.sum_over_points(np.zeros((5, 0, 3))), np.zeros((5, 3)))


def test_resultant_force_has_the_weight_downwards():
    F = np.array([[1.0, 2, 3], [10, 20, 30]])
    assert np.array_equal(assembly.resultant_force(F, np.array(2.0), np.array(9.81)), [11, 22, 33 - 2 * 9.81])


def test_moment_of_a_couple_is_free_of_the_point():
    r = np.array([[1.0, 0, 0], [-1, 0, 0]])
    F = np.array([[0, 5.0, 0], [0, -5, 0]])
    assert np.array_equal(assembly.resultant_moment(r, F), [0, 0, 10])
    assert np.array_equal(assembly.resultant_moment(r + np.array([8.0, -4, 2]), F), [0, 0, 10])


def test_moment_in_body_axes_is_the_transposed_rotation():
    Lambda = rotation.exponential(np.array([0.2, -0.4, 0.7]))
    M = np.array([1.0, -2, 3])
    # one rounding a component
    assert np.max(np.abs(rotation.apply(Lambda, assembly.body_moment(Lambda, M)) - M)) < 2e-15
    # a moment about the plate's z on a body turned by a quarter about x is about the body's y
    quarter = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    assert np.array_equal(assembly.body_moment(quarter, np.array([0, 0, 7.0])), [0, 7, 0])
