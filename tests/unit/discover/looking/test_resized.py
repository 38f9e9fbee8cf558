"""Fits that have stopped beside their valley go on from other sizes of their effects."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover import window_rules as rules
from rockref.discover.fit.approach import HIGHER, higher
from rockref.discover.fit.families import mean_loss, room, structured
from rockref.discover.fit.least_squares import Point
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.looking import resized as module
from rockref.discover.looking.resized import (
    AFFORDABLE,
    AT_NOISE,
    LAST,
    ROUNDS,
    UNSETTLED,
    cheapest,
    has_arrived,
    moves,
    placed_at,
    resized,
)
from tests.unit.discover.bowls import ALONE, WINDOWS, Bowl, family


@dataclass
class Walled(Bowl):
    """A bowl that leads down from near its bottom only: farther off a fit stays where it is."""

    radius: float = 0.3

    def run(self, point, iterations, rng, relative=0.0):
        off = np.max(np.abs(point.z - self.bottom))
        return super().run(point, iterations, rng, relative) if off < self.radius else point


def test_a_size_that_is_twice_too_large_is_found():
    bottom = np.array([0.1, 0.4])
    stuck = family(("rolling_resistance",), Walled(bottom, floor=0.97), np.array([0.0, 0.8]))
    assert resized(ALONE, stuck, seed=0).point.z == pytest.approx(bottom, abs=0.01)


@pytest.mark.parametrize("falls, rounds", [((120, 70, 40, 20), 1), ((240, 150, 20, 20), 3), ((180, 180, 180, 50), 4)])
def test_a_rival_goes_on_while_rounds_like_the_last_one_would_bring_it_level(monkeypatch, falls, rounds):
    """It begins 600 units above the other one; 120 in the first round of four are too few for that."""
    units = np.cumsum([600.0, *np.negative(falls)])
    per_unit = 2 / float(np.sum(Bowl(np.zeros(1)).series.count))
    at = np.array([0.0, 0.4])
    behind = [family(("rolling_resistance",), Bowl(at, floor=1.01 + u * per_unit), at) for u in units]
    ahead = family(("quadratic_drag",), Bowl(at, floor=1.01), at)
    monkeypatch.setattr(module, "averaged", lambda setup, f, seed: behind[behind.index(f) + 1])
    monkeypatch.setattr(module, "refit", lambda f, iterations, seed: f)
    assert behind.index(resized(ALONE, behind[0], 0, ahead)) == rounds
    assert behind.index(resized(ALONE, behind[0], 0)) == 4  # by itself it goes on as long as it falls


@pytest.mark.parametrize("units, falls, rounds", [(100, (70, 40, 15, 30), 2), (250, (30,) * 5, ROUNDS), (50, (15,), 0)])
def test_a_fit_that_has_arrived_goes_on_from_averages_while_they_take_something_off(monkeypatch, units, falls, rounds):
    """And in no other way: right effects had still come down by some hundred units so."""
    left = units - np.cumsum([0.0, *falls])
    per_unit = 2 / float(np.sum(Bowl(np.zeros(1)).series.count))
    at = np.array([0.0, 0.4])
    places = [family(("rolling_resistance",), Bowl(at, floor=rules.NOISE + u * per_unit), at) for u in left]
    monkeypatch.setattr(module, "AT_NOISE", 2.0)  # forty windows have less room than the runs of an experiment
    monkeypatch.setattr(module, "averaged", lambda setup, f, seed: places[places.index(f) + 1])
    monkeypatch.setattr(module, "moved", lambda *a: pytest.fail("changed places"))
    monkeypatch.setattr(module, "refit", lambda f, iterations, seed: f)
    assert places.index(resized(ALONE, places[0], 0)) == rounds


def test_a_rival_that_has_arrived_far_behind_is_only_taken_to_its_end(monkeypatch):
    """More than rivals are forgiven: averages would not bring it level."""
    monkeypatch.setattr(module, "averaged", lambda *a: pytest.fail("averages"))
    at = np.array([0.0, 0.4])
    rival = family(("rolling_resistance",), Bowl(at, floor=0.99), at + 0.02)
    ahead = family(("quadratic_drag",), Bowl(at, floor=0.80), at)
    assert has_arrived(rival) and room(rival) - room(ahead) > rules.UNFINISHED
    assert resized(ALONE, rival, 0, ahead).fit.iterations == LAST


@pytest.mark.parametrize("windows, goes_on", [(40, False), (400, True)])
def test_a_fit_near_the_noise_goes_on_where_many_units_are_left(windows, goes_on):
    """At 0.99 of the noise forty windows leave sixty-seven units, and ten times as many leave 672."""
    bowl = Bowl(np.array([0.0, 0.4]), floor=0.99)
    bowl.series.count = np.full(windows, bowl.series.count[1])
    near = family(("rolling_resistance",), bowl, bowl.bottom)
    assert mean_loss(near) < AT_NOISE and (room(near) > rules.UNFINISHED) is goes_on
    assert has_arrived(near) is not goes_on


@dataclass
class Seen(Walled):
    """The same, seen in every tenth window."""

    def point(self, z, corrections):
        point, states = super().point(z, corrections)
        seen = np.arange(WINDOWS) % 10 == 0
        noise = 0.5 * self.floor * self.series.count
        point.loss = noise + 10 * seen * (point.loss - noise)
        return point, states


@dataclass
class Spinning(Seen):
    """A law of two forms."""

    @property
    def parameters(self):
        names = ["K_N", "spin_friction.radius", "spin_friction.sliding_share"]
        return tuple(Parameter(n, lambda model, value: model, 0.0, 1.0) for n in names)


@pytest.mark.parametrize("right, stuck_at", [(1.0, 0.0), (0.0, 0.9)])
def test_the_other_form_of_a_law_is_found(right, stuck_at):
    bottom = np.array([0.1, 0.8, right])
    stuck = family(("spin_friction",), Spinning(bottom, floor=0.97), np.array([0.1, 0.8, stuck_at]))
    assert resized(ALONE, stuck, seed=0).point.z == pytest.approx(bottom, abs=0.01)


@pytest.mark.parametrize("share, pure", [(0.0, [1]), (1.0, [0]), (0.4, [0, 1]), (0.7, [0, 1])])
def test_a_share_between_two_forms_is_tried_as_either(share, pure):
    z = np.array([0.1, 0.0, share])
    places = z + moves(Spinning(np.zeros(3)), z)
    assert sorted(places[places[:, 2] != share, 2]) == pure


@dataclass
class Feet(Seen):
    """The heights and the distance of four feet that belong to an effect."""

    @property
    def parameters(self):
        names = [f"foot_defects.delta_long{i}" for i in (1, 2, 3, 4)] + ["foot_defects.delta_diag"]
        return tuple(Parameter(n, lambda model, value: model, 0.0, 1.0) for n in names)


def test_feet_that_are_all_too_low_are_found():
    """Heights that are all low by 0.3, at the right distance: neither one foot nor all five numbers lead there."""
    bottom = np.array([1.4, 1.5, 1.3, 1.6, 1.5])
    low = bottom - np.array([0.3, 0.3, 0.3, 0.3, 0.0])
    stuck = family(("foot_defects",), Feet(bottom, floor=0.97, radius=0.2), low)
    assert resized(ALONE, stuck, seed=0).point.z == pytest.approx(bottom, abs=0.01)
    assert structured(stuck) > UNSETTLED
    assert higher(stuck.fit).tolist() == [[h, h, h, h, 0.0] for h in HIGHER]
    assert higher(Bowl(np.array([0.0, 0.4]))).shape == (0, 2)


@dataclass
class Rough(Walled):
    """A bowl that only averages lead down: sample by sample a fit stays where it is."""

    radius: float = 0.0

    def run(self, point, iterations, rng, relative=0.0):
        self.radius = 10.0 if self.averaged > 1 else 0.0
        return super().run(point, iterations, rng, relative)


def test_a_fit_above_the_noise_is_led_on_by_averages():
    bottom = np.array([0.2, 0.4])
    stuck = family(("rolling_resistance",), Rough(bottom, floor=0.97), np.array([0.0, 0.1]))
    assert resized(ALONE, stuck, seed=0).point.z == pytest.approx(bottom, abs=0.01)


def test_a_fit_that_most_windows_contradict_is_left_alone():
    lost = family(("rolling_resistance",), Bowl(np.array([0.0, 0.4]), floor=2.0), np.array([0.0, 0.8]))
    assert resized(ALONE, lost, seed=0) is lost


def test_what_does_not_help_is_not_kept():
    stuck = family(("rolling_resistance",), Walled(np.array([0.0, 0.4]), floor=1.0), np.array([0.0, 0.75]))
    stuck.fit.radius = 0.0
    found = resized(ALONE, stuck, seed=0)
    assert found.point.objective <= stuck.point.objective
    assert found.point.z in np.array([[0.0, 0.75], [0.0, 0.375]])


def test_a_trifle_is_looked_at_with_half_a_size():
    """A foot of a tenth of the size that it has: neither half of it nor half as much again leads to the valley."""
    bottom = np.array([0.1, 0.6])
    stuck = family(("rolling_resistance",), Walled(bottom, floor=0.97), np.array([0.0, 0.06]))
    assert resized(ALONE, stuck, seed=0).point.z == pytest.approx(bottom, abs=0.01)


@dataclass
class Ridge(Bowl):
    """A fit behind a ridge: the second size leads down from 0.45 on, where the misfit is higher than anywhere else."""

    def point(self, z, corrections):
        point, states = super().point(z, corrections)
        down = np.allclose(z, self.bottom)
        mean = 0.97 if down else 1.7 * self.floor if z[2] > 0.45 else self.floor + 0.1 * float(np.sum(np.abs(z)))
        point.loss = 0.5 * mean * self.series.count
        return point, states

    def run(self, point, iterations, rng, relative=0.0):
        self.iterations += iterations
        return self.point(self.bottom, point.corrections)[0] if point.z[2] > 0.45 else point


def test_the_place_that_looks_worst_goes_on_if_one_iteration_shows_it_best():
    """Six places, of which four go on: five that look better than the right one lead nowhere."""
    bottom = np.array([0.0, 0.28, 0.6])
    behind = family(("rolling_resistance", "quadratic_drag"), Ridge(bottom, floor=1.2), np.array([0.0, 0.28, 0.28]))
    assert len(moves(behind.fit, behind.point.z)) == 6
    assert resized(ALONE, behind, seed=0).point.z == pytest.approx(bottom)


@dataclass
class Plate(Bowl):
    """The same with a plate that rings, and may pitch."""

    @property
    def parameters(self):
        names = ("K_N", "compliant_support.frequency", "compliant_support.pitch")
        return tuple(Parameter(n, lambda model, value: model, 0.0, 1.0) for n in names)


def test_a_plate_is_looked_at_with_other_pitches_each_with_its_compliance():
    z = np.array([0.0, 0.9, 0.2])
    places = z + moves(Plate(np.zeros(3)), z)
    assert np.any(np.all(np.isclose(places, [0.0, 0.93 * 0.9, 0.5]), axis=1))
    assert len(np.unique(places.round(9), axis=0)) == len(places)
    rigid = np.array([0.0, 0.0, 0.2])
    assert np.all(moves(Plate(np.zeros(3)), rigid)[:, 1] == 0)


def test_the_compliance_of_a_plate_is_changed_by_a_twelfth_and_not_by_half():
    z = np.array([0.0, 1.0, 0.0])
    found = moves(Plate(np.zeros(3)), z)
    alone = sorted(found[found[:, 2] == 0, 1])
    assert alone == pytest.approx([-0.08, 0.08])


@dataclass
class Heavy(Bowl):
    """A plate that rings, of a mass that no small step moves: only within a tenth of the right one a fit comes down."""

    @property
    def base(self):
        return SimpleNamespace(mass=54.0)

    @property
    def parameters(self):
        still = [Parameter(n, lambda model, value: model, 0.0, 1.0) for n in ("K_N", "compliant_support.frequency")]
        return (*still, Parameter("compliant_support.mass", lambda model, value: model, 100.0, 0.7, log=True))

    def point(self, z, corrections):
        off = abs(z[2] - self.bottom[2])
        mean = self.floor + (0.2 if off > 0.02 else 2 * AFFORDABLE if z[0] == 0 else 0.0)
        return Point(np.array(z, float), corrections, 0.5 * mean * self.series.count, 0.0), None

    def run(self, point, iterations, rng, relative=0.0):
        self.iterations += iterations
        end = point.z.copy()
        end[0] = 1.0 if abs(point.z[2] - self.bottom[2]) < 0.02 else 0.0
        return self.point(end, point.corrections)[0]


def test_a_plate_comes_to_its_mass_though_the_place_looks_unaffordable_at_first(monkeypatch):
    """Its tone stays, and averages, which would take the rounds, come after it."""
    monkeypatch.setattr(module, "averaged", lambda setup, f, seed: f if has_arrived(f) else pytest.fail("averaged"))
    stuck = family(("compliant_support",), Heavy(np.array([0.0, 1.2, -0.3]), floor=0.97), np.array([0.0, 1.2, 0.0]))
    found = resized(ALONE, stuck, seed=0)
    assert mean_loss(found) == pytest.approx(0.97) and found.point.z[2] == pytest.approx(-0.3)
    light = 100 * np.exp(-0.3 * 0.7)
    assert found.point.z[1] == pytest.approx(1.2 * (light / (light + 54)) / (100 / 154))


def test_others_go_on_from_averages_first():
    assert module.ways(family(("rolling_resistance",), Bowl(np.zeros(2)), np.zeros(2)))[0] is module.averaged


def test_only_sizes_of_effects_are_changed_and_the_cheapest_places_come_first():
    bowl = Bowl(np.array([0.3, 1.0, 0.5]))
    z = np.array([0.0, 1.2, 0.5])
    assert np.all(moves(bowl, z)[:, 0] == 0)
    assert sorted(np.abs(moves(bowl, z)).sum(axis=1)) == pytest.approx([0.25, 0.25, 0.6, 0.6])
    point, _ = bowl.point(z, np.zeros((40, 5)))
    places = placed_at(bowl, point, np.concatenate([moves(bowl, z), [[0.0, 1.0, 0.0]]]))
    found = cheapest(point, places)
    assert len(found) == 4 and all(p.objective < AFFORDABLE * point.objective for p in found)
    assert [p.objective for p in found] == sorted(p.objective for p in found)
    assert places[-1].objective >= AFFORDABLE * point.objective


def test_a_fit_that_always_finds_something_better_is_taken_on_a_few_times_only(monkeypatch):
    rounds = []

    def lower(setup, family, seed):
        rounds.append(mean_loss(family))
        bowl = Bowl(np.zeros(2), floor=0.98 * family.fit.floor)
        return type(family)(family.effects, bowl, bowl.point(np.zeros(2), family.point.corrections)[0])

    monkeypatch.setattr("rockref.discover.looking.resized.averaged", lower)
    start = family(("rolling_resistance",), Bowl(np.zeros(2), floor=1.3), np.zeros(2))
    end = resized(ALONE, start, 0)
    assert len(rounds) == ROUNDS and mean_loss(end) == pytest.approx(1.3 * 0.98**ROUNDS)


def test_what_most_windows_contradict_is_left_as_it_is():
    far = family(("rolling_resistance",), Bowl(np.zeros(2), floor=4.0), np.zeros(2))
    assert structured(far) == 1.0 and resized(ALONE, far, 0) is far
