"""The measured cube: needs the data, which are not shipped; ROCKREF_CUBE_TOSSES names their folder."""

import os

import numpy as np
import pytest

from rockref.discover.tosses.body import nominal_model
from rockref.discover.tosses.compare import measured
from rockref.discover.tosses.diagnose import diagnose
from rockref.discover.tosses.errors import errors
from rockref.discover.tosses.fitting import add_to_tosses
from rockref.discover.tosses.predict import predict
from rockref.measure.tosses.flight import side_by_side
from rockref.measure.tosses.load import load_tosses
from rockref.workflows.reproduce_cube import VARIABLE

FOLDER = os.environ.get(VARIABLE)
pytestmark = pytest.mark.skipif(not FOLDER, reason=f"{VARIABLE} names no folder of tosses; the data are not shipped")


@pytest.fixture(scope="module")
def tosses():
    return load_tosses(FOLDER)


@pytest.fixture(scope="module")
def seen(tosses):
    return measured(tosses.tosses, tosses, nominal_model(tosses))


def test_copies_are_set_aside_and_never_on_the_other_side(tosses):
    sides = {toss.group: toss.use for toss in tosses.tosses}
    assert len(sides) == len(tosses.tosses)
    ids = {toss.id for toss in tosses.tosses}
    assert all(copy not in ids and original in ids for copy, original in tosses.copies)


def test_every_flight_is_a_parabola(tosses):
    poses = side_by_side(tosses.tosses, tosses.rate)
    starts = predict(nominal_model(tosses), poses).starts
    # 6 mm between the tracked point and the centre of mass, at 6 rad/s over 0.15 s, leave 0.4 mm; a contact that was
    # taken for flight leaves some millimetres.
    assert np.max(starts.residual_x) < 0.6e-3


def test_centre_and_inertia_are_seen_without_a_contact_model(seen):
    arcs, balance = seen["flight_arcs"]["values"], seen["measured_centre"]["impulse_balance"]
    assert arcs["centre_z"]["value"] == pytest.approx(5.8e-3, abs=3 * arcs["centre_z"]["se"])
    # About the measured centre a tenth of the moment is left that was missing about the stated one.
    assert balance["scatter"] < 0.2 * seen["stated_centre"]["impulse_balance"]["scatter"]
    for J in seen["measured_centre"]["inertia_kg_m2"].values():
        # A box of thin walls: (5/18) m w^2; a uniform one (1/6) m w^2.
        assert 1 / 6 < J / (0.37 * 0.1048**2) < 5 / 18
    assert seen["measured_centre"]["energy_change"]["gains"] == 0


def test_a_flat_face_rubs_more_than_a_corner_and_less_when_slow(seen):
    slides = [v["value"] for v in seen["sliding"]["values"].values()]
    assert slides[0] < 0.9 * max(slides)
    assert min(slides) > 1.1 * seen["measured_centre"]["corner"]["values"]["friction"]["value"]


def test_a_tip_rebounds_by_half_as_much_as_the_corner_of_a_face(seen):
    """A plain damper has it the other way round, see `tests/unit/measure/tosses/test_impact_balance.py`."""
    corner = seen["measured_centre"]["corner"]["values"]
    face, tip = (corner[f"restitution_on_a_{place}"] for place in ("face", "tip"))
    assert tip["value"] < 0.6 * face["value"]
    assert face["value"] - tip["value"] > 4 * np.hypot(face["se"], tip["se"])


def test_stated_values_have_the_errors_that_the_documentation_names(tosses):
    held = side_by_side(tosses.used("holdout"), tosses.rate)
    e = errors(predict(nominal_model(tosses), held), held, tosses.width)
    # Of 153 tosses one that falls on another face moves the means by half a unit.
    assert 100 * np.mean(e.position) == pytest.approx(12.7, abs=0.5)
    assert np.mean(e.rotation) == pytest.approx(14.9, abs=1.0)


@pytest.mark.slow
def test_the_centre_of_mass_lowers_the_error_of_held_out_tosses(tosses):
    found = add_to_tosses("mass_eccentricity", tosses)
    assert found.proof["low"] > 0
    assert found.after.to_dict()["parameters"]["mass_eccentricity.z"]["value"] == pytest.approx(6e-3, abs=1e-3)


@pytest.mark.slow
def test_the_diagnosis_explains_tosses_that_it_did_not_see(tosses):
    found = diagnose(tosses)
    assert {"mass_eccentricity", "rounded_corners"} <= set(found.effects)
    last = found.steps[-1].holdout
    # Set as goals before the work: a third below the 13.5 % and 16.5 deg of simulators that were fitted to what they
    # report, from the raw first frame; from the flight 6.3 % in the mean, 5.5 % and 4.3 deg in the median.
    assert 100 * np.mean(last["raw"].position) < 9.3 and np.mean(last["raw"].rotation) < 9.4
    assert 100 * np.mean(last["flight"].position) < 6.3
    # The goal is 6.2 deg, and 6.1 was reached; the standard error of a mean with a few that fall otherwise is 0.7.
    assert np.mean(last["flight"].rotation) < 6.2 + 0.7
    assert 100 * np.median(last["flight"].position) < 5.5 and np.median(last["flight"].rotation) < 4.3
