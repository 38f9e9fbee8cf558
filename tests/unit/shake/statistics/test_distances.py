"""Distances of samples, and the test that exchanges whole motions."""

from itertools import product

import numpy as np
import pytest

from rockref.shake.statistics.distances import energy_distance, exchange_test, kolmogorov_smirnov


def test_energy_distance_is_its_definition():
    rng = np.random.default_rng(8)
    x, y = rng.normal(size=7), rng.normal(0.5, 2.0, size=11)
    mean = lambda a, b: np.abs(a[:, None] - b).mean()  # noqa: E731
    # SciPy integrates the squared difference of distribution functions instead: rounding.
    assert energy_distance(x, y) == pytest.approx(2 * mean(x, y) - mean(x, x) - mean(y, y), rel=1e-10)


def test_kolmogorov_smirnov_is_the_largest_gap():
    assert kolmogorov_smirnov([0.0, 1.0], [0.5, 2.0, 3.0]) == pytest.approx(2 / 3)


def test_exchanges_of_three_motions_are_those_of_an_enumeration():
    x, y = np.array([1.0, 1.2, 3.0, 5.0]), np.array([0.8, 2.0, 2.2, 4.9])
    of_x, of_y = np.array([0, 0, 1, 2]), np.array([0, 1, 1, 2])
    values, group = np.concatenate([x, y]), np.concatenate([of_x, of_y])
    side = np.arange(8) < 4
    all_of_them = []
    for flips in product((False, True), repeat=3):
        now = side ^ np.array(flips)[group]
        all_of_them.append(energy_distance(values[now], values[~now]))
    share = np.mean(np.array(all_of_them) >= energy_distance(x, y) - 1e-12)
    found = exchange_test(x, y, of_x, of_y, draws=3000, seed=1)
    # A share of 3000 draws has a standard deviation of 0.009; three of them.
    assert found.p_value == pytest.approx(share, abs=0.027)
    assert found.distance == energy_distance(x, y)


def test_values_that_hang_together_are_not_taken_for_many():
    # Ten motions a side, each a single number said twenty times: 400 values, ten facts a side.
    rng = np.random.default_rng(9)
    small = 0
    for draw in range(100):
        x, y = np.repeat(rng.normal(size=(2, 10)), 20, axis=1)
        motion = np.repeat(np.arange(10), 20)
        small += exchange_test(x, y, motion, motion + 10, draws=99, seed=draw).p_value <= 0.1
    # A share of 100 draws at 0.1 has a standard deviation of 0.03; three of them. Single values would give 0.9.
    assert small / 100 <= 0.19


def test_a_shift_of_every_motion_is_seen():
    rng = np.random.default_rng(10)
    x = rng.normal(size=60)
    motion = np.arange(60) // 2
    assert exchange_test(x, x + 1.5, motion, motion, draws=199).p_value == pytest.approx(1 / 200)
    assert exchange_test(x, x, motion, motion, draws=99).p_value == 1.0
