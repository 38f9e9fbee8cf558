"""A block that stands: its feet's springs carry it, none pulls, and it stays where it is."""

from dataclasses import replace

import numpy as np
import pytest

import rockref
from rockref.model.errors import InputError
from rockref.model.rotation import apply_to_points, exponential
from rockref.model.standing import carrying, standing_posture
from tests import physics
from tests.refusal import refused

TABLE = rockref.Model.table_3_1()
BLOCK, POINTS = TABLE.body()
WEIGHT = float(BLOCK.mass * BLOCK.g)


def uneven(seed: int, size: float = 1e-4):
    """Feet of random heights [m] and stiffness, some round, under a centre of mass out of the middle."""
    rng = np.random.default_rng(seed)
    P = POINTS.P + np.column_stack([np.full(8, 0.007), np.full(8, -0.011), rng.uniform(-size, size, 8)])
    return replace(POINTS, P=P, K_N=POINTS.K_N * rng.uniform(0.3, 3, 8), radius=rng.uniform(0, 5e-3, 8))


def forces(points, state):
    """Normal forces (n,) and lever arms (n, 3) in the plate's axes, by the law's own geometry."""
    centre = points.P + np.outer(np.zeros(8) if points.radius is None else points.radius, [0, 0, 1])
    r = apply_to_points(state.Lambda, centre) - np.outer(
        np.zeros(8) if points.radius is None else points.radius, [0, 0, 1]
    )
    return points.K_N * np.maximum(0, -(state.x[2] + r[:, 2])), r


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("size", [1e-7, 1e-4, 2e-3])
def test_force_and_moments_vanish_and_no_spring_pulls(seed, size):
    points = uneven(seed, size)
    state = standing_posture(BLOCK, points, heading=1.0 - seed)
    F, r = forces(points, state)
    # heights of 0.3 m are rounded to 5e-17 m, which the stiffest of these springs turns into 1e-8 N
    assert abs(F.sum() - WEIGHT) < 1e-7
    assert np.max(np.abs((F[:, None] * r[:, :2]).sum(0))) < 1e-7 * 0.05
    assert (F >= 0).all() and (carrying(points, state) == (F > 0)).all()
    assert (F > 0).sum() == 3 or size < 1e-3  # springs give way by micrometres: of far more uneven feet three carry
    assert not state.v.any() and not state.W.any()


def test_even_feet_share_the_weight_and_the_inner_ones_of_the_table_carry_it():
    state = standing_posture(BLOCK, POINTS)
    assert carrying(POINTS, state).tolist() == [False] * 4 + [True] * 4
    np.testing.assert_allclose(state.x[2], 0.344 - WEIGHT / 4 / POINTS.K_N[4], rtol=1e-12)
    assert state.Lambda.tolist() == np.eye(3).tolist()


def test_heading_and_place_turn_and_move_the_block_on_the_plate():
    points = uneven(1)
    here, there = standing_posture(BLOCK, points), standing_posture(BLOCK, points, np.pi / 2, (0.3, -0.2))
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    # a quarter turn by the series of the exponential is rounded once
    np.testing.assert_allclose(there.Lambda, turn @ here.Lambda, rtol=0, atol=1e-15)
    assert there.x.tolist() == [0.3, -0.2, here.x[2]]


@pytest.mark.parametrize("seed", [0, 3])
def test_it_stays_where_it_is(seed):
    """For a tenth of a second: what is left of force and moment moves it by less than a picometre."""
    model = TABLE.replace(points="custom", custom_points=uneven(seed))
    problem = model.problem(0.1, step=2e-6, output_rate=100.0, standing=True, heading=0.3)
    r = rockref.simulate(problem)
    assert np.max(np.abs(r.x - r.x[0])) < 1e-12
    assert np.max(np.abs(r.Lambda - r.Lambda[0])) < 1e-11
    assert (r.anchored == r.anchored[0]).all() and 3 <= r.anchored[0].sum() < 8 and not r.sliding.any()


def test_a_block_without_a_triangle_below_it_is_refused():
    for P in (POINTS.P + [0.06, 0, 0], POINTS.P * [1, 0, 1]):
        error = refused(standing_posture, BLOCK, replace(POINTS, P=P))
        assert (error.code, error.where) == ("E-STAND", "contact points")
        assert error.cure == "Check the feet, their stiffness in N/m and the centre of mass, or give a start state."
    # feet so soft that a tilt lowers the centre of mass by more than it loads the springs: m g H > sum K y^2
    soft = replace(POINTS, K_N=np.full(8, 0.9 * WEIGHT * 0.344 / (8 * 0.05**2)))
    error = refused(standing_posture, BLOCK, soft)
    assert (error.code, error.what) == ("E-STAND", "springs and weight find no equilibrium near the upright")
    # three feet, the centre of mass just outside of their triangle
    corner = replace(POINTS, P=POINTS.P + [0, 0, 1] * np.where([0, 0, 1, 0, 0, 0, 1, 0], 0.02, 0.0)[:, None])
    with pytest.raises(InputError, match="E-STAND"):
        standing_posture(BLOCK, replace(corner, P=corner.P + [0.02, 0.02, 0]))


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("lean, stands", [(0.09, True), (0.11, False)])
def test_a_block_in_balance_does_not_stand_askew(axis, lean, stands):
    """Three like feet around the centre of mass, along axes of a body that is turned about X or Y."""
    angle = 2 * np.pi / 3 * np.arange(3)
    even = np.column_stack([0.1 * np.cos(angle), 0.1 * np.sin(angle), np.full(3, -0.1)])
    points = physics.points(even @ exponential(lean * np.eye(3)[axis]))
    if stands:
        state = standing_posture(physics.block(), points)
        # Depths of 3 micrometres, rounded to those of heights of 0.1 m.
        np.testing.assert_allclose(state.Lambda @ points.P.T, even.T, rtol=0, atol=1e-14)
    else:
        assert refused(standing_posture, physics.block(), points).code == "E-STAND"


def test_a_release_is_what_it_was_and_a_moving_plate_is_stood_upon():
    from rockref.model.base_motion import BaseMotion

    base = BaseMotion(0.0, 0.01, np.zeros((3, 3)))
    assert TABLE.problem(0.1).start.Lambda[1, 2] > 0.1  # released, leaning towards +y
    assert TABLE.problem(0.1, base=base).start.Lambda.tolist() == np.eye(3).tolist()
    assert TABLE.problem(0.1, base=base, standing=False).start.Lambda[1, 2] > 0.1
    assert TABLE.problem(0.1, standing=True).base is None


def carrying_feet(mass, width, height, K_N, raised):
    """Which of the four feet of a block carry it, where they are raised so far [m]."""
    model = rockref.Model(mass=mass, width=width, depth=width, height=height, points="four_points").replace(K_N=K_N)
    block, points = model.body()
    uneven = replace(points, P=points.P + np.column_stack([np.zeros((4, 2)), raised]))
    return carrying(uneven, standing_posture(block, uneven))


@pytest.mark.parametrize("seed", range(12))
def test_a_slender_block_on_soft_uneven_feet_finds_its_third_foot(seed):
    # Two feet of a diagonal carry it, and the third next to nothing: the search has to leave the diagonal.
    raised = 2e-5 * np.random.default_rng(seed).standard_normal(4)
    assert carrying_feet(40.0, 0.08, 0.7, 1.5e7, raised).sum() >= 3


def test_a_block_that_leans_away_from_its_third_foot_stops_on_the_other_one():
    # Foot 1 is short by a third of a millimetre: on 2, 3 and 4 the centre of mass leans towards it.
    carried = carrying_feet(63.0, 0.095, 0.6, 2e7, [3.4e-4, 0.0, 0.0, 0.0])
    assert carried.sum() == 3 and carried[[1, 3]].all()


def test_a_block_balanced_on_two_feet_tips_to_one_of_the_others():
    carried = carrying_feet(66.0, 0.12, 0.5, 2e7, [0.0, 5e-5, 0.0, 5e-5])
    assert carried[[0, 2]].all() and carried.sum() == 3
