"""Fragility: form, prior, and the curve without a form."""

import numpy as np
import pytest
from scipy.stats import norm

from rockref.model.errors import InputError
from rockref.shake.statistics.fragility import fit_fragility, monotone_curve


def test_lognormal_fragility_comes_back():
    rng = np.random.default_rng(4)
    x = np.exp(rng.uniform(-2.0, 1.0, 4000))
    fell = rng.random(4000) < norm.cdf(np.log(x / 0.6) / 0.35)
    found = fit_fragility(x, fell.astype(float))
    # Standard errors of both are 0.012 with 4000 tests over this range; three of them.
    assert np.log(found.theta / 0.6) == pytest.approx(0.0, abs=0.036)
    assert found.beta == pytest.approx(0.35, abs=0.036)
    assert found.probability([found.theta])[0] == pytest.approx(0.5)


def test_a_step_of_few_outcomes_has_finite_scatter():
    found = fit_fragility([0.2, 0.3, 0.5, 0.8], [0, 0, 1, 1])
    assert 0.1 < found.beta < 2.0
    assert 0.3 < found.theta < 0.5
    low, high = found.interval([0.39])
    # Four tests say next to nothing about the middle.
    assert low[0] < 0.2 and high[0] > 0.8


def test_median_has_the_unit_of_the_size():
    one = fit_fragility([0.2, 0.3, 0.4, 0.8], [0, 1, 0, 1], "logit")
    other = fit_fragility([200, 300, 400, 800], [0, 1, 0, 1], "logit")
    # The search stops at a slope of 1e-5.
    assert other.theta == pytest.approx(1000 * one.theta, rel=1e-4)
    assert other.beta == pytest.approx(one.beta, rel=1e-4)


def test_monotone_curve_is_the_largest_of_least_means():
    rng = np.random.default_rng(5)
    x = rng.choice(np.arange(1.0, 9.0), 60)
    fell = (rng.random(60) < x / 9).astype(float)
    levels, curve = monotone_curve(x, fell)

    def mean(a, b):
        inside = (x >= levels[a]) & (x <= levels[b])
        return fell[inside].mean()

    last = len(levels)
    witness = [max(min(mean(a, b) for b in range(k, last)) for a in range(k + 1)) for k in range(last)]
    # Means of the same numbers in another order.
    assert curve == pytest.approx(witness, abs=1e-12)


def test_sizes_must_be_positive():
    with pytest.raises(InputError, match="E-RANGE"):
        fit_fragility([0.0, 1.0], [0, 1])


@pytest.mark.parametrize("link", ["probit", "logit"])
def test_where_nothing_fell_the_median_may_lie_beyond_all_numbers(link):
    # Even in the logarithm about its mean: the slope is zero but for rounding, and one over it has no bound.
    found = fit_fragility([0.5, 1.0, 2.0, 4.0], [0, 0, 0, 0], link)
    assert abs(found.beta) > 1e6
    assert (found.probability([0.5, 4.0]) < 0.25).all()
