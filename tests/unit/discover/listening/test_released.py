"""Models at the releases of runs: what a fit tries beyond the tipping angle is held just before it."""

import numpy as np
import pytest

from rockref import Model
from rockref.discover.listening.released import UPRIGHT, held_up, postures
from rockref.model.release import release_posture, sideways_tipping_angle, tipping_angle

BODY = Model.table_3_1().body()
TURNED = np.array([False, True, False])


def test_a_release_that_no_block_survives_is_held_before_it_tips_over():
    sides = np.where(TURNED, -1, 1)
    limits = np.array([tipping_angle(*BODY, side) for side in sides])
    tilts, rolls = np.array([0.1, 1.2, 1.0]) * limits, np.array([0.0, 0.0, 2.0]) * sideways_tipping_angle(BODY[1])
    found = postures([BODY] * 3, tilts, TURNED, rolls)
    assert np.array_equal(found[0].Lambda, release_posture(*BODY, tilts[0], False).Lambda)  # as it was stated
    assert np.array_equal(found[1].Lambda, release_posture(*BODY, UPRIGHT * limits[1], True).Lambda)
    assert all(np.isfinite(state.x).all() for state in found)


def test_what_stands_is_not_moved():
    tilts, rolls = np.array([0.05, 0.1, 0.12]), np.array([0.0, 1e-3, -1e-3])
    held, level = held_up([BODY] * 3, tilts, TURNED, rolls)
    assert np.array_equal(held, tilts) and np.array_equal(level, rolls)


@pytest.mark.parametrize("tilt", [-0.1, 0.0])
def test_a_tilt_that_is_none_is_a_little_one(tilt):
    (state,) = postures([BODY], np.array([tilt]), TURNED[:1], np.zeros(1))
    assert np.isfinite(state.x).all()
