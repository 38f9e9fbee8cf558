"""The granite blocks in three dimensions: feet, weight, and a run of each test a round."""

import sys

import numpy as np
import pytest

from rockref.model.base_motion import BaseMotion
from rockref.model.standing import standing_posture
from tests.shipped import ROOT

sys.path.insert(0, str(ROOT / "benchmarks"))
from granite_space import STIFFNESS, fall_shares, granite_model  # noqa: E402

MESH = {
    "mass": 350.0,
    "centre_height": 0.3,
    "inertia": [[20.0, -1.0, 0.0], [-1.0, 18.0, 0.0], [0.0, 0.0, 16.0]],
    "within_5mm": {"four_feet": [[0.1, 0.2, 0.0], [-0.1, 0.2, 1e-3], [-0.1, -0.2, 0.0], [0.1, -0.2, 0.0]]},
}


def test_feet_draw_in_and_the_weight_rests_on_them():
    block, points = granite_model(MESH, 0.5).body()
    assert points.P[0].tolist() == [0.05, 0.1, -0.3]
    start = standing_posture(block, points, 0.0)
    # Equilibrium is found to rounding of forces; a second foot stands a millimetre higher and need not touch.
    lowest = start.x[2] + (points.P @ start.Lambda.T)[:, 2]
    assert -STIFFNESS * np.minimum(lowest, 0.0).sum() == pytest.approx(350.0 * 9.81, rel=1e-6)


class Table:
    """Two motions: none, and one that no block survives."""

    def base_motion(self, test, crossover):
        a = np.zeros((120, 3))
        a[1:-1, 0] = 30.0 * test
        return BaseMotion(0.0, 0.005, a, str(test))

    def block(self, number):
        return MESH


def test_each_test_has_its_own_share():
    assert fall_shares(Table(), [0, 1, 0], 1, 1.0, 2).tolist() == [0.0, 1.0, 0.0]
