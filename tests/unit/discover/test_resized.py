"""Fits that have stopped beside their valley go on from other sizes of their effects."""

from dataclasses import dataclass

import numpy as np
import pytest

from rockref.discover.resized import AFFORDABLE, moves, places, resized
from tests.unit.discover.bowls import ALONE, Bowl, family


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


def test_a_fit_that_has_arrived_is_left_alone():
    arrived = family(("rolling_resistance",), Bowl(np.array([0.0, 0.4]), floor=0.9), np.array([0.0, 0.45]))
    assert resized(ALONE, arrived, seed=0) is arrived
    assert arrived.fit.iterations == 0


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


def test_only_sizes_of_effects_are_changed_and_the_cheapest_places_come_first():
    bowl = Bowl(np.array([0.3, 1.0, 0.5]))
    z = np.array([0.0, 1.2, 0.5])
    assert np.all(moves(bowl, z)[:, 0] == 0)
    assert sorted(np.abs(moves(bowl, z)).sum(axis=1)) == pytest.approx([0.25, 0.25, 0.6, 0.6])
    point, _ = bowl.point(z, np.zeros((40, 5)))
    found = places(bowl, point)
    assert [p.objective for p in found] == sorted(p.objective for p in found)
    assert all(p.objective < AFFORDABLE * point.objective for p in found)
