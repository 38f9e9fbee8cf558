"""What the releases tell before anything is cut into windows."""

import pytest

from rockref import Model
from rockref.discover.fit.search import Setup
from rockref.discover.looking.presearch import EXPLAINED, HELD, STRONG, release_fit, suspects
from rockref.effects.catalogue import parse
from tests.unit.discover.synthetic import experiment


def setup_of(*effects):
    truth = Model.table_3_1().replace(effects=tuple(parse(e) for e in effects))
    e = experiment(truth, [{}, {"turned": True}], duration=1.2, noisy=True)
    return Setup(e, e.runs, Model.table_3_1(), end=1.2, workers=1)


def test_a_wire_that_holds_on_is_found_at_the_release():
    """Six newtons at the top take most of the moment that turns the block: no small step leads there."""
    setup = setup_of("lingering_wire_pull:force=6,tau=0.25")
    _, sets, seen = suspects(setup)
    assert ("lingering_wire_pull",) in sets
    fit, point = release_fit(setup, ("lingering_wire_pull",))
    force = dict(zip([p.name for p in fit.parameters], point.z, strict=True))["lingering_wire_pull.force"]
    assert abs(force - 2.0) < 0.2  # in typical sizes, of 3 N; the tilts of the runs take up a part


def test_a_slight_pull_is_found_where_a_clock_explains_nearly_as_much():
    """Half a typical pull: a block that starts late looks like one whose time runs slowly."""
    setup = setup_of("lingering_wire_pull:force=1.4,tau=0.36")
    _, sets, seen = suspects(setup)
    shares = seen["release_shares"]
    assert STRONG < seen["loss"] < HELD and shares["clock_error"] > EXPLAINED
    assert sets[1] == ("lingering_wire_pull",) and shares["lingering_wire_pull"] > shares["clock_error"]


def test_soft_stops_of_a_gyroscope_are_found_at_the_release():
    """They make no flat tops, and bend the last fifth of a second before the impact."""
    setup = setup_of("gyro_saturation:range=0.6,softness=1")
    _, sets, seen = suspects(setup)
    assert "flat_top" not in seen and seen["loss"] > STRONG
    assert sets[1] == ("gyro_saturation",) and seen["release_shares"]["gyro_saturation"] > 0.9
    names = [p.name for p in setup.parameters(("gyro_saturation",))]
    z = dict(zip(names, seen["starts"]["gyro_saturation",], strict=True))
    # In typical sizes of the inverse, of which 1/0.6 is two thirds of one.
    assert z["gyro_saturation.range"] == pytest.approx(2 / 3, rel=0.05)
    assert z["gyro_saturation.softness"] == pytest.approx(1.0, abs=0.2)


def test_nothing_is_suspected_of_a_release_that_the_baseline_explains():
    _, sets, seen = suspects(setup_of())
    # Noise is 1 by definition; some hundred samples of it stay within a tenth.
    assert sets == [()] and seen["loss"] < 1.1


def test_a_block_that_is_thrown_back_first_has_its_release_to_itself():
    """At 0.05 rad/s the wrong way it stops, turns, and falls: what stops it there is no impact."""
    setup = setup_of("release_velocity:x=0.05")
    fit, point = release_fit(setup, ("release_velocity",))
    assert min(fit.series.length) > 0.3 * fit.series.rate  # a fall from rest takes 0.51 s, so thrown on 0.43 s
    assert 2 * point.loss.sum() / fit.series.count.sum() < 1.1


def test_a_release_that_is_a_little_off_is_left_to_the_windows():
    """Feet that settle look like a small velocity of release, and like a tilted plate; neither is there."""
    setup = setup_of("release_velocity:y=-0.01")
    _, sets, seen = suspects(setup)
    assert seen["loss"] > STRONG
    assert sets == [()]


def test_axes_askew_are_begun_with_where_they_and_a_velocity_explain_the_release():
    """Neither explains it alone; what is reconstructed with the wrong axes would hide the velocity for good."""
    turns = (-0.035, 0.037, -0.034)
    askew = "gyro_misalignment:x={},y={},z={}".format(*turns)
    setup = setup_of(askew, "release_velocity:x=-0.015,y=-0.011,z=-0.017")
    _, sets, seen = suspects(setup)
    assert all(share < EXPLAINED for share in seen["release_shares"].values())
    assert ("gyro_misalignment",) in sets and ("release_velocity",) not in sets
    parameters = setup.parameters(("gyro_misalignment",))
    start = seen["starts"]["gyro_misalignment",]
    assert len(start) == len(parameters)
    values = {p.name: p.value(float(z)) for p, z in zip(parameters, start, strict=True)}
    # The turn about x is also one of all the block's angles at release, which the runs' own tilts take up in part.
    for axis, turn, within in zip("xyz", turns, (8e-3, 1e-3, 1e-3), strict=True):
        assert abs(values[f"gyro_misalignment.{axis}"] - turn) < within
