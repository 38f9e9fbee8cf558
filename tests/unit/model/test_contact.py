"""One contact point, rule by rule."""

import numpy as np
import pytest

from rockref.model import contact, rotation

REALS = (np.float32, np.float64, np.longdouble)


def moving_block(seed=0):
    g = np.random.default_rng(seed)
    return {
        "x": g.normal(size=3), "Lambda": rotation.exponential(g.normal(size=3)), "v": g.normal(size=3),
        "W": g.normal(size=3), "P": g.normal(size=(8, 3)),
    }  # fmt: skip


def carried(state, t):
    """Where the points are after t seconds of steady motion: x + v t and Lambda exp(W t), applied to the points."""
    Lambda = rotation.product(state["Lambda"], rotation.exponential(state["W"] * t))
    return state["x"] + state["v"] * t + rotation.apply_to_points(Lambda, state["P"])


class TestShareOfFirst:
    def test_a_contact_that_begins_counts_from_where_it_touched(self):
        h, rate = 1e-5, 0.2
        xi = np.array([0.0, 0.25, 0.75]) * h * rate
        np.testing.assert_allclose(contact.share_of_first(xi, np.full(3, rate), h), [0.5, 0.75, 1.25], rtol=1e-12)

    def test_all_others_count_in_full(self):
        """Above the plate, rising, deeper than one step comes, at rest."""
        xi, rate = np.array([-1e-9, 1e-9, 3e-6, 1e-6, 0.0]), np.array([0.2, -0.2, 0.2, 0.0, 0.0])
        np.testing.assert_array_equal(contact.share_of_first(xi, rate, 1e-5), 1.0)


class TestK1:
    def test_position_and_lever_arm(self):
        s = moving_block()
        k = contact.point_kinematics(**s)
        assert np.array_equal(k.u, carried(s, 0.0))
        assert np.array_equal(k.r, rotation.apply_to_points(s["Lambda"], s["P"]))
        assert np.array_equal(k.xi, -k.u[:, 2])

    def test_rates_are_the_derivative_of_the_positions(self):
        s = moving_block()
        k = contact.point_kinematics(**s)
        h = 1e-5
        # central difference: error h^2/6 times third derivatives of size |W|^3 |P|, and 1e-16/h of rounding
        rate = (carried(s, h) - carried(s, -h)) / (2 * h)
        assert np.max(np.abs(k.u_rate - rate)) < 2e-9
        assert np.array_equal(k.xi_rate, -k.u_rate[:, 2])
        assert np.array_equal(k.v_slide, k.u_rate[:, :2])

    def test_plate_motion_is_subtracted(self):
        s = moving_block()
        q, q_rate = np.array([1.0, 2, 3]), np.array([4.0, 5, 6])
        fixed, moved = contact.point_kinematics(**s), contact.point_kinematics(**s, plate=(q, q_rate))
        assert np.array_equal(moved.u, fixed.u - q)
        assert np.array_equal(moved.u_rate, fixed.u_rate - q_rate)
        assert np.array_equal(moved.r, fixed.r)
        assert np.array_equal(moved.xi, -moved.u[:, 2])

    def test_a_plate_that_turns_rises_under_the_point(self):
        """About X it rises with y, about Y it falls with x; a lever of 2 m and 1 m, of where the points stand on it."""
        s = moving_block()
        still = np.zeros(3)
        turn, rate = np.array([2.0**-10, 2.0**-12, 7.0]), np.array([2.0**-8, -(2.0**-9), 5.0])
        fixed, moved = contact.point_kinematics(**s), contact.point_kinematics(**s, plate=(still, still, turn, rate))
        x, y = fixed.u[:, 0], fixed.u[:, 1]
        assert np.array_equal(moved.u[:, :2], fixed.u[:, :2])
        assert np.array_equal(moved.v_slide, fixed.v_slide)
        assert np.array_equal(moved.u[:, 2], fixed.u[:, 2] - (2.0**-10 * y - 2.0**-12 * x))
        assert np.array_equal(moved.xi_rate, -(fixed.u_rate[:, 2] - (2.0**-8 * y + 2.0**-9 * x)))

    def test_round_foot_touches_with_its_lowest_point(self):
        s, radius = moving_block(), np.linspace(0.001, 0.008, 8)
        k = contact.point_kinematics(**s, radius=radius)
        centre = s["x"] + rotation.apply_to_points(s["Lambda"], s["P"] + radius[:, None] * [0, 0, 1])
        # two roundings of numbers of size 4
        assert np.max(np.abs(k.u[:, 2] - (centre[:, 2] - radius))) < 2e-15
        # the velocity is that of the material there
        omega = rotation.apply(s["Lambda"], s["W"])
        assert np.array_equal(k.u_rate, s["v"] + rotation.cross(omega[None], k.r))

    def test_upright_round_foot_is_the_point_foot(self):
        s = {**moving_block(), "Lambda": np.eye(3)}
        point, round_ = contact.point_kinematics(**s), contact.point_kinematics(**s, radius=np.full(8, 0.001))
        # the radius is added and taken off again
        assert np.max(np.abs(point.u - round_.u)) < 5e-16

    def test_arguments_are_left_alone(self):
        s = moving_block()
        before = {k: a.copy() for k, a in s.items()}
        contact.point_kinematics(**s, radius=np.full(8, 0.001))
        assert all(np.array_equal(s[k], before[k]) for k in s)


class TestN1:
    def test_spring_and_damper_add(self):
        F = contact.kelvin_voigt(np.array([1e-6]), np.array([2e-3]), np.array([6e7]), np.array([2e4]))
        assert F == 6e7 * 1e-6 + 2e4 * 2e-3

    def test_no_tension_of_the_sum(self):
        """Spring 60 N, damper -80 N: their sum is cut, not each of them."""
        xi, K, C = np.array([1e-6]), np.array([6e7]), np.array([2e4])
        assert contact.kelvin_voigt(xi, np.array([-4e-3]), K, C) == 0
        assert contact.kelvin_voigt(xi, np.array([-1e-3]), K, C) == pytest.approx(40.0, rel=1e-14)


class TestN2:
    def test_above_the_plate_there_is_no_force(self):
        xi = np.array([-1e-9, -0.0, 0.0, 1e-9, -1.0])
        assert np.array_equal(contact.open_gap(xi, np.full(5, 7.0)), [0, 7, 7, 7, 0])

    def test_touching_without_depth_is_contact(self):
        """xi = 0 belongs to (3.5a): a point that arrives with a speed feels its damper at once."""
        F = contact.kelvin_voigt(np.array([0.0]), np.array([1e-2]), np.array([6e7]), np.array([2e4]))
        assert contact.open_gap(np.array([0.0]), F) == 200.0

    @pytest.mark.parametrize("dtype", REALS)
    def test_zero_is_that_of_the_precision(self, dtype):
        """One block or many: no precision is gained or lost at the limits, and the least number is not zero."""
        least = np.finfo(dtype).smallest_subnormal
        for xi in (np.array([-least, 0, least], dtype), np.array([[-least, 0, least]] * 2, dtype)):
            one = np.ones_like(xi)
            F = contact.kelvin_voigt(xi, np.zeros_like(xi), one, one)
            assert F.dtype == contact.open_gap(xi, one).dtype == dtype
            assert np.array_equal(F, np.broadcast_to(np.array([0, 0, least], dtype), xi.shape))
            assert np.array_equal(contact.open_gap(xi, one), np.broadcast_to([0, 1, 1], xi.shape))
            s, touching = contact.touch(xi, np.zeros(xi.shape + (2,), dtype), np.ones(xi.shape + (2,), dtype), xi == xi)
            assert np.array_equal(touching, np.broadcast_to([False, True, True], xi.shape))
            assert s.dtype == dtype

    def test_with_no_effects_spring_and_damper_add_as_without(self):
        """Going down the damper pushes as well, going up it holds back."""
        points = type("P", (), {"K_N": np.full(2, 6e7), "C_N": np.full(2, 2e4)})()
        for speed, force in ((-1e-3, 80.0), (1e-3, 40.0)):
            s = {**moving_block(), "P": np.zeros((2, 3)), "W": np.zeros(3)}
            s |= {"x": np.array([0, 0, -1e-6]), "v": np.array([0, 0, speed])}
            k = contact.point_kinematics(**s)
            F = contact.altered_normal_force(k, points, [])
            assert F == pytest.approx(np.full(2, force), rel=1e-14)
            assert np.array_equal(F, contact.kelvin_voigt(k.xi, k.xi_rate, points.K_N, points.C_N))

    def test_effects_act_before_the_cut(self):
        class Pulled:
            def normal_force(self, F_N, k, points, m):
                # 1e-6 m times 6e7, 1e7, 6e7 N/m is taken off, and what the memory says
                return F_N - points.K_N * k.xi - m["pull"] + 60

        s = {**moving_block(), "P": np.zeros((3, 3)), "Lambda": np.eye(3), "v": np.zeros(3)}
        s["x"] = np.array([0, 0, -1e-6])
        k = contact.point_kinematics(**s)
        properties = type("P", (), {"K_N": np.array([6e7, 1e7, 6e7]), "C_N": np.zeros(3)})()
        F = contact.altered_normal_force(k, properties, [(Pulled(), {"pull": np.array([50, 70, 20.0])})])
        assert F == pytest.approx([10, 0, 40], abs=1e-12)
        assert np.array_equal(
            contact.altered_normal_force(k, properties, []),
            contact.open_gap(k.xi, contact.kelvin_voigt(k.xi, k.xi_rate, properties.K_N, properties.C_N)),
        )


class TestT5:
    def test_anchor_is_born_where_the_point_touches_and_dies_with_the_contact(self):
        xi = np.array([1e-6, 1e-6, -1e-6, 0.0])
        u_t = np.arange(8.0).reshape(4, 2)
        old = np.full((4, 2), 99.0)
        s, touching = contact.touch(xi, u_t, old, np.array([True, False, True, True]))
        assert np.array_equal(touching, [True, True, False, True])
        assert np.array_equal(s[0], [99, 99])
        assert np.array_equal(s[1], u_t[1])
        assert np.array_equal(s[2], u_t[2])
        assert np.array_equal(s[3], [99, 99])


class TestT1:
    def test_spring_to_the_anchor_and_damper(self):
        F = contact.trial_force(
            np.array([[3e-6, 0.0]]),
            np.array([[1e-6, 2e-6]]),
            np.array([[1e-3, -2e-3]]),
            np.array([5e7]),
            np.array([1e4]),
        )
        # -K (u - s) - C v
        assert F == pytest.approx(np.array([[-100 - 10, 100 + 20]]), rel=1e-13)


class TestT6AndT2:
    def test_threshold_depends_on_what_the_point_did(self):
        limit = contact.threshold(
            np.array([100.0, 100.0]), np.array([False, True]), np.array([0.5, 0.5]), np.array([0.25, 0.25])
        )
        assert np.array_equal(limit, [50, 25])

    def test_on_the_cone_it_sticks(self):
        assert np.array_equal(contact.sticks(np.array([25.0, np.nextafter(25.0, 26)]), np.array([25.0, 25.0])), [1, 0])

    def test_without_force_nothing_slides(self):
        assert contact.sticks(np.array([0.0]), np.array([0.0])).all()


class TestT3:
    def test_a_cone_not_a_box(self):
        """Trial (-300, -150) N against 200 N: back along itself, both components in the same ratio."""
        F = np.array([[-300.0, -150.0]])
        size = contact.norm(F)
        returned = contact.radial_return(F, size, np.array([False]), np.array([200.0]))
        assert contact.norm(returned) == pytest.approx(200, rel=1e-15)
        assert returned[0, 0] / returned[0, 1] == pytest.approx(2, rel=1e-15)
        assert np.all(returned < 0)

    def test_inside_the_cone_the_trial_force_stands(self):
        F = np.array([[3.0, 4.0]])
        assert np.array_equal(contact.radial_return(F, contact.norm(F), np.array([True]), np.array([1e3])), F)

    def test_nothing_at_zero(self):
        """No trial force and no normal force: zero, not 0/0."""
        returned = contact.radial_return(np.zeros((1, 2)), np.zeros(1), np.array([True]), np.zeros(1))
        assert np.array_equal(returned, np.zeros((1, 2)))

    def test_a_point_above_the_plate_has_no_friction(self):
        F = np.array([[3.0, 4.0]])
        assert np.array_equal(contact.radial_return(F, contact.norm(F), np.array([False]), np.zeros(1)), [[0, 0]])

    def test_sliding_takes_the_dynamic_force(self):
        F = np.array([[60.0, 80.0]])
        returned = contact.radial_return(F, contact.norm(F), np.array([False]), np.array([25.0]))
        assert returned == pytest.approx(np.array([[15, 20]]), rel=1e-15)

    @pytest.mark.parametrize("dtype", REALS)
    def test_precision_is_kept(self, dtype):
        third = dtype(1) / dtype(3)
        F = np.array([[3, 4], [3, 4]], dtype)
        returned = contact.radial_return(F, contact.norm(F), np.array([True, False]), np.full(2, 5 * third))
        assert returned.dtype == dtype
        # 5/3 N along (3, 4)/5: two roundings
        assert np.all(np.abs(returned - [[3, 4], [1, 4 * third]]) <= 2 * np.finfo(dtype).eps)


class TestT4:
    def test_moved_anchor_gives_the_friction_force(self):
        u, v, F_T = np.array([[1e-3, 2e-3]]), np.array([[0.1, -0.2]]), np.array([[-30.0, 60.0]])
        K, C = np.array([5e7]), np.array([2e4])
        s = contact.move_anchor(F_T, u, np.array([[7.0, 7.0]]), v, np.array([False]), K, C)
        # the anchor is 1e-5 m away from points at 1e-3 m, which costs two digits of sixteen
        assert contact.trial_force(u, s, v, K, C) == pytest.approx(F_T, rel=1e-8)

    def test_sticking_leaves_it_alone(self):
        s = np.array([[7.0, 8.0]])
        moved = contact.move_anchor(
            np.ones((1, 2)), np.zeros((1, 2)), s, np.ones((1, 2)), np.array([True]), np.ones(1), np.ones(1)
        )
        assert np.array_equal(moved, s)


class TestNorm:
    @pytest.mark.parametrize("dtype", REALS)
    def test_of_ordinary_forces_is_the_root_of_the_squares(self, dtype):
        F = np.random.default_rng(0).normal(size=(1000, 8, 2)).astype(dtype) * dtype(1e3)
        assert np.array_equal(contact.norm(F), np.sqrt(F[..., 0] * F[..., 0] + F[..., 1] * F[..., 1]))
        assert contact.norm(F).dtype == dtype

    @pytest.mark.parametrize("dtype", REALS)
    def test_of_tiny_forces_does_not_vanish(self, dtype):
        """3-4-5 at the bottom of the range, where the squares are zero."""
        for scale in (np.finfo(dtype).tiny, np.sqrt(np.finfo(dtype).tiny), np.sqrt(np.finfo(dtype).smallest_subnormal)):
            F = np.array([[3, 4], [-4, 3], [0, -5]], dtype) * dtype(scale)
            # three roundings
            assert np.all(np.abs(contact.norm(F) / dtype(scale) - 5) <= 5 * 3 * np.finfo(dtype).eps)

    def test_at_1e_minus_170(self):
        """The squares underflow; a force of 1e-170 N is still outside a cone of zero."""
        F = np.array([[1e-170, 0.0], [3e-170, 4e-170], [0.0, 0.0]])
        assert contact.norm(F) == pytest.approx([1e-170, 5e-170, 0], rel=1e-15, abs=0)
        assert np.array_equal(contact.sticks(contact.norm(F), np.zeros(3)), [False, False, True])

    def test_the_two_ways_meet(self):
        """Just above and just below the switch both ways of computing agree to rounding."""
        least = float(contact.LEAST_SQUARE[np.dtype(float)])
        for factor in (0.999, 1.001):
            F = np.sqrt(least * factor) * np.array([[0.6, 0.8]])
            assert contact.norm(F) == pytest.approx(np.hypot(*F.T), rel=5e-16)

    def test_one_tiny_force_does_not_touch_the_others(self):
        F = np.array([[3.3, 4.7], [1e-170, 0.0]])
        assert contact.norm(F)[0] == contact.norm(F[:1])[0]


def test_rolling_anchor_follows_the_lowest_point():
    """A sphere that rolls by an angle about y moves its lowest point by radius * angle along x; about x, along -y."""
    s, radius = np.array([[0.5, 0.25], [3.0, 4.0]]), np.array([0.001, 0.0])
    rolled = contact.roll_anchor(s, radius, np.array([0.3, 0.2, 9.0]))
    # rounded once, at 0.5
    assert rolled - s == pytest.approx(np.array([[0.0002, -0.0003], [0, 0]]), rel=0, abs=1e-16)
    assert np.array_equal(s, [[0.5, 0.25], [3, 4]])


def test_round_feet_keep_the_batch_fastest_in_memory():
    s, P, Lambda = (rotation.empty((5,), core, float) for core in ((8, 2), (8, 3), (3, 3)))
    for a in (s, P, Lambda):
        a[...] = 0
    x, radius = np.zeros((5, 3)), rotation.empty((5,), (8,), float)
    radius[...] = 0
    assert contact.roll_anchor(s, radius, x).strides == s.strides
    point, round_ = (contact.point_kinematics(x, Lambda, x, x, P, r) for r in (None, radius))
    assert round_.r.strides == point.r.strides
