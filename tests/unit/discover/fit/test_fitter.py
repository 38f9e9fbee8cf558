"""The fit on runs that the model itself made: what is put in comes out."""

from functools import cache

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.differences import jacobian
from rockref.discover.fit.fitter import FittedModel, Fitter, damped, learned
from rockref.discover.fit.objective import WHITE, inflation_for, loss, mean_loss, objective, smoothed, weight
from rockref.discover.fit.problem import fit_problem
from rockref.discover.fit.stages import S1, S3, fineness, time_scale
from rockref.effects.catalogue import parse
from tests.unit.discover.synthetic import experiment

MODEL = Model.table_3_1().replace(mu_ext=0.22, beta_ext=0.2)
NOMINAL = Model.table_3_1()


@cache
def problem(effects: tuple[str, ...] = ()):
    model = MODEL.replace(effects=tuple(map(parse, effects)))
    e = experiment(model, [{}, {"turned": True}], duration=1.0, noisy=True)
    return fit_problem(e, e.runs, NOMINAL, end=0.9, workers=1, candidates=("rolling_resistance", "gyro_scale"))


def test_white_noise_has_the_mean_loss_that_is_stated():
    r = np.random.default_rng(1).normal(size=400_000)
    assert mean_loss(r) == pytest.approx(WHITE, abs=5 * loss(r).std() / 632)
    assert WHITE == pytest.approx(0.947, abs=5e-4)  # as it is quoted


def test_the_weight_is_the_slope_of_the_loss():
    r = np.linspace(-20, 20, 41)
    h = 1e-5
    assert np.allclose((loss(r + h) - loss(r - h)) / (2 * h), 2 * r * weight(r), atol=1e-8)


def test_smoothing_keeps_white_noise_at_size_one():
    r = np.random.default_rng(2).normal(size=(1, 200_000, 1))
    for samples in (2.0, 8.0):
        s = smoothed(r, samples)
        assert s.shape[1] == pytest.approx(200_000 / samples, abs=1)
        assert s[:, 20:-20].std() == pytest.approx(1.0, abs=0.03)


def test_inflation_brings_innovations_to_a_level():
    r = 7 * np.random.default_rng(3).normal(size=5000)
    assert mean_loss(r / inflation_for(r, r.size, 1.5)) == pytest.approx(1.5, rel=1e-4)
    assert inflation_for(r / 7, r.size, 1.5) == 1.0


def test_the_jacobian_predicts_what_a_step_does():
    p = problem()
    fitter = Fitter(p)
    h = fitter.evaluate(FittedModel((), p.nominal()), S1)
    parameters = p.parameters()
    J = jacobian(fitter.residuals(S1), parameters, h.z, h.r)
    k = [q.name for q in parameters].index("tilt_offset[1]")
    assert not J[k][0].any()  # a tilt moves its own run alone
    z = h.z.copy()
    z[k] += 0.05
    moved = fitter.residuals(S1).at(parameters, [z])[0] - h.r
    # A tenth of a wide difference: the curve between is nearly straight before the first impact.
    n = moved.shape[1] // 2
    assert np.allclose(moved[1, :n], 0.05 * J[k][1, :n], atol=0.15 * np.abs(0.05 * J[k][1, :n]).max())


def test_a_fit_finds_what_was_put_in():
    p = problem()
    fitter = Fitter(p)
    h = fitter.tempered(FittedModel((), p.nominal()), S1, 3)
    fitter.refine(h, S3, 2)
    assert h.loss == pytest.approx(WHITE, abs=0.09)  # 5400 innovations scatter by 0.02, and the fit takes up some
    model = p.job(p.parameters(), h.z).models[0]
    assert model.parameters.mu_ext == pytest.approx(0.22, abs=0.03)  # half of the way from nominal, 0.25


def test_the_form_of_a_law_is_held_over_a_part_of_the_runs_at_the_shortest_memory():
    """Neither the records nor the prior move it there, also from where it is not none; over whole runs it moves."""
    p = problem()
    fitter, effects = Fitter(p), ("clock_error",)
    parameters = p.parameters(effects)
    assert [q.name for q in parameters if q.form] == ["clock_error.growth"]
    k = [q.form for q in parameters].index(True)
    start = p.nominal(effects)
    start[[k - 1, k]] = 0.3, 1.0
    for stage, held in ((S1.upto(0.7), True), (S1, False), (S3.upto(0.7), False)):
        h = fitter.tempered(FittedModel(effects, start.copy()), stage, 2)
        assert bool(h.z[k] == start[k]) is held, stage.name
        assert h.z[k - 1] != start[k - 1]


def test_steps_stay_inside_the_limits():
    p = problem()
    parameters = p.parameters(("rolling_resistance",))
    z, G = np.zeros(len(parameters)), len(parameters)
    found = damped(z, np.eye(G), np.full(G, 100.0), 1e-4, parameters)
    assert np.abs(found).max() <= 1.5 + 1e-12
    assert found[-1] == 0.0  # a lever is not negative


def test_an_effect_is_taken_out_and_put_back():
    p = problem()
    fitter = Fitter(p)
    h = FittedModel(("gyro_scale",), np.arange(len(p.parameters(("gyro_scale",))), dtype=float))
    both = fitter.with_effect(h, "rolling_resistance")
    assert both.effects == ("gyro_scale", "rolling_resistance")
    less = fitter.without(both, "gyro_scale")
    assert less.effects == ("rolling_resistance",)
    assert len(less.z) == len(p.parameters(("rolling_resistance",)))
    assert np.array_equal(fitter.without(both, "rolling_resistance").z, h.z)


def test_nominal_numbers_are_those_of_table_3_1_scaled_with_the_block():
    p = problem()
    model = p.job(p.parameters(), p.nominal()).models[0]
    for name in ("K_N", "K_T", "beta_int", "mu_ext", "delta_diag"):
        assert getattr(model.parameters, name) == pytest.approx(getattr(NOMINAL.parameters, name), rel=1e-6)


def test_objective_counts_the_prior():
    z = np.array([1.0, 2.0])
    assert objective(np.zeros(3), z) == 2.5


def test_slower_blocks_remember_longer_and_stiffer_ones_take_finer_steps():
    assert time_scale(NOMINAL) == pytest.approx(1.0)
    assert time_scale(NOMINAL.replace(width=0.4, height=4 * 0.688)) == pytest.approx(2.0)
    assert fineness(6e7, 54.0) == 1.0 < fineness(1.5e8, 54.0) <= 1.8


def test_slopes_that_learn_give_the_last_change_and_keep_what_is_across_it():
    rng = np.random.default_rng(3)
    J, change, step = rng.standard_normal((4, 9)), rng.standard_normal(9), np.array([1.0, 2.0, 0.0, -1.0])
    across = np.array([2.0, -1.0, 5.0, 0.0])
    assert step @ learned(J, step, change) == pytest.approx(change, rel=1e-12)
    assert across @ learned(J, step, change) == pytest.approx(across @ J, rel=1e-12)
