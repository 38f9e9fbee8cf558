"""The run that tells effects apart: what is offered, how far apart two effects are, and which offer is best."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover import separating
from rockref.discover.hypotheses.law import law_parameters
from rockref.discover.plan import GYRO, Release
from rockref.discover.separating import Offer, apart, offers, separating_run

TABLE = Model.table_3_1()
SHARED = len(law_parameters(TABLE))
MEMBERS = ("viscous_friction", "rolling_resistance")


def test_two_effects_that_leave_the_same_trace_are_not_apart():
    v = np.array([2.0, 1.0])
    assert apart(np.outer(v, v), [np.array([0]), np.array([1])], np.array([1.0])) == pytest.approx(0.0, abs=1e-6)


def test_effects_that_do_not_touch_each_other_are_as_far_apart_as_the_first_is_large():
    H = np.diag([4.0, 9.0])
    assert apart(H, [np.array([0]), np.array([1])], np.array([3.0])) == pytest.approx(0.5 * 4 * 9)


def test_the_nearest_rival_counts():
    angle = 0.3
    H = np.array([[1, 0, np.cos(angle)], [0, 1, 0], [np.cos(angle), 0, 1.0]])
    blocks = [np.array([0]), np.array([1]), np.array([2])]
    assert apart(H, blocks, np.array([1.0])) == pytest.approx(0.5 * np.sin(angle) ** 2, rel=1e-6)


def test_both_sides_three_tilts_more_mass_and_the_cable_off_where_there_is_one():
    without_cable = offers([Release(0.1), Release(0.08)], MEMBERS)
    assert {o.release.tilt for o in without_cable} == {0.1, 0.085, 0.07}
    assert {o.release.turned for o in without_cable} == {False, True}
    assert any(o.added for o in without_cable) and not any(o.without for o in without_cable)
    with_cable = offers([Release(0.1)], ("quadratic_drag", "cable_restraint"))
    assert "the cable taken off" in str(with_cable[-1])


def setup():
    run = SimpleNamespace(release_tilt=0.1, block_turned=0.0)
    experiment = SimpleNamespace(tilt_uncertainty=0.0014, gyro=GYRO, path="made")
    return SimpleNamespace(experiment=experiment, runs=(run, run), listener=SimpleNamespace(workers=1, gyro=GYRO))


def test_the_offer_whose_traces_differ_is_named(monkeypatch):
    """Along the release that was made both effects leave one trace; turned, they leave opposite ones."""

    def says(model, release, effects, *args, **options):
        H = np.zeros((SHARED + 2, SHARED + 2))
        v = np.array([1.0, -1.0 if release.turned else 1.0])
        H[SHARED:, SHARED:] = 10 * np.outer(v, v) * (1.0 if release.tilt == 0.1 else 0.1)
        return H

    monkeypatch.setattr(separating, "says", says)
    found = separating_run(setup(), TABLE, MEMBERS, np.array([2.0]), 3.0)
    assert "the block turned by half a turn, released at 0.1 rad." in found
    assert found.startswith("To tell viscous_friction from rolling_resistance")
    # H = 20 v v' + 10 u u' + 1 (the prior) with v = (1, 1), u = (1, -1): 31 - 10 * 10 / 31 is the first's own, half of
    # it times 2 * 2; of the runs at hand, H = 20 v v' + 1, it is 21 - 20 * 20 / 21, of three of them 31 - 30 * 30 / 31.
    now, again, turned = 21 - 400 / 21, 31 - 900 / 31, 31 - 100 / 31
    assert f"adds {2 * (turned - now):.0f} units" in found and f"adds {2 * (again - now):.0f}." in found


def test_a_shaking_base_has_no_derivative_and_no_offer():
    assert separating_run(setup(), TABLE, ("base_vibration", "quadratic_drag"), np.array([1.0]), 3.0) == ""


def test_taking_the_cable_off_takes_its_trace_out_of_that_run(monkeypatch):
    """Drag and cable leave one trace in every run; only a run without the cable can tell them apart."""
    members = ("quadratic_drag", "cable_restraint")
    numbers = [len(separating.switches_of(separating.catalogue.find(id), TABLE)) for id in members]

    def says(model, release, effects, *args, **options):
        H = np.zeros((SHARED + sum(numbers), SHARED + sum(numbers)))
        H[SHARED:, SHARED:] = 10.0
        return H

    monkeypatch.setattr(separating, "says", says)
    assert "the cable taken off" in separating_run(setup(), TABLE, members, np.ones(numbers[0]), 3.0)


def test_an_offer_with_more_mass_is_a_heavier_block(monkeypatch):
    seen = []

    def says(model, release, effects, *args, **options):
        seen.append(model.mass)
        return np.eye(SHARED + 2)

    monkeypatch.setattr(separating, "says", says)
    separating_run(setup(), TABLE, MEMBERS, np.array([1.0]), 3.0)
    assert TABLE.mass * 1.25 in seen
    assert str(replace(Offer(Release(0.1)), added=0.25)).endswith("25% more mass spread evenly")
