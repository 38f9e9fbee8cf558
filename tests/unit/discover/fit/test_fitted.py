"""A fit as a model: what stands in the file, and what belongs to one run only."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.baseline import baseline_parameters
from rockref.discover.fit.errors import STRETCHES, errors_of, stretch_of
from rockref.discover.fit.fitted import estimates, fitted_model, in_file_order, origin_of
from rockref.discover.fit.gates import off_bounds, other_start, step_small
from rockref.discover.fit.least_squares import Fit
from rockref.discover.hypotheses.candidates import parameters_of
from rockref.discover.windows.series import series
from rockref.effects import catalogue
from tests.unit.discover.synthetic import experiment

TABLE = Model.table_3_1()


@pytest.fixture(scope="module")
def fit():
    """The truth itself, on the windows of two noisy runs of Table 3.1."""
    e = experiment(TABLE, [{}, {"tilt": 0.105}], duration=1.2, noisy=True)
    windows = series(e, e.fit_runs(), 0.05, 0.09, 1.2)
    made = Fit(windows, TABLE, baseline_parameters(TABLE, 2, 0.0014))
    return e, made, made.relax_states(made.begin(), 2)


def test_truth_has_the_error_of_the_noise(fit):
    _, made, point = fit
    seen = errors_of(made, point)
    # Restarted windows follow a model that is right; the worst tenth is left out, five corrections a window are fitted.
    assert 0.9 * seen.noise < seen.total < 1.15 * seen.noise
    assert set(stretch_of(made)) == set(STRETCHES)
    assert np.nanmax(seen.table[:, :2]) < 1.15 * seen.noise
    # About the longitudinal axis the clatter is stiffest: two relaxations leave some windows half a sample off.
    assert np.nanmax(seen.table[:, 2]) < 2.0 * seen.noise


def test_half_the_step_changes_little(fit):
    _, made, point = fit
    gate = step_small(made, point)
    assert gate.passed and 0 < gate.value < gate.limit
    assert made.series.refine == 1


def test_a_parameter_at_its_bound_is_named(fit):
    _, made, point = fit
    assert off_bounds(made, point).passed
    far = type(point)(point.z.copy(), point.corrections, point.loss)
    far.z[3] = -3.5
    gate = off_bounds(made, far)
    assert not gate.passed and made.parameters[3].name in gate.sentence and gate.value == 3.5


def test_the_form_of_a_law_has_no_bound():
    """All of the way from one form to the other is ten deviations of its price."""
    parameters = parameters_of(catalogue.find("lingering_wire_pull"), 2)
    made = SimpleNamespace(parameters=parameters, prior=np.array([p.prior for p in parameters]))
    at = {"lingering_wire_pull.force": 2.0, "lingering_wire_pull.evenness": 1.0, "lingering_wire_pull.tau": 0.5}
    gate = off_bounds(made, SimpleNamespace(z=np.array([at[p.name] for p in parameters])))
    assert gate.passed and gate.value == pytest.approx(2.0 / 3.0) and "force" in gate.sentence


def test_another_start_moves_what_is_shared_only(fit):
    _, made, point = fit
    other = other_start(made.parameters, point.z, 1)
    shared = np.array([p.run is None for p in made.parameters])
    assert np.all(other[shared] != point.z[shared])
    np.testing.assert_array_equal(other[~shared], point.z[~shared])
    np.testing.assert_array_equal(other, other_start(made.parameters, point.z, 1))


def test_model_and_its_file(fit, tmp_path):
    e, made, point = fit
    point = type(point)(point.z.copy(), point.corrections, point.loss)
    point.z[:] = 0.3
    found = in_file_order(estimates(made, point, 0.01 * np.eye(len(point.z))))
    model = fitted_model(
        made, point, found, origin_of(e, 4, "rockref fit") | {"history": [{"effects": [], "fit_deg_s": 0.1}]}
    )
    model.save(tmp_path / "m.toml")
    back = Model.load(tmp_path / "m.toml")
    assert back.parameters == model.parameters
    assert back.parameters.K_N == pytest.approx(TABLE.parameters.K_N * np.exp(0.15 * 0.3))
    u = back.uncertainty["K_N"]
    assert u["low"] < back.parameters.K_N < u["high"] and u["unit"] == "N/m"
    # The tilt of one release is a note about the run: it is neither a property of the block nor part of the model.
    assert not [name for name in back.uncertainty if "tilt" in name] and "tilt_offset" not in back.origin
    assert back.origin["seed"] == 4 and back.origin["versions"]["experiment"] == e.digest
    assert back.origin["history"][0]["fit_deg_s"] == 0.1
    assert found[-1].of_run == 1 and not found[0].of_effect
