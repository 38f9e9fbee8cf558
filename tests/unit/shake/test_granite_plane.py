"""Ensembles of plane blocks: the grid, and the mixture over what is unknown."""

import math
import sys
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import norm

from rockref.model.base_motion import BaseMotion
from tests.shipped import ROOT

sys.path.insert(0, str(ROOT / "benchmarks"))
from granite_plane import LADDER, PHYSICAL, critical_angles, falls, plane_blocks, probabilities  # noqa: E402

WEAK_DEG, RATIOS, RESTITUTIONS = PHYSICAL.weak_deg, PHYSICAL.ratios, PHYSICAL.restitutions
MESH = {"mass": 350.0, "centre_height": 0.3, "inertia": [[20.0, -1.0, 0.0], [-1.0, 18.0, 0.0], [0.0, 0.0, 16.0]]}


def test_the_weaker_edge_lies_on_either_side():
    grid = plane_blocks(MESH)
    assert grid.shape == (len(WEAK_DEG), len(RATIOS), len(RESTITUTIONS), 2, 6)
    weak, strong = grid[4, 0, 1, 0, :2], grid[4, 0, 1, 1, :2]
    # Degrees to radians and back by a tangent: rounding.
    assert np.degrees(weak) == pytest.approx([WEAK_DEG[4], WEAK_DEG[4] * RATIOS[0]])
    assert strong.tolist() == weak[::-1].tolist()
    R2 = 0.3**2 * (1 + math.tan(math.radians(WEAK_DEG[4])) ** 2)
    assert grid[4, 0, 1, 0, 2] == pytest.approx(math.sqrt(9.81 * math.sqrt(R2) / (19.0 / 350.0 + R2)))


def test_a_threshold_becomes_a_lognormal_probability():
    # Every block weaker than the middle of the grid falls, on one of its sides only.
    threshold = math.sqrt(WEAK_DEG[6] * WEAK_DEG[7])
    fell = np.zeros((1, len(WEAK_DEG), len(RATIOS), len(RESTITUTIONS), 2), bool)
    fell[:, :7, :, :, 0] = True
    p, numbers = probabilities(fell)
    assert p.shape == (1, len(numbers))
    for k, n in enumerate(numbers):
        if 8.0 <= n.medians_deg[0] <= 11.0 and n.scatter < 0.2:
            held = 0.5 * norm.cdf(math.log(threshold / n.medians_deg[0]) / n.scatter)
            # The grid of angles has steps of 0.08 in the logarithm, four fifths of the least scatter.
            assert p[0, k] == pytest.approx(0.5 * n.unheld + (1 - n.unheld) * held, abs=0.02)
    assert min(PHYSICAL.medians_deg) > min(WEAK_DEG)


class Table:
    """A table whose motion is one long push, of `test` hundredths of g."""

    def base_motion(self, test, crossover):
        a = np.zeros((400, 3))
        a[1:-1, 0] = 0.01 * test * 9.81
        return BaseMotion(0.0, 0.005, a, str(test))

    def block(self, number):
        return MESH


def test_a_long_push_fells_what_is_more_slender_than_it_lifts():
    push = [9, 18]
    found = critical_angles(falls(Table(), push, 1, of=LADDER), LADDER)
    # A push of two seconds, eight times 1/p, fells every edge that it lifts: those below atan(a/g). Half of the blocks
    # are pushed over the weaker edge, half over the stronger: the mean is the angle over the root of the ratio.
    lifted = np.degrees(np.arctan(np.array(push) / 100))
    half = (LADDER.weak_deg[1] / LADDER.weak_deg[0]) ** 0.5
    assert found == pytest.approx(lifted / math.sqrt(LADDER.ratios[0]), rel=half - 1)
    nothing, everything = (np.full((1, 39, 1, 2, 2), value) for value in (False, True))
    assert critical_angles(nothing) == pytest.approx([1.0]) and critical_angles(everything) == pytest.approx([45.0])


def test_each_session_has_its_own_median():
    fell = np.random.default_rng(17).random((3, len(WEAK_DEG), len(RATIOS), len(RESTITUTIONS), 2)) < 0.5
    one, numbers = probabilities(fell)
    two, pairs = probabilities(fell, ["b", "a", "b"])
    place = {n: k for k, n in enumerate(numbers)}
    for k in range(0, len(pairs), 997):
        n = pairs[k]
        for test, session in ((0, 1), (1, 0), (2, 1)):
            alone = replace(n, medians_deg=(n.medians_deg[session],))
            assert two[test, k] == one[test, place[alone]]
