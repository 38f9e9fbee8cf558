"""The step inside windows suits the stiffest contact of the model that a fit begins with."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.search import MIDDLE, Setup, release_windows, windows
from rockref.discover.windows.on_time import gyro_of
from rockref.discover.windows.series import STEP, Sensor, refinement
from rockref.model.errors import InputError
from rockref.model.simulate import largest_step
from tests.unit.discover.synthetic import experiment


@pytest.mark.parametrize("model", [Model.table_3_1(), Model.four_points()], ids=["eight points", "four points"])
def test_the_block_of_the_source_needs_no_finer_steps(model):
    assert refinement(model) == 1


@pytest.mark.parametrize("factor", [2.0, 5.0, 40.0])
def test_stiffer_contacts_are_stepped_as_finely_as_they_need(factor):
    model = Model.table_3_1().replace(K_N=6e7 * factor)
    parts, limit = refinement(model), largest_step(model.problem())
    assert STEP / parts <= limit < STEP / (parts - 1)


def test_windows_of_a_stiff_block_follow_its_record():
    pytest.importorskip("numba")
    stiff = Model.table_3_1().replace(K_N=1.2e9, K_T=1e9)
    measured = experiment(stiff, [{}], duration=1.0, noisy=True)
    setup = Setup(measured, measured.fit_runs(), stiff, end=1.0, workers=1)
    assert release_windows(setup).refine == refinement(stiff)
    cut, left = windows(setup, MIDDLE), []
    for parts in (cut.refine, 1):
        cut.refine = parts
        fit = setup.fit(cut)
        left.append(np.mean(2 * fit.relax_states(fit.begin(), 3).loss / cut.count))
    # At the truth white noise leaves one, and 12 windows of 70 samples scatter by a twentieth; undivided steps leave a
    # fifth more.
    assert left[0] < 1.05 and left[1] > left[0] + 0.15


@pytest.mark.parametrize("rate", [200.0, 833.0, 952.0, 1000.0, 3200.0, 20000.0])
def test_rows_stand_half_a_sample_apart_at_any_rate(rate):
    """And no step is longer than STEP."""
    e = experiment(Model.table_3_1(), [{}], duration=0.7)
    e = replace(e, gyro=replace(e.gyro, sample_rate=rate))
    run = e.runs[0]
    t = np.arange(int(run.t[-1] * rate)) / rate
    crv = np.stack([np.interp(t, run.t, run.crv[:, k]) for k in range(3)], axis=1)
    e = replace(e, runs=(replace(run, t=t, crv=crv),))
    one = release_windows(Setup(e, e.runs, Model.table_3_1(), workers=1))
    args = [Model.table_3_1()], np.array([0.117]), np.zeros((1, 5)), np.array([0])
    batch = one.batch(*args, Sensor(), one.length)
    instants = batch.wanted[0] * batch.h
    np.testing.assert_allclose(instants, np.arange(len(instants)) / rate / 2, rtol=1e-12)
    assert batch.h <= STEP * (1 + 1e-12)


def test_a_rigid_plate_remembers_nothing_of_one_that_rang():
    """Fits try both on the same windows."""
    e = experiment(Model.table_3_1(), [{}], duration=1.0)
    setup = Setup(e, e.runs, Model.table_3_1(), end=1.0, workers=1)
    fit = setup.fit(windows(setup, MIDDLE))
    before = fit.begin()
    fit.series._carried[1:] = [5e-6, 1e-3, 0.0, 0.0]
    np.testing.assert_array_equal(fit.begin().loss, before.loss)


def test_without_a_gyroscope_there_is_nothing_to_restart_from():
    e = SimpleNamespace(gyro=None, path="folder")
    with pytest.raises(InputError, match="is missing") as error:
        gyro_of(e)
    assert error.value.code == "E-GYRO"
