"""The gyroscope of the blind test: what each of its faults does to a known signal."""

import numpy as np
import pytest

from rockref.blind.simulator import recorder
from rockref.blind.simulator.world import Sensor

T = np.arange(recorder.FINE + 500) / recorder.FINE
#: Five sigma of the white noise, and half a resolution.
PLAIN = Sensor()
NOISY = 5 * PLAIN.noise + 0.5 * PLAIN.resolution


def tone(frequency):
    return np.repeat(np.sin(2 * np.pi * frequency * T)[:, None], 3, axis=1)


def recorded(rates, sensor=None, seconds=1.0):
    return recorder.record(rates, sensor or Sensor(), seconds, np.random.default_rng(0))[1]


@pytest.mark.parametrize("order", [1, 2])
def test_low_pass_halves_the_power_at_its_frequency(order):
    out = recorder.low_pass(tone(50.0), 50.0, order)[5000:10000, 0]
    # The midpoint rule warps 50 Hz at 10 kHz by (pi 50/1e4)^2/3 = 1e-4.
    assert np.sqrt(2 * np.mean(out**2)) == pytest.approx(np.sqrt(0.5), rel=1e-3)


def test_slow_motion_is_late_by_three_quarters_of_a_millisecond():
    ramp = np.repeat(T[:, None], 3, axis=1)
    late = T[5000] - recorder.low_pass(ramp, PLAIN.low_pass)[5000, 0]
    assert late == pytest.approx(np.sqrt(2) / (2 * np.pi * PLAIN.low_pass), rel=1e-6)


def test_noise_and_resolution():
    u = recorded(np.zeros((len(T), 3)))
    assert np.std(u) == pytest.approx(PLAIN.noise, rel=0.05)  # 3000 values: 1.3 %, four of those
    assert np.abs(u / PLAIN.resolution - np.round(u / PLAIN.resolution)).max() < 1e-9


def test_a_clock_that_is_slow_shows_a_higher_tone():
    u = recorded(tone(2.0), Sensor(clock=1.02))
    t = np.arange(len(u)) / 1000
    delay = np.sqrt(2) / (2 * np.pi * PLAIN.low_pass)
    expected = np.sin(2 * np.pi * 2.0 * (1.02 * t - delay))
    assert np.abs(u[50:, 0] - expected[50:]).max() < NOISY


def test_bias_drift_scale_and_mounting():
    sensor = Sensor(bias=np.array([0.02, 0, 0]), drift=np.array([0, 0.03, 0]), scale=np.array([1.1, 1, 1]))
    sensor.turn = np.array([[0, 1.0, 0], [1.0, 0, 0], [0, 0, 1.0]])
    u = recorded(np.tile([0.1, 0.2, 0.3], (len(T), 1)), sensor)
    assert u[-1] == pytest.approx([1.1 * 0.2 + 0.02, 0.1 + 0.03, 0.3], abs=NOISY)


def test_stops_are_flat():
    u = recorded(tone(2.0), Sensor(range=0.5))
    top = np.round(0.5 / PLAIN.resolution) * PLAIN.resolution
    assert u.max() == pytest.approx(top) and np.mean(np.abs(u[:, 0]) == u.max()) > 0.5


def test_lost_packets_repeat_the_ones_before():
    u = recorder._lose(np.arange(90.0).reshape(30, 3), Sensor(lost_packets=1.0, packet=10), np.random.default_rng(0))
    assert u[10:20] == pytest.approx(np.arange(90.0).reshape(30, 3)[:10])


def test_a_ringing_mount_swells_at_its_frequency_and_shows_slow_motion_as_it_is():
    u = recorded(tone(60.0), Sensor(ring_frequency=60.0, ring_gain=0.04))
    # A damping ratio of 0.02 makes 25 times of it, a quarter of a period late; 300 Hz low-pass: 1/sqrt(1 + 0.2^4).
    wanted = np.hypot(0.96, 25 * 0.04) / np.sqrt(1 + 0.2**4)
    assert np.sqrt(2 * np.mean(u[800:1000, 0] ** 2)) == pytest.approx(wanted, rel=5e-3)
    still = recorded(np.full((len(T), 3), 0.2), Sensor(ring_frequency=60.0, ring_gain=0.5))
    assert np.abs(still - 0.2).max() < NOISY


@pytest.mark.parametrize("order", [1, 2])
def test_a_slow_gyroscope_shows_less_of_a_fast_tone(order):
    u = recorded(tone(40.0), Sensor(bandwidth=40.0, bandwidth_order=order))
    assert np.sqrt(2 * np.mean(u[500:1000, 0] ** 2)) == pytest.approx(np.sqrt(0.5), rel=5e-3)


def test_a_gyroscope_that_warms_up_drifts_less_and_less():
    u = recorded(np.zeros((len(T), 3)), Sensor(drift=np.array([0.3, 0, 0]), warm_up=0.25))
    for row in (250, 1000):
        assert u[row, 0] == pytest.approx(0.3 * (1 - np.exp(-row / 250)), abs=NOISY)


def test_a_record_of_late_packets_shows_what_was_one_packet_before():
    ramp = np.repeat(T[:, None], 3, axis=1)
    late = recorded(ramp, Sensor(lost_packets=1.0, packet=10)) - recorded(ramp)
    # Ten rows of a millisecond each, but for the first packet, which has none before it.
    assert late[:10] == pytest.approx(np.zeros((10, 3)), abs=2 * NOISY)
    assert late[10:1000] == pytest.approx(np.full((990, 3), -0.01), abs=2 * NOISY)


def test_packets_that_come_in_time_are_kept():
    u = np.arange(3000.0).reshape(1000, 3)
    found = recorder._lose(u, Sensor(lost_packets=0.3, packet=10), np.random.default_rng(3))
    lost = [k for k in range(100) if np.array_equal(found[10 * k : 10 * k + 10], u[10 * k : 10 * k + 10] - 30)]
    kept = [k for k in range(100) if np.array_equal(found[10 * k : 10 * k + 10], u[10 * k : 10 * k + 10])]
    assert sorted(lost + kept) == list(range(100)) and 15 < len(lost) < 45
