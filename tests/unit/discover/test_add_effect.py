"""One more effect in a model: it is found with its size, and the error before and after is measured on both uses."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from rockref import Model
from rockref.discover import add_effect as engine
from rockref.discover.add_effect import State, earlier, spread_of
from rockref.discover.fit_store import FitStore
from rockref.effects.catalogue import parse
from rockref.model.errors import InputError
from tests.unit.discover import fakes
from tests.unit.discover.synthetic import experiment

SCALED = Model.table_3_1().replace(effects=(parse("gyro_scale:x=1.02,y=1.02,z=1.02"),))


@cache
def made():
    return experiment(SCALED, [{}, {"turned": True}, {"tilt": 0.11, "use": "holdout"}], duration=0.9, noisy=True)


def add(monkeypatch, effect, model=None, e=None, **options):
    monkeypatch.setattr(engine, "opened", lambda path: (e or made(), e or made()))
    monkeypatch.setattr("rockref.discover.fit_baseline.Search.anywhere", lambda search, h: h)
    return engine.add_effect(effect, "folder", model, workers=1, end=0.8, **options)


@pytest.fixture(scope="module")
def found():
    store = FitStore(on_disk=False)
    with pytest.MonkeyPatch.context() as patch:
        return add(patch, "gyro_scale", store=store), add(patch, "gyro_scale", store=store)


def test_the_size_that_was_put_in_comes_out_and_the_gap_to_the_noise_closes(found):
    a = found[0]
    assert a.numbers["gyro_scale.x"].value == pytest.approx(1.02, abs=0.004)
    assert a.before.effects == () and a.after.effects == ("gyro_scale",)
    # The noise is 0.05 deg/s; what the fit takes up and what a short run scatters is a tenth of it.
    assert a.gap_closed("fit") > 0.9 and a.after.fit["total"] < 0.056
    # The held-out run alone was not fitted: its innovations, in a gap of the size of the noise, scatter by twice that.
    assert a.gap_closed("holdout") > 0.6 and a.after.holdout["total"] < 0.065
    assert [e["effects"] for e in a.model.origin["history"]] == [[], ["gyro_scale"]]
    assert [e.id for e in a.model.active_effects()] == ["gyro_scale"]


def test_what_was_found_once_is_not_computed_again(found):
    first, again = found
    assert again.from_store and not first.from_store
    assert again.numbers["gyro_scale.x"].value == pytest.approx(first.numbers["gyro_scale.x"].value, abs=1e-3)
    assert again.seconds < 0.8 * first.seconds


def test_without_held_out_runs_nothing_is_said_of_them_and_no_gap_is_closed_there():
    a = fakes.addition()
    assert a.gap_closed("fit") == pytest.approx(0.9) and "holdout_deg_s" in a.after.to_dict()
    bare = replace(a, before=State((), a.before.fit, None), after=State(("quadratic_drag",), a.after.fit, None))
    assert set(bare.after.to_dict()) == {"effects", "fit_deg_s", "fit_by_axis_deg_s"}
    assert bare.gap_closed("holdout") is None and bare.to_dict()["error"]["gap_closed"]["holdout"] is None


def test_where_the_error_was_the_noise_there_was_no_gap():
    a = fakes.addition()
    assert replace(a, before=State((), fakes.errors(a.noise), None)).gap_closed("fit") is None


def test_an_effect_that_the_model_has_is_not_added_again(monkeypatch):
    with pytest.raises(InputError, match="is in the model already") as error:
        add(monkeypatch, "gyro_scale", SCALED)
    assert error.value.code == "E-EFFECT"


def test_the_history_is_that_before_the_model_s_own_state():
    history = [{"effects": []}, {"effects": ["a"]}, {"effects": ["b", "a"]}]
    model = Model.table_3_1().replace(origin={"history": history})
    assert earlier(model, ("a", "b")) == history[:2]
    assert earlier(Model.table_3_1(), ()) == []


def test_repeated_runs_differ_by_their_noise_where_nothing_else_does():
    twice = experiment(Model.table_3_1(), [{}, {}], duration=0.9, noisy=True)
    # Two records with noise of 0.05 deg/s each differ by root two of it.
    assert spread_of(twice, 0.8) == pytest.approx(np.full(3, 0.05 * np.sqrt(2)), rel=0.15)
    assert spread_of(experiment(Model.table_3_1(), [{}, {"tilt": 0.1}], duration=0.9), 0.8) is None
