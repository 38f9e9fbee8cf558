"""What the factors of all feet have in common goes to the baseline: the same feet, nearer to what was expected."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.baseline import baseline_parameters
from rockref.discover.fit.common_factor import COMMON, EXACTLY, directions, shared_out
from rockref.discover.fit.least_squares import Fit
from rockref.discover.hypotheses.candidates import parameters_of
from rockref.effects import catalogue

WINDOWS, SAMPLES = 3, 4


class Records:
    """Windows whose misfit follows one number of the feet, pulled towards what it is in `truth`, or nothing at all."""

    B, runs, rate = WINDOWS, [SimpleNamespace(release_tilt=0.1)], 1000.0
    time, run_of, first = np.zeros(WINDOWS), np.zeros(WINDOWS, int), np.ones(WINDOWS, bool)
    length, count = np.full(WINDOWS, SAMPLES), np.full(WINDOWS, 3 * SAMPLES)

    def __init__(self, key: str | None = None, truth: float = 0.0):
        self.key, self.truth = key, truth

    def residual(self, models, tilt, corrections, which=None, upto=None):
        off = 1e3 * (getattr(models[0].parameters, self.key) - self.truth) if self.key else 0.0
        return np.full((WINDOWS, SAMPLES, 3), off)

    def pieces(self, which=None, beyond=0):
        return [(slice(None), SAMPLES)]


def a_fit(effect: str, records: Records, model: Model | None = None) -> Fit:
    """Baseline and effect over records that say little."""
    model = model or Model.table_3_1()
    return Fit(records, model, (*baseline_parameters(model, 1, 0.0014), *parameters_of(catalogue.find(effect), 1)))


def away(fit: Fit, effect: str) -> np.ndarray:
    """Four factors that differ and are all too large, while the baseline makes up for a part of it."""
    z = np.zeros(len(fit.parameters))
    names = [p.name for p in fit.parameters]
    z[[names.index(f"{effect}.foot{i}") for i in (1, 2, 3, 4)]] = 2.2, 4.3, 0.4, 1.0
    z[[names.index(name) for name in COMMON[effect]]] = -2.0
    return z


def of_points(fit: Fit, z: np.ndarray) -> dict[str, np.ndarray]:
    """Stiffness, damping and friction of the contact points at z."""
    _, points = fit.models(z)[0][0].body()
    return {key: getattr(points, key) for key in ("K_N", "K_T", "C_N", "C_T", "mu_0", "mu")}


@pytest.mark.parametrize("effect", EXACTLY)
def test_the_feet_stay_what_they_are(effect):
    fit = a_fit(effect, Records())
    z = away(fit, effect)
    (way,) = directions(fit.parameters)
    before, after = of_points(fit, z), of_points(fit, z + 0.3 * way)
    for key in before:
        np.testing.assert_allclose(after[key], before[key], rtol=1e-13, err_msg=key)  # a product of three, rounded


@pytest.mark.parametrize("effect", EXACTLY)
def test_priors_tell_what_runs_do_not(effect):
    """Where no window sees the common factor, the penalty is least along it, and the factors keep their ratios."""
    fit = a_fit(effect, Records())
    z = away(fit, effect)
    before = fit.point(z, np.zeros((WINDOWS, 5)))[0]
    after = shared_out(fit, before)
    (way,) = directions(fit.parameters)
    assert after.objective < before.objective - 1
    assert way @ (after.z / fit.prior**2) == pytest.approx(0, abs=1e-9)  # z and way are of the order of ten
    feet = [i for i, p in enumerate(fit.parameters) if p.name.startswith(f"{effect}.foot")]
    np.testing.assert_allclose(np.diff(after.z[feet]), np.diff(z[feet]), rtol=1e-12)


def test_records_that_tell_are_heard():
    """Where the windows see a number of the baseline themselves, it stays."""
    model = Model.table_3_1()
    fit = a_fit("uneven_foot_friction", Records("mu_ext", model.parameters.mu_ext * np.exp(-0.3)))
    before = fit.point(away(fit, "uneven_foot_friction"), np.zeros((WINDOWS, 5)))[0]
    assert shared_out(fit, before) is before


def test_on_four_points_the_outer_ones_make_up_for_it():
    model = Model.four_points()
    fit = a_fit("uneven_foot_damping", Records(), model)
    (way,) = directions(fit.parameters)
    moved = {p.name for p, w in zip(fit.parameters, way, strict=True) if w}
    assert moved == {"beta_ext", *(f"uneven_foot_damping.foot{i}" for i in (1, 2, 3, 4))}


@pytest.mark.parametrize("effect", ["quadratic_drag", "rounded_feet", "uneven_foot_stiffness"])
def test_other_effects_have_nothing_in_common_with_the_baseline(effect):
    fit = a_fit(effect, Records())
    assert directions(fit.parameters) == []
    point = fit.begin()
    assert shared_out(fit, point) is point


def test_what_a_model_states_does_not_make_up_for_anything():
    """Factors of friction on feet whose friction is stated mean what they say."""
    parameters = [p for p in a_fit("uneven_foot_friction", Records()).parameters if not p.name.startswith("mu_")]
    assert directions(parameters) == []
