"""What is said of tosses where something is missing: a use without tosses, flights too short, corners never struck."""

from dataclasses import replace

import pytest

from rockref.discover.tosses import compare as comparing
from rockref.discover.tosses.body import nominal_model
from rockref.discover.tosses.compare import compare, measured
from rockref.discover.tosses.first_guess import first_guesses
from rockref.model.errors import InputError
from tests.tosses import stated, tosses_of

pytest.importorskip("numba")


@pytest.mark.parametrize("use", ["fit", "holdout"])
def test_a_use_without_tosses_has_no_row(use):
    found = compare(tosses_of(stated(), 8, (use,)))
    assert [(row.use, row.start) for row in found.rows] == [(use, "flight"), (use, "raw")]


def test_no_toss_at_all_is_refused():
    with pytest.raises(InputError, match="holds no toss") as error:
        compare(replace(tosses_of(stated(), 1), tosses=()))
    assert error.value.code == "E-SIZE"


def test_flights_too_short_to_see_the_centre_leave_everything_else_open():
    tosses = tosses_of(stated(), 8, frames=6)
    found = measured(tosses.tosses, tosses, nominal_model(tosses))
    assert set(found) == {"flight_arcs"} and found["flight_arcs"]["values"] == {}
    assert first_guesses(found, stated()) == {}


def test_where_no_corner_was_struck_the_impacts_say_nothing(monkeypatch):
    tosses = tosses_of(stated(), 8)

    def first_impacts(*a):
        raise InputError("E-SIZE", "tosses", "strike no corner", "")

    whole = measured(tosses.tosses, tosses, nominal_model(tosses))
    assert {"stated_centre", "measured_centre", "energy_of_stated_velocities"} <= set(whole)
    monkeypatch.setattr(comparing.impact_balance, "first_impacts", first_impacts)
    found = measured(tosses.tosses, tosses, nominal_model(tosses))
    assert set(found) == {"flight_arcs", "sliding"}
    # Without them there is nothing to begin the effects of the contact at.
    assert first_guesses(found, stated()) == {} and first_guesses(whole, stated())


def value(v):
    return {"value": v, "se": 0.1}


def struck(tau=2e-3, radius=1e-3, **more):
    """What first impacts say: half a contact's time and a corner's radius."""
    return {
        "flight_arcs": {"values": {f"centre_{a}": value(1e-3) for a in "xyz"}},
        "measured_centre": {
            "inertia_kg_m2": dict.fromkeys(("xx", "yy", "zz"), 1e-3),
            "shape": {"values": {"half_contact_time": value(tau), "radius": value(radius)}},
            "corner": {"values": {"friction": value(0.16), "restitution": value(0.4)}},
        },
    } | more


CENTRE = {f"mass_eccentricity.{a}" for a in "xyz"} | {f"inertia_deviation.{a}" for a in ("xx", "yy", "zz")}
ROUND = {"rounded_corners.radius", "K_N", "K_T"}


@pytest.mark.parametrize("tau, radius", [(0.0, 1e-3), (2e-3, -1e-4)])
def test_a_corner_that_is_not_seen_to_be_round_is_no_guess(tau, radius):
    assert set(first_guesses(struck(tau, radius), stated())) == CENTRE


def test_a_contact_twice_as_long_is_a_spring_four_times_as_soft():
    short, long = (first_guesses(struck(tau), stated()) for tau in (1e-3, 2e-3))
    assert set(short) == CENTRE | ROUND and short["K_N"] == pytest.approx(4 * long["K_N"])
    assert short["rounded_corners.radius"] == 1e-3 and short["K_T"] == short["K_N"]


def test_friction_of_slides_and_corners_is_a_power_of_the_load():
    slides = {"sliding": {"values": {"slow": value(0.24), "fast": value(0.20)}}}
    found = first_guesses(struck(**slides), stated())
    assert found["stribeck_friction.ratio"] == pytest.approx(1.2)
    # A corner that is struck bears more than one in a slide, and rubs less: (F/F0)^-p falls with the load.
    assert found["load_dependent_friction.exponent"] > 0
    same = {"sliding": {"values": {"fast": value(0.16)}}}
    assert first_guesses(struck(**same), stated())["load_dependent_friction.exponent"] == pytest.approx(0, abs=1e-9)
