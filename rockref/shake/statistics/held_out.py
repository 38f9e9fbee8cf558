"""Predictions of tests whose motion took no part in the fit."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.model.errors import InputError
from rockref.shake.statistics.binary_regression import Link, fit_binary
from rockref.shake.statistics.outcomes import motions, outcomes
from rockref.shake.statistics.scores import log_losses


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


def held_out_choice(probability: Any, fell: Any, motion: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return the probability (n,) of falling of each test by the candidate that is best for all other motions.

    Parameters
    ----------
    probability : (n, k), a column a candidate, for example a model with other numbers
    fell : (n,) outcomes;  motion : (n,) labels

    The second array (m,) holds the candidate of each held-out motion, in the order of their sorted labels. Best is
    the least log loss; of equals, the first.

    Raises InputError E-SHAPE, E-RANGE.
    """
    y = outcomes(fell)
    p = np.asarray(probability, float)
    if p.ndim != 2 or len(p) != len(y):
        raise InputError("E-SHAPE", "probability", f"has shape {p.shape}", f"Give {len(y)} rows, a column a candidate.")
    group, number = motions(motion, len(y))
    losses = log_losses(p.ravel(), np.repeat(y, p.shape[1])).reshape(p.shape)
    of_motion = np.stack([losses[group == k].sum(axis=0) for k in range(number)])
    chosen = np.argmin(of_motion.sum(axis=0) - of_motion, axis=1)
    return p[np.arange(len(y)), chosen[group]], chosen
