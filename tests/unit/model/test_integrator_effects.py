"""The step with effects: when they are called, what they are given, and what becomes of what they give."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest

import rockref
from rockref.effects.base import Effect, Quantity
from rockref.model import integrator
from rockref.model.problem import as_arrays
from tests import physics
from tests.unit.model.test_integrator import after

MODEL = rockref.Model.table_3_1()


class Shaken:
    """A plate that moves along x as its memory says."""

    def plate_motion(self, t, m):
        return np.array([m["rate"] * t, 0, 0]), np.array([m["rate"], 0, 0])


class Turning:
    """A plate that turns about X as its memory says."""

    def plate_motion(self, t, m):
        return np.zeros(3), np.zeros(3), np.array([m["turn"], 0, 0]), np.array([2 * m["turn"], 0, 0])


class Still:
    def plate_motion(self, t, m):
        return None


@dataclass(frozen=True)
class Lifted(physics.Pull):
    """The plate is 1e-6 m above its place and comes up with 1 mm/s."""

    def plate_motion(self, t, m):
        return np.array([0, 0, 1e-6]), np.array([0, 0, 1e-3])


class TestPlateMotion:
    def test_motions_add_up(self):
        effects = [(Shaken(), {"rate": 2.0}), (Still(), {}), (Shaken(), {"rate": 0.5})]
        q, q_rate = integrator.plate_motion(effects, 3.0)
        assert np.array_equal(q, [7.5, 0, 0])
        assert np.array_equal(q_rate, [2.5, 0, 0])

    def test_turns_add_up_and_follow_the_motion(self):
        effects = [(Shaken(), {"rate": 2.0}), (Turning(), {"turn": 1.0}), (Turning(), {"turn": 0.5})]
        motion = integrator.plate_motion(effects, 3.0)
        assert np.array_equal(motion, [[6.0, 0, 0], [2.0, 0, 0], [1.5, 0, 0], [3.0, 0, 0]])

    def test_without_one_the_plate_is_fixed(self):
        assert integrator.plate_motion([(Still(), {})], 3.0) is None

    def test_a_plate_that_comes_up_presses(self):
        problem = as_arrays(physics.mass_on_a_foot(effects=(Lifted(),)))
        # spring 60 N, damper 20 N
        assert integrator.first_evaluation(problem).F[0, 2] == pytest.approx(6e7 * 1e-6 + 2e4 * 1e-3, rel=1e-12)


@dataclass(frozen=True)
class Recorder(Effect):
    """Calls every hook and changes nothing."""

    size: float = 1.0
    id: ClassVar[str] = "recorder"
    quantities: ClassVar[dict[str, Quantity]] = {"size": Quantity("", 0.0, 0.0, 1.0, 1.0)}
    calls: ClassVar[list[str]] = []

    def start(self, problem):
        return {"steps": np.zeros(problem.batch)}

    def plate_motion(self, t, m):
        self.calls.append("plate_motion")

    def normal_force(self, F_N, k, points, m):
        self.calls.append("normal_force")
        return F_N

    def friction_coefficient(self, mu_0, mu, F_N, k, points, m):
        self.calls.append("friction_coefficient")
        return mu_0, mu

    def point_wrench(self, problem, c, m):
        self.calls.append("point_wrench")

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        self.calls.append("body_wrench")

    def advance(self, problem, c, h, m):
        self.calls.append("advance")
        m["steps"] = m["steps"] + 1


@dataclass(frozen=True)
class Witness(Recorder):
    """Keeps what every hook is given; pulls and twists so that the predicted rates differ from the old ones."""

    id: ClassVar[str] = "witness"
    given: ClassVar[dict[str, tuple]] = {}

    def plate_motion(self, *given):
        self.given["plate_motion"] = given

    def normal_force(self, *given):
        self.given["normal_force"] = given
        return given[0]

    def friction_coefficient(self, *given):
        self.given["friction_coefficient"] = given
        return 0.5 * given[0], 0.25 * given[1]

    def point_wrench(self, *given):
        self.given["point_wrench"] = given
        given[2]["asked at"] = given[1].t
        return np.array([54.0, 0, 0]), np.array([0, 0, 9.0])

    def body_wrench(self, *given):
        self.given["body_wrench"] = given

    def advance(self, *given):
        self.given["advance"] = given


# For every test anew: mutmut lets a test judge the functions that it calls itself.
@pytest.fixture
def witnessed():
    start = physics.mass_on_a_foot(z=-1e-6, v=(0.3, 0, 0), mu_0=0.5, mu=0.4, effects=(Witness(),))
    problem = as_arrays(replace(start, start=replace(start.start, W=np.array([0.0, 0, 2]), t=7.0)))
    first = integrator.first_evaluation(problem)
    inertia = integrator.prepared_inertia(problem.block)
    state = integrator.step(problem, first, inertia)
    A = integrator.angular_acceleration(first.T, first.W, inertia.J * first.W, inertia.J_inverse)
    return problem, first, state, A, dict(Witness.given)


class TestWhatEffectsAreGiven:
    def test_the_plate_is_asked_at_the_new_time(self, witnessed):
        t, m = witnessed[4]["plate_motion"]
        assert t == witnessed[2].t == 7 + 1e-5
        assert m == witnessed[2].memory[0]

    def test_forces_get_kinematics_points_and_memory(self, witnessed):
        problem, _, state, _, given = witnessed
        F_N, k, points, m = given["normal_force"]
        assert F_N == points.K_N * k.xi + points.C_N * k.xi_rate
        assert points is problem.points
        assert np.array_equal(k.u[0], state.x)
        assert m is state.memory[0]
        mu_0, mu, F_N, of_friction, *rest = given["friction_coefficient"]
        assert (mu_0, mu) == (0.5, 0.4)
        assert F_N == state.F[:, 2]
        assert of_friction is k
        assert rest[0] is points
        assert rest[1] is m

    def test_the_coefficient_that_they_give_is_the_one_that_slides(self, witnessed):
        _, _, state, _, _ = witnessed
        assert state.sliding.all()
        assert state.F[0, 0] == pytest.approx(-0.25 * 0.4 * state.F[0, 2], rel=1e-14)

    def test_loads_get_the_contact_and_the_predicted_motion(self, witnessed):
        problem, first, state, A, given = witnessed
        told, c, m = given["point_wrench"]
        assert told is problem
        assert m is state.memory[0]
        assert c.t == state.t
        assert np.array_equal(c.F, state.F)
        assert np.array_equal(c.F_N, state.F[:, 2])
        assert np.array_equal(c.s, state.s)
        assert c.touching.all()
        assert c.sliding.all()
        # turned by h W + h^2/2 A about z
        assert c.turn == pytest.approx([0, 0, 1e-5 * 2 + 0.5e-10 * A[2]], rel=1e-14)
        told, c_again, x, Lambda, v, W, m = given["body_wrench"]
        assert told is problem
        assert c_again is c
        assert m is state.memory[0]
        assert np.array_equal(x, state.x)
        assert np.array_equal(Lambda, state.Lambda)
        assert np.array_equal(v, first.v + 1e-5 * first.a)
        assert np.array_equal(W, first.W + 1e-5 * A)
        told, c_again, h, m = given["advance"]
        assert told is problem
        assert c_again is c
        assert h == 1e-5
        assert m is state.memory[0]

    def test_what_they_remember_is_kept_from_the_first_evaluation_on(self, witnessed):
        assert witnessed[1].memory[0]["asked at"] == 7
        assert witnessed[2].memory[0]["asked at"] == 7 + 1e-5

    def test_their_loads_are_added(self, witnessed):
        _, first, state, A, _ = witnessed
        # 54 N on 54 kg beside friction; 9 N m about z, where the foot has no lever
        assert first.a[0] == pytest.approx(1 + first.F[0, 0] / 54, rel=1e-14)
        assert np.array_equal(first.T, [0, 0, 9])
        assert state.W[2] == pytest.approx(2 + 1e-5 * 9 / physics.J_LONG, rel=1e-14)

    def test_an_effect_without_memory_is_an_error(self, witnessed):
        with pytest.raises(ValueError):
            integrator.acting(witnessed[0], ())


class TestEffects:
    def test_hooks_are_called_in_the_order_of_the_step(self):
        problem = replace(MODEL.problem(), effects=(Recorder(),))
        Recorder.calls.clear()
        state = after(problem, 2)
        evaluation = ["plate_motion", "normal_force", "friction_coefficient", "point_wrench", "body_wrench"]
        assert Recorder.calls == evaluation + (evaluation + ["advance"]) * 2
        assert state.memory[0]["steps"] == 2

    def test_an_effect_that_does_nothing_changes_no_bit(self):
        plain, with_effect = after(MODEL.problem(), 50), after(replace(MODEL.problem(), effects=(Recorder(),)), 50)
        for name in ("x", "v", "Lambda", "W", "F", "s", "T", "a"):
            assert np.array_equal(getattr(plain, name), getattr(with_effect, name)), name

    def test_memories_of_the_state_before_are_not_touched(self):
        problem = as_arrays(replace(MODEL.problem(), effects=(Recorder(),)))
        first = integrator.first_evaluation(problem)
        integrator.step(problem, first, integrator.prepared_inertia(problem.block))
        assert first.memory[0]["steps"] == 0

    def test_loads_add_up(self):
        pull = (physics.Pull(force=54.0), physics.Pull(force=-27.0))
        problem = as_arrays(physics.mass_on_a_foot(z=1.0, effects=pull))
        # 54 N - 27 N on 54 kg
        assert integrator.first_evaluation(problem).a == pytest.approx([0.5, 0, -9.81], rel=1e-15)
