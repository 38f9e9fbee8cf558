"""How wide intervals are: what the runs say, and what is added for a law that is a little wrong."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover import window_rules as rules
from rockref.discover.fit.baseline import baseline_parameters
from rockref.discover.fit.intervals import NINETY, UNSEEN, half_widths
from rockref.discover.hypotheses.candidates import SELDOM_PRIOR, parameters_of
from rockref.effects import catalogue


def halves(effect, z, covariance=None):
    """Half widths by name, of an effect alone at z (by name; zero where not given)."""
    parameters = parameters_of(catalogue.find(effect), 2)
    place = np.array([z.get(p.name.split(".")[1], 0.0) for p in parameters])
    covariance = np.zeros((len(place),) * 2) if covariance is None else covariance
    found = half_widths(SimpleNamespace(parameters=parameters), SimpleNamespace(z=place), covariance)
    return dict(zip((p.name.split(".")[1] for p in parameters), found, strict=True))


def test_what_the_runs_say_is_widened_as_calibrated():
    found = halves("spin_friction", {}, 0.04 * np.eye(2))
    assert found["radius"] == pytest.approx(NINETY * rules.INTERVAL * 0.2)


def test_a_size_is_known_to_its_systematic_part():
    found = halves("spin_friction", {"radius": -2.0}, 0.04 * np.eye(2))
    assert found["radius"] == pytest.approx(np.hypot(NINETY * rules.INTERVAL * 0.2, rules.SYSTEMATIC * 2.0))


def test_what_is_small_along_one_axis_is_known_no_better_for_it():
    found = halves("release_velocity", {"x": 3.0, "y": 0.0, "z": 1.5})
    whole = np.sqrt((3.0**2 + 1.5**2) / 3)
    assert found["x"] == pytest.approx(rules.SYSTEMATIC * 3.0)
    assert found["y"] == found["z"] == pytest.approx(rules.SYSTEMATIC * whole)


def test_the_height_of_the_centre_of_mass_is_known_to_less_than_its_place():
    """It trades with the tilts, whatever the covariance says."""
    found = halves("mass_eccentricity", {"x": 1.0})
    assert found["y"] == pytest.approx(rules.SYSTEMATIC / np.sqrt(3))
    assert found["z"] == pytest.approx(np.hypot(found["y"], UNSEEN["mass_eccentricity", "z"]))


def test_what_no_window_sees_are_parameters_that_there_are():
    names = {p.name for effect, _ in UNSEEN for p in parameters_of(catalogue.find(effect), 2)}
    assert {".".join(key) for key in UNSEEN} <= names


def test_numbers_of_another_unit_do_not_count():
    found = halves("gyro_drift", {"bias_x": 2.0, "rate_y": 0.5})
    assert found["bias_y"] == pytest.approx(rules.SYSTEMATIC * 2.0 / np.sqrt(3))
    assert found["rate_x"] == pytest.approx(rules.SYSTEMATIC * 0.5 / np.sqrt(3))


def test_a_factor_is_known_to_a_part_of_itself():
    """On a logarithmic scale: fifteen per cent of each foot's factor, whatever the others have."""
    found = halves("uneven_foot_friction", {"foot1": 2.0})
    spread = parameters_of(catalogue.find("uneven_foot_friction"), 2)[0].spread
    assert set(found.values()) == {rules.SYSTEMATIC / spread}


def test_a_common_factor_of_the_feet_is_known_as_the_baseline_is():
    """Friction of all feet, 15 % more of it: mu_int and mu_ext both known to 15 % say no more than each of them alone
    could; together they are known to 15 % over the root of two."""
    parameters = (
        *baseline_parameters(Model.table_3_1(), 0, 0.0014),
        *parameters_of(catalogue.find("uneven_foot_friction"), 2),
    )
    names = [p.name for p in parameters]
    fit = SimpleNamespace(parameters=parameters)
    found = half_widths(fit, SimpleNamespace(z=np.zeros(len(names))), np.zeros((len(names),) * 2))
    spread, own = parameters[-1].spread, parameters[names.index("mu_ext")].spread
    expected = np.hypot(rules.SYSTEMATIC, NINETY * own / np.sqrt(2)) / spread
    assert found[-4:] == pytest.approx(expected)


def test_what_is_typically_none_takes_a_leak_of_the_largest_beside_it():
    found = halves("gyro_misalignment", {"x": 2.0, "xy": 0.01})
    own, turned = (parameters_of(catalogue.find("gyro_misalignment"), 2)[i].spread for i in (3, 0))
    leak = rules.LEAKS * 2.0 * turned / own
    assert found["xy"] == pytest.approx(np.hypot(rules.SYSTEMATIC * 0.01, leak))


def test_a_force_of_drag_follows_its_moment():
    """The force is known as well as the moment, where the runs know only their sum."""
    covariance = np.array([[1.0, -0.5], [-0.5, 1.0]]) * SELDOM_PRIOR**2
    found = halves("quadratic_drag", {"c": 2.0}, covariance)
    statistical = NINETY * rules.INTERVAL * SELDOM_PRIOR
    assert found["c_v"] == pytest.approx(np.hypot(statistical, rules.SYSTEMATIC * 0.5 * 2.0))
    assert found["c"] == pytest.approx(np.hypot(statistical, rules.SYSTEMATIC * 2.0))
