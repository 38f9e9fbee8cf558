"""What a model leaves in records of its own: white noise where impacts are calm, more where they amplify noise."""

from dataclasses import replace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.floor import floor
from rockref.discover.fit.objective import WHITE
from rockref.discover.fit.problem import fit_problem
from rockref.discover.fit.stages import S3, F
from rockref.discover.fit.whitening import whiten
from tests.unit.discover.synthetic import experiment

MODEL = Model.table_3_1()
#: A block that amplifies noise: stiffer feet that give back nearly all.
LIVELY = MODEL.replace(
    parameters=MODEL.parameters.replace(
        K_N=2.5 * MODEL.parameters.K_N, K_T=2.5 * MODEL.parameters.K_T, beta_int=0.05, beta_ext=0.05
    )
)


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


def test_impacts_that_amplify_noise_raise_the_floor():
    e = experiment(LIVELY, [{}, {"tilt": 0.1}], duration=1.0, noisy=True)
    fitter = Fitter(fit_problem(e, e.runs, LIVELY, end=0.9, workers=1))
    whole, _ = floor(fitter, at_truth(fitter), replace(F, jitter=0.0))
    # 5400 innovations: the mean loss of white noise scatters by 0.016, the median of three records by 0.011.
    assert whole > WHITE + 0.02


def test_by_their_own_covariance_they_do_not():
    e = experiment(LIVELY, [{}, {"tilt": 0.1}], duration=1.0, noisy=True)
    fitter = Fitter(fit_problem(e, e.runs, LIVELY, end=0.9, workers=1))
    whiten(fitter, at_truth(fitter), F)
    assert floor(fitter, at_truth(fitter), F)[0] < WHITE + 0.02


def test_the_floor_is_the_same_each_time(fitter):
    h = at_truth(fitter)
    assert floor(fitter, h, S3)[0] == floor(fitter, h, S3)[0]
