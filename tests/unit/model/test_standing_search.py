"""The search for the posture of a block that stands, rule by rule: its energy, its start, its steps."""

import numpy as np
import pytest
from scipy.optimize import linprog

from rockref.model.errors import InputError
from rockref.model.problem import ContactPoints, State
from rockref.model.standing import (
    TIPPED,
    carrying,
    check_inside,
    descent,
    lower,
    potential,
    raised,
    rigid_support,
    standing_posture,
    tipped,
)
from tests import physics

B = 0.05


def feet(heights, K=5e7, dtype=float):
    """Feet around a base of 0.1 m whose heights [m] are over z = -0.3 m, the first four in its corners."""
    n = len(heights)
    angle = np.pi / 4 + np.where(np.arange(n) < 4, np.arange(n) * np.pi / 2, np.arange(n) * 2.4)
    radius = np.where(np.arange(n) < 4, B * np.sqrt(2), 0.03)
    P = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.asarray(heights) - 0.3], axis=1).astype(dtype)
    full = np.full(n, 1.0, dtype)
    return ContactPoints(P, K * full, K * full, full, full, full, full, None, tuple(map(str, range(n))))


def energy(q, points, weight=500.0):
    return potential(q, B, weight, points.K_N, *raised(points))


@pytest.mark.parametrize("seed", range(4))
def test_force_and_stiffness_are_the_slopes_of_the_energy(seed):
    rng = np.random.default_rng(seed)
    points = feet(rng.uniform(0, 1e-5, 8))
    q = np.array([0.3 - 4e-5, 0.1 * B * rng.uniform(-1e-3, 1e-3), 0.1 * B * rng.uniform(-1e-3, 1e-3)])
    _, gradient, curvature = energy(q, points)
    assert gradient[0] != 500.0
    for i, h in enumerate(np.eye(3) * 1e-8):
        # A spring's energy is quadratic: what rounding leaves of 100 J is 1e-14/1e-8 N, of 1e4 N it is 1e-4 N/m.
        slope = (energy(q + h, points)[0] - energy(q - h, points)[0]) / 2e-8
        assert slope == pytest.approx(gradient[i], abs=1e-4)
        bend = (energy(q + h, points)[1] - energy(q - h, points)[1]) / 2e-8
        np.testing.assert_allclose(bend, curvature[i], rtol=1e-6, atol=1e-6 * np.abs(curvature).max())


@pytest.mark.parametrize("tilt", [(0.3, 0.2), (-0.25, 0.35)])
def test_the_stiffness_is_the_slope_of_the_force_however_far_it_leans(tilt):
    points = feet(np.zeros(8))
    q = np.array([0.3, *(B * np.array(tilt))])
    _, _, curvature = energy(q, points)
    for i, h in enumerate(np.eye(3) * 1e-7):
        # Forces of 1e6 N are rounded to 1e-10 N, over 2e-7 m; what the third derivative leaves is (h/b)^2 of 1e9 N/m.
        bend = (energy(q + h, points)[1] - energy(q - h, points)[1]) / 2e-7
        np.testing.assert_allclose(bend, curvature[i], rtol=0, atol=1e-8 * np.abs(curvature).max())


@pytest.mark.parametrize("tilt, stands", [((0.49, 0), True), ((0, 0.5), True), ((0.51, 0), False), ((0, -0.51), False),
                                          ((0.4, 0.4), False)])  # fmt: skip
def test_beyond_thirty_degrees_nothing_stands(tilt, stands):
    # A width of 0.5 m is halved and squared without rounding.
    q = np.array([0.3, 0.5 * tilt[0], 0.5 * tilt[1]], np.longdouble)
    points = feet(np.zeros(4), dtype=np.longdouble)
    height, gradient, curvature = potential(q, 0.5, 500.0, points.K_N, *raised(points))
    assert np.isfinite(height) == stands and gradient.dtype == curvature.dtype == np.longdouble
    if not stands:
        assert gradient.tolist() == [0, 0, 0] and curvature.tolist() == np.eye(3).tolist()


@pytest.mark.parametrize("n", [3, 4, 9, 16])
@pytest.mark.parametrize("seed", range(3))
def test_the_start_is_the_lowest_plane_below_which_no_foot_is(n, seed):
    """A linear programme, by another hand."""
    points = feet(np.random.default_rng(seed).uniform(0, 1e-3, n))
    centre, radius = raised(points)
    q = rigid_support(centre, radius, B)
    slope = np.column_stack([np.ones(n), centre[:, :2] / B])
    asked = linprog([1, 0, 0], A_ub=-slope, b_ub=centre[:, 2] - radius, bounds=[(None, None)] * 3)
    # Where the block balances on a diagonal two planes are as low.
    gaps = slope @ q - (radius - centre[:, 2])
    assert q[0] == pytest.approx(asked.fun, abs=1e-12) and gaps.min() > -1e-12 and np.sum(gaps < 1e-12) >= 3


def test_the_start_on_more_feet_is_flat_on_the_longest_and_as_precise_as_the_feet():
    for n, flat in ((16, False), (17, True)):
        centre, radius = raised(feet([3e-4, 0.0, 2e-4, 1e-4, *[1e-3] * (n - 4)], dtype=np.longdouble))
        q = rigid_support(centre, radius, B)
        assert q.dtype == np.longdouble and (q.tolist() == [-centre[:, 2].min(), 0, 0]) is flat
    in_a_row = np.column_stack([np.linspace(-0.05, 0.05, 5), np.zeros(5), np.full(5, -0.3)])
    assert rigid_support(in_a_row, np.zeros(5), B).tolist() == [0.3, 0, 0]


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("unstable", [1, 2])
def test_a_balance_is_left_to_the_lower_side(side, unstable):
    stiffness, gradient = np.ones(3), np.zeros(3, np.longdouble)
    stiffness[unstable], gradient[unstable] = -2.0, 0.5 * side
    step = tipped(gradient, np.diag(stiffness), 0.2)
    wanted = np.zeros(3)
    wanted[unstable] = -side * TIPPED * 0.2
    np.testing.assert_allclose(step.astype(float), wanted, atol=1e-15 * TIPPED)
    assert step.dtype == np.longdouble
    np.testing.assert_allclose(np.abs(tipped(0 * gradient, np.diag(stiffness), 0.2).astype(float)), np.abs(wanted))


def test_what_stands_is_not_tipped():
    for stiffness in ([0.5, 1.0, 2.0], [0.0, 1.0, 2.0]):
        assert tipped(np.ones(3), np.diag(stiffness), 0.2) is None


def test_a_block_on_many_feet_balanced_on_two_tips_to_a_third():
    """Two corners of a diagonal are long; the search starts flat, where nothing says to which side."""
    points = feet([0.0, 5e-5, 0.0, 5e-5, *[5e-3] * 14], K=2e7)
    block = physics.block()
    carried = carrying(points, standing_posture(block, points))
    assert carried[[0, 2]].all() and carried.sum() == 3


def test_feet_in_the_air_change_nothing():
    block, corners = physics.block(), [0.0, 2e-5, 4e-5, 1e-5]
    few, many = (standing_posture(block, feet([*corners, *[5e-3] * more])) for more in (0, 14))
    # Both ends are within 1e-10 of the weight, 500 N over 5e7 N/m.
    np.testing.assert_allclose(many.x, few.x, atol=1e-14)
    np.testing.assert_allclose(many.Lambda, few.Lambda, atol=1e-13)


def test_the_posture_is_as_precise_as_the_feet():
    points = feet([0.0, 2e-5, 4e-5, 1e-5], dtype=np.longdouble)
    state = standing_posture(physics.block(), points, heading=0.3)
    assert state.x.dtype == state.Lambda.dtype == np.longdouble
    F = points.K_N * np.maximum(0, -(state.x[2] + (points.P @ state.Lambda.T)[:, 2]))
    # The search ends at 1e-10 of the weight; heights of 0.3 m are rounded to 2e-20 m, 1e-12 N of these springs.
    assert abs(F.sum() - 54 * np.longdouble("9.81")) < 1e-10 * 54 * 9.81
    product = state.Lambda.T @ state.Lambda
    # three rotations are multiplied, each entry rounded a few times
    assert np.abs(product - np.eye(3)).max() < 10 * np.finfo(np.longdouble).eps


@pytest.mark.parametrize("stiffness, divisor", [(2000.0, 1.0), (1100.0, 2.3)])
def test_a_block_that_tips_goes_no_farther_than_it_would_were_it_as_stiff_as_it_is_unstable(stiffness, divisor):
    """Energy falls all along its way, by a stiffness of -1; of what may be added to that a thousandth is 2, or 1.1, and
    three thousandths of 1100 are 3.3."""

    def at(q):
        return 5 * q[0] ** 2 + 5 * q[1] ** 2 - q[2] ** 2 / 2, q * [10.0, 10.0, -1.0], np.diag([10.0, 10.0, -1.0])

    step = descent(np.array([0.0, 0.0, 0.01]), at, stiffness)
    # A few roundings of a number of 0.01.
    np.testing.assert_allclose(step, [0.0, 0.0, 0.01 / divisor], rtol=1e-14, atol=0)


def held(q, at):
    return lower(q, np.array([-4.0, 0.0, 0.0]), 1.0, np.array([1.0, 0.0, 0.0]), at)


def test_a_step_is_halved_until_the_energy_falls():
    found = held(np.zeros(3), lambda q: (0.9 if abs(q[0]) <= 1.0 else 1.0, np.array([1.0, 0, 0]), None))
    assert found.tolist() == [-1.0, 0.0, 0.0]


@pytest.mark.parametrize("slope, taken", [(0.45, True), (0.48, True), (0.5, False), (1.0, False)])
def test_where_the_energy_does_not_fall_the_slope_has_to_by_half(slope, taken):
    found = held(np.zeros(3), lambda q: (1.0, np.array([slope, 0.0, 0.0]), None))
    assert (found is not None) is taken


@pytest.mark.parametrize("trial", [[np.inf, 0, 0], [np.nan, 0, 0], [0.0, 1.0, 0.0], [0.5, 0.0, 0.0]])
def test_a_step_that_leads_up_or_nowhere_is_none(trial):
    assert lower(np.zeros(3), np.array(trial), 1.0, np.array([1.0, 0, 0]), lambda q: (0.0, np.zeros(3), None)) is None


def places(*degrees):
    P = np.array([[np.cos(a), np.sin(a), -1.0] for a in np.radians(degrees)])
    return physics.points(P)


@pytest.mark.parametrize("degrees", [(10, 120, 250), (0, 90, 179, 270), (-179, 0.5, 100), (181, 60, 300)])
def test_a_centre_of_mass_inside_of_the_feet_is_over_them(degrees):
    check_inside(places(*degrees))


@pytest.mark.parametrize("degrees", [(0, 120), (0,), (0, 90, 180), (10, 40, 189, 30), (-170, 170, 60), (0, 20, 40)])
def test_a_centre_of_mass_over_an_edge_or_beyond_falls(degrees):
    with pytest.raises(InputError, match=": the centre of mass does not stand above a triangle of feet. Check"):
        check_inside(places(*degrees))


def test_a_foot_that_just_touches_carries():
    points = feet([0.0, 0.0, 1e-9, 0.0])
    state = State.at_rest(np.array([0.0, 0.0, 0.3]), np.eye(3), 4)
    assert carrying(points, state).tolist() == [True, True, False, True]
