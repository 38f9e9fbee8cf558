"""What is hidden has the names and units of the catalogue, and a size that can be seen."""

import numpy as np
import pytest

from rockref.blind.cases import hidden, unlisted
from rockref.blind.cases.drawing import CATALOGUE, uneven
from rockref.blind.scoring import sizes
from rockref.blind.simulator.release import simulate
from rockref.blind.simulator.world import TABLE, build
from rockref.effects.catalogue import EFFECTS


def drawn(id, size=1.0, other=False, given=None, seed=2):
    world = build(dict(TABLE))
    truth = (hidden.EFFECTS | unlisted.EFFECTS)[id](world, np.random.default_rng(seed), size, other, given or {})
    return world, truth


def test_every_effect_of_the_catalogue_can_be_hidden():
    assert set(hidden.EFFECTS) == set(EFFECTS)
    assert not set(unlisted.EFFECTS) & set(EFFECTS)


@pytest.mark.parametrize("id", hidden.EFFECTS)
def test_parameters_are_named_as_in_the_catalogue_and_plausible(id):
    _, truth = drawn(id)
    assert truth["form"] == CATALOGUE
    for name, value in truth["parameters"].items():
        q = EFFECTS[id].quantities[name]
        if id == "gyro_saturation":
            assert -1 < value < 0  # a share of the largest rate, known when that is
        else:
            # Not outside the range that the catalogue calls plausible by more than the scatter of a draw.
            width = q.high - q.low
            assert q.low - 0.3 * width <= value <= q.high + 0.3 * width


@pytest.mark.parametrize("id", sizes.ABSENT)
def test_absent_values_are_those_of_the_catalogue(id):
    for name, absent in sizes.ABSENT[id].items():
        if absent != sizes.RATIO:
            assert EFFECTS[id].quantities[name].absent == absent


@pytest.mark.parametrize("id", [id for id in hidden.EFFECTS if id not in ("plate_tilt", "release_velocity")])
def test_another_form_is_said_to_be_one(id):
    assert drawn(id, other=True)[1]["form"] != CATALOGUE


@pytest.mark.parametrize("id", ["rolling_resistance", "cable_restraint", "gyro_scale", "uneven_foot_damping"])
def test_twice_the_size_is_twice_as_much(id):
    (_, one), (_, two) = drawn(id, 1.0), drawn(id, 2.0)
    absent = sizes.ABSENT[id]
    for name, value in absent.items():
        first, second = one["parameters"][name], two["parameters"][name]
        if id == "uneven_foot_damping":
            assert np.log(second) == pytest.approx(2 * np.log(first))
        else:
            assert second - value == pytest.approx(2 * (first - value))


def test_values_can_be_set():
    world, truth = drawn("quadratic_drag", given={"c": 1.25})
    assert truth["parameters"] == {"c": 1.25} and world["drag"] == 1.25


def test_uneven_factors_have_the_spread_they_are_given():
    factors = uneven(np.random.default_rng(0), 0.35)
    assert np.log(factors).mean() == pytest.approx(0, abs=1e-12) and np.log(factors).std() == pytest.approx(0.35)


@pytest.mark.parametrize(
    "id", ["plate_tilt", "quadratic_drag", "cable_restraint", "lingering_wire_pull", "magnet", "rolling_resistance"]
)
def test_loads_change_the_first_arc_in_the_right_sense(id):
    plain = simulate(build(dict(TABLE)), 0.117, seconds=0.45)
    given = {"x": 0.0, "y": 1e-3} if id == "plate_tilt" else {}
    world, _ = drawn(id, given=given)
    # All of them hold the block back on its way from the lean to +y: the plate falls to +y, drag, the cable that ties
    # it to the start, the wire, the pole at +y, the rolling edge. So it swings more slowly.
    held = simulate(world, 0.117, seconds=0.45)
    assert np.all(held[2000::500, 0] < plain[2000::500, 0])


def test_a_soft_plate_lets_the_block_down_gently_and_a_stiff_one_is_none():
    from rockref.blind.simulator.posture import stand

    world, _ = drawn("compliant_support", given={"frequency": 3000.0, "mass": 2000.0})
    assert stand(world, 0.1, False)[0] == pytest.approx(stand(build(dict(TABLE)), 0.1, False)[0])
    stiff = simulate(world, 0.117, seconds=0.6)
    plain = simulate(build(dict(TABLE)), 0.117, seconds=0.6)
    soft = simulate(drawn("compliant_support")[0], 0.117, seconds=0.6)
    # 7e11 N/m under contacts of 6e7: a ten-thousandth of their depth.
    assert np.abs(stiff - plain).max() < 0.05 * np.abs(soft - plain).max()


def test_factors_that_are_drawn_alike_are_drawn_again():
    """Four equal numbers have no spread that could be made the wanted one."""

    class Alike:
        def __init__(self):
            self.left = [np.full(4, 0.7), np.array([1.0, 2.0, 3.0, 4.0])]

        def normal(self, size):
            return self.left.pop(0)

    assert np.log(uneven(Alike(), 0.2)).std() == pytest.approx(0.2)


def test_a_push_may_turn_the_block_about_a_line_above_its_feet():
    plain, other = drawn("release_velocity")[0], drawn("release_velocity", other=True)[0]
    np.testing.assert_array_equal(plain.kick, other.kick)
    assert (plain.kick_at, other.kick_at) == (0.0, 5e-3) and "above the feet" in drawn("release_velocity", other=True)[
        1
    ]["form"]


def test_a_range_is_a_share_of_the_largest_rate_unless_it_is_set():
    assert -0.95 <= drawn("gyro_saturation")[0].sensor.range <= -0.4
    world, truth = drawn("gyro_saturation", given={"range": 1.75})
    assert world.sensor.range == 1.75 and truth["parameters"] == {"range": 1.75}
