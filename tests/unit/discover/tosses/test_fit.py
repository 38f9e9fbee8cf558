"""Fits and staircases of tosses with known truth."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover.tosses.descent import limits
from rockref.discover.tosses.errors import Errors
from rockref.discover.tosses.gates import off_bounds, paired, uses_agree
from rockref.discover.tosses.parameters import CANDIDATES, apply, effect_parameters, law_parameters
from rockref.effects import catalogue
from tests.tosses import stated


def test_every_candidate_is_absent_at_zero():
    base = stated()
    for id in CANDIDATES:
        found = effect_parameters(id)
        model = apply(base, found, np.zeros(len(found)))
        assert not model.active_effects(), id
        assert {p.name for p in found} <= {f"{id}.{key}" for key in catalogue.find(id).quantities}


def test_the_laws_numbers_are_those_of_the_model_at_zero():
    base = stated()
    model = apply(base, law_parameters(base), np.zeros(5))
    for key in ("K_N", "K_T", "C_N", "C_T", "mu", "mu_0"):
        assert np.array_equal(getattr(model.custom_points, key), getattr(base.custom_points, key))


def made_errors(position, rotation):
    return Errors(np.array(position), np.array(rotation), np.zeros((0, 0)), np.zeros((0, 0)))


def test_the_paired_interval_sees_what_is_common_to_all_tosses():
    rng = np.random.default_rng(0)
    position, rotation = rng.lognormal(size=100), rng.lognormal(size=100)
    # A fall by one on every toss is certain however much the tosses differ; the same fall on average is not.
    sure = paired(made_errors(position, rotation + 1), made_errors(position, rotation))
    assert sure["low"] == sure["high"] == pytest.approx(1.0)
    unsure = paired(made_errors(position, rng.permutation(rotation)), made_errors(position, rotation))
    assert unsure["low"] < 0 < unsure["high"]
    # Of eleven comparisons each has an interval of 99.1 %: 2.61 deviations of a mean instead of 1.64.
    of_many = paired(made_errors(position, rng.permutation(rotation)), made_errors(position, rotation), 11)
    assert of_many["interval"] == pytest.approx(0.9909, abs=1e-4)
    wider = (of_many["high"] - of_many["low"]) / (unsure["high"] - unsure["low"])
    assert wider == pytest.approx(2.61 / 1.64, rel=0.25)


def test_a_fit_that_is_better_on_its_own_tosses_alone_is_not_passed():
    rng = np.random.default_rng(1)
    position, rotation = rng.lognormal(size=(2, 200)) / 100, rng.lognormal(size=(2, 200))
    fitted = made_errors(position[0], rotation[0])
    assert uses_agree(fitted, made_errors(position[1], rotation[1]))["passed"]
    found = uses_agree(fitted, made_errors(2 * position[1], 2 * rotation[1]))
    assert not found["passed"] and found["value"] > found["limit"]


def test_a_number_at_its_bound_is_named_and_one_at_its_absence_is_not():
    fit = SimpleNamespace(parameters=effect_parameters("rounded_corners") + effect_parameters("gravity_deviation"))
    low, high = limits(fit.parameters)
    # A radius of zero is no radius: the least that it can be is where the effect is absent.
    assert low[0] == 0 and off_bounds(fit, np.array([0.0, high[1] / 2]))["passed"]
    found = off_bounds(fit, np.array([high[0], low[1]]))
    assert not found["passed"] and found["at_bounds"] == ["rounded_corners.radius", "gravity_deviation.scale"]
