"""Means over tests with intervals from resampled motions: tests of one motion depend on one another."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.model.errors import InputError
from rockref.shake.statistics.outcomes import finite, motions


@dataclass(frozen=True)
class MeanOverMotions:
    """A mean over tests, and its interval."""

    mean: float
    low: float
    high: float

    def __str__(self) -> str:
        return f"{self.mean:.3f} ({self.low:.3f} to {self.high:.3f})"


def mean_over_motions(
    values: Any, motion: Any, *, confidence: float = 0.95, draws: int = 4000, seed: int = 0
) -> MeanOverMotions:
    """Return the mean of values (n,) over tests, with the percentile interval of resampled motions.

    A draw takes as many motions as there are, with replacement, and all tests of each. Source: Davison and Hinkley,
    Bootstrap Methods and their Application (1997), section 3.8, doi 10.1017/CBO9780511802843. Raises InputError
    E-SHAPE, E-RANGE; E-MOTIONS where there is one motion only.
    """
    x = finite(values, "values")
    group, number = motions(motion, len(x))
    if number < 2:
        raise InputError("E-MOTIONS", "motion", "there is one motion", "An interval needs several motions.")
    sums, counts = np.bincount(group, weights=x), np.bincount(group)
    weights = np.random.default_rng(seed).multinomial(number, np.full(number, 1.0 / number), size=draws)
    means = (weights @ sums) / (weights @ counts)
    low, high = np.quantile(means, [0.5 - 0.5 * confidence, 0.5 + 0.5 * confidence])
    return MeanOverMotions(float(x.mean()), float(low), float(high))


def paired_difference(scores_a: Any, scores_b: Any, motion: Any, **how: Any) -> MeanOverMotions:
    """Return the mean of a - b over the same tests, with the interval of resampled motions.

    Both models must have seen the same motions and the same draws. Keywords as in `mean_over_motions`.
    """
    a, b = finite(scores_a, "scores of a"), finite(scores_b, "scores of b")
    if len(a) != len(b):
        raise InputError("E-SHAPE", "scores of b", f"has {len(b)} values", f"Give {len(a)}: both score every test.")
    return mean_over_motions(a - b, motion, **how)
