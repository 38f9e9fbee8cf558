"""Which point belongs to which foot."""

import numpy as np
import pytest

from rockref.effects.feet import foot_numbers, of_foot, over_mean
from tests.refusal import refused
from tests.unit.effects.bodies import points_at


def named(*names):
    """Points of these names."""
    return points_at([(0, 0, 0)] * len(names), names=names)


def test_a_point_belongs_to_the_foot_that_its_name_begins_with():
    points = named("3int", "1ext", "4", "2ext", "1int")
    assert np.array_equal(foot_numbers(points, "any"), [2, 0, 3, 1, 0])
    assert np.array_equal(of_foot(points, (10.0, 20.0, 30.0, 40.0), "any"), [30, 10, 40, 20, 10])


@pytest.mark.parametrize("name", ["0ext", "5ext", "left", "ext1", ""])
def test_a_name_without_a_foot_is_refused(name):
    for ask in (foot_numbers, lambda points, effect: of_foot(points, (1.0, 2.0, 3.0, 4.0), effect)):
        found = refused(ask, named("1ext", name), "uneven_foot_damping")
        error = found
        assert (error.code, error.where) == ("E-FEET", "effect uneven_foot_damping")
        assert error.what == f"contact point {name!r} belongs to no foot"
        assert error.cure == 'Names of points begin with the number of their foot, as in "1ext" and "3int".'


def test_factors_over_their_geometric_mean():
    """Of 4, 1, 2 and 2 it is 2; a common factor is no matter."""
    for common in (1.0, 0.3, 1e200):
        found = over_mean([4 * common, common, 2 * common, 2 * common])
        assert found == pytest.approx([2.0, 0.5, 1.0, 1.0], rel=1e-13)
    assert over_mean((1.0, 1.0, 1.0, 1.0)).tolist() == [1.0] * 4
    assert over_mean((1.0, 1.0, 1.0, 16.0)) == pytest.approx([0.5, 0.5, 0.5, 8.0], rel=1e-14)
