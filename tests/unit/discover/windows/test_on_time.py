"""Records are read at the instants that their time stamps tell, or refused."""

from dataclasses import replace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.windows.on_time import SLOWEST, gyro_of, on_time
from rockref.model.errors import InputError
from tests.unit.discover.synthetic import experiment

RATE = 1000.0


@pytest.fixture(scope="module")
def measured():
    return experiment(Model.table_3_1(), [{}], duration=1.0)


def stamped(e, t, crv=None):
    """The experiment with these time stamps for its one run."""
    run = e.runs[0]
    return replace(e, runs=(replace(run, t=t, crv=run.crv if crv is None else crv),))


def test_a_record_at_the_stated_rate_is_left_as_it_is(measured):
    assert on_time(measured).runs[0] is measured.runs[0]
    rounded = stamped(measured, np.round(measured.runs[0].t, 3))
    assert on_time(rounded).runs[0] is rounded.runs[0]
    unopened = replace(measured, runs=(replace(measured.runs[0], t=None, crv=None),))
    assert on_time(unopened).runs[0] is unopened.runs[0]


@pytest.mark.parametrize("rate, late", [(1004.0, 0.0), (995.0, 0.0), (1000.0, 1.0e-3), (1003.0, 0.6e-3)])
def test_the_time_stamps_are_believed(measured, rate, late):
    """A record of the same motion at another rate, or begun a sample late, is that of the stated rate again."""
    from scipy.interpolate import CubicSpline

    run = measured.runs[0]
    t = late + np.arange(int((run.t[-1] - late) * rate)) / rate
    found = on_time(stamped(measured, t, CubicSpline(run.t, run.crv)(t))).runs[0]
    assert np.array_equal(found.t, np.arange(len(found.t)) / RATE)
    # Cubics through cubics, behind a low-pass at 300 Hz: off by some of the noise at the impacts, 0.05 deg/s.
    off = np.degrees(found.crv - run.crv[: len(found.t)])
    assert np.sqrt(np.mean(off**2)) < 0.03
    assert np.allclose(found.crv[0], run.crv[0], atol=np.radians(0.05))


def test_what_is_cut_flat_stays_so(measured):
    run = measured.runs[0]
    top = 0.6 * np.abs(run.crv[:, 0]).max()
    found = on_time(stamped(measured, run.t * 1.004, np.clip(run.crv, -top, top))).runs[0]
    assert np.abs(found.crv[:, 0]).max() <= top


def test_a_record_that_lacks_its_beginning_is_refused(measured):
    run = measured.runs[0]
    with pytest.raises(InputError, match="late") as error:
        on_time(stamped(measured, run.t[50:], run.crv[50:]))
    assert error.value.code == "E-START" and run.file in error.value.where


def test_a_record_without_a_main_impact_is_refused(measured):
    run = measured.runs[0]
    with pytest.raises(InputError, match="main impact") as error:
        on_time(stamped(measured, run.t[:300], run.crv[:300]))
    assert error.value.code == "E-SHORT"


def test_a_gyroscope_that_is_too_slow_is_refused(measured):
    slow = replace(measured, gyro=replace(measured.gyro, sample_rate=SLOWEST / 2))
    with pytest.raises(InputError, match="sample_rate_hz = 100") as error:
        gyro_of(slow)
    assert error.value.code == "E-GYRO"
