"""What the releases tell before anything is cut into windows."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.least_squares import Point
from rockref.discover.fit.search import Setup
from rockref.discover.looking import presearch
from rockref.discover.looking.presearch import EXPLAINED, HELD, STRONG, release_fit, suspects
from rockref.effects import catalogue
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


def test_half_a_push_is_begun_with():
    """A drift of the gyroscope would explain a part of it, and be built on."""
    setup = setup_of("release_velocity:y=-0.01")
    _, sets, seen = suspects(setup)
    assert STRONG < seen["loss"] < HELD and seen["release_shares"]["release_velocity"] > EXPLAINED
    assert sets == [(), ("release_velocity",)]


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


@pytest.fixture
def scripted(monkeypatch):
    """Release fits whose excess is given by effect, and a tone; the sets of effects that are suspected come back."""

    def prepare(left, strength=1.0, baseline="eight_points", flat=None, size=1.0, had=()):
        asked = []

        def release_fit(setup, effects=(), iterations=6):
            asked.append((effects, setup.frequency))
            count = np.full(2, 3000.0)
            point = Point(
                np.zeros(len(setup.parameters(effects))), None, 0.5 * count * (1 + left.get(effects, left[()]))
            )
            return SimpleNamespace(series=SimpleNamespace(count=count), parameters=()), point

        monkeypatch.setattr(presearch, "release_fit", release_fit)
        monkeypatch.setattr(presearch, "flat_tops", lambda experiment, runs: flat)
        monkeypatch.setattr(presearch, "tone", lambda fit, point: (17.0, strength))
        monkeypatch.setattr(presearch, "size_of", lambda family: size)
        model = Model.table_3_1() if baseline == "eight_points" else Model.four_points()
        model = model.replace(effects=tuple(parse(text) for text in had))
        setup = Setup(SimpleNamespace(baseline=baseline, tilt_uncertainty=0.0014), (), model)
        setup, sets, seen = suspects(setup)
        return setup, sets, seen, asked

    return prepare


def test_a_quiet_release_is_searched_for_nothing(scripted):
    setup, sets, seen, asked = scripted({(): 0.0})
    assert sets == [()] and asked == [((), None)] and setup.frequency is None and seen["tone_hz"] == 17.0


@pytest.mark.parametrize("strong, size, suspected", [(1.0, 1.0, True), (1.0, 0.1, False), (8.0, 0.1, True)])
def test_a_push_at_a_release_that_is_a_little_off_must_have_a_size(scripted, strong, size, suspected):
    """Feet that settle look like a trifle of a push, and like a tilted plate; neither is there."""
    _, sets, _, _ = scripted({(): strong, ("release_velocity",): 0.01}, size=size)
    assert (("release_velocity",) in sets) is suspected


@pytest.mark.parametrize("explained, suspected", [(0.1, True), (0.9, False)])
def test_a_tone_is_a_shaking_base_where_that_explains_the_release(scripted, explained, suspected):
    left = {(): 1.0, ("base_vibration",): explained}
    setup, sets, seen, asked = scripted(left, strength=2 * presearch.TONE)
    assert (("base_vibration",) in sets) is suspected and (("base_vibration",) in seen["starts"]) is suspected
    assert setup.frequency == 17.0 and asked[-1] == (("base_vibration",), 17.0)


def test_the_feet_are_suspected_where_the_experimenter_knows_of_none(scripted):
    setup, sets, seen, _ = scripted({(): 0.0}, baseline="four_points")
    assert sets == [(), ("foot_defects",)]
    # Begun at their typical size beside what the release says of the baseline.
    start = seen["starts"]["foot_defects",]
    n = len(seen["z"])
    assert len(start) > n and np.all(start[:n] == 0.0)
    for p, z in zip(setup.parameters(("foot_defects",))[n:], start[n:], strict=True):
        # Inner points rub more than outer ones, and damp less.
        assert p.value(z) == pytest.approx(catalogue.find("foot_defects").quantities[p.name.split(".")[1]].typical)


def test_what_a_model_has_is_not_suspected_again(scripted):
    defects = "foot_defects:delta_long1=5e-5,delta_diag=0.006"
    assert scripted({(): 0.0}, baseline="four_points", had=[defects])[1] == [()]
    shaking = "base_vibration:amplitude=0.05,frequency=17"
    left = {(): 1.0, ("base_vibration",): 0.1}
    assert ("base_vibration",) not in scripted(left, strength=2 * presearch.TONE, had=[shaking])[1]


def test_flat_tops_are_the_stops_of_the_gyroscope_at_that_rate(scripted):
    setup, sets, seen, asked = scripted({(): 1.0}, flat=0.5)
    assert sets[:2] == [(), ("gyro_saturation",)] and seen["flat_top"] == 0.5
    own = setup.parameters(("gyro_saturation",))[-2]
    assert 1 / own.value(seen["starts"]["gyro_saturation",][-2]) == pytest.approx(0.5)
    # Nobody has to fit what is in the records.
    assert (("gyro_saturation",), None) not in asked


def test_where_no_single_effect_explains_the_release_two_may_and_the_sensor_is_taken_along(scripted):
    pair = ("gyro_misalignment", "release_velocity")
    left = {(): 8.0, ("gyro_misalignment",): 6.0, ("release_velocity",): 5.0, pair: 0.1}
    _, sets, seen, asked = scripted(left)
    assert sets == [(), ("gyro_misalignment",)]
    assert seen["release_shares"]["release_velocity"] == pytest.approx(1 - 5 / 8)
    assert (pair, None) in asked


def test_a_fit_of_the_release_that_always_gains_ends_at_last(monkeypatch):
    class Falling:
        parameters, series, steps = (), SimpleNamespace(count=np.zeros(1)), 0

        def begin(self):
            return Point(np.zeros(1), None, np.full(1, 1e6))

        def step(self, point, lam):
            self.steps += 1
            return Point(point.z, None, 0.9 * point.loss), lam

    fit = Falling()
    monkeypatch.setattr(presearch, "release_windows", lambda setup: None)
    setup = SimpleNamespace(fit=lambda windows, effects: fit)
    assert release_fit(setup)[1].objective == pytest.approx(1e6 * 0.9**presearch.LONGEST)
    assert fit.steps == presearch.LONGEST
