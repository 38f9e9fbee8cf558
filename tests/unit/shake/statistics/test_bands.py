"""Bands and intervals against closed forms."""

import numpy as np
import pytest
from scipy.stats import multinomial

from rockref.model.errors import InputError
from rockref.shake.statistics.bands import distribution_function, dkw_half_width, paired_interval, wilson_interval


@pytest.mark.parametrize("n, expected", [(100, 0.136), (226, 0.090), (254, 0.085)])
def test_half_width_of_published_campaigns(n, expected):
    # Three figures are printed.
    assert dkw_half_width(n) == pytest.approx(expected, abs=5e-4)


def test_band_holds_the_whole_distribution_function_as_often_as_it_says():
    rng = np.random.default_rng(1)
    n, held = 40, 0
    for _ in range(2000):
        u = np.sort(rng.random(n))
        steps = np.arange(n + 1) / n
        held += max((steps[1:] - u).max(), (u - steps[:-1]).max()) <= dkw_half_width(n, 0.9)
    # A share of 2000 draws has a standard deviation of 0.007; the band is a bound, and is nearly sharp.
    assert 0.88 <= held / 2000 <= 0.94


def test_distribution_function_rises_by_steps_within_its_band():
    x, share, low, high = distribution_function([3.0, 1.0, 2.0, 2.0])
    assert x.tolist() == [1.0, 2.0, 2.0, 3.0]
    assert share.tolist() == [0.25, 0.5, 0.75, 1.0]
    assert low.min() == 0.0 and high.max() == 1.0


@pytest.mark.parametrize("k, n", [(0, 10), (3, 7), (30, 34), (50, 50)])
def test_wilson_interval_solves_its_quadratic(k, n):
    z = 1.959963984540054
    roots = np.roots([1 + z**2 / n, -(2 * k / n + z**2 / n), (k / n) ** 2])
    # Rounding of two ways to solve one quadratic.
    assert wilson_interval(k, n) == pytest.approx(sorted(roots.real), abs=1e-12)


def test_what_is_no_share_is_refused():
    with pytest.raises(InputError, match="E-RANGE"):
        wilson_interval(3, 2)


def test_a_difference_of_paired_shares_has_the_published_interval():
    # `ci.prop.ps(.05, 12, 4, 26, 6)` of the R package statpsych, by the authors of the method, prints these ends.
    assert paired_interval(26, 4, 48) == pytest.approx((0.2548067, 0.6251933), abs=5e-8)


@pytest.mark.parametrize("only_one, only_other", [(0.01, 0.01), (0.03, 0.0), (0.2, 0.1), (0.45, 0.4)])
def test_a_difference_of_paired_shares_is_held_as_often_as_it_says(only_one, only_other):
    n, held = 60, 0.0
    law = multinomial(n, [only_one, only_other, 1 - only_one - only_other])
    for b in range(n + 1):
        for c in range(n + 1 - b):
            low, high = paired_interval(b, c, n)
            held += law.pmf([b, c, n - b - c]) * (low <= only_one - only_other <= high)
    # An interval of a normal form: its authors report coverages from about 94 % on.
    assert held >= 0.94


def test_counts_that_are_no_pairs_are_refused():
    for counts in ((-1, 0, 5), (3, 3, 5), (0, 0, 0)):
        with pytest.raises(InputError, match="E-RANGE"):
            paired_interval(*counts)
