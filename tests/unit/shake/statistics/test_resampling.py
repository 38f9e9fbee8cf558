"""Intervals from resampled motions."""

import numpy as np
import pytest

from rockref.model.errors import InputError
from rockref.shake.statistics.resampling import mean_over_motions, paired_difference


def test_one_value_a_motion_gives_the_interval_of_a_mean():
    x = np.random.default_rng(11).normal(2.0, 3.0, 400)
    found = mean_over_motions(x, np.arange(400))
    half = 1.96 * x.std() / 20
    assert found.mean == pytest.approx(x.mean())
    # Quantiles of 4000 draws are good to some 4 % of the half width.
    assert (found.low, found.high) == pytest.approx((x.mean() - half, x.mean() + half), abs=0.1 * half)


def test_copies_of_a_test_do_not_narrow_the_interval():
    x = np.random.default_rng(12).normal(size=50)
    once = mean_over_motions(x, np.arange(50))
    often = mean_over_motions(np.repeat(x, 30), np.repeat(np.arange(50), 30))
    # The same draws of the same motions; sums differ by rounding.
    assert (often.low, often.high) == pytest.approx((once.low, once.high), abs=1e-12)


def test_what_both_models_share_drops_out_of_a_paired_difference():
    rng = np.random.default_rng(13)
    hard = np.repeat(rng.normal(0.0, 5.0, 40), 5)
    found = paired_difference(hard + 0.2, hard, np.repeat(np.arange(40), 5))
    # A difference of large numbers: rounding.
    assert (found.low, found.mean, found.high) == pytest.approx((0.2, 0.2, 0.2), abs=1e-12)


def test_one_motion_has_no_interval():
    with pytest.raises(InputError, match="E-MOTIONS"):
        mean_over_motions([0.1, 0.2], ["a", "a"])
