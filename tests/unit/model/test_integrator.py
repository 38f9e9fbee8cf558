"""One step: the rules I1 to I5 by themselves, the force evaluation, and what a restart needs."""

from dataclasses import replace

import numpy as np
import pytest

import rockref
from rockref.model import integrator, rotation
from rockref.model.problem import as_arrays, stack
from tests import physics

MODEL = rockref.Model.table_3_1()


def after(problem, steps):
    problem = as_arrays(problem)
    state, inertia = integrator.first_evaluation(problem), integrator.prepared_inertia(problem.block)
    for _ in range(steps):
        state = integrator.step(problem, state, inertia)
    return state


class TestRules:
    def test_i1_is_exact_for_a_constant_acceleration(self):
        x = integrator.update_position(np.zeros(3), np.array([1.0, 2, 3]), np.array([8.0, 0, -8]), 0.5)
        assert np.array_equal(x, [0.5 + 1, 1, 1.5 - 1])

    def test_i2_is_exact_for_a_constant_acceleration(self):
        Theta = integrator.rotation_increment(np.array([1.0, 2, 3]), np.array([8.0, 0, -8]), 0.5)
        assert np.array_equal(Theta, [1.5, 1, 0.5])

    def test_i3_turns_in_body_axes(self):
        Lambda, Theta = rotation.exponential(np.array([0.3, 0.1, -0.2])), np.array([0.0, 0.1, 0.2])
        turned = integrator.update_rotation(Lambda, rotation.exp_minus_identity(Theta))
        # two roundings
        assert np.max(np.abs(turned - rotation.product(Lambda, rotation.exponential(Theta)))) < 4e-16
        assert np.max(np.abs(turned - rotation.product(rotation.exponential(Theta), Lambda))) > 0.01

    def test_i4_takes_the_mean_of_both_accelerations(self):
        v = integrator.update_velocity(np.zeros(3), np.array([1.0, 2, 3]), np.array([3.0, 2, 1]), 0.5)
        assert np.array_equal(v, [1, 1, 1])

    def test_i5_keeps_the_spatial_momentum_without_moment(self):
        JW, Theta, zero = np.array([1.0, 2, 3]), np.array([0.1, -0.2, 0.3]), np.zeros(3)
        E = rotation.exp_minus_identity(Theta)
        new = integrator.update_momentum(JW, zero, zero, E, 0.5)
        assert rotation.apply(rotation.exponential(Theta), new) == pytest.approx(JW, rel=4e-16)

    def test_i5_adds_half_of_each_moment_the_old_one_turned_back(self):
        T, T_next = np.array([1.0, 0, 0]), np.array([0.0, 2, 0])
        quarter = np.array([0, 0, np.pi / 2])
        new = integrator.update_momentum(np.zeros(3), T, T_next, rotation.exp_minus_identity(quarter), 0.5)
        # x of the old axes is -y of the new ones
        assert new == pytest.approx([0, -0.25 + 0.5, 0], abs=1e-16)

    def test_rates_gain_what_the_momentum_gains(self):
        J = np.array([2.0, 0.5, 4.0])
        W = integrator.update_rates(np.array([1.0, 2, 3]), np.array([2.0, 1, 12]), np.array([4.0, 2, 8]), 1 / J)
        assert np.array_equal(W, [2, 4, 2])

    def test_rates_that_do_not_change_keep_their_bits(self):
        """1/J J W is not W for every J: in each step the same digit would be lost."""
        J, W = np.random.default_rng(0).uniform(0.05, 5, size=(2, 100, 3))
        assert not np.array_equal(1 / J * (J * W), W)
        assert np.array_equal(integrator.update_rates(W, J * W, J * W, 1 / J), W)

    def test_euler_acceleration(self):
        """W x J W of a spinning disc that is tilted: J diag(1, 1, 2), W = (1, 0, 3) gives (0, -3, 0) x -1."""
        J = np.array([1.0, 1, 2])
        W = np.array([1.0, 0, 3])
        A = integrator.angular_acceleration(np.array([5.0, 0, 0]), W, J * W, 1 / J)
        assert np.array_equal(A, [5, -(3 * 1 - 1 * 6), 0])


class TestInertia:
    def test_diagonal_and_full_matrix_give_the_same_bits(self, monkeypatch):
        problem = MODEL.problem(theta_0=0.01)
        fast = after(problem, 200)

        def full(block):
            return integrator.Inertia(block.inertia, rotation.inverse(block.inertia))

        monkeypatch.setattr(integrator, "prepared_inertia", full)
        slow = after(problem, 200)
        # the cofactors of a diagonal matrix round once more than 1/J: one part in 1e16 of each increment
        assert np.max(np.abs(fast.W - slow.W)) < 1e-13
        assert fast.x == pytest.approx(slow.x, rel=1e-14)

    def test_an_inertia_that_is_not_diagonal_is_kept_whole(self):
        J = np.array([[2.1, 0.1, 0.05], [0.1, 2.2, 0.03], [0.05, 0.03, 0.09]])
        prepared = integrator.prepared_inertia(physics.block(inertia=J))
        assert np.array_equal(prepared.J, J)
        a = np.array([1.0, 2, 3])
        assert integrator.times(prepared.J_inverse, integrator.times(prepared.J, a)) == pytest.approx(a, rel=1e-13)

    @pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble])
    def test_precision_is_kept(self, dtype):
        problem = as_arrays(stack([MODEL.problem(), MODEL.problem()]), dtype)
        third = replace(problem.block, inertia=problem.block.inertia * 0 + np.eye(3, dtype=dtype) * 3)
        prepared = integrator.prepared_inertia(third)
        assert prepared.J.dtype == prepared.J_inverse.dtype == dtype
        assert np.array_equal(prepared.J_inverse, np.full((2, 3), dtype(1) / dtype(3)))

    def test_a_batch_of_diagonal_inertias(self):
        problem = as_arrays(stack([MODEL.problem(), MODEL.replace(mass=60.0).problem()]))
        prepared = integrator.prepared_inertia(problem.block)
        assert prepared.J.shape == (2, 3)
        assert prepared.J.strides[0] == prepared.J.itemsize

    def test_a_batch_of_diagonal_and_full_inertias_inverts_each_as_alone(self):
        full = np.array([[2.1, 0.1, 0.05], [0.1, 2.2, 0.03], [0.05, 0.03, 0.09]])
        problems = [MODEL.problem(), MODEL.replace(inertia=full).problem(), MODEL.replace(mass=60.0).problem()]
        together = integrator.prepared_inertia(as_arrays(stack(problems)).block)
        alone = [integrator.prepared_inertia(as_arrays(problem).block).J_inverse for problem in problems]
        assert together.J_inverse.shape == (3, 3, 3)
        assert np.array_equal(together.J_inverse[0], np.diag(alone[0]))
        assert np.array_equal(together.J_inverse[1], alone[1])
        assert np.array_equal(together.J_inverse[2], np.diag(alone[2]))


class TestFirstEvaluation:
    def test_release_is_in_equilibrium_with_the_wire(self):
        """The two pivots carry the weight; the moment is what the wire has just stopped to hold."""
        state = integrator.first_evaluation(as_arrays(MODEL.problem()))
        # 54 x 9.81 / 2 = 264.87 N each; the posture is solved to 1e-12 m of penetration times 6e7 N/m
        assert state.F[:, 2] == pytest.approx([264.87, 264.87] + [0] * 6, abs=1e-4)
        assert np.max(np.abs(state.a)) < 1e-5
        # m g (b/2 cos - h/2 sin), turned by the small roll
        assert state.T[0] == pytest.approx(529.74 * (0.05 * np.cos(0.117) - 0.34399 * np.sin(0.117)), rel=1e-3)
        assert list(np.flatnonzero(state.anchored)) == [0, 1]

    def test_a_point_that_arrives_sliding_slides_at_once(self):
        problem = as_arrays(physics.mass_on_a_foot(z=physics.resting(), v=(1.0, 0, 0)))
        assert integrator.first_evaluation(problem).sliding.all()

    def test_a_state_of_a_run_is_left_as_it_is(self):
        problem = as_arrays(MODEL.problem())
        state = after(problem, 3)
        again = integrator.first_evaluation(replace(problem, start=state))
        assert again is state

    def test_what_is_missing_of_a_state_is_evaluated(self):
        problem = as_arrays(MODEL.problem())
        state = integrator.first_evaluation(problem)
        for name in ("a", "T", "F"):
            again = integrator.first_evaluation(replace(problem, start=replace(state, **{name: None})))
            assert np.array_equal(getattr(again, name), getattr(state, name))

    def test_another_step_length_counts_anew(self):
        problem = as_arrays(MODEL.problem())
        state = after(problem, 3)
        again = integrator.first_evaluation(replace(problem, start=state, step=5e-6))
        assert (again.origin, again.count, again.h) == (state.t, 0, 5e-6)
        assert np.array_equal(again.x, state.x)


class TestContactOfAStep:
    def test_forces_take_the_new_posture_and_the_predicted_velocity(self):
        """Decided in the law: x and Lambda at n+1; v + h a, W + h A. One mass on a damped spring shows it."""
        problem = physics.mass_on_a_foot(z=-1e-6, v=(0, 0, -0.1), K_N=6e7, C_N=2e4, step=1e-5)
        first = integrator.first_evaluation(as_arrays(problem))
        state = after(problem, 1)
        h, m, g = 1e-5, physics.MASS, 9.81
        a = (6e7 * 1e-6 + 2e4 * 0.1) / m - g
        z = -1e-6 - h * 0.1 + h * h / 2 * a
        F = 6e7 * -z - 2e4 * (-0.1 + h * a)
        assert first.a[2] == pytest.approx(a, rel=1e-15)
        assert state.F[0, 2] == pytest.approx(F, rel=1e-14)
        assert state.v[2] == pytest.approx(-0.1 + h / 2 * (a + F / m - g), rel=1e-14)

    def test_a_turning_block_is_felt_where_it_will_turn(self):
        """The same for W + h A: a foot beside the centre, whose force gives the block an angular acceleration."""
        foot = physics.points([0.05, 0, 0], K_N=6e7, C_N=2e4, mu_0=0)
        problem = as_arrays(replace(physics.mass_on_a_foot(z=-1e-5), points=foot))
        first, state = integrator.first_evaluation(problem), after(problem, 1)
        h, F = 1e-5, 6e7 * 1e-5
        A_y = -0.05 * F / physics.J_MAIN
        assert first.F[0, 2] == pytest.approx(F, rel=1e-12)
        # still to first order in h: the foot falls with a_z - 0.05 A_y
        rate = h * (F / physics.MASS - 9.81) - 0.05 * h * A_y
        assert state.F[0, 2] - F == pytest.approx(-(6e7 * h / 2 + 2e4) * rate, rel=1e-6)

    def test_a_point_at_rest_holds_more_than_one_that_slides(self):
        """A pull of 0.4 of the weight is above mu = 0.25; put on at once it asks for twice that, below mu_0 = 1."""
        pull = dict(mu_0=1.0, mu=0.25, effects=(physics.Pull(force=0.4 * 54 * 9.81),))
        held = after(physics.mass_on_a_foot(z=physics.resting(), **pull), 300)
        assert not held.sliding.any()
        slides = after(physics.mass_on_a_foot(z=physics.resting(), v=(0.5, 0, 0), **pull), 300)
        assert slides.sliding.all()
        # 0.15 g for 3 ms
        assert slides.v[0] == pytest.approx(0.5 + 0.15 * 9.81 * 3e-3, rel=1e-4)

    def test_a_round_foot_touches_with_its_lowest_point(self):
        """Tilted by 0.3 about its point at the plate, a foot of 1 mm sinks in by 1 mm (1 - cos 0.3)."""
        problem = physics.mass_on_a_foot(z=0.0, radius=1e-3)
        tilted = replace(problem.start, Lambda=rotation.exponential(np.array([0.3, 0, 0])))
        state = integrator.first_evaluation(as_arrays(replace(problem, start=tilted)))
        assert state.F[0, 2] == pytest.approx(6e7 * 1e-3 * (1 - np.cos(0.3)), rel=1e-12)

    def test_the_anchor_of_a_round_foot_rolls_along(self):
        problem = as_arrays(physics.mass_on_a_foot(z=-1e-6, radius=0.1, mu_0=1e9))
        state = replace(integrator.first_evaluation(problem), anchored=np.array([True]))
        turn = np.array([0.0, 1e-4, 0.0])
        c = integrator.evaluate_contact(problem, state, state.x, state.Lambda, state.v, state.W, turn, 0.0, ())
        assert c.s - state.s == pytest.approx(np.array([[1e-5, 0]]), rel=1e-12, abs=0)

    def test_a_point_that_slides_and_one_that_sticks(self):
        sliding = after(physics.mass_on_a_foot(z=physics.resting(), v=(1.0, 0, 0)), 5)
        sticking = after(physics.mass_on_a_foot(z=physics.resting(), v=(1e-5, 0, 0)), 5)
        assert sliding.sliding.all()
        assert not sticking.sliding.any()
        assert sliding.anchored.all()
        assert sticking.anchored.all()
        # on the cone, against the motion
        assert sliding.F[0, 0] == pytest.approx(-0.25 * sliding.F[0, 2], rel=1e-15)

    def test_a_point_in_the_air_neither_slides_nor_holds(self):
        state = after(physics.mass_on_a_foot(z=1e-3, v=(1.0, 0, 0)), 5)
        assert not state.sliding.any()
        assert not state.anchored.any()
        assert np.array_equal(state.F, np.zeros((1, 3)))
