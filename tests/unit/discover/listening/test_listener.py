"""Runs that listen: white innovations at the truth, larger ones elsewhere, and a target with the sensor undone."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.objective import WHITE, loss
from rockref.discover.listening.listener import Job, Listener, Memory, noise_of
from rockref.discover.listening.target import between, grid, target_of
from rockref.discover.provenance import ZERO_OFFSETS
from rockref.effects.catalogue import parse
from rockref.effects.sensor.clock_error import ClockError
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
    "effects",
    [
        (), ("rolling_resistance",), ("gyro_misalignment", "gyro_scale"), ("clock_error",), ("gyro_drift",),
        ("clock_error:rate=1.02,growth=0.25",),
    ],
)  # fmt: skip
def test_innovations_are_white_at_the_truth(effects):
    e, model = made(effects)
    listener = Listener(e, e.runs, END, workers=1)
    found = mean_losses(listener, model)
    # 900 innovations of a run and axis: the mean loss of white noise scatters by 0.04; the model listens to the noise
    # of six samples, which shows about the height in the clatter most.
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


def test_every_other_sample_of_a_fast_record_tells_of_the_same_motion():
    e, model = made()
    listener = Listener(e, e.runs, END, workers=1)
    few = listener.thinned(500.0)
    assert listener.thinned(501.0) is listener and listener.thinned(500.0) is few
    assert few.gyro.sample_rate == 500.0 and few.N == -(-listener.N // 2)
    assert np.array_equal(few.measured, listener.measured[:, ::2]) and np.array_equal(few.sigma, listener.sigma)
    # Bounds as above; between fewer samples the rates of an impact are not told, so the longest memory is not for them.
    assert abs(np.median(mean_losses(few, model)) - WHITE) < 0.2


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
    # The record is cut 0.1 s beyond the horizon: what the low-pass remembers is below a hundredth of the noise.
    assert np.abs(part - whole[:, : part.shape[1]]).max() < 1e-2 * GYRO.noise


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
    a, b = (target_of(e.runs[0], GYRO, own, ticks, {}) for e, own in ((plain, ()), (shown, effects)))
    # Without noise both are the same but for the rounding of the inverse filter.
    assert np.allclose(a.rates, b.rates, atol=1e-9) and np.allclose(a.turns, b.turns, atol=1e-9)
    assert a.heard.all()


def test_a_clipped_record_is_not_heard():
    e = experiment(MODEL, [{}], duration=0.6)
    limit = 0.6 * np.abs(e.runs[0].crv).max()
    clipped = parse(f"gyro_saturation:range={limit}")
    run = experiment(MODEL.replace(effects=(clipped,)), [{}], duration=0.6).runs[0]
    target = target_of(run, GYRO, (clipped,), grid(1000.0, 0.55), {})
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


def test_what_is_left_of_a_zero_is_taken_off_what_the_run_listens_to_and_shown_again():
    e, model = made()
    zero = np.array([2e-4, -4e-4, 3e-4])
    shifted = replace(e, runs=tuple(replace(run, crv=run.crv + zero) for run in e.runs))
    moved = replace(model, origin={**model.origin, **dict(zip(ZERO_OFFSETS, map(float, zero), strict=True))})
    before = Listener(e, e.runs, END, workers=1).predict([Job((model, model))], LONG)
    after = Listener(shifted, shifted.runs, END, workers=1).predict([Job((moved, moved))], LONG)
    # The low-pass is undone of the shifted record: to rounding, which the impacts magnify.
    assert np.abs(after - before - zero).max() < 1e-3 * GYRO.noise


def test_rates_between_samples_are_those_of_a_band_limited_signal():
    t = np.arange(400) / 500
    signal = lambda t: np.stack([np.sin(2 * np.pi * f * t) for f in (10, 40, 80)], axis=-1)  # noqa: E731
    at = np.linspace(0.1, 0.7, 1201)
    error = np.abs(between(t, signal(t), at) - signal(at)).max(axis=0)
    straight = np.abs(np.stack([np.interp(at, t, x) for x in signal(t).T], axis=-1) - signal(at)).max(axis=0)
    # Lagrange's remainder through six samples: (2 pi f / rate)^6 max|prod(u - j)| / 6!, of which 14.1/4.
    bound = (2 * np.pi * np.array([10, 40, 80]) / 500) ** 6 * 3.52 / 720
    assert np.all(error <= bound) and np.all(error < straight / 10)
    assert np.allclose(between(t, signal(t), np.array([-1.0, 9.0])), signal(t)[[0, -1]])


def test_rates_between_rows_of_a_clock_whose_rate_moves_are_those_of_the_signal():
    """It moves by 4 % over the record, in whose middle rows lie two and a half samples beside even ones."""
    dated, tones = np.arange(500) / 500, np.array([10, 40, 80])
    t = ClockError(1.04, 1.0).true_time(dated)
    signal = lambda t: np.stack([np.sin(2 * np.pi * f * t) for f in tones], axis=-1)  # noqa: E731
    at = np.linspace(0.1, 0.9, 1201)
    error = np.abs(between(t, signal(t), at, dated) - signal(at)).max(axis=0)
    # Lagrange's remainder, as above, of tones that turn further from row to row; and a hundred thousandth of a sample.
    turn = 2 * np.pi * tones * 1.08 / 500
    assert np.all(error <= turn**6 * 3.52 / 720 + 1e-5 * turn)
    assert np.all(np.abs(between(t, signal(t), at) - signal(at)).max(axis=0) > turn)
    assert np.allclose(between(t, signal(t), np.array([-1.0, 9.0]), dated), signal(t)[[0, -1]])


def test_a_clock_of_another_rate_leaves_rows_where_they_are_among_each_other():
    """To the last bit, as if nobody had asked how they were dated; rows that were a little uneven, too."""
    rng = np.random.default_rng(3)
    dated = np.arange(500) / 500 + rng.uniform(0, 4e-5, 500)
    t, crv = ClockError(1.02).true_time(dated) - 1e-3, rng.normal(size=(500, 3))
    at = np.linspace(0.0, 1.0, 300)
    assert np.array_equal(between(t, crv, at, dated), between(t, crv, at))


def test_noise_is_the_stated_one_where_the_calmest_run_agrees():
    e, _ = made()
    true = np.hypot(GYRO.noise, GYRO.resolution / np.sqrt(12))
    assert np.all(noise_of(e.runs, GYRO) == true)
    rough = replace(e.runs[0], crv=e.runs[0].crv + np.random.default_rng(2).normal(0.0, 5 * true, e.runs[0].crv.shape))
    assert np.all(noise_of((rough, e.runs[1]), GYRO) == true)  # one run is rough, the other one tells
    # A data sheet that is wrong is not believed: the measured noise is within an eighth of the true one.
    found = noise_of(e.runs, replace(GYRO, noise=2 * GYRO.noise))
    assert np.all(np.abs(found / true - 1) < 0.125)


def test_a_slow_clock_is_followed_to_the_end_of_its_record():
    """A record of 1.2 s by a clock that is 4 % slow tells of 1.248 s."""
    told = MODEL.replace(effects=(parse("clock_error:rate=1.04"),))
    e = experiment(told, [{}], duration=1.6, noisy=True)
    listener = Listener(e, e.runs, 1.2, workers=1)
    r = listener.innovations(listener.predict([Job((told,))], LONG), 0.05e-3)[0]
    # 90 innovations of the last 30 ms: the mean loss of white noise scatters by 0.13.
    assert loss(r[:, -30:]).mean() < 1.4
