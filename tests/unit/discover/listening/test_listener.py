"""Runs that listen: white innovations at the truth, larger ones elsewhere, and a target with the sensor undone."""

from functools import cache

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.objective import WHITE, loss
from rockref.discover.listening.listener import Job, Listener, Memory
from rockref.discover.listening.target import grid, target_of
from rockref.effects.catalogue import parse
from tests.unit.discover.synthetic import GYRO, experiment

MODEL = Model.table_3_1()
END = 0.9  # past the first main impact
LONG = Memory(0.04, 1.0, 16)


@cache
def made(effects: tuple[str, ...] = ()):
    model = MODEL.replace(effects=tuple(map(parse, effects)))
    return experiment(model, [{}, {"turned": True}], duration=1.0, noisy=True), model


def mean_losses(listener: Listener, model: Model) -> np.ndarray:
    r = listener.innovations(listener.predict([Job((model, model))], LONG), 0.05e-3)[0]
    return loss(r).mean(axis=1)


@pytest.mark.parametrize(
    "effects", [(), ("rolling_resistance",), ("gyro_misalignment", "gyro_scale"), ("clock_error",), ("gyro_drift",)]
)
def test_innovations_are_white_at_the_truth(effects):
    e, model = made(effects)
    listener = Listener(e, e.runs, END, workers=1)
    found = mean_losses(listener, model)
    # 900 innovations of a run and axis: the mean loss of white noise scatters by 0.04, and the measured noise by 4 %.
    assert np.all(np.abs(found - WHITE) < 0.2), found
    assert abs(found.mean() - WHITE) < 0.08


@pytest.mark.parametrize(
    "change",
    [{"mu_ext": 0.20}, {"K_N": 7e7}, {"delta_long": (10e-6, 40e-6, 80e-6, 70e-6)}, {"effects": (parse("gyro_scale"),)}],
)
def test_innovations_of_a_wrong_model_are_not(change):
    e, model = made()
    listener = Listener(e, e.runs, END, workers=1)
    assert mean_losses(listener, model.replace(**change)).mean() > 1.3 * WHITE


def test_a_run_that_is_left_out_shows_nothing():
    e, model = made()
    predicted = Listener(e, e.runs, END, workers=1).predict([Job((None, model))], LONG)
    assert not predicted[0, 0].any() and predicted[0, 1].any()


def test_predictions_do_not_depend_on_who_runs_beside():
    e, model = made()
    listener = Listener(e, e.runs, END, workers=1)
    other = model.replace(effects=(parse("quadratic_drag"),))
    alone = listener.predict([Job((model, None))], LONG)[0, 0]
    beside = listener.predict([Job((other, other)), Job((model, other))], LONG)[1, 0]
    assert np.array_equal(alone, beside)


def test_shorter_horizons_follow_the_same_motion():
    e, model = made()
    listener = Listener(e, e.runs, END, workers=1)
    whole = listener.predict([Job((model, model))], LONG)[0]
    part = listener.predict([Job((model, model))], LONG, horizon=0.4)[0]
    assert part.shape[1] < whole.shape[1]
    assert np.array_equal(part, whole[:, : part.shape[1]])


@pytest.mark.parametrize("rate, parts", [(1000.0, 2), (500.0, 4), (800.0, 3), (4000.0, 1)])
def test_ticks_are_whole_parts_of_a_sample(rate, parts):
    ticks = grid(rate, 1.0)
    assert ticks.interval == pytest.approx(1 / rate / parts)
    assert ticks.t[-1] > 1.0


def test_the_target_is_the_motion_behind_the_sensor():
    """A turned, scaled sensor is undone: the target of its record is that of a perfect one."""
    effects = (parse("gyro_misalignment"), parse("gyro_scale"))
    plain = experiment(MODEL, [{}], duration=0.4)
    shown = experiment(MODEL.replace(effects=effects), [{}], duration=0.4)
    ticks = grid(1000.0, 0.3)
    a, b = target_of(plain.runs[0], GYRO, (), ticks), target_of(shown.runs[0], GYRO, effects, ticks)
    # Without noise both are the same but for the rounding of the inverse filter.
    assert np.allclose(a.rates, b.rates, atol=1e-9) and np.allclose(a.turns, b.turns, atol=1e-9)
    assert a.heard.all()


def test_a_clipped_record_is_not_heard():
    e = experiment(MODEL, [{}], duration=0.6)
    limit = 0.6 * np.abs(e.runs[0].crv).max()
    clipped = parse(f"gyro_saturation:range={limit}")
    run = experiment(MODEL.replace(effects=(clipped,)), [{}], duration=0.6).runs[0]
    target = target_of(run, GYRO, (clipped,), grid(1000.0, 0.55))
    at = int(np.argmax(np.abs(e.runs[0].crv[:, 0])) * 2)
    assert target.heard[at, 0] == 0 and target.heard[0].all()
    assert target.heard[-1, 3] == 0  # the turn since the release is not known any more


def test_blocks_on_four_and_on_eight_points_run_side_by_side():
    e, model = made()
    listener = Listener(e, e.runs, END, workers=1)
    four = model.replace(points="four_points")
    alone = [listener.predict([Job((m, None))], LONG)[0, 0] for m in (model, four)]
    together = listener.predict([Job((model, None)), Job((four, None))], LONG)[:, 0]
    assert np.array_equal(together, np.stack(alone))
