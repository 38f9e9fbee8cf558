"""The granite blocks in three dimensions: points of the hull, its weak edge, and the factor at which a block falls."""

import sys

import numpy as np
import pytest

from rockref.model.base_motion import BaseMotion
from rockref.model.standing import standing_posture
from tests.shipped import ROOT

sys.path.insert(0, str(ROOT / "benchmarks"))
from granite_space import FACTORS, MISSED, STIFFNESS, critical_factors, granite_model, support, supporting  # noqa: E402

# A box whose feet at +x stand nearer to the centre; two points of the mesh lie inside of it.
CORNERS = [[x, y, z] for x in (-0.2, 0.08) for y in (-0.25, 0.25) for z in (-0.3, 0.3)]
BLOCK = {
    "mesh": "box.obj",
    "mass": 350.0,
    "centre_of_mass": [0.01, 0.0, 0.0],
    "rest_rotation": np.eye(3).tolist(),
    "inertia": [[20.0, -1.0, 0.0], [-1.0, 18.0, 0.0], [0.0, 0.0, 16.0]],
}


class Table:
    """Motions along x: a push of a second that lifts the weak edge at `test` hundredths of its size."""

    def __init__(self, folder):
        self.folder = folder
        inside = [[0.0, 0.0, 0.0], [0.01, 0.1, -0.1]]
        lines = [f"v {' '.join(map(str, vertex))}" for vertex in CORNERS + inside]
        (folder / "box.obj").write_text("\n".join([*lines, "f 1 2 3"]) + "\n", encoding="utf-8")

    def base_motion(self, test, crossover):
        a = np.zeros((200, 3))
        a[1:-1, 0] = -9.81 * 0.07 / 0.3 / (0.01 * test)
        return BaseMotion(0.0, 0.005, a, str(test))

    def block(self, number):
        return BLOCK


def test_a_box_stands_on_its_four_feet_and_tips_over_the_near_edge(tmp_path):
    model, azimuth = granite_model(Table(tmp_path), 1)
    block, points = model.body()
    feet = {(x - 0.01, y, -0.3) for x in (-0.2, 0.08) for y in (-0.25, 0.25)}
    assert {tuple(np.round(p, 12)) for p in points.P} == {tuple(np.round(p, 12)) for p in feet} and azimuth == 0.0
    start = standing_posture(block, points, 0.0)
    lowest = start.x[2] + (points.P @ start.Lambda.T)[:, 2]
    # Equilibrium is found to rounding of forces.
    assert -STIFFNESS * np.minimum(lowest, 0.0).sum() == pytest.approx(350.0 * 9.81, rel=1e-6)


def test_few_corners_miss_the_hull_by_less_than_is_stated():
    turns = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    r, turn = np.meshgrid([0.05, 0.1, 0.15, 0.2], turns)
    bowl = np.stack([r * np.cos(turn), r * np.sin(turn), -0.3 + r**2], axis=-1).reshape(-1, 3)
    kept = supporting(bowl)
    azimuth, tilt = np.meshgrid(np.linspace(0, 2 * np.pi, 91), np.radians(np.linspace(0, 20, 31)))
    missed = support(bowl, azimuth, tilt) - support(kept, azimuth, tilt)
    # Between tilts that are looked at, 1.5 degrees off at 0.2 m: a tenth of a millimetre more.
    assert len(kept) < 60 and missed.min() >= 0.0 and missed.max() < MISSED + 1e-4


def test_a_block_falls_at_the_factor_that_lifts_it(tmp_path):
    found = critical_factors(Table(tmp_path), [10, 100, 10000], 1)
    step = FACTORS[1] / FACTORS[0]
    assert found[0] == pytest.approx(FACTORS[0] / step**0.5) and found[2] == pytest.approx(FACTORS[-1] * step**0.5)
    # A long push fells what it lifts, from heading 15 degrees off and on springs that sink: one rung to either side.
    assert 1.0 / step < found[1] < step**1.5
