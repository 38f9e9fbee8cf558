"""Intervals of shares and bands of a distribution function, without assumption about its form."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rockref.model.errors import InputError
from rockref.shake.statistics.outcomes import finite

#: decided: the usual 95 %.
CONFIDENCE = 0.95


def dkw_half_width(n: int, confidence: float = CONFIDENCE) -> float:
    """Return the half width of the band that holds a whole distribution function of n independent values.

    sqrt(ln(2/delta)/(2 n)) with delta = 1 - confidence: Dvoretzky, Kiefer and Wolfowitz (1956), with the constant of
    Massart (1990), doi 10.1214/aop/1176990746. Raises InputError E-RANGE.

    >>> from rockref.shake.statistics.bands import dkw_half_width
    >>> round(dkw_half_width(100), 3)
    0.136
    """
    if n < 1 or not 0.0 < confidence < 1.0:
        raise InputError("E-RANGE", "band", f"n = {n}, confidence = {confidence}", "Give n > 0, 0 < confidence < 1.")
    return math.sqrt(math.log(2.0 / (1.0 - confidence)) / (2.0 * n))


def distribution_function(
    values: Any, confidence: float = CONFIDENCE
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return the steps of a distribution function: values in order, share at or below each, lower and upper band."""
    x = np.sort(finite(values, "values"))
    share = np.arange(1, len(x) + 1) / len(x)
    half = dkw_half_width(len(x), confidence)
    return x, share, np.maximum(share - half, 0.0), np.minimum(share + half, 1.0)


def wilson_interval(k: int, n: int, confidence: float = CONFIDENCE) -> tuple[float, float]:
    """Return the interval of a share k/n by Wilson (1927), doi 10.1080/01621459.1927.10502953.

    Raises InputError E-RANGE.
    """
    from scipy.stats import binomtest

    if not 0 <= k <= n or n < 1:
        raise InputError("E-RANGE", "share", f"is {k} of {n}", "Give 0 <= k <= n and n > 0.")
    found = binomtest(k, n).proportion_ci(confidence, method="wilson")
    return float(found.low), float(found.high)


def paired_interval(only_one: int, only_other: int, n: int, confidence: float = CONFIDENCE) -> tuple[float, float]:
    """Return the interval of a difference of two shares of the same n independent trials.

    only_one, only_other : trials in which only one side had the event, and in which only the other had it

    One trial more of either kind, among n + 2, keeps the interval from vanishing where the sides never part. Source:
    Bonett and Price, Journal of Educational and Behavioral Statistics 37 (2012), doi 10.3102/1076998611411915. Raises
    InputError E-RANGE.

    >>> from rockref.shake.statistics.bands import paired_interval
    >>> [round(end, 3) for end in paired_interval(0, 0, 200)]
    [-0.014, 0.014]
    """
    from scipy.stats import norm

    if min(only_one, only_other) < 0 or only_one + only_other > n or n < 1:
        what = f"is {only_one} less {only_other} of {n}"
        raise InputError("E-RANGE", "difference", what, "Give counts of one kind each, together at most n > 0.")
    one, other = (only_one + 1) / (n + 2), (only_other + 1) / (n + 2)
    half = float(norm.ppf(0.5 + 0.5 * confidence)) * math.sqrt((one + other - (one - other) ** 2) / (n + 2))
    return max(-1.0, one - other - half), min(1.0, one - other + half)
