"""Predictions of tests whose motion took no part in the fit."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.shake.statistics.binary_regression import Link, fit_binary
from rockref.shake.statistics.outcomes import motions, outcomes


def held_out_regression(features: Any, fell: Any, motion: Any, link: Link = "logit") -> np.ndarray:
    """Return the probability (n,) of falling of each test, fitted to the tests of all other motions.

    features : (n, k) columns beside the constant, for example logarithms of PGA and PGV/PGA
    fell : (n,) outcomes;  motion : (n,) labels

    Raises InputError E-SHAPE, E-RANGE, E-RANK.
    """
    y = outcomes(fell)
    design = np.column_stack([np.ones(len(y)), np.asarray(features, float)])
    group, number = motions(motion, len(y))
    probability = np.empty(len(y))
    for k in range(number):
        out = group == k
        probability[out] = fit_binary(design[~out], y[~out], link).probability(design[out])
    return probability
