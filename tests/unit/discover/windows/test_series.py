"""The step inside windows suits the stiffest contact of the model that a fit begins with."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.search import MIDDLE, Setup, release_windows, windows
from rockref.discover.windows.series import STEP, gyro_of, refinement
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


def test_without_a_gyroscope_there_is_nothing_to_restart_from():
    e = SimpleNamespace(gyro=None, path="folder")
    with pytest.raises(InputError, match="is missing") as error:
        gyro_of(e)
    assert error.value.code == "E-GYRO"
