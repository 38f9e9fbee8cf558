"""The gyroscope against its transfer function and its data sheet.

Then the recording chain at its limits: steps, damping, instants, refusals.
"""

import math

import numpy as np
import pytest

from rockref.effects.sensor.clock_error import ClockError
from rockref.effects.sensor.gyro_bandwidth import GyroBandwidth, natural_frequency
from rockref.effects.sensor.gyro_drift import GyroDrift
from rockref.effects.sensor.gyro_misalignment import GyroMisalignment
from rockref.effects.sensor.gyro_saturation import GyroSaturation
from rockref.effects.sensor.gyro_scale import GyroScale
from rockref.measure.gyroscope import (
    DAMPING,
    add_noise,
    expected,
    limited,
    low_pass,
    quantise,
    record,
    sample,
    sample_times,
    saturate,
)
from rockref.measure.records.release import Gyro
from rockref.model.errors import InputError
from tests.refusal import refusal, refused

STEP = 1.0 / 20000.0


def response(frequency, bandwidth, damping=DAMPING):
    """The transfer function of the data sheet at a frequency in Hz."""
    ratio = 2.0 * math.pi * frequency / natural_frequency(bandwidth, damping)
    return 1.0 / (1.0 - ratio**2 + 2j * damping * ratio)


@pytest.mark.parametrize("frequency", [10.0, 100.0, 300.0, 900.0])
def test_sines_pass_as_the_transfer_function_says(frequency):
    t = np.arange(0.0, 0.5, STEP)
    wave = np.exp(2j * np.pi * frequency * t)
    crv = np.stack((wave.real, wave.imag, 0 * t), axis=-1)
    out = low_pass(crv, STEP, 300.0)
    # After 0.1 s the start has died by exp(-133).
    late = t > 0.1
    expected = response(frequency, 300.0) * wave
    # A sine between samples is not straight: (pi f step)^2/3 of it at most.
    error = (math.pi * frequency * STEP) ** 2
    assert np.abs(out[late, 0] - expected.real[late]).max() < error
    assert np.abs(out[late, 1] - expected.imag[late]).max() < error
    assert not out[:, 2].any()


def test_step_follows_the_closed_form():
    """A step of one sample's width, seen by a second-order low-pass of damping 1/sqrt(2)."""
    t = np.arange(0.0, 0.05, STEP)
    out = low_pass((t >= 0.01)[:, None] * np.ones(3), STEP, 300.0)[:, 0]
    a = natural_frequency(300.0) / math.sqrt(2.0)
    s = np.maximum(t - 0.01 + 0.5 * STEP, 0.0)
    closed = 1.0 - np.exp(-a * s) * (np.cos(a * s) + np.sin(a * s))
    # The step is a ramp of 0.05 ms: second order in that, (omega step)^2/24.
    assert np.abs(out - closed).max() < (natural_frequency(300.0) * STEP) ** 2 / 6.0
    assert out.max() == pytest.approx(1.0 + math.exp(-math.pi), abs=1e-4)


def test_batches_are_filtered_one_by_one():
    crv = np.random.default_rng(0).standard_normal((2, 5, 400, 3))
    whole = low_pass(crv, STEP, 300.0)
    assert whole.shape == crv.shape
    assert np.array_equal(whole[1, 3], low_pass(crv[1, 3], STEP, 300.0))


@pytest.mark.parametrize("step", [1e-3, 5.1e-4, 0.0, -1e-5, math.nan])
def test_coarse_signals_are_refused(step):
    with pytest.raises(InputError, match="E-STEP]"):
        low_pass(np.zeros((10, 3)), step, 300.0)


def test_sampling_on_the_grid_takes_the_samples():
    t = np.arange(4001) / 2000.0
    crv = np.random.default_rng(0).standard_normal((2, 4001, 3))
    assert np.array_equal(sample(t, crv, np.arange(2001) / 1000.0), crv[:, ::2])


def test_record_is_the_chain_in_order():
    gyro = Gyro(sample_rate=1000.0, noise=1e-3, bandwidth=300.0, resolution=5e-4, range=0.4)
    t = np.arange(0.0, 1.0, 0.0005)
    crv = np.stack((0.6 * np.sin(9.0 * t), 0.1 * np.cos(40.0 * t), 0 * t), axis=-1)
    times, seen = record(t, crv, gyro, np.random.default_rng(5))
    smooth = low_pass(crv, 0.0005, 300.0)[::2]
    noisy = add_noise(smooth, 1e-3, np.random.default_rng(5))
    assert np.array_equal(seen, quantise(saturate(noisy, 0.4), 5e-4))
    assert np.allclose(times, t[::2], rtol=0.0, atol=1e-12)
    assert np.abs(seen).max() == pytest.approx(0.4, abs=2.5e-4)
    _, expected = record(t, crv, gyro)
    assert np.array_equal(expected, saturate(smooth, 0.4))


def test_record_with_sensor_effects_is_the_chain_in_order():
    """Misalignment, scale, low-pass, bandwidth, drift, clock, sampling, noise, stops, rounding."""
    gyro = Gyro(sample_rate=1000.0, noise=1e-2, bandwidth=300.0, resolution=5e-4, range=0.5)
    turn, scale, slow = GyroMisalignment(0.1, 0.2, 0.3), GyroScale(1.1, 0.9, 1.2), GyroBandwidth(60.0)
    drift, clock, stops = GyroDrift(0.05, rate_y=0.1), ClockError(0.99), GyroSaturation(0.4)
    t = np.arange(0.0, 1.0, 0.0005)
    crv = np.stack((0.6 * np.sin(9.0 * t), 0.5 * np.cos(40.0 * t), 0 * t), axis=-1)
    times, seen = record(t, crv, gyro, np.random.default_rng(5), [stops, clock, drift, slow, scale, turn])
    rates = low_pass(scale.sensor(t, turn.sensor(t, crv)), 0.0005, 300.0)
    for effect in (slow, drift, clock):
        rates = effect.sensor(t, rates)
    noisy = add_noise(rates[::2], 1e-2, np.random.default_rng(5))
    assert np.array_equal(seen, quantise(np.clip(noisy, -0.4, 0.4), 5e-4))
    # The stops are the last but rounding: noise does not stand on a flat top, nor does the filter round its corners.
    assert np.sum(np.abs(seen) == 0.4) > 100 and np.abs(seen).max() == 0.4
    assert len(times) == len(seen)


COARSE = "Simulate with an output rate of 2 kHz or more, then let the gyroscope sample it. [E-STEP]"


@pytest.mark.parametrize(("damping", "slack"), [(0.5, 1e-12), (1.0, 1e-5), (1.0 + 1e-5, 1e-12), (3.0, 1e-12)])
def test_ramps_are_late_by_two_dampings_over_the_natural_frequency(damping, slack):
    """Also where the poles are two in one, to a part in a hundred thousand."""
    step = 5e-5
    t = np.arange(0.0, 0.3, step)
    out = low_pass(np.stack([2.0 + t, 2.0 - t, t], axis=-1), step, 200.0, damping)
    late = t > 0.2
    delay = 2.0 * damping / natural_frequency(200.0, damping)
    for axis, line in enumerate((lambda s: 2.0 + s, lambda s: 2.0 - s, lambda s: s)):
        assert out[late, axis] == pytest.approx(line(t[late] - delay), rel=slack, abs=3e-12)


def test_twice_the_same_pole_answers_a_step_as_in_the_closed_form():
    """1 - (1 + w s) exp(-w s), s from the middle of the sample in which the step is a ramp."""
    step = 2e-5
    t = np.arange(0.0, 0.02, step)
    out = low_pass((t >= 0.002)[:, None] * np.ones(3), step, 200.0, 1.0)[:, 1]
    w = natural_frequency(200.0, 1.0)
    s = np.maximum(t - 0.002 + step / 2, 0.0)
    # Second order in the ramp of one step, and 1e-6 for the poles that are moved apart.
    assert np.abs(out - (1.0 - (1.0 + w * s) * np.exp(-w * s))).max() < (w * step) ** 2 / 6.0 + 1e-5


def test_it_starts_as_if_the_first_sample_had_been_there_for_ever():
    crv = np.random.default_rng(0).standard_normal((50, 3))
    before = np.repeat(crv[:1], 3000, axis=0)
    # After 0.3 s the start of the longer signal has died by exp(-400).
    assert low_pass(crv, 1e-4, 300.0) == pytest.approx(low_pass(np.concatenate([before, crv]), 1e-4, 300.0)[3000:])


def test_whole_numbers_and_single_precision_are_filtered_in_double():
    rates = np.arange(60).reshape(20, 3) % 7
    double = low_pass(rates.astype(float), 1e-4, 300.0)
    for given in (rates, rates.astype(np.float32), rates.tolist()):
        found = low_pass(given, 1e-4, 300.0)
        assert found.dtype == np.float64 and np.array_equal(found, double)


def test_half_a_millisecond_to_rounding_is_fine_enough():
    assert low_pass(np.ones((10, 3)), 5e-4 * (1.0 + 5e-7), 300.0) == pytest.approx(np.ones((10, 3)))
    assert low_pass(np.ones((10, 3)), 5e-4, 300.0) == pytest.approx(np.ones((10, 3)))
    error = refused(low_pass, np.ones((10, 3)), 5.1e-4, 300.0)
    assert str(error) == f"argument step: 0.00051 s between samples. {COARSE}"


def wavy(t):
    """Rates whose cubic between the samples is not a straight line."""
    return np.stack([np.sin(300.0 * t), np.cos(200.0 * t), t**2], axis=-1)


def test_a_thousandth_of_a_sample_is_the_sample_itself():
    t = 3.0 + np.arange(100) / 1000.0
    crv = wavy(t)
    rows = np.array([0, 17, 50, 99])
    for off in (-0.9e-6, 0.0, 0.9e-6):
        assert np.array_equal(sample(t, crv, t[rows] + off), crv[rows])
    # Two thousandths are another instant: 300 rad/s times 2 microseconds.
    moved = sample(t, crv, t[[17, 50]] + 2e-6)
    assert moved[:, 0] == pytest.approx(crv[[17, 50], 0] + 300.0 * np.cos(300.0 * t[[17, 50]]) * 2e-6, abs=1e-6)
    assert not np.array_equal(moved, crv[[17, 50]])


def test_one_instant_between_the_samples_makes_all_cubic():
    t = np.arange(100) / 1000.0
    crv = np.stack([t**3, t**2, t], axis=-1)
    times = np.array([0.0, 0.0105, 0.05, 0.0987])
    assert sample(t, crv, times) == pytest.approx(np.stack([times**3, times**2, times], axis=-1), abs=1e-15)
    assert sample(t, np.stack([crv, 2.0 * crv]), times)[1] == pytest.approx(2.0 * sample(t, crv, times), rel=1e-12)


def test_instants_a_thousandth_of_a_sample_outside_are_inside():
    """With others between the samples, so that the cubic is asked, which ends with the signal."""
    t = 3.0 + np.arange(100) / 1000.0
    crv = wavy(t)
    times = np.array([t[0] - 0.9e-6, t[10] + 4e-4, t[-1] + 0.9e-6])
    found = sample(t, crv, times)
    assert found[[0, 2]] == pytest.approx(crv[[0, -1]], abs=1e-12)
    for wrong in (t[0] - 1.1e-6, t[-1] + 1.1e-6):
        error = refused(sample, t, crv, np.array([wrong]))
        what = f"times {wrong:g} to {wrong:g} s are asked of a signal from 3 to 3.099 s"
        assert str(error) == f"argument times: {what}. Ask for times inside the signal. [E-TIMES]"


def test_no_instants_have_no_samples():
    assert sample(np.arange(9) / 1000.0, np.ones((2, 9, 3)), np.array([])).shape == (2, 0, 3)


def test_lists_are_sampled_as_arrays():
    assert sample([0, 1, 2], [[0, 0, 0], [2, 3, 4], [4, 6, 8]], [1, 2]).tolist() == [[2, 3, 4], [4, 6, 8]]


@pytest.mark.parametrize(
    ("start", "end", "rate", "count"),
    [
        (2.0, 3.0, 10.0, 11),
        (2.0, 2.99, 10.0, 10),
        (2.0, 3.0 - 5e-8, 10.0, 11),
        (-1.0, 1.0, 3.0, 7),
        (5.0, 5.0, 1.0, 1),
        (0.0, 0.3, 10.0, 4),
        (0.0, 0.9995, 1000.0, 1000),
    ],
)
def test_sample_times_begin_at_the_start(start, end, rate, count):
    times = sample_times(start, end, rate)
    assert times == pytest.approx(start + np.arange(count) / rate, rel=1e-15)


def test_a_signal_of_two_samples_can_be_recorded_and_one_of_one_cannot():
    gyro = Gyro(1000.0, 0.0, 300.0, 0.0)
    assert expected(np.array([1.0, 1.0005]), np.ones((2, 3)), gyro) == pytest.approx(np.ones((2, 3)))
    said = ("E-STEP", "argument t", "fewer than two samples", "Simulate for longer.")
    assert refusal(expected, np.array([1.0]), np.ones((1, 3)), gyro) == said


def test_the_low_pass_of_the_data_sheet_has_its_bandwidth_and_the_step_of_the_signal():
    gyro = Gyro(1000.0, 0.0, 80.0, 0.0)
    t = 4.0 + np.arange(201) * 2.5e-4
    crv = wavy(t)
    assert expected(t, crv, gyro) == pytest.approx(low_pass(crv, 2.5e-4, 80.0), rel=1e-9)
    times, seen = record(t, crv, gyro)
    assert times == pytest.approx(4.0 + np.arange(51) / 1000.0, rel=1e-15)
    assert seen == pytest.approx(low_pass(crv, 2.5e-4, 80.0)[::4], rel=1e-9)


def test_limits_and_steps_take_anything_that_is_an_array():
    assert saturate([3.0, -3.0, 1.0], 2.0).tolist() == [2.0, -2.0, 1.0]
    assert quantise([0.24, -0.26, 0.0], 0.5).tolist() == [0.0, -0.5, 0.0]
    assert isinstance(saturate([1.0], None), np.ndarray) and quantise([1.3], 0.0).tolist() == [1.3]
    assert isinstance(quantise([1.3], 0.0), np.ndarray)
    gyro = Gyro(1000.0, 0.0, 300.0, 0.0, range=2.0)
    assert limited(np.arange(2.0), np.array([[3.0, 0.0, -3.0]] * 2), gyro).tolist() == [[2.0, 0.0, -2.0]] * 2


def test_noise_is_that_of_its_generator():
    drawn = np.random.default_rng(5).standard_normal((4, 3))
    assert np.array_equal(add_noise(np.ones((4, 3)), 0.5, np.random.default_rng(5)), 1.0 + 0.5 * drawn)


def test_the_expected_record_is_cut_at_the_ranges_of_effects_as_well():
    t = np.arange(21) * 5e-4
    gyro = Gyro(1000.0, 0.0, 300.0, 0.0, range=2.0)
    for effects, limit in (((), 2.0), ((GyroSaturation(0.7),), 0.7)):
        assert record(t, np.full((21, 3), 3.0), gyro, effects=effects)[1] == pytest.approx(np.full((11, 3), limit))
