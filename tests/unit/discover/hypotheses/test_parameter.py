"""Numbers counted in prior deviations."""

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.problem import fit_problem
from rockref.discover.hypotheses.law import law_parameters, release_parameters, with_law
from rockref.discover.hypotheses.parameter import FARTHEST, Parameter, centring
from rockref.discover.listening.target import zero_offset
from rockref.discover.provenance import ZERO_OFFSETS
from rockref.effects.catalogue import parse
from tests.unit.discover.synthetic import experiment

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


def test_a_zero_that_is_uncertain_is_a_number_of_each_run():
    found = release_parameters(2, 1.4e-3, zero_uncertainty=1e-4)
    zeros = [p for p in found if p.kind in ZERO_OFFSETS]
    assert [p.run for p in zeros] == [0, 0, 0, 1, 1, 1] and all(p.moves_target for p in zeros)
    assert zero_offset(zeros[1].set(Model.table_3_1(), zeros[1].value(2.0))) == (0.0, 2e-4, 0.0)


@pytest.mark.parametrize("id", ["uneven_foot_stiffness", "uneven_foot_damping", "uneven_foot_friction"])
def test_factors_of_the_feet_count_by_their_ratios(id):
    """A common factor of all feet is a number of the law: the model is the same, and its numbers are told alike."""
    e = experiment(Model.table_3_1(), [{}], duration=0.1)
    problem = fit_problem(e, e.runs, Model.table_3_1(), end=0.1, workers=1)
    parameters = problem.parameters((id,))
    rng = np.random.default_rng(2)
    z, feet = np.zeros(len(parameters)), [k for k, p in enumerate(parameters) if p.by_ratio]
    z[feet] = rng.normal(size=4)
    more = z.copy()
    more[feet] += 0.7
    (one,), (other,) = problem.job(parameters, z).models, problem.job(parameters, more).models
    values = np.array([getattr(one.effects[0], f"foot{i}") for i in (1, 2, 3, 4)])
    assert np.prod(values) == pytest.approx(1.0)
    assert np.allclose([getattr(other.effects[0], f"foot{i}") for i in (1, 2, 3, 4)], values)
    assert np.allclose(centring(parameters) @ more, centring(parameters) @ z)


@pytest.mark.parametrize(
    "id, law", [("uneven_foot_stiffness", {"K_N", "K_T"}), ("uneven_foot_friction", {"mu_int", "mu_ext"})]
)
def test_a_common_factor_of_the_feet_is_one_of_the_law(id, law):
    p = Model.table_3_1().parameters
    factor = 1.3
    scaled = {name: factor * getattr(p, name) for name in law}
    common = ",".join(f"foot{i}={factor}" for i in (1, 2, 3, 4)) + (",tangential_share=1" if "K_T" in law else "")
    by_feet = Model.table_3_1().replace(effects=(parse(f"{id}:{common}"),))
    by_law = Model.table_3_1().replace(**scaled)
    _, feet = by_feet.body()
    _, whole = by_law.body()
    for name in ("K_N", "K_T", "mu", "mu_0"):
        assert np.allclose(getattr(feet, name), getattr(whole, name), rtol=1e-14), name
