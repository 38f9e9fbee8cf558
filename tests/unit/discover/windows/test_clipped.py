"""Records that are cut flat are seen, and what was cut off is put back well enough to know the attitude."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.windows import clipped as windows_clipped
from rockref.discover.windows.clipped import flat_tops, unclipped
from tests.unit.discover.synthetic import experiment

LIMIT = 0.45


@pytest.fixture(scope="module")
def two_runs():
    return experiment(Model.table_3_1(), [{}, {"turned": True}], duration=1.2, noisy=True)


def clipped(e, limits):
    return tuple(replace(run, crv=np.clip(run.crv, -k, k)) for run, k in zip(e.runs, limits, strict=True))


def test_records_that_are_cut_at_one_rate_have_flat_tops(two_runs):
    assert flat_tops(two_runs, clipped(two_runs, (LIMIT, LIMIT))) == pytest.approx(LIMIT)


def test_of_one_run_alone_a_flat_top_is_enough(two_runs):
    one = clipped(two_runs, (LIMIT, LIMIT))[:1]
    assert flat_tops(two_runs, one) == pytest.approx(LIMIT)
    assert flat_tops(two_runs, two_runs.runs[:1]) is None and flat_tops(two_runs, ()) is None


def test_records_that_are_not_cut_have_none(two_runs):
    assert flat_tops(two_runs, two_runs.runs) is None


def test_tops_at_different_rates_are_not_one_gyroscope_s(two_runs):
    assert flat_tops(two_runs, clipped(two_runs, (LIMIT, 0.9 * LIMIT))) is None


@pytest.mark.parametrize("k", [0, 1])
def test_the_attitude_survives_what_was_cut_off(two_runs, k):
    """The peaks of 0.65 rad/s are cut at 0.45, 27 ms and more about every impact."""
    run = clipped(two_runs, (LIMIT, LIMIT))[k]
    whole, cut, back = two_runs.runs[k].crv, run.crv, unclipped(two_runs, clipped(two_runs, (LIMIT, LIMIT)))[k]
    step = run.t[1] - run.t[0]
    lost, left = (np.abs(np.cumsum(w[:, 0] - whole[:, 0]) * step).max() for w in (cut, back))
    # Five milliradians and more would leave every later window out of step; half of one is within the corrections.
    assert lost > 5e-3 and left < 5e-4
    kept = np.abs(run.crv[:, 0]) < 0.99 * LIMIT
    np.testing.assert_array_equal(back[kept], cut[kept])


def test_what_is_not_clipped_stays_as_it_is(two_runs):
    assert unclipped(two_runs, two_runs.runs)[0] is two_runs.runs[0].crv


def swing(t, at=0.6):
    """Rate about X of a block that is upright at `at` [s]: it falls toward it and slows down behind it."""
    before, after = np.cosh(4.6 * t), 0.95 * np.cosh(4.6 * (2 * at - t))
    return np.where(t < at, before, after) / np.cosh(4.6 * at)


def made(wx, others=0.0):
    """A run of a slender block with these rates, cut at 0.6 of the largest, and how it is put back."""
    t = np.arange(len(wx)) * 1e-3
    crv = np.stack([wx, np.full(len(wx), others), np.zeros(len(wx))], axis=-1)
    limit = 0.6
    gyro = SimpleNamespace(resolution=1e-4)
    run = SimpleNamespace(t=t, crv=np.clip(crv, -limit, limit), release_tilt=0.117, block_turned=0.0)
    return run, windows_clipped._whole(SimpleNamespace(gyro=gyro, width=0.1, height=0.688), run, limit)


def test_rates_about_the_other_axes_are_bridged_by_a_line():
    wx = np.zeros(400)
    run, back = made(wx)
    np.testing.assert_array_equal(back, run.crv)
    t = run.t
    bump = 0.7 - 4.0 * np.abs(t - 0.2)
    run.crv[:, 1] = np.clip(bump, -0.6, 0.6)
    gyro = SimpleNamespace(resolution=1e-4)
    back = windows_clipped._whole(SimpleNamespace(gyro=gyro, width=0.1, height=0.688), run, 0.6)
    # Between the two ends of the gap, both just below the limit, a line is level.
    assert np.abs(back[:, 1] - run.crv[:, 1]).max() < 5e-3 and np.array_equal(back[:, 0], run.crv[:, 0])


@pytest.mark.parametrize("first", [0, 560])
def test_a_gap_with_too_little_beside_it_is_left_as_it_is(first):
    """From the first sample on, and where another gap is near, there is no arc to be continued."""
    t = np.arange(1200) * 1e-3
    wx = 0.5 * swing(t)
    wx[first : first + 20] = 0.7
    if first:
        wx[first - 3] = 0.7
    run, back = made(wx)
    np.testing.assert_array_equal(back[first : first + 20, 0], run.crv[first : first + 20, 0])


def test_an_arc_that_is_cut_at_its_impact_is_put_back():
    t = np.arange(1200) * 1e-3
    run, back = made(-swing(t))
    cut = np.abs(run.crv[:, 0]) >= 0.6
    assert 0.02 < cut.mean() < 0.5
    assert np.abs(back[:, 0] + swing(t)).max() < 0.1 < np.abs(run.crv[:, 0] + swing(t)).max()
