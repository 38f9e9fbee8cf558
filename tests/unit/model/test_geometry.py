"""Block and contact points: rules G1 and G2."""

import numpy as np
import pytest

from rockref.model import geometry
from rockref.model.errors import InputError
from tests.refusal import refused

SIZES = dict(mass=54.0, width=0.100, depth=0.100, height=0.688)
DELTA_LONG, DELTA_DIAG = (0.010e-3, 0.040e-3, 0.092e-3, 0.058e-3), 6.0e-3


def test_inertia_is_the_integral_over_the_cuboid():
    """Midpoint rule over n cells a side: the error of x^2 is exactly L^2/(12 n^2), so it is taken out."""
    mass, sides, n = 54.0, np.array([0.1, 0.2, 0.688]), 20
    cell = [(np.arange(n) + 0.5) / n * side - side / 2 for side in sides]
    second = np.array([np.mean(c * c) for c in cell]) + sides**2 / (12 * n * n)
    expected = mass * np.diag([second[1] + second[2], second[0] + second[2], second[0] + second[1]])
    # a dozen roundings
    assert np.max(np.abs(geometry.cuboid_inertia(mass, *sides) - expected)) < 1e-14


def test_inertia_of_the_block_of_the_source():
    J = geometry.cuboid_inertia(**SIZES)
    assert np.diag(J) == pytest.approx([2.175048, 2.175048, 0.09], rel=1e-15)
    assert np.count_nonzero(J) == 3


def parallel(a, b, bound):
    """Whether plane vectors of 0.2 m are parallel; the products round at 1e-18."""
    return np.max(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])) < bound


def test_eight_points():
    P = geometry.eight_points(0.100, 0.100, 0.688, DELTA_LONG, DELTA_DIAG)
    assert np.array_equal(P[:4, :2], 0.05 * np.array(geometry.CORNER_SIGNS))
    assert np.array_equal(P[:4, 2], -0.344 + np.array(DELTA_LONG))
    assert np.array_equal(P[4:, 2], np.full(4, -0.344))
    # along the diagonal: 6 mm from the corner, on the line from it to the centre
    assert np.hypot(*(P[4:, :2] - P[:4, :2]).T) == pytest.approx(np.full(4, 6e-3), rel=1e-13)
    assert parallel(P[4:], P[:4], 1e-17)


def test_eight_points_of_an_oblong_base_lie_on_its_diagonals():
    P = geometry.eight_points(0.3, 0.1, 1.0, (0, 0, 0, 0), 0.02)
    assert parallel(P[4:], P[:4], 1e-17)
    assert np.hypot(*(P[4:, :2] - P[:4, :2]).T) == pytest.approx(np.full(4, 0.02), rel=1e-13)


def test_corners_one_and_two_are_on_the_side_to_which_the_block_leans():
    P = geometry.four_points(0.1, 0.1, 0.688)
    assert list(P[:, 1] > 0) == [True, True, False, False]
    assert list(P[:, 0] > 0) == [True, False, False, True]
    assert np.array_equal(P, geometry.eight_points(0.1, 0.1, 0.688, (0, 0, 0, 0), DELTA_DIAG)[:4])


CUBOID = {**SIZES, "delta_long": DELTA_LONG, "delta_diag": DELTA_DIAG}


@pytest.mark.parametrize(
    "key, value, code, where",
    [
        *((key, value, "E-RANGE", key) for key in SIZES for value in (0.0, -1.0, np.nan, np.inf)),
        *(("mass", value, "E-TYPE", "mass") for value in ("54", None, True, [54.0], 54j, np.array([1.0, 2]))),
        *(("delta_long", (0, 0, value, 0), "E-RANGE", "delta_long[2]") for value in (0.689, -0.7, np.nan)),
        ("delta_long", (0, 0, 0), "E-SHAPE", "delta_long"),
    ],
)
def test_sizes_and_foot_heights_that_are_no_block_are_refused(key, value, code, where):
    error = refused(geometry.check_cuboid, **CUBOID | {key: value})
    assert (error.code, error.where) == (code, where)


@pytest.mark.parametrize("value", [-1e-3, 0.0708, 6.0, np.nan])
def test_inner_points_beyond_the_centre_are_refused(value):
    """Half the diagonal is 70.71 mm; 6.0 is six millimetres with the unit forgotten."""
    error = refused(geometry.check_cuboid, **CUBOID | {"delta_diag": value})
    assert (error.code, error.where) == ("E-RANGE", "delta_diag")
    assert "0.07071" in error.what or not value > 0


def test_numbers_of_other_kinds_are_accepted():
    for value in (54, np.float32(54), np.int64(54), np.longdouble(54)):
        geometry.check_cuboid(**CUBOID | {"mass": value})


def test_limits_belong_or_do_not():
    geometry.check_number("mu", 0.0)
    with pytest.raises(InputError):
        geometry.check_number("K_N", 0.0, more_than_least=True)


# Whole and extended numbers beyond every float are finite all the same.
@pytest.mark.parametrize("value", [1e31, 1e308, 1e-31, 5e-324, 10**31, 10**400, np.longdouble("1e400")])
def test_numbers_of_no_block_are_refused(value):
    with pytest.raises(InputError, match="No block has such a number"):
        geometry.check_number("mass", value, more_than_least=True)
    geometry.check_number("mass", geometry.LARGEST, more_than_least=True)
    geometry.check_number("mass", geometry.SMALLEST, more_than_least=True)
    geometry.check_number("beta_int", 1e-31)


@pytest.mark.parametrize(
    "J", [np.zeros((3, 3)), -np.eye(3), np.triu(np.ones((3, 3))), np.eye(2), np.full((3, 3), np.nan)]
)
def test_inertias_of_no_body_are_refused(J):
    error = refused(geometry.check_inertia, J)
    assert error.code == "E-RANGE"


def test_the_block_of_the_source_is_accepted():
    geometry.check_inertia(np.stack([np.eye(3), geometry.cuboid_inertia(**SIZES)]))
    geometry.check_inertia(np.eye(3, dtype=np.longdouble))
    geometry.check_cuboid(**SIZES, delta_long=DELTA_LONG, delta_diag=DELTA_DIAG)
