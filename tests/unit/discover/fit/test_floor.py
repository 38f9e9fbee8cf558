"""What a model leaves in records of its own: white noise where these tell enough, more where they do not."""

from dataclasses import replace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.floor import floor
from rockref.discover.fit.objective import WHITE
from rockref.discover.fit.problem import fit_problem
from rockref.discover.fit.stages import S3
from tests.unit.discover.synthetic import experiment

MODEL = Model.table_3_1()


@pytest.fixture(scope="module")
def fitter():
    e = experiment(MODEL, [{}, {"turned": True}], duration=1.0, noisy=True)
    return Fitter(fit_problem(e, e.runs, MODEL, end=0.9, workers=1))


def at_truth(fitter: Fitter) -> FittedModel:
    return fitter.evaluate(FittedModel((), fitter.problem.nominal()), S3)


def test_a_right_model_leaves_what_it_leaves_in_records_of_its_own(fitter):
    h = at_truth(fitter)
    whole, by_run = floor(fitter, h, S3)
    # 5400 innovations: their mean loss scatters by 0.016, that of the floor by as much.
    assert h.loss == pytest.approx(whole, abs=0.08)
    assert by_run.shape == (2, 3) and np.all(by_run >= WHITE)


def test_a_wrong_model_leaves_more(fitter):
    wrong = fitter.evaluate(FittedModel((), fitter.problem.nominal() + 0.4), S3)
    assert wrong.loss > 1.3 * floor(fitter, wrong, S3)[0]


def test_a_slow_recorder_raises_the_floor():
    e = experiment(MODEL, [{}], duration=1.0, noisy=True)
    slow = replace(e, gyro=replace(e.gyro, sample_rate=250.0, bandwidth=100.0))
    runs = tuple(replace(run, t=run.t[::4], crv=run.crv[::4]) for run in e.runs)
    fitter = Fitter(fit_problem(slow, runs, MODEL, end=0.9, workers=1))
    assert floor(fitter, at_truth(fitter), S3)[0] > 1.05 * WHITE


def test_the_floor_is_the_same_each_time(fitter):
    h = at_truth(fitter)
    assert floor(fitter, h, S3)[0] == floor(fitter, h, S3)[0]
