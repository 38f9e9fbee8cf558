"""The release posture: touching, in equilibrium, leaning the right way."""

from dataclasses import replace

import numpy as np
import pytest

import rockref
from rockref.model import release, rotation
from rockref.model.contact import point_kinematics
from rockref.model.errors import InputError
from tests import physics
from tests.refusal import refused

MODEL = rockref.Model.table_3_1()
HALF_WEIGHT = 54 * 9.81 / 2


def penetrations(model, **kwargs):
    block, points = model.body()
    state = release.release_posture(block, points, **kwargs)
    k = point_kinematics(state.x, state.Lambda, state.v, state.W, points.P, points.radius)
    return state, k.xi


@pytest.mark.parametrize("theta_0, pivots", [(0.001, [4, 5]), (0.05, [0, 1]), (0.1170, [0, 1]), (0.14, [0, 1])])
@pytest.mark.parametrize("radius", [0.0, 0.001])
def test_both_pivots_carry_half_the_weight(theta_0, pivots, radius):
    state, xi = penetrations(MODEL.replace(foot_radius=radius), theta_0=theta_0)
    # heights of 0.35 m are rounded at 5e-17, some ten times
    assert xi[pivots] == pytest.approx([HALF_WEIGHT / 6e7] * 2, abs=1e-15)
    assert np.all(np.delete(xi, pivots) < 0)
    assert np.array_equal(state.v, np.zeros(3))
    assert np.array_equal(state.W, np.zeros(3))
    assert not state.anchored.any()


def test_the_block_leans_to_plus_y_and_swings_with_positive_crv():
    state, _ = penetrations(MODEL, theta_0=0.1170)
    top = rotation.apply(state.Lambda, np.array([0, 0, 0.344]))
    # the block is turned by -theta_0 about x: its top goes to +y
    assert top[1] == pytest.approx(0.344 * np.sin(0.1170), rel=1e-6)
    run = rockref.simulate(MODEL, duration=0.01, output_rate=1000, engine="numpy")
    assert run.W[-1, 0] > 0
    assert run.tilt[0] == pytest.approx(-0.1170, abs=1e-7)


def test_tilt_is_the_angle_to_the_vertical():
    """The roll that makes both pivots touch is of second order: 0.03 mm over 100 mm."""
    state, _ = penetrations(MODEL, theta_0=0.1170)
    assert np.arccos(state.Lambda[2, 2]) == pytest.approx(0.1170, abs=(0.03e-3 / 0.1) ** 2 / 0.1170)


def test_small_roll_levels_the_unequal_feet():
    state, _ = penetrations(MODEL, theta_0=0.1170)
    # point 2 is 0.030 mm higher than point 1 on a base of 100 mm
    assert abs(state.Lambda[2, 0]) == pytest.approx(0.030e-3 / 0.1 * np.cos(0.1170), rel=1e-6)


def test_lower_neighbours_take_over_at_small_tilts():
    """Below some tilt the internal points are lower than the raised corners."""
    _, points = MODEL.body()
    assert release.pivot_points(points, 0.1170, 1) == (0, 1)
    assert release.pivot_points(points, 1e-4, 1) == (4, 5)
    assert release.pivot_points(points, 0.1170, -1) == (3, 2)


def test_turned_block_leans_on_corners_three_and_four_to_the_same_side():
    state, xi = penetrations(MODEL, theta_0=0.1170, turned=True)
    assert list(np.flatnonzero(xi >= 0)) == [2, 3]
    assert rotation.apply(state.Lambda, np.array([0, 0, 0.344]))[1] > 0.04
    run = rockref.simulate(MODEL, duration=0.01, output_rate=1000, turned=True, engine="numpy")
    assert run.W[-1, 0] < 0


def test_turned_block_of_equal_feet_is_the_mirror_of_itself():
    four = rockref.Model.four_points()
    _, plain = penetrations(four, theta_0=0.1)
    _, turned = penetrations(four, theta_0=0.1, turned=True)
    assert turned[[2, 3, 0, 1]] == pytest.approx(plain, abs=1e-16)


@pytest.mark.parametrize("out_of_plane", [1e-6, -1e-6])
def test_oblique_wire_shares_the_weight_as_the_springs_do(out_of_plane):
    _, xi = penetrations(MODEL, theta_0=0.1170, out_of_plane=out_of_plane)
    # 0.1 m apart: 1e-7 m of difference, within the 4.4e-6 m of penetration
    assert np.sum(xi[:2]) * 6e7 == pytest.approx(2 * HALF_WEIGHT, rel=1e-9)
    assert xi[0] - xi[1] == pytest.approx(out_of_plane * 0.1 * np.cos(0.1170), rel=1e-4)


@pytest.mark.parametrize("out_of_plane, carrier", [(1e-3, 0), (-1e-3, 1)])
def test_very_oblique_wire_puts_all_on_one_point(out_of_plane, carrier):
    _, xi = penetrations(MODEL, theta_0=0.1170, out_of_plane=out_of_plane)
    assert xi[carrier] * 6e7 == pytest.approx(2 * HALF_WEIGHT, rel=1e-9)
    assert xi[1 - carrier] < 0


def test_unequal_stiffness_sinks_unequally():
    q = {k: np.array(v) for k, v in zip(("K_N", "K_T", "C_N", "C_T", "mu_0", "mu"), np.ones((6, 8)), strict=True)}
    q["K_N"] = np.array([6e7, 3e7] + [6e7] * 6)
    _, xi = penetrations(MODEL.replace(properties=q), theta_0=0.1170)
    assert xi[:2] == pytest.approx([HALF_WEIGHT / 6e7, HALF_WEIGHT / 3e7], rel=1e-9)


def test_pivots_at_unequal_distances_from_the_edge_touch_as_well():
    """Leaning over an oblique edge: the roll is no longer small, 20 mm sin(0.1) over 100 mm."""
    points = physics.points([[0.05, 0.05, -0.344], [-0.05, 0.03, -0.344], [-0.05, -0.05, -0.3], [0.05, -0.05, -0.3]])
    state = release.release_posture(physics.block(), points, 0.1)
    k = point_kinematics(state.x, state.Lambda, state.v, state.W, points.P)
    # heights of 0.35 m are rounded at 5e-17, some ten times
    assert k.xi[:2] == pytest.approx([HALF_WEIGHT / 6e7] * 2, abs=1e-15)
    assert state.Lambda[2, 0] == pytest.approx(0.02 * np.sin(0.1) / 0.1, rel=1e-12)
    product = rotation.product(rotation.transposed(state.Lambda), state.Lambda)
    # two rotations are multiplied, each entry rounded a few times
    assert np.max(np.abs(product - np.eye(3))) < 1e-15


def test_pivots_of_unequal_radius_touch_as_well():
    _, points = MODEL.body()
    radius = np.linspace(1e-3, 8e-3, 8)
    state = release.release_posture(physics.block(), replace(points, radius=radius), 0.1)
    k = point_kinematics(state.x, state.Lambda, state.v, state.W, points.P, radius)
    assert k.xi[:2] == pytest.approx([HALF_WEIGHT / 6e7] * 2, abs=1e-15)


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble])
@pytest.mark.parametrize("turned", [False, True])
def test_posture_is_as_precise_as_the_points(dtype, turned):
    block, points = MODEL.body()
    state = release.release_posture(block, replace(points, P=points.P.astype(dtype)), 0.1, turned, out_of_plane=1e-3)
    assert state.x.dtype == state.Lambda.dtype == dtype
    product = rotation.product(rotation.transposed(state.Lambda), state.Lambda)
    # three rotations are multiplied, each entry rounded a few times
    assert np.max(np.abs(product - np.eye(3, dtype=dtype))) < 10 * np.finfo(dtype).eps


def test_many_bodies_at_once_have_the_bits_of_each_alone():
    """Pivots inside and outside, tilted on either side, rounded feet, one pivot that carries all."""
    models = [
        MODEL,
        MODEL.replace(mass=30.0, g=3.7, foot_radius=0.002),
        MODEL.replace(delta_long=(0.0, 2e-4, 1e-4, 0.0)),
    ] * 4
    bodies = [model.body() for model in models]
    tilts, rolls = np.linspace(0.001, 0.14, 12), np.array([0.0, 1e-3, -1e-6] * 3 + [0.0] * 3)
    turned = np.arange(12) % 2 == 0
    for k, state in enumerate(release.release_postures(bodies, tilts, turned, rolls)):
        alone = release.release_posture(*bodies[k], tilts[k], turned[k], rolls[k])
        assert np.array_equal(state.x, alone.x)
        assert np.array_equal(state.Lambda, alone.Lambda)


def side_by_side(*models):
    """Block and feet of as many models, side by side; round feet only where all have them."""
    blocks, feet = zip(*(model.body() for model in models), strict=True)
    together = {key: np.stack([getattr(p, key) for p in feet]) for key in ("P", "K_N")}
    mass, g = (np.stack([getattr(b, key) for b in blocks]) for key in ("mass", "g"))
    return replace(blocks[0], mass=mass, g=g), replace(feet[0], **together)


def test_point_feet_side_by_side_have_the_bits_of_each_alone():
    models, tilts = (MODEL, MODEL.replace(mass=30.0), MODEL.replace(width=0.12)), [0.1, 0.05, 0.02]
    state = release.release_posture(*side_by_side(*models), np.array(tilts))
    for k, (model, tilt) in enumerate(zip(models, tilts, strict=True)):
        alone = release.release_posture(*model.body(), tilt)
        assert np.array_equal(state.x[k], alone.x) and np.array_equal(state.Lambda[k], alone.Lambda)
    (one,) = release.release_postures([MODEL.body()], [0.1], [False], [0.0])
    assert np.array_equal(one.Lambda, release.release_posture(*MODEL.body(), 0.1).Lambda)


def test_each_block_has_its_own_tipping_angles():
    """A small one beside one that is wider by four and higher by two: it tips at half the angle."""
    models = [MODEL.replace(width=w, depth=w, height=h) for w, h in ((0.1, 0.4), (0.4, 0.8))]
    block, points = side_by_side(*models)
    angles = release.tipping_angle(block, points, np.ones(2))
    assert angles.tolist() == [release.tipping_angle(*model.body()) for model in models]
    limits = np.arctan2([0.05, 0.2], [0.2, 0.4])
    # The feet's heights differ by a tenth of a millimetre, the limits so by 5e-4 of them.
    assert angles == pytest.approx(limits, rel=1e-3)
    release.check_roll(points, 0.999 * limits)
    for roll in (1.001 * limits[0], 0.999 * limits[1]):
        error = refused(release.check_roll, points, np.array([roll, 0.0]))
        assert error.what.startswith(f"is {float(roll)!r} rad; the block tips over sideways at {angles[0]:.4g} rad")


def test_each_block_has_its_own_depth_and_its_own_lowest_point():
    """One is pressed in by a millimetre, as its soft feet are; as deep, a point of the stiff one beside is refused."""
    P = np.array([[0.05, 0.0, -0.3], [-0.05, 0.0, -0.3], [0.0, 0.0, -0.3]])
    deep = np.array([0.0, 0.0, -9e-4])
    level, upright = np.array([[0.0, 0.0, 0.3]] * 2), np.broadcast_to(np.eye(3), (2, 3, 3))
    points = replace(physics.points(P), P=np.stack([P + deep, P]))
    release.check_clear(points, level, upright, np.array([1e-3, 0.0]))
    askew = replace(points, P=np.stack([P + deep, P + [[0, 0, 0], [0, 0, 0], deep]]))
    error = refused(release.check_clear, askew, level, upright, np.array([1e-3, 0.0]))
    assert error.what == "point 2 would start 0.9 mm inside the plate"


def test_the_stiff_feet_of_one_block_are_not_as_deep_as_the_soft_ones_of_another():
    soft, stiff = (physics.points([[0.05, 0.04, -0.3], [-0.05, 0.04, -0.3], [0.0, 0.04, z]], K_N=K)
                   for K, z in ((2e5, -0.3), (6e7, -0.3005)))  # fmt: skip
    bodies = [(physics.block(), soft), (physics.block(), stiff)]
    release.release_postures(bodies[:1], [0.05], [False], [0.0])
    for chosen in (bodies, bodies[1:]):
        n = len(chosen)
        error = refused(release.release_postures, chosen, [0.05] * n, [False] * n, [0.0] * n)
        assert error.what.startswith("point 2 would start 0.5")


def test_every_block_needs_a_point_on_either_side():
    block, points = side_by_side(MODEL, MODEL)
    points.P[1, :, 0] = np.abs(points.P[1, :, 0])
    error = refused(release.release_posture, block, points, np.array([0.1, 0.1]))
    assert (error.code, error.what) == ("E-RELEASE", "there is no point with x < 0")


def test_one_bad_tilt_among_many_is_refused_with_its_number():
    with pytest.raises(InputError, match=r"is 0.2 rad; the block tips over at 0\.1443"):
        release.release_postures([MODEL.body()] * 3, [0.1, 0.2, 0.1], [False] * 3, [0.0] * 3)


def test_the_centre_of_mass_starts_above_the_origin():
    state, _ = penetrations(MODEL, theta_0=0.1)
    assert np.array_equal(state.x[:2], [0, 0])


def test_tipping_angle():
    block, points = MODEL.body()
    assert release.tipping_angle(block, points) == pytest.approx(np.arctan2(0.05, 0.344), rel=1e-12)


@pytest.mark.parametrize("theta_0", [0.0, -0.1, 0.1444, 0.2, np.nan, np.inf])
def test_tilt_out_of_range(theta_0):
    block, points = MODEL.body()
    for turned in (False, True):
        error = refused(release.release_posture, block, points, theta_0, turned)
        assert (error.code, error.where) == ("E-TILT", "theta_0")
        assert "0.1443" in error.what


def test_a_turned_block_tips_over_its_other_edge():
    feet = physics.points([[0.05, 0.05, -0.344], [-0.05, 0.05, -0.344], [-0.05, -0.03, -0.344], [0.05, -0.03, -0.344]])
    release.release_posture(physics.block(), feet, 0.1)
    # arctan(0.03 / 0.344)
    with pytest.raises(InputError, match="0.08699 rad"):
        release.release_posture(physics.block(), feet, 0.1, turned=True)


def test_at_the_tipping_angle_itself_the_block_would_not_come_back():
    block, points = MODEL.body()
    with pytest.raises(InputError):
        release.release_posture(block, points, release.tipping_angle(block, points))


def test_without_a_point_on_either_side_there_is_no_posture():
    points = physics.points([[0.05, 0.05, -0.344], [0.05, -0.05, -0.344]])
    error = refused(release.release_posture, physics.block(), points, 0.1)
    assert error.code == "E-RELEASE"
    assert "x < 0" in error.what


def test_settled_height_balances_the_weight():
    z = release.settled_height(-0.35, -0.35001, 6e7, 3e7, 500.0)
    assert 6e7 * -(z - 0.35) + 3e7 * -(z - 0.35001) == pytest.approx(500.0, rel=1e-7)
    # one point lifted clear of the plate: the other carries all
    z = release.settled_height(-0.35, -0.36, 6e7, 3e7, 500.0)
    assert 3e7 * -(z - 0.36) == pytest.approx(500.0, rel=1e-7)
    z = release.settled_height(-0.36, -0.35, 6e7, 3e7, 500.0)
    assert 6e7 * -(z - 0.36) == pytest.approx(500.0, rel=1e-7)


def test_soft_feet_may_start_deep_inside_the_plate():
    """Half the weight on springs of 1e5 N/m: 2.6 mm, and no foot is deeper than the pivots."""
    points = physics.points([[x, y, -0.344] for x in (0.05, -0.05) for y in (0.05, -0.05)], K_N=1e5)
    state = release.release_posture(physics.block(), points, 0.1)
    height = state.x[2] + (state.Lambda @ points.P.T)[2]
    # The weight over twice the stiffness, to the rounding of heights of a third of a metre.
    assert np.min(height) == pytest.approx(-54 * 9.81 / 2 / 1e5, rel=1e-12)


@pytest.mark.parametrize("K_N, soft", [([60.0] * 8, "1ext"), ([6e7, 60.0] + [6e7] * 6, "2ext")], ids=["all", "one"])
def test_a_foot_that_half_the_weight_presses_in_by_metres_is_refused(K_N, soft):
    """60 N/m, where 60 N/um was meant: the block fell through the plate, and was said to overturn."""
    block, points = MODEL.body()
    error = refused(release.release_posture, block, replace(points, K_N=np.array(K_N)), 0.1170)
    assert (error.code, error.where) == ("E-RELEASE", f"K_N of point {soft}")
    # 264.87 N over 60 N/m
    assert error.what == "is 60 N/m, so that half the weight presses it in by 4.41e+03 mm"
    assert "N/m" in error.cure


def test_feet_of_soft_rubber_are_released():
    """Pressed in by 26 mm of a base of 100 mm: odd, and still a release."""
    block, points = MODEL.replace(K_N=1e4).body()
    assert np.all(np.isfinite(release.release_posture(block, points, 0.1170).Lambda))
    with pytest.raises(InputError, match="press"):
        release.release_posture(block, replace(points, K_N=points.K_N / 2), 0.1170)


@pytest.mark.parametrize("out_of_plane", [0.1444, -0.1444, 2.0, np.nan])
def test_a_roll_beyond_the_tipping_angle_is_refused(out_of_plane):
    """atan(0.05 / 0.344) = 0.14434 rad, as about the main axis: the base is square. 2 rad stood it on its head."""
    block, points = MODEL.body()
    assert np.all(np.isfinite(release.release_posture(block, points, 0.1170, out_of_plane=0.1443).x))
    error = refused(release.release_posture, block, points, 0.1170, out_of_plane=out_of_plane)
    assert (error.code, error.where) == ("E-TILT", "out_of_plane")
    assert "sideways at 0.1443 rad" in error.what


def test_a_roll_is_held_against_the_points_on_either_side():
    """A base of 0.1 m in X and 0.06 m in Y under a centre 0.344 m up: sideways it is X that counts. At the limit itself
    the block would not come back."""
    points = MODEL.body()[1]
    narrow = replace(points, P=points.P * [1.0, 0.6, 1.0])
    limit = float(np.arctan2(0.05, -np.min(points.P[:, 2])))
    release.check_roll(narrow, np.nextafter(limit, 0))
    error = refused(release.check_roll, narrow, limit)
    assert (error.code, error.where) == ("E-TILT", "out_of_plane")
    assert error.cure == "Give a small roll in radians."


def test_half_of_the_base_is_too_deep():
    points = MODEL.body()[1]
    depth = np.full(points.n, release.SOFTEST * abs(points.P[0, 0] - points.P[1, 0]))
    release.check_depth(points, np.nextafter(depth, 0), 0, 1)
    error = refused(release.check_depth, points, depth, 0, 1)
    assert (error.code, error.where) == ("E-RELEASE", f"K_N of point {points.names[0]}")
    assert error.cure == "No foot gives way that far: give the stiffness in N/m."
