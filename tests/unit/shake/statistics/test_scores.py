"""Scores against their definitions, and the ceiling of repeats against a population."""

import math

import numpy as np
import pytest

from rockref.model.errors import InputError
from rockref.shake.statistics.scores import best_accuracy, brier_scores, hits, log_losses, reliability, repeats


def test_scores_of_three_predictions():
    p, y = [0.25, 0.5, 1.0], [0, 1, 0]
    # One rounding each.
    assert log_losses(p, y) == pytest.approx([-math.log(0.75), math.log(2), -math.log(1e-6)], rel=1e-9)
    assert brier_scores(p, y) == pytest.approx([0.0625, 0.25, 1.0])
    assert hits(p, y).tolist() == [1.0, 0.5, 0.0]


def test_reliability_of_a_calibrated_prediction_is_inside_its_intervals():
    rng = np.random.default_rng(6)
    bins = []
    for _ in range(40):
        p = rng.random(500)
        bins += reliability(p, (rng.random(500) < p).astype(float), bins=5)
    assert len(bins) == 200 and sum(b.n for b in bins) == 40 * 500
    # A share of 200 at 0.95 has a standard deviation of 0.015; three of them.
    assert 0.905 <= np.mean([b.low <= b.predicted <= b.high for b in bins]) <= 0.995


def test_repeats_are_counted_within_a_motion():
    motion = ["a", "a", "a", "b", "b"]
    found = repeats(motion, [1.0, 1.04, 2.0, 1.0, 1.01], [0, 1, 1, 1, 1])
    assert (found.pairs, found.agree) == (2, 1)
    assert found.best_accuracy == 0.5


def test_no_population_beats_the_ceiling_of_its_repeats():
    rng = np.random.default_rng(7)
    for spread in (0.3, 1.0, 4.0):
        p = 1 / (1 + np.exp(-spread * rng.normal(size=2000)))
        agreement = np.mean(p**2 + (1 - p) ** 2)
        best = np.mean(np.maximum(p, 1 - p))
        assert agreement < best <= best_accuracy(agreement)
    # One probability for all: the bound is reached, but for rounding.
    assert best_accuracy(0.7**2 + 0.3**2) == pytest.approx(0.7)


def test_probabilities_beyond_one_and_campaigns_without_repeats_are_refused():
    with pytest.raises(InputError, match="E-RANGE"):
        log_losses([1.2], [1])
    with pytest.raises(InputError, match="E-REPEATS"):
        repeats(["a", "b"], [1.0, 1.0], [0, 1])
