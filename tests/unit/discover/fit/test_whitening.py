"""Innovations of a right model that impacts have coloured are white by their own covariance; a wrong one's are not."""

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.objective import WHITE
from rockref.discover.fit.problem import fit_problem
from rockref.discover.fit.stages import F
from rockref.discover.fit.whitening import changes, quieten, whitening
from tests.unit.discover.synthetic import experiment

TABLE = Model.table_3_1()
#: A block that amplifies noise: stiffer feet that give back nearly all.
LIVELY = TABLE.replace(
    parameters=TABLE.parameters.replace(
        K_N=2.5 * TABLE.parameters.K_N, K_T=2.5 * TABLE.parameters.K_T, beta_int=0.05, beta_ext=0.05
    )
)


def fitter_of(model: Model) -> Fitter:
    made = experiment(model, [{}, {"tilt": 0.1}, {"turned": True}], duration=1.6, noisy=True)
    return Fitter(fit_problem(made, made.runs, model, end=1.5, workers=1))


def at_truth(fitter: Fitter) -> FittedModel:
    return FittedModel((), fitter.problem.nominal())


@pytest.fixture(scope="module")
def lively() -> Fitter:
    return fitter_of(LIVELY)


def test_impacts_colour_the_innovations_of_a_right_model(lively):
    change = changes(lively, at_truth(lively), F)
    wide = (change**2).mean(axis=0)
    # Fresh noise alone is one; behind impacts it is several times that.
    assert np.median(wide) == pytest.approx(1.0, abs=0.1) and wide.max() > 5.0


def test_they_are_white_by_their_covariance(lively):
    h = at_truth(lively)
    found = whitening(lively, h, F)
    lively.problem.spikes["F"] = []
    r = lively.evaluate(h, F).r
    lively.problem.spikes.clear()
    along = [s.directions @ r[s.run, s.first : s.end].ravel() for s in found]
    variances = np.concatenate([s.variances for s in found])
    squares = np.concatenate(along) ** 2
    # Some forty values, each of its own variance: their mean scatters by a quarter. Without it they are far from one.
    assert len(squares) > 20
    assert np.mean(squares / variances) == pytest.approx(1.0, abs=0.6) and np.mean(squares) > 10.0


def test_a_wrong_model_is_not_white_by_it(lively):
    h = at_truth(lively)
    lively.problem.spikes["F"] = whitening(lively, h, F)
    wrong = lively.evaluate(FittedModel((), h.z + 0.2), F)
    lively.problem.spikes.clear()
    assert wrong.loss > 1.5 * WHITE


def test_the_same_noise_is_added_each_time(lively):
    first, again = (whitening(lively, at_truth(lively), F) for _ in range(2))
    assert len(first) == len(again) > 0
    assert all(np.array_equal(a.directions, b.directions) for a, b in zip(first, again, strict=True))


def test_noise_that_was_taken_for_too_much_is_what_a_right_model_leaves():
    fitter = fitter_of(TABLE)
    true = fitter.problem.listener.sigma.copy()
    assert not quieten(fitter, at_truth(fitter), F) and np.array_equal(fitter.problem.listener.sigma, true)
    fitter.problem.listener.quieten(np.array([1.0, 2.0, 1.0]))
    assert quieten(fitter, at_truth(fitter), F)
    # 4500 samples of an axis tell a median to 2 %.
    assert np.allclose(fitter.problem.listener.sigma / true, [1.0, 1.0, 1.0], atol=0.06)


def test_noise_is_never_taken_for_more(lively):
    true = lively.problem.listener.sigma.copy()
    wrong = FittedModel((), at_truth(lively).z + 0.2)
    assert not quieten(lively, wrong, F) and np.array_equal(lively.problem.listener.sigma, true)
