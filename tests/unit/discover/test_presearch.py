"""What is seen in the records before anything is cut: flat tops."""

from dataclasses import replace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.presearch import flat_tops
from tests.unit.discover.synthetic import experiment

LIMIT = 0.45


@pytest.fixture(scope="module")
def two_runs():
    return experiment(Model.table_3_1(), [{}, {"turned": True}], duration=1.2, noisy=True)


def clipped(e, limits):
    return tuple(replace(run, crv=np.clip(run.crv, -k, k)) for run, k in zip(e.runs, limits, strict=True))


def test_records_that_are_cut_at_one_rate_have_flat_tops(two_runs):
    assert flat_tops(two_runs, clipped(two_runs, (LIMIT, LIMIT))) == pytest.approx(LIMIT)


def test_records_that_are_not_cut_have_none(two_runs):
    assert flat_tops(two_runs, two_runs.runs) is None


def test_tops_at_different_rates_are_not_one_gyroscope_s(two_runs):
    assert flat_tops(two_runs, clipped(two_runs, (LIMIT, 0.9 * LIMIT))) is None
