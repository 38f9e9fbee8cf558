"""The public face: what a user types, and what he is told when it cannot be."""

from dataclasses import replace

import numpy as np
import pytest

import rockref
from rockref import InputError, Model
from rockref.model.parameters import PROPERTIES, chromosome_54, point_properties
from tests import physics
from tests.refusal import refused


def code_of(call):
    error = refused(call)
    return error.code, error.where


#: One model for every kind of array that a model may have.
MODELS = {
    "plain": Model.table_3_1(),
    "inertia": Model(inertia=np.diag([2.0, 2.1, 0.1])),
    "properties": Model(properties={k: np.full(8, 1e3 if k[0] in "KC" else 0.2) for k in PROPERTIES}),
    "custom": Model(
        points="custom", custom_points=physics.points([[0, 0.05, -0.3], [0.04, -0.05, -0.3], [-0.04, 0, -0.3]])
    ),
}


class TestModel:
    def test_table_3_1(self):
        block, points = Model.table_3_1().body()
        assert (float(block.mass), float(block.g)) == (54.0, 9.81)
        assert np.diag(block.inertia) == pytest.approx([2.175048, 2.175048, 0.09], rel=1e-14)
        assert points.names == ("1ext", "2ext", "3ext", "4ext", "1int", "2int", "3int", "4int")
        assert points.radius is None

    def test_four_points(self):
        _, points = Model.four_points().body()
        assert points.names == ("1ext", "2ext", "3ext", "4ext")
        assert np.array_equal(points.mu, np.full(4, 0.25))
        assert np.all(points.P[:, 2] == -0.344)

    def test_custom_points(self):
        own = physics.points([[0, 0.05, -0.3], [0.04, -0.05, -0.3], [-0.04, -0.05, -0.3]])
        assert Model(points="custom", custom_points=own).body()[1] is own

    @pytest.mark.parametrize("kind", MODELS)
    def test_what_is_read_back_is_equal_and_another_one_is_not(self, kind, tmp_path):
        model = MODELS[kind]
        model.save(tmp_path / "m.toml")
        again = Model.load(tmp_path / "m.toml")
        assert again == model and not again != model
        assert again != model.replace(mass=55.0) and again != model.replace(origin={"source": "another"})
        assert again != "a model"

    @pytest.mark.parametrize("name", ["P", "mu", "names", "radius"])
    def test_one_number_of_a_point_makes_another_model(self, name):
        own = physics.points([[0, 0.05, -0.3], [0.04, -0.05, -0.3], [-0.04, -0.05, -0.3]])
        value = getattr(own, name)
        other = {"names": ("a", "b", "c"), "radius": np.full(3, 1e-3)}.get(name)
        changed = replace(own, **{name: np.nextafter(value, 1.0) if other is None else other})
        model = Model(points="custom", custom_points=own)
        assert model != model.replace(custom_points=changed) and model.replace(custom_points=changed) != model
        assert model != Model(points="custom", custom_points=None)

    def test_replace_finds_fields_and_parameters(self):
        changed = Model.table_3_1().replace(mass=60.0, K_N=7e7, delta_long=(0, 0, 0, 0), effects=())
        assert (changed.mass, changed.parameters.K_N, changed.parameters.delta_long) == (60.0, 7e7, (0.0, 0, 0, 0))
        assert changed.parameters.K_T == 5e7
        assert Model.table_3_1().mass == 54.0

    def test_replace_does_not_invent_names(self):
        assert code_of(lambda: Model().replace(theta0=1.0)) == ("E-KEY", "Model.replace")
        with pytest.raises(InputError, match="'theta_0'"):
            Model().replace(theta0=1.0)

    def test_fifty_four_genes_of_the_table_make_the_table(self):
        table = Model.table_3_1()
        same = Model.from_chromosome_54(chromosome_54(table.parameters, table.mass))
        for key in ("P", *PROPERTIES):
            assert np.array_equal(getattr(same.body()[1], key), getattr(table.body()[1], key)), key

    def test_damping_goes_with_the_mass(self):
        light, heavy = Model(mass=27.0).body()[1], Model(mass=108.0).body()[1]
        assert heavy.C_N == pytest.approx(2 * light.C_N, rel=1e-15)

    def test_round_feet(self):
        assert np.array_equal(Model(foot_radius=1e-3).body()[1].radius, np.full(8, 1e-3))


class TestRefusals:
    @pytest.mark.parametrize(
        "change, where",
        [
            ({"mass": -54.0}, "mass"),
            ({"mass": 0.0}, "mass"),
            ({"width": np.nan}, "width"),
            ({"height": np.inf}, "height"),
            ({"g": 0.0}, "g"),
            ({"g": -9.81}, "g"),
            ({"K_N": -6e7}, "K_N"),
            ({"K_N": 0.0}, "K_N"),
            ({"K_T": np.inf}, "K_T"),
            ({"beta_int": -0.1}, "beta_int"),
            ({"beta_ext": np.nan}, "beta_ext"),
            ({"mu_int": -0.3}, "mu_int"),
            ({"mu_ext": np.inf}, "mu_ext"),
            ({"theta_0": -0.1}, "theta_0"),
            ({"foot_radius": -1e-3}, "foot_radius"),
            ({"foot_radius": np.nan}, "foot_radius"),
            ({"delta_long": (0, 0, 1.0, 0)}, "delta_long[2]"),
            ({"delta_diag": 0.071}, "delta_diag"),
            ({"delta_diag": -1e-3}, "delta_diag"),
            ({"inertia": -np.eye(3)}, "inertia"),
        ],
        ids=lambda change: str(change)[:40],
    )
    def test_values_out_of_range(self, change, where):
        assert code_of(lambda: Model().replace(**change).problem()) == ("E-RANGE", where)

    @pytest.mark.parametrize("key", ["mass", "K_N", "mu_ext", "delta_diag", "theta_0"])
    @pytest.mark.parametrize("value", ["6e7", None, [1.0], True])
    def test_what_is_no_number(self, key, value):
        assert code_of(lambda: Model().replace(**{key: value}).problem()) == ("E-TYPE", key)

    def test_three_heights(self):
        assert code_of(lambda: Model().replace(delta_long=(0, 0, 0)).problem()) == ("E-SHAPE", "delta_long")

    def test_unknown_point_set(self):
        assert code_of(lambda: Model(points="six_points").problem()) == ("E-KEY", "points")

    def test_custom_points_forgotten(self):
        assert code_of(lambda: Model(points="custom").problem()) == ("E-KEY", "custom_points")

    @pytest.mark.parametrize("wrong", [np.ones(7), np.ones((8, 2)), 1.0])
    def test_properties_of_another_number_of_points(self, wrong):
        q = point_properties(Model().parameters, 54.0, np.arange(8) < 4)
        assert code_of(lambda: Model(properties={**q, "C_T": wrong}).problem()) == ("E-SHAPE", "properties['C_T']")

    def test_properties_that_are_missing(self):
        assert code_of(lambda: Model(properties={}).problem()) == ("E-SHAPE", "properties['K_N']")

    @pytest.mark.parametrize("tilt", [0.0, 0.15, 6.7])
    def test_tilt_beyond_tipping(self, tilt):
        """6.7 is the tilt in degrees."""
        assert code_of(lambda: rockref.simulate(Model(), theta_0=tilt)) == ("E-TILT", "theta_0")

    def test_a_step_too_large(self):
        for engine in ("numpy", "numba"):
            assert code_of(lambda: rockref.simulate(Model(), step=2e-4, engine=engine))[0] == "E-STEP"  # noqa: B023

    def test_an_engine_that_is_none(self):
        assert code_of(lambda: rockref.simulate(Model(), engine="fortran"))[0] == "E-ENGINE"


class TestSimulate:
    @pytest.mark.parametrize("other", ["model.toml", None, {"mass": 54.0}])
    def test_what_is_no_model(self, other):
        found = code_of(lambda: rockref.simulate(other))
        assert found == ("E-TYPE", "model")

    def test_a_model_from_release(self):
        response = rockref.simulate(Model.table_3_1(), duration=0.002, output_rate=1000)
        assert response.t == pytest.approx([0, 0.001, 0.002])

    def test_a_problem_brings_its_own_times(self):
        problem = Model.table_3_1().problem(duration=0.001, step=2e-5, output_rate=1000)
        response = rockref.simulate(problem, duration=99, step=99)
        assert len(response.t) == 2
        assert response.problem.step == 2e-5

    def test_start_posture(self):
        tilted = rockref.simulate(Model(), duration=1e-4, output_rate=1e4, theta_0=0.05, turned=True)
        assert tilted.tilt[0] == pytest.approx(-0.05, abs=1e-6) or tilted.tilt[0] == pytest.approx(0.05, abs=1e-6)

    def test_in_other_precisions(self):
        for dtype in (np.float32, np.longdouble):
            assert (
                rockref.simulate(Model(), duration=1e-4, output_rate=1e4, engine="numpy", dtype=dtype).W.dtype == dtype
            )

    def test_an_overturning_block_is_a_result(self):
        """Pushed over the edge: no error, and it says so."""
        problem = Model().problem(duration=1.0, theta_0=0.14, output_rate=100)
        pushed = problem.replace(start=rockref.State.at_rest(problem.start.x, problem.start.Lambda, 8, W=[-1.5, 0, 0]))
        assert rockref.simulate(pushed, engine="numba").overturned
        assert not rockref.simulate(Model(), duration=0.1, engine="numba").overturned


class TestEffectsInWords:
    def test_one_or_several(self):
        one = Model(effects="rolling_resistance:lever=3e-4")
        assert [(e.id, e.values()["lever"]) for e in one.effects] == [("rolling_resistance", 3e-4)]
        both = one.replace(effects=["gyro_scale:x=1.02", "rolling_resistance:lever=3e-4"])
        assert {e.id for e in both.effects} == {"gyro_scale", "rolling_resistance"}
        assert both.replace(effects=both.effects) == both

    @pytest.mark.parametrize("effects", [3, [3], {"rolling_resistance": 3e-4}, None])
    def test_wrong_types_are_refused(self, effects):
        error = refused(Model, effects=effects)
        assert error.code == "E-TYPE"

    def test_parameters_that_are_none(self):
        error = refused(Model, parameters={"K_N": 6e7})
        assert error.code == "E-TYPE"

    def test_a_model_says_itself_in_a_line(self):
        model = Model(effects="rolling_resistance:lever=3e-4")
        assert repr(model) == "<Model: 54.0 kg, 0.1 x 0.1 x 0.688 m, eight_points, rolling_resistance>"


def test_a_model_says_itself_in_a_few_lines():
    head, numbers, effect = Model(effects="rolling_resistance:lever=3e-4").summary().splitlines()
    assert head.startswith("Model: 54.0 kg") and "delta_long_4 5.8e-05" in numbers and "theta_0 0.117" in numbers
    assert effect == "rolling_resistance: lever 0.0003"


def test_an_argument_that_a_run_does_not_know_is_refused_with_the_nearest():
    error = refused(rockref.simulate, Model(), duration=0.01, turnt=True)
    assert (error.code, error.cure) == ("E-KEY", "Did you mean 'turned'?")
