"""What a run gives back."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import rockref
from rockref.model import rotation
from rockref.model.errors import InputError
from rockref.model.problem import stack
from rockref.model.simulate import simulate
from tests import physics
from tests.refusal import refused

MODEL = rockref.Model.table_3_1()


@pytest.fixture(scope="module")
def short():
    return simulate(MODEL.problem(duration=0.02))


def tilting(angles, t=None):
    """A response whose tilt is given; everything else is of no interest."""
    base = simulate(MODEL.problem(duration=1e-4, output_rate=1e4))
    angles = np.asarray(angles, float)
    Theta = np.zeros((len(angles), 3))
    Theta[:, 0] = angles
    t = np.arange(len(angles), dtype=float) if t is None else t
    return replace(base, t=t, Lambda=rotation.exponential(Theta))


def test_crv_is_the_measured_channel(short):
    assert np.array_equal(short.crv, short.W * (180 / np.pi))


def test_tilt_is_negative_at_release(short):
    assert short.tilt[0] == pytest.approx(-0.1170, abs=1e-6)
    assert np.all(np.diff(short.tilt) > 0)


class TestMainImpacts:
    def test_zero_crossings_between_the_rows(self):
        # straight lines through zero at 1.25 and 3.5
        assert tilting([-0.05, -0.01, 0.03, 0.02, -0.02]).main_impacts() == pytest.approx([1.25, 3.5], rel=1e-12)

    def test_a_quiver_at_rest_is_no_impact(self):
        """Through zero from a swing and into the quiver; the twenty crossings of the quiver itself are none."""
        quiver = -1e-6 * (-1.0) ** np.arange(20)
        instants = tilting(np.concatenate([[-0.1, -0.05, 0.05], quiver])).main_impacts()
        assert instants == pytest.approx([1.5, 3.0], abs=1e-4)

    def test_rows_may_be_any_time_apart(self):
        t = np.array([10.0, 10.5, 12.5])
        # one fifth of the way from 10.5 to 12.5
        assert tilting([-0.05, -0.01, 0.04], t).main_impacts() == pytest.approx([10.9], rel=1e-12)

    def test_the_first_row_may_be_the_whole_swing(self):
        assert tilting([-0.05, 0.05, 0.01]).main_impacts() == pytest.approx([0.5], rel=1e-12)

    @pytest.mark.parametrize("largest", [0.5, 0.1, 1e-3])
    def test_a_swing_counts_above_a_thousandth_of_the_largest(self, largest):
        """The second half swing decides on the second crossing, whatever comes after it."""
        for size, count in ((1.01e-3, 2), (0.99e-3, 1)):
            assert len(tilting(largest * np.array([-1, -0.5, size, -size / 2])).main_impacts()) == count
            assert len(tilting(largest * np.array([-1, -0.5, size, -0.5])).main_impacts()) == count

    def test_a_swing_of_a_thousandth_exactly_is_none(self):
        # of angles this small the tangent is the angle itself, to the last bit
        tangent = 1e-9 * np.array([-1, 1e-3, -1e-4])
        Lambda = np.zeros((3, 3, 3))
        Lambda[:, 2, 1], Lambda[:, 2, 2] = tangent, 1
        r = replace(tilting(tangent), Lambda=Lambda)
        assert np.array_equal(r.tilt, tangent)
        assert len(r.main_impacts()) == 1

    def test_a_block_that_does_not_cross_has_none(self):
        assert len(tilting([-0.1, -0.05, -0.2]).main_impacts()) == 0


class TestOverturned:
    def test_beyond_45_degrees(self):
        assert tilting([-0.1, -0.8]).overturned
        assert not tilting([-0.1, -0.7]).overturned

    def test_a_block_pushed_over_is_a_result(self):
        """Released near the tipping angle with a push of 0.2 rad/s against the fall: it goes over, and no error."""
        problem = MODEL.problem(duration=0.8, theta_0=0.14, output_rate=100.0)
        start = replace(problem.start, W=np.array([-1.5, 0, 0]))
        response = rockref.simulate(replace(problem, start=start), engine="auto")
        assert response.overturned


class TestContacts:
    def test_intervals_of_each_point(self, short):
        contacts = dict(short.contacts())
        assert list(contacts) == list(short.problem.points.names)
        assert contacts["1ext"] == pytest.approx(np.array([[0, 0.02]]))
        assert contacts["3int"].shape == (0, 2)

    def test_on_and_off(self, short):
        on = np.zeros((6, 8), bool)
        on[[0, 1, 4], 2] = True
        r = replace(short, t=np.arange(6.0), anchored=on)
        assert np.array_equal(dict(r.contacts())["3ext"], [[0, 1], [4, 4]])


class TestEnergy:
    def test_terms(self, short):
        e = short.energy()
        assert e["potential"] == pytest.approx(54 * 9.81 * short.x[:, 2], rel=1e-15)
        kinetic = 27 * np.sum(short.v**2, -1) + 0.5 * short.W**2 @ [2.175048, 2.175048, 0.09]
        assert e["kinetic"] == pytest.approx(kinetic, rel=1e-13)
        # 2 x 264.87^2 / (2 x 6e7)
        assert e["stored_normal"][0] == pytest.approx(264.87**2 / 6e7, rel=1e-6)
        assert e["total"] == pytest.approx(
            e["kinetic"] + e["potential"] + e["stored_normal"] + e["stored_tangential"], rel=1e-15
        )
        assert e["dissipated"] == pytest.approx(e["total"][0] - e["total"], abs=1e-12)

    def test_springs_under_round_feet_carry_the_same_weight(self):
        e = simulate(MODEL.replace(foot_radius=1e-3).problem(duration=1e-4)).energy()
        assert e["stored_normal"][0] == pytest.approx(264.87**2 / 6e7, rel=1e-6)

    @pytest.mark.parametrize("radius", [0.0, 1e-3])
    def test_of_a_batch_is_that_of_its_members(self, radius):
        problems = [MODEL.replace(foot_radius=radius).problem(duration=0.003, theta_0=q) for q in (0.02, 0.1)]
        together = simulate(stack(problems)).energy()
        for i, problem in enumerate(problems):
            for key, values in simulate(problem).energy().items():
                assert np.array_equal(together[key][i], values), key


class TestFrame:
    def test_columns_carry_units(self, short):
        frame = short.to_frame()
        assert list(frame.columns[:11]) == [
            "t_s", "wx_deg_s", "wy_deg_s", "wz_deg_s", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz",
        ]  # fmt: skip
        assert len(frame.columns) == 11 + 8 * 5
        assert len(frame) == len(short.t) == 41
        assert np.array_equal(frame["wx_deg_s"], short.crv[:, 0])
        assert np.array_equal(frame["fz_2ext_N"], short.F[:, 1, 2])
        assert np.array_equal(frame["contact_1ext"], short.anchored[:, 0])
        assert np.array_equal(frame["slip_1ext"], short.sliding[:, 0])
        q = frame[["qw", "qx", "qy", "qz"]].to_numpy()
        # a thousand steps have taken the matrix that far from orthogonal; the quaternion is of unit length
        assert np.max(np.abs(rotation.from_quaternion(q) - short.Lambda)) < 1e-14


@dataclass(frozen=True)
class Counting(physics.Pull):
    """Pulls at nothing, and adds the mass of the block to its memory in every step."""

    def start(self, problem):
        return {"weights": np.zeros(problem.batch)}

    def advance(self, problem, c, h, m):
        m["weights"] = m["weights"] + problem.block.mass


def assert_same(a, b):
    for name in a.__dataclass_fields__:
        x, y = getattr(a, name), getattr(b, name)
        assert (x is None) == (y is None), name
        if name != "memory" and x is not None:
            assert np.array_equal(x, y), name


class TestBatch:
    def test_picking_gives_the_response_of_the_one(self):
        problems = [MODEL.problem(duration=0.002, theta_0=q) for q in (0.05, 0.1)]
        both = simulate(stack(problems))
        one = simulate(problems[1])
        assert np.array_equal(both[1].W, one.W)
        assert np.array_equal(both[1].final_state.x, one.final_state.x)
        assert both[1].problem.batch == ()
        assert both[1].main_impacts().shape == (0,)

    @pytest.mark.parametrize("radius", [0.0, 1e-3])
    def test_picking_gives_the_problem_and_the_memories_of_the_one(self, radius):
        models = [MODEL.replace(mass=m, K_N=k, mu_ext=0.3, foot_radius=radius) for m, k in ((54.0, 6e7), (60.0, 5e7))]
        problems = [replace(model.problem(duration=1e-4, output_rate=1e5), effects=(Counting(),)) for model in models]
        both = simulate(stack(problems))
        for i, one in enumerate(map(simulate, problems)):
            assert_same(both[i].problem.block, one.problem.block)
            assert_same(both[i].problem.points, one.problem.points)
            assert_same(both[i].problem.start, one.problem.start)
            assert_same(both[i].final_state, one.final_state)
            assert np.array_equal(both[i].final_state.memory[0]["weights"], 10 * one.problem.block.mass)

    @pytest.mark.parametrize("method", ["main_impacts", "contacts", "to_frame"])
    def test_what_needs_one_block_says_so(self, method):
        both = simulate(stack([MODEL.problem(duration=0.001)] * 2))
        error = refused(getattr(both, method))
        assert (error.code, error.where) == ("E-BATCH", method)

    def test_one_block_is_not_indexed(self, short):
        with pytest.raises(InputError) as refused:
            short[0]
        assert refused.value.code == "E-BATCH"


class TestState:
    def test_of_a_row_is_a_start(self, short):
        s = short.state(10)
        assert s.t == short.t[10]
        assert np.array_equal(s.W, short.W[10])
        assert s.a is None
        again = simulate(replace(short.problem, start=s, duration=0.01))
        # the half step of the row's acceleration is made anew from the velocities at the row
        assert np.max(np.abs(again.W[10] - short.W[20])) < 1e-4
