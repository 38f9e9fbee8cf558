"""Faults of the sensor in a record of a block that has none: told with their numbers, and told from motion."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

from rockref.measure.checks.sensor import _lags, sensor_faults
from rockref.measure.experiment import load_experiment
from rockref.measure.reading.columns import DEGREE
from tests.shipped import CONTROL


@pytest.fixture(scope="module")
def control():
    """An experiment in which nothing is hidden, two runs of it."""
    experiment = load_experiment(CONTROL)
    return dataclasses.replace(experiment, runs=experiment.runs[:2])


def found(experiment, change):
    """The faults of the sensor once every run was changed, and their remarks."""
    runs = [dataclasses.replace(run, crv=change(run.t, run.crv.copy())) for run in experiment.runs]
    return sensor_faults(experiment, runs)


def shifted(axis, size, since):
    def change(t, crv):
        crv[t > since, axis] += size * DEGREE
        return crv

    return change


def late(axis, count):
    def change(_, crv):
        crv[count:, axis] = crv[:-count, axis].copy()
        return crv

    return change


def humming(axis, size, line):
    def change(t, crv):
        crv[:, axis] += size * DEGREE * np.sin(2.0 * np.pi * line * t + 0.7)
        return crv

    return change


def test_shipped_records_have_none(control):
    assert control.sensor_faults == ()
    assert sensor_faults(control, control.runs) == ([], [])


@pytest.mark.parametrize(("axis", "size"), [(0, -1.2), (1, 1.5), (2, 2.5)])
def test_a_zero_that_shifts_is_told_with_its_size(control, axis, size):
    faults, notices = found(control, shifted(axis, size, 0.55))
    assert {(f.kind, f.run, f.axis) for f in faults} == {("zero", run.id, axis) for run in control.runs}
    # A tenth: feet that are uneven stand a little askew from impact to impact.
    assert all(f.size / DEGREE == pytest.approx(size, rel=0.15) and 0.4 < f.place < 1.6 for f in faults)
    assert {n.code for n in notices} == {"W-ZERO"}


@pytest.mark.parametrize("axis", [0, 1])
def test_a_channel_that_is_a_sample_late_is_told(control, axis):
    """In some runs the shocks are too few to tell: half of six have to agree."""
    faults, notices = found(load_experiment(CONTROL), late(axis, 1))
    assert [(f.kind, f.axis) for f in faults] == [("lag", axis)]
    assert faults[0].size == pytest.approx(1e-3, abs=3e-4)
    assert [n.code for n in notices] == ["W-LAG"]


@pytest.mark.parametrize(("axis", "size", "line"), [(2, 0.2, 50.02), (0, 0.1, 59.95)])
def test_a_hum_is_told_with_size_and_frequency(control, axis, size, line):
    faults, notices = found(control, humming(axis, size, line))
    assert {(f.kind, f.axis) for f in faults} == {("hum", axis)}
    assert all(f.size / DEGREE == pytest.approx(size, rel=0.15) and abs(f.place - line) < 0.1 for f in faults)
    assert {n.code for n in notices} == {"W-HUM"}


@pytest.mark.parametrize(("count", "told"), [(2, True), (3, False)])
def test_of_one_run_alone_a_large_lag_is_chance(count, told):
    """Shocks of random size at random rows, the same in all channels, one of which comes late."""
    rng = np.random.default_rng(8)
    shocks = np.zeros((4000, 1))
    shocks[rng.choice(4000, 80, replace=False), 0] = rng.uniform(0.5, 1.0, 80)
    crv = np.repeat(shocks, 3, axis=1) + 1e-3 * rng.standard_normal((4000, 3))
    crv[count:, 1] = crv[:-count, 1].copy()
    run = SimpleNamespace(t=np.arange(4000) * 1e-3, crv=crv)
    assert [f.kind for f in _lags([run])] == ["lag"] * told
    assert [(f.axis, round(1e3 * f.size)) for f in _lags([run, run])] == [(1, count)]
