"""Numbers counted in prior deviations."""

import numpy as np
import pytest

from rockref import Model
from rockref.discover.hypotheses.law import law_parameters, release_parameters, with_law
from rockref.discover.hypotheses.parameter import FARTHEST, Parameter

SCALES = {
    "linear": Parameter("a", lambda m, v: m, 2.0, 0.5),
    "log": Parameter("a", lambda m, v: m, 2.0, 0.5, "log"),
    "uniform": Parameter("a", lambda m, v: m, 0.0, scale="uniform", low=-1.0, high=3.0),
    "log_uniform": Parameter("a", lambda m, v: m, 0.0, scale="log_uniform", low=0.1, high=10.0),
}


@pytest.mark.parametrize("scale", SCALES)
def test_z_of_a_value_gives_the_value(scale):
    p = SCALES[scale]
    for z in (-2.0, -0.3, 0.0, 0.7, 1.9):
        assert p.z_of(p.value(z)) == pytest.approx(z, abs=1e-9)


@pytest.mark.parametrize("scale", ["uniform", "log_uniform"])
def test_bounded_numbers_stay_inside(scale):
    p = SCALES[scale]
    assert p.low < p.value(-50.0) < p.value(50.0) < p.high
    assert (p.least, p.most) == (-FARTHEST, FARTHEST)


def test_a_flat_prior_is_flat():
    """Of standard normal z, shares of a uniform number below any value are as large as its share of the range."""
    p = SCALES["uniform"]
    from scipy.special import ndtr

    for value in (-0.5, 1.0, 2.9):
        assert ndtr(p.z_of(value)) == pytest.approx((value - p.low) / (p.high - p.low), abs=1e-9)


@pytest.mark.parametrize("mass, width, height", [(54.0, 0.1, 0.688), (1.2, 0.03, 0.2), (900.0, 0.4, 2.0)])
def test_priors_of_the_law_hold_for_any_block(mass, width, height):
    model = Model.table_3_1().replace(mass=mass, width=width, depth=width, height=height)
    for p in law_parameters(model):
        for z in (-FARTHEST, 0.0, FARTHEST):
            made = p.set(model, p.value(z))
            made.check_values()
    names = [p.name for p in law_parameters(model)]
    assert len(names) == 11 and "theta_0" not in names


def test_setting_a_number_changes_only_that_number():
    model = Model.table_3_1()
    for p in law_parameters(model):
        moved = p.set(model, p.value(1.0))
        changed = [k for k in vars(model.parameters) if getattr(moved.parameters, k) != getattr(model.parameters, k)]
        assert len(changed) == 1, (p.name, changed)


def test_each_run_has_a_tilt_and_a_roll_of_its_own():
    found = release_parameters(3, 1.4e-3)
    assert [p.run for p in found] == [0, 0, 1, 1, 2, 2]
    assert {p.kind for p in found} == {"tilt_offset", "roll_offset"}
    assert np.allclose([found[0].value(1.0), found[1].value(0.0)], [1.4e-3, 0.0])


def test_an_experiment_may_state_ranges_of_its_own():
    stated = {"mu_ext": (0.2, 0.3), "delta_long": (0.0, 5e-5), "K_T_over_K_N": (0.8, 0.9)}
    own = {p.name: (p.low, p.high) for p in law_parameters(Model.table_3_1(), stated)}
    wide = {p.name: (p.low, p.high) for p in law_parameters(Model.table_3_1())}
    assert own["mu_ext"] == (0.2, 0.3) and own["delta_long_3"] == (0.0, 5e-5) and own["K_T"] == (0.8, 0.9)
    assert own["mu_int"] == wide["mu_int"] and own["K_N"] == wide["K_N"]


def test_several_numbers_of_the_law_are_set_as_one_after_another():
    model = Model.table_3_1()
    values = {p.name: p.value(0.3) for p in law_parameters(model)}
    one_by_one = model
    for p in law_parameters(model):
        one_by_one = p.set(one_by_one, values[p.name])
    assert with_law(model, values) == one_by_one
