"""Typical sizes on other blocks, where the answer follows from the physics."""

import math

import pytest

from rockref import Model
from rockref.discover.hypotheses.effects import effect_parameters, seeds_of
from rockref.effects import catalogue
from rockref.effects.natural import SOURCE, NaturalUnits, factor_of, natural_units

#: Eight times the mass, twice the length: the same block of the same material, twice as large.
TWICE = NaturalUnits(8.0, 2.0)


def test_the_source_block_keeps_all_sizes():
    assert natural_units(Model.table_3_1()) == SOURCE
    twice = natural_units(Model.table_3_1().replace(mass=8 * 54.0, width=0.2, depth=0.2, height=2 * 0.688))
    assert (twice.mass, twice.length) == pytest.approx((TWICE.mass, TWICE.length))


@pytest.mark.parametrize(
    ("unit", "factor"),
    [
        ("1", 1.0),
        ("rad", 1.0),
        ("m", 2.0),
        ("kg", 8.0),
        ("s", math.sqrt(2)),
        ("N", 8.0),  # a weight
        ("m/s2", 1.0),  # gravity is the same
        ("N/m", 4.0),
        ("rad/s", 1 / math.sqrt(2)),  # the rate of rocking
        ("N m s2", 8.0 * 2**2),  # c w^2 beside m g R, w^2 as g / R
        ("N s2/m2", 4.0),
        ("kg2", 64.0),
        ("1/kg2", 1 / 64.0),
    ],
)
def test_factors(unit, factor):
    assert TWICE.factor(unit) == pytest.approx(factor)


def test_what_belongs_to_sensor_film_or_floor_keeps_its_size():
    for id, name in (("gyro_drift", "bias_x"), ("adhesion", "range"), ("stribeck_friction", "velocity")):
        assert factor_of(catalogue.find(id), name, TWICE) == 1.0
    assert factor_of(catalogue.find("adhesion"), "force", TWICE) == 8.0


def test_one_typical_size_is_as_many_deviations_on_any_block():
    for kind in catalogue.IN_STEP_ORDER:
        here, there = (effect_parameters(kind.id, 1, units=units) for units in (SOURCE, TWICE))
        assert [p.typical for p in here] == [p.typical for p in there]
    drag = effect_parameters("quadratic_drag", 1, units=TWICE)[0]
    assert drag.value(drag.typical) == pytest.approx(32 * 0.4)


def test_starts_grow_with_the_block():
    here, there = (effect_parameters("adhesion", 1, units=units) for units in (SOURCE, TWICE))
    for a, b in zip(seeds_of(here, "adhesion", []), seeds_of(there, "adhesion", [], TWICE), strict=True):
        assert a == pytest.approx(b)
    force = [p.value(z) for p, z in zip(there, seeds_of(there, "adhesion", [], TWICE)[0], strict=True)][0]
    assert force == pytest.approx(8 * 15.0)
