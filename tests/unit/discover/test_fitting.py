"""Of some starts of a fit the nearest to the runs is kept, and stands on another one that ends in the same place."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover import fitting
from rockref.discover.fit.families import Family
from rockref.discover.fit.search import SHORT, Setup, windows
from rockref.discover.windows.series import refinement
from tests.unit.discover import fakes
from tests.unit.discover.bowls import ALONE, Bowl, family


@pytest.fixture
def ends_at(monkeypatch):
    """Starts that end at given places of a bowl about zero, one after the other."""

    def prepare(*places):
        left = list(places)

        def baseline(setup, effects, begin, iterations):
            end = family(effects, Bowl(np.zeros(1)), np.array([left.pop(0)]))
            return end.fit, end.point

        def agree(fit, point, other, found):
            off = float(abs(point.z - other.z)[0])
            return SimpleNamespace(value=off, passed=off < 0.1)

        looked = []
        monkeypatch.setattr(fitting, "baseline", baseline)
        monkeypatch.setattr(fitting, "information", lambda fit, point: looked.append(float(point.z[0])) or point)
        monkeypatch.setattr(fitting, "starts_agree", agree)
        first = family((), Bowl(np.zeros(1)), np.array([left.pop(0)]))
        best, other, found = fitting.begun_again(ALONE, first, 0, lambda line: None)
        # What the runs say, which takes as long as a step of the fit, is asked once of each that was the nearest.
        assert found is best.point and len(set(looked)) == len(looked)
        return float(best.point.z[0]), float(other.point.z[0]), len(left)

    return prepare


@pytest.mark.parametrize(
    "places, kept, confirmed_by, not_begun",
    [
        pytest.param((0.10, 0.15, 9.0), 0.10, 0.15, 1, id="two agree"),
        pytest.param((0.15, 0.10, 9.0), 0.10, 0.15, 1, id="two agree, the second is nearer"),
        pytest.param((0.80, 0.10, 0.15), 0.10, 0.15, 0, id="the first had stopped in a side valley"),
        pytest.param((0.10, 0.80, 0.15), 0.10, 0.15, 0, id="the second had"),
        pytest.param((0.30, 0.60, 0.10), 0.10, 0.30, 0, id="none agree"),
    ],
)
def test_the_nearest_start_is_kept_and_the_one_that_agrees_confirms_it(ends_at, places, kept, confirmed_by, not_begun):
    assert ends_at(*places) == (kept, confirmed_by, not_begun)


@pytest.mark.parametrize("model", [None, fakes.DRAG])
def test_a_block_more_slender_than_table_3_1_is_begun_with_all_the_same(model):
    """Its baseline has a tilt of its own, which no run uses, from which such a block would fall over."""
    slender = replace(fakes.made_experiment(0.1), width=0.07)
    slender = replace(slender, runs=tuple(replace(run, release_tilt=0.08) for run in slender.runs))
    base = fitting.baseline_model(slender, model)
    assert refinement(base) == 1 and base.width == base.depth == 0.07
    assert base.active_effects() == (model.active_effects() if model else ())


@pytest.mark.parametrize("base, own", [(Model.table_3_1(), 0), (fakes.DRAG, 2)], ids=["plain", "with drag"])
def test_effects_begin_where_the_release_says_if_it_says_something_of_them(base, own):
    """Beside those of the model, of which it says nothing: they begin where the model has them."""
    setup = Setup(fakes.made_experiment(0.1), (None,), base)
    law = len(setup.parameters())
    plain, scale = np.arange(1.0, law + 1), np.arange(1.0, law + 4)
    assert len(setup.parameters(fitting.beside(setup, ()))) == law + own
    for seen, start in (
        ({"z": plain}, [*plain, *[0.0] * own]),
        ({"z": plain, "starts": {("gyro_scale",): scale}}, [*plain, *[0.0] * own, *scale[-3:]]),
        ({"z": plain, "starts": {("gyro_drift",): plain}}, None),
    ):
        found = fitting.start_of(setup, seen, ("gyro_scale",))
        assert found is None if start is None else found.tolist() == start


def test_effects_of_the_model_are_fitted_again_with_those_that_are_named():
    setup = Setup(fakes.made_experiment(0.1), (None,), fakes.DRAG)
    assert fitting.beside(setup, ("gyro_scale", "quadratic_drag")) == ("quadratic_drag", "gyro_scale")


@pytest.mark.parametrize("floor, kept", [(1.2, ("gyro_scale",)), (1.1, ())])
def test_a_suspect_is_taken_along_where_it_lowers_the_mean_loss_clearly(monkeypatch, floor, kept):
    asked = []

    def started_family(setup, effects, seen, iterations):
        asked.append((effects, iterations))
        return family(effects, Bowl(np.zeros(1), floor=1.0 if effects else floor), [0.0])

    monkeypatch.setattr(fitting, "suspects", lambda setup: (setup, [(), ("gyro_scale",)], {"z": np.zeros(1)}))
    monkeypatch.setattr(fitting, "started_family", started_family)
    assert fitting.chosen_family(Setup(fakes.made_experiment(0.1), (), Model.table_3_1(), workers=1))[1].effects == kept
    # A baseline that the release refutes gets few iterations.
    assert asked == [((), fitting.FEW), (("gyro_scale",), fitting.ITERATIONS)]


@pytest.fixture(scope="module")
def true_family():
    """The truth itself, on the windows of two runs, where each window has been let settle."""
    e = fakes.made_experiment(1.2)
    setup = Setup(e, e.fit_runs(), fakes.DRAG, end=1.2, workers=1)
    fit = setup.fit(windows(setup, SHORT))
    return e, Family((), fit, fit.relax_states(fit.begin(), 2))


@pytest.mark.parametrize("effects, check", [(None, False), ((), True)])
def test_what_a_fit_says_of_itself(monkeypatch, true_family, effects, check):
    e, found = true_family
    asked = []
    monkeypatch.setattr(fitting, "opened", lambda path: (e, e))
    monkeypatch.setattr(fitting, "chosen_family", lambda setup: (asked.append("chosen"), (setup, found))[1])
    monkeypatch.setattr(fitting, "suspects", lambda setup: (setup, [()], {"z": np.zeros(1)}))
    monkeypatch.setattr(fitting, "started_family", lambda *a: (asked.append("named"), found)[1])
    known = fitting.information(found.fit, found.point)
    monkeypatch.setattr(fitting, "begun_again", lambda *a: (asked.append("again"), (found, found, known))[1])
    fitted = fitting.fit_experiment("folder", effects, fakes.DRAG, end=1.2, workers=1, check=check)
    assert asked == (["chosen"] if effects is None else ["named", "again"])
    # Where nobody went through the gates the model says so.
    gates = {g.name: g.passed for g in fitted.gates}
    assert bool(gates) is check and gates.get("starts_agree", True)
    assert fitted.model.origin["gates_passed"] == (all(gates.values()) if check else "not checked")
    assert fitted.passed is all(gates.values())
    record = fitted.to_dict()
    assert 0.9 < record["error"]["fit"] / record["error"]["noise_floor"] < 1.5
    assert {"K_N", "mu_ext", "tilt_offset[0]"} <= set(record["parameters"])
    assert fitted.model.parameters.K_N == pytest.approx(record["parameters"]["K_N"]["value"])
