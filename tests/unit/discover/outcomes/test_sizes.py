"""Size and interval of a strong candidate, where the log-likelihood is known in closed form and is no parabola."""

import numpy as np
import pytest

from rockref.discover.outcomes.candidates import CANDIDATES
from rockref.discover.outcomes.curves import Curves
from rockref.discover.outcomes.likelihood import Likelihood
from rockref.discover.outcomes.sizes import LARGEST, profile, starting
from rockref.discover.outcomes.weighing import TEMPERATURE, weighed
from rockref.model.errors import InputError

FRICTION = next(c for c in CANDIDATES if c.id == "contact_friction")
FITTED = np.array([True, True, False])


def likelihood_of(level):
    """One quantity of two fitted tests that share a level, and of a held-out one that must not matter."""
    measured = np.array([[0.5 * level, 0.5 * level, 1e3 * level]])
    return Likelihood(measured, 0 * measured, 0 * measured, np.zeros(3))


def skew(z, best, n=60.0, a=3.0):
    """The logarithm of the likelihood of n exponential waits in the logarithm of their mean, zero at its top."""
    return -n * (np.exp(a * (z - best)) - 1.0 - a * (z - best))


def found(log_p, refuse=lambda z: False):
    def at(size):
        if refuse(size / FRICTION.typical):
            raise InputError("E-STAND", "block", "falls", "Flatten it.")
        return likelihood_of(log_p(size / FRICTION.typical))

    null = likelihood_of(log_p(0.0))
    curves = Curves(null, (profile(FRICTION, null, FITTED, at),), FITTED)
    return curves, weighed(curves, 0, FITTED)


@pytest.mark.parametrize("best", [-1.0, -0.6, 1.37, -3.1])
def test_value_and_interval_are_those_of_the_posterior_though_it_is_skew(best):
    curves, said = found(lambda z: skew(z, best))
    assert 0 in curves.strong and not said.open
    z = np.linspace(best - 1.0, best + 1.0, 20001)
    density = np.exp(skew(z, best) / TEMPERATURE - 0.5 * z * z)
    order = np.argsort(-density)
    inside = z[order[: 1 + np.searchsorted(np.cumsum(density[order]), 0.9 * density.sum())]]
    # What the parabola leaves out, n (a x)^3/6, moves its top by 0.1 a x^2 where the likelihood falls by ten nats, at
    # x = 0.19: a sixth of the posterior's deviation of 0.06. As much again for sizes that lie to one side.
    for value, true in ((said.z, z[np.argmax(density)]), (said.low, inside.min()), (said.high, inside.max())):
        assert value == pytest.approx(true, abs=0.022)


def test_a_parabola_from_zero_would_be_wrong_here():
    """The seeded fault: one curve over the first sizes alone, as for a candidate that is not strong."""
    z = np.array([0.0, *starting(FRICTION)])
    level = skew(z, -0.6)
    root = 1.0 / np.sqrt(1.0 + ((level.max() - level) / 10.0) ** 2)
    c = np.polyfit(z, level, 2, w=root)
    assert abs(-c[1] / (2 * c[0]) + 0.6) > 0.022


def test_an_interval_is_not_narrower_than_the_sizes_are_apart():
    _, said = found(lambda z: skew(z, -1.0, n=1e4), refuse=lambda z: z not in starting(FRICTION))
    assert said.high - said.low >= 0.5 and said.low < -1.0 < said.high and not said.open


def test_an_interval_that_ends_with_the_sizes_says_so():
    curves, said = found(lambda z: 50.0 * z)
    assert 0 in curves.strong and curves.profiles[0].z[-1] == LARGEST and said.open and said.high == LARGEST
    curves, said = found(lambda z: 4.0 * z)
    assert not curves.strong and said.open and said.high == starting(FRICTION)[-1]


def test_what_outcomes_hardly_ask_for_gets_no_more_sizes():
    curves, said = found(lambda z: -5.0 * (z - 1.0) ** 2)
    assert curves.profiles[0].z.tolist() == sorted(starting(FRICTION)) and not said.open
    # Normal likelihood and prior: precisions of 10 / TEMPERATURE and 1.
    assert said.z == pytest.approx(5.0 / 6.0, abs=0.005)
