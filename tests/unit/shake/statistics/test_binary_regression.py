"""Regression with Jeffreys' prior against closed forms and a search over a grid."""

import numpy as np
import pytest
from scipy.optimize import approx_fprime, brute
from scipy.stats import norm

from rockref.model.errors import InputError
from rockref.shake.statistics.binary_regression import fit_binary, penalised, penalised_slope


@pytest.mark.parametrize("fallen", [(0, 3), (2, 5), (1, 1)])
def test_saturated_logit_is_a_half_test_more_on_either_side(fallen):
    # With a parameter for each group the penalised likelihood is that of Jeffreys' prior on each share.
    sizes = (4, 5)
    group = np.repeat([0, 1], sizes)
    fell = np.concatenate([np.arange(n) < k for n, k in zip(sizes, fallen, strict=True)]).astype(float)
    design = np.column_stack([np.ones(9), group])
    found = fit_binary(design, fell, "logit").probability([[1, 0], [1, 1]])
    # The search stops at a slope of 1e-5.
    assert found == pytest.approx([(k + 0.5) / (n + 1) for k, n in zip(fallen, sizes, strict=True)], abs=1e-5)


@pytest.mark.parametrize("link", ["logit", "probit"])
def test_separated_outcomes_have_a_finite_fit_which_a_grid_finds_too(link):
    x = np.array([-2.0, -1.0, -0.4, 0.5, 1.1, 2.3])
    fell = (x > 0).astype(float)
    design = np.column_stack([np.ones(6), x])

    def witness(b):
        eta = b[0] + b[1] * x
        p = norm.cdf(eta) if link == "probit" else 1 / (1 + np.exp(-eta))
        density = norm.pdf(eta) if link == "probit" else p * (1 - p)
        w = density**2 / (p * (1 - p))
        det = w.sum() * (w * x**2).sum() - (w * x).sum() ** 2
        return -(np.log(np.where(fell == 1, p, 1 - p)).sum() + 0.5 * np.log(det))

    best = brute(witness, ((-1, 1), (0.1, 2.5)), Ns=60)
    # The polished grid is good to four figures.
    assert fit_binary(design, fell, link).coefficients == pytest.approx(best, abs=1e-3)


@pytest.mark.parametrize("link, far", [("logit", 1.0), ("logit", 800.0), ("probit", 1.0), ("probit", 45.0)])
def test_the_slope_is_that_of_the_likelihood_where_weights_underflow_too(link, far):
    x = np.array([-2.0, -1.0, -0.4, 0.5, 1.1, 2.3])
    design, fell = np.column_stack([np.ones(6), x]), (x > 0).astype(float)
    at = np.array([far, 0.01])
    # A likelihood bends by some ten a test: over a difference of 1e-4 that is less than a thousandth of slopes.
    wanted = approx_fprime(at, lambda b: penalised(design, fell, b, link), 1e-4)
    assert penalised_slope(design, fell, at, link) == pytest.approx(wanted, rel=1e-3, abs=1e-2)


def test_units_of_the_columns_change_nothing():
    rng = np.random.default_rng(2)
    x, fell = rng.normal(size=30), (rng.random(30) < 0.4).astype(float)
    ones = np.ones(30)
    small = fit_binary(np.column_stack([ones, x]), fell)
    large = fit_binary(np.column_stack([ones, 1e4 * x + 3.0]), fell)
    # The search stops at a slope of 1e-5.
    assert small.probability(np.column_stack([ones, x])) == pytest.approx(
        large.probability(np.column_stack([ones, 1e4 * x + 3.0])), abs=1e-5
    )


def test_interval_covers_the_truth_as_often_as_it_says():
    rng = np.random.default_rng(3)
    x = np.linspace(-2.0, 2.0, 40)
    design = np.column_stack([np.ones(40), x])
    truth, at = 1 / (1 + np.exp(-1.5 * x)), np.array([[1.0, 0.7]])
    wanted, inside = 1 / (1 + np.exp(-1.05)), 0
    for _ in range(200):
        low, high = fit_binary(design, (rng.random(40) < truth).astype(float)).interval(at, 0.9)
        inside += low[0] <= wanted <= high[0]
    # A share of 200 draws at 0.9 has a standard deviation of 0.02; three of them.
    assert 0.84 <= inside / 200 <= 0.96


@pytest.mark.parametrize(
    "design, fell, code",
    [
        ([[1, 1], [1, 1]], [0, 1], "E-RANK"),
        ([[1], [1]], [0, 2], "E-RANGE"),
        ([[1], [1], [1]], [0, 1], "E-SHAPE"),
        ([[1, np.nan], [1, 0]], [0, 1], "E-RANGE"),
    ],
)
def test_what_cannot_be_fitted_is_refused(design, fell, code):
    with pytest.raises(InputError, match=code):
        fit_binary(design, fell)
