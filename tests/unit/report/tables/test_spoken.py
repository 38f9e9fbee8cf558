"""Sizes as a person says them: in millimetres, degrees, per cent; a plain number stays what it is."""

import math

import pytest

from rockref.report.tables.spoken import spoken


@pytest.mark.parametrize(
    "name, values, unit, said",
    [
        ("rolling_resistance.lever", (3.237e-4, 3.203e-4, 3.27e-4), "m", "0.324 mm (90 %: 0.32 to 0.327)"),
        ("plate_tilt.x", (1e-3, 9e-4, 1.1e-3), "rad", "0.0573 deg (90 %: 0.0516 to 0.063)"),
        ("gyro_scale.x", (1.021, 1.018, 1.024), "1", "+2.1 % (90 %: +1.8 to +2.4)"),
        ("stribeck_friction.ratio", (0.8, 0.7, 0.9), "1", "-20 % (90 %: -30 to -10)"),
        ("hertzian_contact.exponent", (1.5, 1.4, math.inf), "1", "1.5 (90 %: 1.4 to ∞)"),
        ("hysteretic_contact.kappa", (0.31, 0.3, None), "1", "0.31 (90 %: 0.3 to ∞)"),
        ("adhesion.force", (51234.5, 0.0, 6e4), "N", "5.12e+04 N (90 %: 0 to 6.00e+04)"),
        ("nobody.knows", (2.0, 1.0, 3.0), "1", "2 (90 %: 1 to 3)"),
        ("quadratic_drag.c_v", (0.3, 0.1, 1.6), "N s2/m2", "0.3 N s²/m² (90 %: 0.1 to 1.6)"),
    ],
)
def test_a_size_is_said_in_the_unit_of_a_person(name, values, unit, said):
    assert str(spoken(name, *values, unit)) == said


def test_what_the_number_means_is_known():
    assert spoken("rolling_resistance.lever", 1e-4, 0, 1, "m").meaning.startswith("shift of the pressure")


@pytest.mark.parametrize(
    "name, ends, determined",
    [
        ("quadratic_drag.c", (0.2, 0.4), True),
        ("quadratic_drag.c_v", (0.0, 1.6), False),
        ("gyro_scale.x", (0.99, 1.02), False),  # absent at one
        ("gyro_scale.x", (1.01, 1.02), True),
    ],
)
def test_a_number_is_determined_where_its_interval_leaves_out_that_the_effect_is_absent(name, ends, determined):
    assert spoken(name, sum(ends) / 2, *ends, "1").is_determined is determined
