"""Rows that stand twice in a record, and one channel in two columns."""

from __future__ import annotations

import numpy as np
import pytest

from rockref.measure.checks.repeated import repeated_rows
from rockref.measure.experiment import load_experiment
from rockref.model.errors import InputError
from tests.records import DEGREE, Gyro, sensed, some_block, written
from tests.refusal import refused


@pytest.fixture(scope="module")
def made():
    block = some_block(np.random.default_rng(4), 0.1)
    gyro = Gyro(1000.0, 0.05 * DEGREE, 300.0, 0.01 * DEGREE)
    return sensed(block, gyro, np.random.default_rng(4))


@pytest.mark.parametrize("count", [8, 100])
@pytest.mark.parametrize("instead", [True, False])
def test_a_block_of_rows_that_is_written_again_is_refused(tmp_path, made, count, instead):
    """In the place of the next one, or before it with the stamps going on."""
    again = np.concatenate((np.arange(600), np.arange(600 - count, 600), np.arange(600 + count * instead, len(made.t))))
    degrees = made.degrees[again]
    error = refused(load_experiment, written(tmp_path, made, t=np.arange(len(degrees)) / 1000.0, degrees=degrees))
    assert error.code == "E-REPEAT"
    assert f"rows 601 to {600 + count} hold the numbers of rows {601 - count} to 600 again" in error.what


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_channel_in_two_columns_is_refused(tmp_path, made, sign):
    spoiled = made.degrees.copy()
    spoiled[:, 1] = sign * spoiled[:, 0]
    with pytest.raises(InputError, match="wx_deg_s and wy_deg_s hold the same numbers") as refused:
        load_experiment(written(tmp_path, made, degrees=spoiled))
    assert refused.value.code == "E-REPEAT"


def test_the_stairs_of_a_coarse_step_are_no_copy():
    """A swing up and down in steps of half a degree a second, noise below the step: equal stairs, nothing copied."""
    t = np.arange(0.0, 3.0, 1e-3)
    swing = 30.0 * np.sin(2.0 * np.pi * t)
    noise = 0.1 * np.random.default_rng(0).standard_normal((len(t), 3))
    crv = np.rint((np.stack((swing, 0.0 * t, 0.0 * t), axis=-1) + noise) / 0.5) * 0.5
    assert repeated_rows(crv) is None
