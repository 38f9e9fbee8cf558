"""Fragility: how the probability of falling rises with the size of a motion."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.model.errors import InputError
from rockref.shake.statistics.binary_regression import BinaryRegression, Link, fit_binary
from rockref.shake.statistics.outcomes import finite, outcomes


@dataclass(frozen=True)
class Fragility:
    """P(fell | x) = H((ln x - ln theta)/beta): theta the median capacity in the unit of x, beta its scatter."""

    theta: float
    beta: float
    regression: BinaryRegression

    def probability(self, x: Any) -> np.ndarray:
        """Return the probability of falling at sizes x (n,), in the unit of theta."""
        return self.regression.probability(_design(x))

    def interval(self, x: Any, confidence: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
        """Return lower and upper probability at sizes x (n,); tests are taken as independent."""
        return self.regression.interval(_design(x), confidence)


def fit_fragility(x: Any, fell: Any, link: Link = "probit") -> Fragility:
    """Fit a lognormal (probit) or log-logistic (logit) fragility with Jeffreys' prior.

    Without the prior a handful of outcomes gives a step of infinite likelihood. Where falls do not become more
    frequent with x, beta comes out negative or large: the fit says so and nobody corrects it.

    Parameters
    ----------
    x : (n,) size of each motion, positive, in any unit (of PGA, PGV ...)
    fell : (n,) outcomes, 0 or 1

    Raises InputError E-SHAPE, E-RANGE, E-RANK.

    Source: Lallemant, Kiremidjian and Burton, Earthquake Engineering and Structural Dynamics 44 (2015), doi
    10.1002/eqe.2522, for the lognormal form; Firth (1993) for the prior.
    """
    regression = fit_binary(_design(x), fell, link)
    constant, slope = regression.coefficients
    beta = 1.0 / slope if slope else math.inf
    with np.errstate(over="ignore"):  # where falls do not depend on x, the median may lie beyond all numbers
        theta = float(np.exp(-constant * beta))
    return Fragility(theta, beta, regression)


def _design(x: Any) -> np.ndarray:
    sizes = finite(x, "size of the motion")
    if sizes.min() <= 0.0:
        raise InputError("E-RANGE", "size of the motion", f"is {sizes.min():g}", "Give positive sizes.")
    return np.column_stack([np.ones(len(sizes)), np.log(sizes)])


def monotone_curve(x: Any, fell: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return sizes in order (m,) and the rising probabilities (m,) of the largest likelihood, without any form.

    Pool adjacent violators: Ayer et al., Annals of Mathematical Statistics 26 (1955), doi 10.1214/aoms/1177728423.
    Tests of equal size count as one group. Raises InputError E-SHAPE, E-RANGE.
    """
    from scipy.optimize import isotonic_regression

    sizes, y = finite(x, "size of the motion"), outcomes(fell)
    if len(sizes) != len(y):
        raise InputError("E-SHAPE", "size of the motion", f"has {len(sizes)} values", f"Give {len(y)}, one a test.")
    levels, group, count = np.unique(sizes, return_inverse=True, return_counts=True)
    share = np.bincount(group, weights=y) / count
    return levels, isotonic_regression(share, weights=count).x
