"""How many tests a campaign needs before one probability of falling is told from another."""

from __future__ import annotations

import math

from rockref.model.errors import InputError


def sample_size(p_a: float, p_b: float, *, power: float = 0.8, confidence: float = 0.95) -> int:
    """Return the independent tests a side that tell two probabilities apart, by the normal formula, rounded up.

    n = [z sqrt(2 q (1 - q)) + z' sqrt(p_a (1 - p_a) + p_b (1 - p_b))]^2/(p_a - p_b)^2, q the mean, z two-sided.
    Source: Fleiss, Levin and Paik, Statistical Methods for Rates and Proportions (2003), equation 4.14, doi
    10.1002/0471445428. Tests of one motion are not independent: count motions where they decide. Raises InputError
    E-RANGE.

    >>> from rockref.shake.statistics.campaign import sample_size
    >>> sample_size(0.5, 0.6)
    388
    """
    from scipy.stats import norm

    if not (0.0 < p_a < 1.0 and 0.0 < p_b < 1.0 and p_a != p_b):
        raise InputError("E-RANGE", "probabilities", f"are {p_a} and {p_b}", "Give two different ones between 0 and 1.")
    middle = 0.5 * (p_a + p_b)
    under_equal = norm.ppf(0.5 + 0.5 * confidence) * math.sqrt(2.0 * middle * (1.0 - middle))
    under_other = norm.ppf(power) * math.sqrt(p_a * (1.0 - p_a) + p_b * (1.0 - p_b))
    return math.ceil((under_equal + under_other) ** 2 / (p_a - p_b) ** 2)


def rough_sample_size(p: float, difference: float) -> int:
    """Return 16 p (1 - p)/d^2, the rule of thumb for 80 % power at 95 % (Lehr, doi 10.1002/sim.4780110811).

    >>> from rockref.shake.statistics.campaign import rough_sample_size
    >>> rough_sample_size(0.5, 0.1)
    400
    """
    if not 0.0 < p < 1.0 or not difference:
        raise InputError("E-RANGE", "probability", f"is {p}, difference {difference}", "Give 0 < p < 1 and d not 0.")
    return math.ceil(round(16.0 * p * (1.0 - p) / difference**2, 9))


def least_difference(p: float, n: int) -> float:
    """Return the difference that n tests a side see beside p, by the same rule of thumb: 4 sqrt(p (1 - p)/n)."""
    if not 0.0 < p < 1.0 or n < 1:
        raise InputError("E-RANGE", "probability", f"is {p}, tests {n}", "Give 0 < p < 1 and n > 0.")
    return 4.0 * math.sqrt(p * (1.0 - p) / n)
