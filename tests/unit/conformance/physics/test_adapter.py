"""What an adapter is given, what it may return, and what is said where it does not."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.conformance.physics import scene
from rockref.conformance.physics.adapter import KNOWN, Adapter, Engine, Lost, checked, load
from rockref.conformance.physics.adapters.rockref_law import run
from rockref.model.errors import InputError

CUBE = scene.box((0.3, 0.3, 0.3), 27.0, 0.5, step=0.1)
DOWN, ASIDE = (0.0, 0.0, -9.81), (1.0, 0.0, -9.81)


class TestLegs:
    def test_a_run_is_one_loop(self):
        found = scene.legs(CUBE, [0.0, 0.2, 0.5], [(0.0, DOWN), (0.3, ASIDE)])
        assert found == [(DOWN, 0, True), (None, 2, True), (None, 1, False), (ASIDE, 2, True)]

    def test_a_row_at_a_change_is_of_the_gravity_before(self):
        found = scene.legs(CUBE, [0.3, 0.4], [(0.0, DOWN), (0.3, ASIDE)])
        assert found == [(DOWN, 0, False), (None, 3, True), (ASIDE, 1, True)]

    def test_what_comes_after_the_last_row_is_left_out(self):
        assert scene.legs(CUBE, [0.2], [(0.0, DOWN), (0.5, ASIDE)])[-1] == (None, 2, True)


@pytest.mark.parametrize("axis, onto", [("x", 1), ("y", 2), ("z", 0)])
def test_a_turn_by_a_right_angle(axis, onto):
    """About x it takes y to z, about y z to x, about z x to y."""
    assert scene.turn(axis, np.pi / 2)[:, onto] == pytest.approx(np.eye(3)[(onto + 1) % 3], abs=1e-15)


def test_the_inertia_of_a_cuboid_and_a_sphere():
    assert scene.box((1.0, 2.0, 3.0), 12.0, 0.5).inertia == (13.0, 10.0, 5.0)
    assert scene.sphere(0.5, 10.0, 0.5).inertia == pytest.approx((1.0, 1.0, 1.0))


class TestAnswers:
    def good(self):
        return [np.zeros((2, 3)), np.tile(np.eye(3), (2, 1, 1)), np.zeros((2, 3)), np.zeros((2, 3))]

    def test_four_arrays_are_a_motion(self):
        assert checked(self.good(), 2, "engine").R.shape == (2, 3, 3)

    @pytest.mark.parametrize("change", [lambda a: a[:3], lambda a: None, lambda a: [a[0][:1], *a[1:]]])
    def test_another_shape_is_refused(self, change):
        with pytest.raises(InputError) as e:
            checked(change(self.good()), 2, "engine")
        assert e.value.code == "E-SHAPE"

    def test_numbers_that_are_lost_are_told_with_their_place(self):
        arrays = self.good()
        arrays[2][1, 0] = np.nan
        with pytest.raises(Lost, match="v is not finite from instant 2 of 2"):
            checked(arrays, 2, "engine")

    def test_an_engine_that_stops_is_told_with_its_error(self):
        def stops(*_):
            raise ValueError("too stiff")

        engine = Engine(Adapter(SimpleNamespace(run=stops), "mine"), "default")
        with pytest.raises(Lost, match="ValueError: too stiff"):
            engine.run(CUBE, scene.Start.at_rest((0, 0, 1)), np.array([0.0]), scene.down(9.81))


class TestLoading:
    @pytest.mark.parametrize("name", KNOWN)
    def test_every_known_engine_has_an_adapter_that_says_what_it_needs(self, name):
        adapter = load(name)
        assert callable(adapter.run) and list(adapter.settings) == ["default", "careful"]
        why = adapter.absence()
        assert why is None or "pip install" in why
        if why is None:
            assert adapter.facts()["version"]

    def test_a_module_that_is_not_there_is_told(self):
        module = SimpleNamespace(run=None, REQUIRES="no_such_engine", INSTALL="pip install it")
        assert Adapter(module, "mine").absence() == "no_such_engine is not installed; pip install it"

    @pytest.mark.parametrize("target, text", [("bulet", None), ("none.py", None), ("empty.py", "a = 1\n")])
    def test_what_is_no_adapter_is_refused(self, tmp_path, target, text):
        if text is not None:
            (tmp_path / target).write_text(text)
        with pytest.raises(InputError) as e:
            load(str(tmp_path / target) if target.endswith(".py") else target)
        assert e.value.code == "E-BACKEND"


class TestTheLawAsAnEngine:
    """In NumPy: short runs."""

    SCENE = scene.box((0.3, 0.3, 0.3), 27.0, 0.5, step=1e-4, settings={"K": 1e6, "beta": 0.3})

    @pytest.mark.parametrize("settings", [{}, {"inner": 0.01}])
    def test_any_gravity_acts_exactly(self, settings):
        gravity = (3.0, -2.0, -7.0)
        free = self.SCENE.replace(plate=False, settings=self.SCENE.settings | settings)
        motion = run(free, scene.Start.at_rest((0, 0, 1)), np.array([0.0, 0.01]), [(0.0, gravity)])
        assert motion.v[1] == pytest.approx(0.01 * np.array(gravity), rel=1e-12)

    def test_contact_is_kept_where_gravity_turns(self):
        """A block at rest under its weight stays at rest: the change of gravity by nothing changes nothing."""
        sink = 27 * 9.81 / 4e6
        start = scene.Start.at_rest((0.0, 0.0, 0.15 - sink))
        one = run(self.SCENE, start, np.array([0.02]), [(0.0, (1.0, 0.0, -9.81))])
        two = run(self.SCENE, start, np.array([0.02]), [(0.0, (1.0, 0.0, -9.81)), (0.01, (1.0, 0.0, -9.81))])
        # The forces at the change are made anew from the same state; their velocities are not the predicted ones.
        assert two.x == pytest.approx(one.x, abs=1e-9)
