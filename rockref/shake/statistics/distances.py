"""Distance between two distributions of a result, tested by exchanging whole motions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.shake.statistics.outcomes import finite, motions


@dataclass(frozen=True)
class DistanceTest:
    """A distance between two samples, and the share of exchanges that give at least as large a one."""

    distance: float
    p_value: float


def kolmogorov_smirnov(x: Any, y: Any) -> float:
    """Return the largest difference between two distribution functions of samples (n,) and (m,)."""
    from scipy.stats import ks_2samp

    return float(ks_2samp(finite(x, "x"), finite(y, "y")).statistic)


def energy_distance(x: Any, y: Any) -> float:
    """Return 2 E|X - Y| - E|X - X'| - E|Y - Y'| of two samples, in the unit of x.

    Source: Szekely and Rizzo, Journal of Statistical Planning and Inference 143 (2013), doi
    10.1016/j.jspi.2013.03.018. SciPy gives the root.
    """
    from scipy.stats import energy_distance as root

    return float(root(finite(x, "x"), finite(y, "y"))) ** 2


def exchange_test(
    x: Any, y: Any, motion_x: Any, motion_y: Any, *, statistic: Any = energy_distance, draws: int = 999, seed: int = 0
) -> DistanceTest:
    """Test whether two samples have one distribution, by exchanging whole motions.

    Tests of one motion depend on one another, so single values may not be exchanged. Where both samples have a motion
    (a model and the experiment), the two exchange all values of it; a motion that only one of them has may go to the
    other side.

    Parameters
    ----------
    x, y : (n,), (m,) results;  motion_x, motion_y : their motions
    statistic : function of two samples; large where they differ
    draws : random exchanges; the observed one is counted too, so that the least p is 1/(draws + 1)

    Raises InputError E-SHAPE, E-RANGE.
    """
    first, second = finite(x, "x"), finite(y, "y")
    values = np.concatenate([first, second])
    labels = np.concatenate([np.asarray(motion_x), np.asarray(motion_y)])
    group, number = motions(labels, len(values))
    side = np.arange(len(values)) < len(first)
    observed, rng, as_far = float(statistic(first, second)), np.random.default_rng(seed), 1
    for _ in range(draws):
        swapped = side ^ (rng.random(number) < 0.5)[group]
        if swapped.all() or not swapped.any():
            # One side is empty: no distance, and as far as any.
            as_far += 1
            continue
        # Sums in another order differ in the last digits; a millionth of a millionth is no larger distance.
        as_far += bool(statistic(values[swapped], values[~swapped]) >= observed * (1.0 - 1e-12))
    return DistanceTest(observed, as_far / (draws + 1))
