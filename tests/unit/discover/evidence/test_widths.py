"""Widths of numbers, where the answer is known."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover.evidence import widths
from rockref.discover.fit.directions import Spread
from rockref.discover.fit.fitter import FittedModel


@pytest.fixture
def straight():
    """A model that is linear in two numbers, with innovations of a given noise."""
    rng = np.random.default_rng(3)
    J = rng.standard_normal((2, 1, 4000, 3))
    listener = SimpleNamespace(gyro=SimpleNamespace(sample_rate=1000.0))
    problem = SimpleNamespace(time_scale=1.0, listener=listener)

    def polish(h, stage, most):
        h.spread = Spread(np.eye(2), J, h.r)

    numbers = [SimpleNamespace(effect="", by_ratio=False)] * 2
    fitter = SimpleNamespace(problem=problem, polish=polish, parameters=lambda h: numbers)

    def deviations(noise, temperature):
        h = FittedModel((), np.zeros(2), r=noise * rng.standard_normal(J.shape[1:]))
        return widths.deviations(fitter, h, None, temperature)[0]

    return deviations


def test_white_innovations_of_a_right_model_have_the_classical_width(straight):
    # 12000 values of size one; forty blocks tell a width to a ninth, and the robust weight of white noise is 0.93.
    assert straight(1.0, 1.0) == pytest.approx(1 / np.sqrt(12000), rel=0.35)


def test_the_temperature_widens(straight):
    assert straight(0.5, 18.0) == pytest.approx(np.sqrt(18 / 12000), rel=0.05)


def test_innovations_that_are_larger_than_noise_widen(straight):
    assert np.all(straight(3.0, 1.0) > 1.8 / np.sqrt(12000))
