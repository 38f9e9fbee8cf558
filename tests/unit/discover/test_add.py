"""One more effect in a model: how it is begun, what its state holds, and how much of the gap it closes."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover import add as adding
from rockref.discover.add import State, earlier, with_one_more, with_tone
from rockref.discover.fit.search import Setup
from rockref.effects.catalogue import parse
from rockref.model.errors import InputError
from tests.unit.discover import fakes
from tests.unit.discover.bowls import Bowl, family

TABLE = Model.table_3_1()
SHAKING = parse("base_vibration:amplitude=0.1,frequency=12.5")


def test_without_held_out_runs_nothing_is_said_of_them_and_no_gap_is_closed_there():
    a = fakes.addition()
    assert a.closed("fit") == pytest.approx(0.9) and "holdout_deg_s" in a.after.to_dict()
    bare = replace(a, before=State((), a.before.fit, None), after=State(("quadratic_drag",), a.after.fit, None))
    assert set(bare.after.to_dict()) == {"effects", "fit_deg_s", "fit_by_stretch_deg_s"}
    assert bare.closed("holdout") is None and bare.to_dict()["error"]["gap_closed"]["holdout"] is None


def test_where_the_error_was_the_noise_there_was_no_gap():
    a = fakes.addition()
    assert replace(a, before=State((), fakes.errors(0.1, a.noise), None)).closed("fit") is None


def test_an_effect_that_the_model_has_is_not_added_again(monkeypatch):
    monkeypatch.setattr(adding, "opened", lambda path: (fakes.made_experiment(0.1), None))
    model = TABLE.replace(effects=(parse("quadratic_drag:c=0.4"),))
    with pytest.raises(InputError, match="is in the model already") as error:
        adding.add("quadratic_drag", "folder", model)
    assert error.value.code == "E-EFFECT"


def setup_of(base=TABLE):
    return Setup(None, (), base, workers=1)


def test_the_frequency_of_a_shaking_base_is_the_model_s_own():
    plain = setup_of()
    assert with_tone(plain, ("quadratic_drag",)) is plain
    shaken = setup_of(TABLE.replace(effects=(parse("quadratic_drag:c=0.4"), SHAKING)))
    assert with_tone(shaken, ("base_vibration",)).frequency == 12.5


def test_without_one_in_the_model_it_is_that_of_the_strongest_tone_of_the_plain_baseline(monkeypatch):
    asked = []

    def release_fit(setup):
        asked.append(setup.base.effects)
        return "fit", "point"

    monkeypatch.setattr(adding, "release_fit", release_fit)
    monkeypatch.setattr(adding, "tone", lambda fit, point: (17.3, 40.0))
    setup = setup_of(TABLE.replace(effects=(parse("quadratic_drag:c=0.4"),)))
    assert with_tone(setup, ("quadratic_drag", "base_vibration")).frequency == 17.3
    assert asked == [()]


@pytest.fixture
def begun(monkeypatch):
    """Fits that are bowls about 0.4; where each began comes back."""
    asked = SimpleNamespace(sensors=[], baselines=[], screened=[])

    def end(effects, z):
        return family(effects, Bowl(np.full(len(z), 0.4)), z)

    def started_family(setup, effects, seen, iterations):
        asked.sensors.append((effects, list(seen)))
        return end(effects, seen)

    def baseline(setup, effects, z, iterations):
        asked.baselines.append((effects, list(z), setup.base.effects))
        found = end(effects, z)
        return found.fit, found.point

    def screen(fit, point, kinds, setup, effects):
        asked.screened.append((tuple(kind.id for kind in kinds), effects))
        return [end((*effects, kinds[0].id), np.array([0.1]))]  # no better step along the effect

    monkeypatch.setattr(adding, "started_family", started_family)
    monkeypatch.setattr(adding, "baseline", baseline)
    monkeypatch.setattr(adding, "screen", screen)
    monkeypatch.setattr(adding, "release_fit", lambda setup, effects, iterations: (None, SimpleNamespace(z=[0.2, 0.9])))
    monkeypatch.setattr(adding, "afresh", lambda setup, family: family)
    monkeypatch.setattr(adding, "resized", lambda setup, family, seed: family)
    return asked


def before():
    found = family((), Bowl(np.zeros(1)), [0.1])
    found.fit.base = TABLE
    return found


def test_an_error_of_a_sensor_begins_where_the_release_says(begun):
    found = with_one_more(setup_of(), before(), "gyro_scale", 0)
    assert begun.sensors == [(("gyro_scale",), [0.2, 0.9])] and begun.screened == begun.baselines == []
    assert found.effects == ("gyro_scale",) and found.point.z == pytest.approx([0.4, 0.4], abs=0.01)


def test_a_load_begins_where_a_step_led_and_absent_where_none_did(begun, monkeypatch):
    monkeypatch.setattr(Bowl, "parameters", property(lambda self: ("K_N", "rolling_resistance.lever")))
    found = with_one_more(setup_of(TABLE.replace(effects=(SHAKING,))), before(), "rolling_resistance", 0)
    assert begun.screened == [(("rolling_resistance",), ())] and begun.sensors == []
    # The model before, its own effects in it, is what windows are restarted with; the effect begins at nothing.
    assert begun.baselines == [(("rolling_resistance",), [0.1, 0.0], ())]
    assert found.effects == ("rolling_resistance",) and found.point.z == pytest.approx([0.4, 0.4], abs=0.01)


def test_the_history_is_that_before_the_model_s_own_state():
    history = [{"effects": []}, {"effects": ["a"]}, {"effects": ["b", "a"]}]
    model = TABLE.replace(origin={"history": history})
    assert earlier(model, ("a", "b")) == history[:2]
    assert earlier(TABLE, ()) == []


def test_states_are_measured_on_both_kinds_of_runs(monkeypatch):
    found = family(("quadratic_drag",), Bowl(np.zeros(1)), [0.1])
    model = object()
    found.fit.models = lambda z: [[model]]
    monkeypatch.setattr(adding, "errors_of", lambda fit, point: ("fit", fit is found.fit))
    monkeypatch.setattr(adding, "holdout_errors", lambda setup, m, effects: (m is model, effects))
    state = adding.state_of(setup_of(), found)
    assert state == State(("quadratic_drag",), ("fit", True), (True, ("quadratic_drag",)))
    assert len(adding.cell_names()) == 9
