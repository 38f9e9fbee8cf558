"""A record that most faults are put into: a block of a decimetre through twelve swings, a thousand samples a second."""

from __future__ import annotations

import numpy as np
import pytest

from tests.records import DEGREE, Gyro, motion_of, sensed, some_block


@pytest.fixture(scope="module")
def made():
    block = some_block(np.random.default_rng(4), 0.1)
    gyro = Gyro(1000.0, 0.05 * DEGREE, 300.0, 0.01 * DEGREE)
    return sensed(block, gyro, np.random.default_rng(4), motion_of(block, swings=12.0))
