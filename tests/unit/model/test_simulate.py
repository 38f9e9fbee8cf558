"""The loop: which rows it records, what it refuses, what it says when the numbers are lost."""

from dataclasses import replace

import numpy as np
import pytest

import rockref
from rockref.model import rotation
from rockref.model import simulate as loop
from rockref.model.errors import InputError, NumericalError
from rockref.model.problem import State, as_arrays, stack
from tests import physics
from tests.refusal import refused

MODEL = rockref.Model.table_3_1()


def code_of(call):
    with pytest.raises((InputError, NumericalError)) as refused:
        call()
    return refused.value.code, refused.value.where


class TestRows:
    def test_a_row_every_fifty_steps_at_2_khz(self):
        steps = loop.output_steps(MODEL.problem(duration=0.01))
        assert np.array_equal(steps, np.arange(0, 1001, 50))

    def test_rates_that_do_not_divide_take_the_nearest_step(self):
        steps = loop.output_steps(MODEL.problem(duration=0.001, output_rate=30000.0))
        # 3.33 steps apart
        assert np.array_equal(steps[:5], [0, 3, 7, 10, 13])

    def test_the_last_row_is_not_beyond_the_duration(self):
        assert loop.output_steps(MODEL.problem(duration=0.00999, output_rate=100.0))[-1] == 0
        assert loop.output_steps(MODEL.problem(duration=0.01, output_rate=100.0))[-1] == 1000

    def test_every_step_at_the_rate_of_the_steps(self):
        assert np.array_equal(loop.output_steps(MODEL.problem(duration=1e-4, output_rate=1e5)), np.arange(11))

    def test_the_last_row_is_there_in_long_runs_of_small_steps(self):
        """1.3355 / 4e-8 is 33387499.999999996 in float64."""
        for step in (4e-8, 2.5e-8, 1.25e-8, 1e-7):
            assert len(loop.output_steps(MODEL.problem(duration=1.3355, step=step))) == 2672

    def test_shapes_and_times(self):
        r = loop.simulate(MODEL.problem(duration=0.005, output_rate=1000.0))
        assert r.t == pytest.approx([0, 0.001, 0.002, 0.003, 0.004, 0.005], abs=1e-17)
        assert r.F.shape == (6, 8, 3)
        assert r.s.shape == (6, 8, 2)
        assert r.Lambda.shape == (6, 3, 3)
        b = loop.simulate(stack([MODEL.problem(duration=0.002, output_rate=1000.0)] * 3))
        assert b.F.shape == (3, 3, 8, 3)
        assert b.anchored.shape == (3, 3, 8)
        assert b.t.shape == (3,)

    def test_progress_of_a_few_rows_is_told_at_each(self):
        seen = []
        loop.simulate(physics.mass_on_a_foot(duration=1e-4), progress=seen.append)
        assert seen == [i / 11 for i in range(1, 12)]

    def test_progress_of_many_rows_is_told_two_hundred_times(self):
        seen = []
        loop.simulate(physics.mass_on_a_foot(duration=0.01), progress=seen.append)
        # of 1001 rows every fifth
        assert seen == [i / 1001 for i in range(1, 1002, 5)]

    def test_a_run_of_one_step(self):
        assert np.array_equal(loop.output_steps(physics.mass_on_a_foot(duration=1e-5)), [0, 1])
        assert len(loop.simulate(physics.mass_on_a_foot(duration=1e-5)).t) == 2

    @pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble])
    def test_a_run_is_as_precise_as_is_asked(self, dtype):
        r = loop.simulate(MODEL.problem(duration=1e-4), dtype=dtype)
        assert r.x.dtype == r.Lambda.dtype == r.F.dtype == dtype


class TestRefusals:
    @pytest.mark.parametrize("key", ["step", "duration", "output_rate"])
    @pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf])
    def test_times_that_are_none(self, key, value):
        assert code_of(lambda: loop.simulate(replace(MODEL.problem(), **{key: value}))) == ("E-RANGE", key)

    def test_shorter_than_a_step(self):
        assert code_of(lambda: loop.simulate(MODEL.problem(duration=1e-6)))[0] == "E-DURATION"

    def test_more_rows_than_steps(self):
        assert code_of(lambda: loop.simulate(MODEL.problem(output_rate=2e5))) == ("E-RATE", "output_rate")

    @pytest.mark.parametrize(
        "key, value", [("K_N", -1.0), ("K_T", 0.0), ("K_N", np.nan), ("C_N", -1e-9), ("C_T", np.inf), ("mu", -0.1)]
    )
    def test_point_properties_out_of_range_name_the_point(self, key, value):
        problem = MODEL.problem()
        values = getattr(problem.points, key).copy()
        values[5] = value
        assert code_of(lambda: loop.check_points(replace(problem.points, **{key: values}))) == (
            "E-RANGE",
            f"{key} of point 2int",
        )

    def test_negative_foot_radius(self):
        assert code_of(lambda: loop.check_points(physics.points([0, 0, 0], radius=-1e-3)))[0] == "E-RANGE"

    def test_dynamic_friction_above_static(self):
        assert code_of(lambda: loop.check_points(physics.points([0, 0, 0], mu_0=0.2, mu=0.3))) == ("E-RANGE", "mu_0")

    def test_a_step_too_large_for_the_stiffest_contact_names_one_that_will_do(self):
        error = refused(loop.simulate, MODEL.problem(step=5e-4, output_rate=2000.0))
        assert (error.code, error.where) == ("E-STEP", "step")
        allowed = float(error.cure.split(" at most ")[1].split()[0])
        loop.check(MODEL.problem(step=allowed * 0.99))


class TestBody:
    @pytest.mark.parametrize("key, value", [("mass", 0.0), ("mass", np.nan), ("g", -9.81), ("g", np.inf)])
    def test_mass_and_gravity(self, key, value):
        problem = MODEL.problem()
        problem = replace(problem, block=replace(problem.block, **{key: np.array(value)}))
        assert code_of(lambda: loop.simulate(problem)) == ("E-RANGE", key)

    @pytest.mark.parametrize(
        "J", [np.zeros((3, 3)), np.diag([1.0, 1, -1]), np.triu(np.ones((3, 3))), np.eye(3) * np.nan]
    )
    def test_an_inertia_that_no_body_has(self, J):
        problem = MODEL.problem()
        problem = replace(problem, block=replace(problem.block, inertia=J))
        assert code_of(lambda: loop.simulate(problem)) == ("E-RANGE", "inertia")

    @pytest.mark.parametrize("key", ["x", "v", "W", "Lambda"])
    def test_a_start_that_is_nowhere(self, key):
        problem = MODEL.problem()
        values = getattr(problem.start, key).copy()
        values.flat[0] = np.nan
        problem = replace(problem, start=replace(problem.start, **{key: values}))
        assert code_of(lambda: loop.simulate(problem)) == ("E-START", f"start.{key}")

    def test_a_start_that_is_no_rotation(self):
        problem = MODEL.problem()
        problem = replace(problem, start=replace(problem.start, Lambda=2 * problem.start.Lambda))
        assert code_of(lambda: loop.simulate(problem)) == ("E-START", "start.Lambda")


def test_the_step_that_is_offered_is_not_rounded_up():
    assert [loop.rounded_down(a) for a in (2.99e-5, 3e-5 + 1e-9, 1.234e-12, 0.999)] == pytest.approx(
        [2.9e-5, 3e-5, 1.2e-12, 0.99], rel=1e-12
    )


def test_no_step_is_offered_that_rounding_may_lift_above_the_limit():
    """A limit that has two digits itself: the next lower number is offered."""
    for digits in range(11, 100):
        assert loop.rounded_down(digits * 1e-6) == pytest.approx((digits - 1) * 1e-6, rel=1e-12, abs=0)


class TestLargestStep:
    def test_the_limit_itself_is_allowed(self):
        problem = physics.mass_on_a_foot(K_N=6e7, K_T=6e7, C_N=0, C_T=0)
        limit = loop.largest_step(problem)
        loop.check(replace(problem, step=limit, output_rate=0.5 / limit))
        with pytest.raises(InputError):
            loop.check(replace(problem, step=np.nextafter(limit, 1), output_rate=0.5 / limit))

    def test_of_one_foot_below_the_centre_is_that_of_its_pendulum(self):
        """Pushed sideways at h below the centre the foot feels the mass 1 / (1/m + h^2/J), the lesser J of two."""
        m, h, J = 54.0, 0.3, 1.5
        foot = physics.points([0, 0, -h], K_N=6e7, K_T=6e7, C_N=0, C_T=0)
        problem = replace(physics.mass_on_a_foot(), block=physics.block(m, (J, 2.0, 0.1)), points=foot)
        # of an undamped oscillator w h = 2
        expected = 2 / np.sqrt(6e7 * (1 / m + h * h / J))
        assert loop.largest_step(problem) == pytest.approx(expected, rel=1e-12, abs=0)

    def test_does_not_depend_on_the_axes_of_the_body(self):
        problem = MODEL.problem()
        Q = rotation.exponential(np.array([0.3, -0.5, 0.8]))
        block = replace(problem.block, inertia=Q @ problem.block.inertia @ Q.T)
        turned = replace(problem, block=block, points=replace(problem.points, P=problem.points.P @ Q.T))
        for other in (turned, stack([turned, turned])):
            # eigenvalues of 6 x 6 matrices, conditioned by the ratio of the moments, 24
            assert loop.largest_step(other) == pytest.approx(loop.largest_step(problem), rel=1e-12, abs=0)

    def test_does_not_depend_on_the_precision(self):
        problem = MODEL.problem()
        precise = loop.largest_step(as_arrays(problem, np.longdouble))
        assert precise == pytest.approx(loop.largest_step(problem), rel=1e-12, abs=0)

    @pytest.mark.parametrize("C_T", [0.0, 1e3, 2e4, 2e5])
    def test_is_where_a_damped_spring_begins_to_grow(self, C_T, monkeypatch):
        """A mass held by the tangential spring, friction out of reach: linear, so it grows or it does not."""

        def grows(factor):
            foot = dict(K_T=5e7, K_N=1e5, C_N=0.0, C_T=C_T, mu_0=1e9)
            limit = loop.largest_step(physics.mass_on_a_foot(**foot))
            problem = physics.mass_on_a_foot(z=physics.resting(K_N=1e5), v=(1e-3, 0, 0), step=factor * limit, **foot)
            monkeypatch.setattr(loop, "check", lambda problem: None)
            r = loop.simulate(replace(problem, duration=800 * problem.step))
            return np.max(np.abs(r.v[-100:, 0])) > 1e-3

        assert grows(1.01)
        assert not grows(0.99)

    def test_of_the_block_is_below_that_of_its_points_one_by_one(self):
        problem = MODEL.problem()
        alone = [replace(problem, points=physics.points(P)) for P in problem.points.P]
        assert loop.largest_step(problem) < min(map(loop.largest_step, alone))

    def test_of_a_batch_is_the_least(self):
        soft, stiff = MODEL.replace(K_N=1e7).problem(), MODEL.problem()
        assert loop.largest_step(stack([soft, stiff])) == pytest.approx(loop.largest_step(stiff), rel=1e-12)

    def test_without_points_any_step_will_do(self):
        assert loop.largest_step(physics.flying((1, 2, 3), (0, 0, 1), 1e-3, 0.1)) == np.inf


class TestLostNumbers:
    @pytest.mark.parametrize("name", ["x", "W", "Lambda"])
    @pytest.mark.parametrize("batch", [(), (3,)], ids=str)
    def test_one_number_is_enough(self, name, batch):
        state = State.at_rest(np.zeros(batch + (3,)), np.broadcast_to(np.eye(3), batch + (3, 3)), 8)
        assert not np.any(loop.body_lost(state))
        assert loop.body_lost(state).shape == batch
        values = np.array(getattr(state, name))
        (values[1] if batch else values).flat[-1] = np.nan
        lost = loop.body_lost(replace(state, **{name: values}))
        assert np.array_equal(lost, [False, True, False] if batch else True)
        has_no_place = loop.pose_lost(replace(state, **{name: values}))
        assert np.array_equal(has_no_place, np.asarray(lost) & (name != "W"))

    def test_nan_in_the_start_is_found_at_its_point(self):
        problem = MODEL.problem(duration=0.01)
        start = replace(problem.start, s=np.full((8, 2), np.nan), anchored=np.arange(8) == 1)
        with pytest.raises(NumericalError) as lost:
            loop.simulate(replace(problem, start=start))
        assert lost.value.code == "E-NAN"
        assert lost.value.where.startswith("step 0 ")
        assert "2ext" in lost.value.what

    def test_nan_at_a_later_step(self):
        """A spring that meets a NaN at t = 3 ms."""

        class Breaks(physics.Pull):
            def body_wrench(self, problem, c, x, Lambda, v, W, m):
                force = np.zeros_like(x)
                force[..., 2] = np.nan if c.t >= 0.003 else 0
                return force, np.zeros_like(x)

        problem = replace(MODEL.problem(duration=0.01), effects=(Breaks(force=1.0),))
        with pytest.raises(NumericalError) as lost:
            loop.simulate(problem)
        # the acceleration is lost at step 300, the position at the next
        assert lost.value.where == "step 301 (t = 0.00301 s)"
        assert "none of the contact points" in lost.value.what

    def test_what_an_effect_refuses_on_the_way_is_told_as_it_is(self):
        class Refuses(physics.Pull):
            def body_wrench(self, problem, c, x, Lambda, v, W, m):
                if c.t >= 0.003:
                    raise InputError("E-OWN", "pull", "is too much", "Pull less.")
                return np.zeros_like(x), np.zeros_like(x)

        error = refused(loop.simulate, physics.mass_on_a_foot(effects=(Refuses(),)))
        assert str(error) == "pull: is too much. Pull less. [E-OWN]"

    def test_of_a_batch_the_block_is_named(self):
        problem = stack([MODEL.problem(duration=0.002, theta_0=1e-4)] * 3)
        s, anchored = problem.start.s.copy(), problem.start.anchored.copy()
        s[1, 5], anchored[1, 5] = np.nan, True
        problem = replace(problem, start=replace(problem.start, s=s, anchored=anchored))
        with pytest.raises(NumericalError) as lost:
            loop.simulate(problem)
        assert "block 1" in lost.value.what
        assert lost.value.what.endswith("at: 2int")
        kept = loop.simulate(problem, keep_going=True)
        assert np.all(np.isfinite(kept.W[[0, 2]]))
        assert not np.any(np.isfinite(kept.W[1, -1]))


@pytest.mark.parametrize("direction", [0, 1])
@pytest.mark.parametrize("body", [0, 1])
@pytest.mark.parametrize("point", [0, 1, 2])
def test_the_stiffest_contact_is_the_one_with_the_shortest_step_by_itself(direction, body, point):
    """Undamped, one contact alone is stable up to 2 sqrt(m / K): three points under each of two bodies."""
    mass, K = np.array([60.0, 6000.0]), np.full((2, 2, 3), 5e7)
    # As heavy a body as the second one needs a hundred times the stiffness for the same step; this is a little more.
    K[direction, body, point] *= 2.0 * mass[body] / mass[0]
    if body:
        # Stiffer than any under the light body, and yet with a longer step.
        K[:, 1] = np.maximum(K[:, 1], 3e8)
    P = np.array([[0.0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]])
    problems = []
    for b in range(2):
        points = physics.points(P, K_N=K[0, b], K_T=K[1, b], C_N=0.0, C_T=0.0)
        start = State.at_rest(np.zeros(3), np.eye(3), 3)
        problems.append(replace(physics.mass_on_a_foot(mass=mass[b]), points=points, start=start))
    k = K[direction, body, point]
    axis = "NT"[direction]
    assert loop.stiffest(stack(problems)) == f"{point} with K_{axis} = {k:.3g} N/m and C_{axis} = 0 N s/m"


def test_points_with_names_of_their_own_are_taken():
    assert loop.check_names(physics.points([[0, 0, 0]] * 3)) is None
