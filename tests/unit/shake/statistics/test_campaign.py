"""Sizes of campaigns against known numbers and a simulated campaign."""

import numpy as np
import pytest

from rockref.model.errors import InputError
from rockref.shake.statistics.campaign import least_difference, rough_sample_size, sample_size


def test_half_against_six_tenths():
    assert rough_sample_size(0.5, 0.1) == 400
    assert sample_size(0.5, 0.6) == 388
    # Two figures are printed.
    assert least_difference(0.5, 226) == pytest.approx(0.13, abs=5e-3)


def test_a_campaign_of_that_size_sees_the_difference_as_often_as_it_says():
    rng, n = np.random.default_rng(14), sample_size(0.2, 0.4)
    a, b = rng.binomial(n, 0.2, 20000) / n, rng.binomial(n, 0.4, 20000) / n
    middle = 0.5 * (a + b)
    seen = np.abs(a - b) > 1.96 * np.sqrt(2 * middle * (1 - middle) / n)
    # The normal formula is good to a few hundredths at these sizes.
    assert seen.mean() == pytest.approx(0.8, abs=0.03)


def test_equal_probabilities_are_refused():
    with pytest.raises(InputError, match="E-RANGE"):
        sample_size(0.5, 0.5)
