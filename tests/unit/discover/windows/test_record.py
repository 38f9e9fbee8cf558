"""Records of windows held to the gyroscope of the measuring side."""

import numpy as np
import pytest

from rockref import InputError, Model
from rockref.discover.hypotheses.candidates import parameters_of
from rockref.discover.windows.record import filter_coefficients, records
from rockref.discover.windows.series import Sensor, sensor_of
from rockref.effects.sensor.gyro_bandwidth import GyroBandwidth
from rockref.effects.sensor.gyro_drift import GyroDrift
from rockref.effects.sensor.gyro_misalignment import GyroMisalignment
from rockref.effects.sensor.gyro_saturation import GyroSaturation
from rockref.effects.sensor.gyro_scale import GyroScale
from rockref.engines.compiled.columns import STATE, W_
from rockref.measure.experiment import Gyro
from rockref.measure.gyroscope import low_pass, record

RATE, PER, N = 1000.0, 2, 60
STEP = 1 / RATE / PER


def rates(seed: int, rows: int = N * PER + 1) -> np.ndarray:
    """Smooth rates (rows, 3) rad/s."""
    rng = np.random.default_rng(seed)
    t = np.arange(rows) * STEP
    return sum(rng.normal(size=3) * np.sin(2 * np.pi * f * t + f)[:, None] for f in (7.0, 31.0, 90.0))


def states(*windows: np.ndarray) -> np.ndarray:
    out = np.zeros((len(windows), len(windows[0]), STATE))
    out[:, :, W_ : W_ + 3] = np.stack(windows)
    return out


def seen(rows, *, matrix=None, slow=None, follows=None, start=None, bias=0.0, drift=0.0, limit=np.inf, softness=0.0):
    B = len(rows)
    return records(
        rows, np.eye(3) if matrix is None else matrix, filter_coefficients(STEP, 300.0), slow,
        np.zeros(B, bool) if follows is None else follows, np.full(B, N), N, PER,
        np.zeros(B) if start is None else start, 1 / RATE, np.full(3, bias), np.full(3, drift), limit, softness,
    )  # fmt: skip


def test_a_window_is_what_the_gyroscope_shows():
    w = rates(1)
    # The same recursion in another order of additions: rounding of some hundred steps.
    np.testing.assert_allclose(seen(states(w))[0], low_pass(w, STEP, 300.0)[: N * PER : PER], atol=1e-11)


def test_scale_and_misalignment_come_before_the_filter_bias_and_drift_after():
    w, A = rates(2), np.array([[1.02, 0.01, 0.0], [-0.01, 0.97, 0.03], [0.0, -0.03, 1.1]])
    t = 0.5 + np.arange(N) / RATE
    expected = low_pass(w @ A.T, STEP, 300.0)[: N * PER : PER] + 0.02 + 0.3 * t[:, None]
    found = seen(states(w), matrix=A, start=np.array([0.5]), bias=0.02, drift=0.3)[0]
    np.testing.assert_allclose(found, expected, atol=1e-11)


def test_saturation_is_the_last_thing():
    found = seen(states(rates(3)), limit=0.4)
    free = seen(states(rates(3)))
    assert np.abs(free).max() > 0.4
    np.testing.assert_array_equal(found, np.clip(free, -0.4, 0.4))


@pytest.mark.parametrize("softness", [0.3, 1.0])
def test_soft_stops_are_those_of_the_effect(softness):
    free, found = seen(states(rates(3))), seen(states(rates(3)), limit=0.4, softness=softness)
    # The same formula, compiled.
    np.testing.assert_allclose(found, GyroSaturation(0.4, softness).sensor(None, free), rtol=1e-14)
    np.testing.assert_array_equal(seen(states(rates(3)), softness=softness), free)


def test_a_slow_filter_runs_on_over_windows_that_follow():
    w = rates(4, 2 * N * PER + 1)
    slow = filter_coefficients(STEP, 25.0)
    halves = states(w[: N * PER + 1], w[N * PER :])
    joined = seen(halves, slow=slow, follows=np.array([False, True]))
    apart = seen(halves, slow=slow, follows=np.array([False, False]))
    whole = low_pass(low_pass(w, STEP, 300.0), STEP, 25.0)[: 2 * N * PER : PER]
    np.testing.assert_allclose(joined[0], whole[:N], atol=1e-11)
    # The fast filter settles anew (some 3 ms); after that the joined slow one goes on as if nothing had been cut.
    error = np.abs(joined[1] - whole[N:])[10:].max()
    assert error < 0.2 * np.abs(apart[1] - whole[N:])[10:].max()


def test_a_lost_number_does_not_spread_beyond_its_window():
    w = rates(5)
    bad = w.copy()
    bad[20:] = np.nan
    both = seen(states(bad, w))
    assert np.isfinite(both).all() and np.abs(both[0]).max() > 100.0
    np.testing.assert_array_equal(both[1], seen(states(w))[0])


@pytest.mark.parametrize("length", [10, N])
def test_nothing_stands_beyond_the_length_of_a_window(length):
    out = records(
        states(rates(6)), np.eye(3), filter_coefficients(STEP, 300.0), None, np.zeros(1, bool), np.array([length]),
        N, PER, np.zeros(1), 1 / RATE, np.zeros(3), np.zeros(3), np.inf,
    )  # fmt: skip
    assert np.all(out[0, length:] == 0.0) and np.all(np.any(out[0, 1:length] != 0.0, axis=1))


def test_a_window_is_what_the_measured_channel_makes_of_it():
    """All that a sensor may do but its clock, which windows have in their step: held to `gyroscope.record`."""
    w, t = rates(7), np.arange(N * PER + 1) * STEP
    sensor = Sensor(
        turn=np.array([0.1, -0.2, 0.05]), skew=np.array([0.01, -0.02, 0.03]), scale=np.array([1.02, 0.97, 1.1]),
        bias=np.array([0.02, -0.01, 0.03]), drift=np.array([0.3, 0.1, -0.2]), bandwidth=60.0, range=1.2,
    )  # fmt: skip
    effects = (
        GyroMisalignment(*sensor.turn, *sensor.skew), GyroScale(*sensor.scale), GyroBandwidth(sensor.bandwidth),
        GyroDrift(*sensor.bias, *sensor.drift), GyroSaturation(sensor.range),
    )  # fmt: skip
    _, expected = record(t, w, Gyro(RATE, 0.0, 300.0, 0.0), effects=effects)
    found = records(
        states(w), sensor.matrix(), filter_coefficients(STEP, 300.0), filter_coefficients(STEP, 60.0),
        np.zeros(1, bool), np.full(1, N), N, PER, np.zeros(1), 1 / RATE, sensor.bias, sensor.drift, sensor.range,
    )  # fmt: skip
    assert np.abs(expected).max() == 1.2
    # The two filters settle on the first rate one after the other, here and there: rounding of some hundred steps.
    np.testing.assert_allclose(found[0], expected[:N], atol=1e-10)


def test_windows_refuse_a_delay_and_no_fit_moves_one():
    """A delay is the release at another instant; nobody looks for it, and it is not passed over in silence."""
    late = Model.table_3_1().replace(effects=(GyroBandwidth(60.0, delay=2e-3),))
    with pytest.raises(InputError, match="has a delay") as caught:
        sensor_of(late)
    assert caught.value.code == "E-TWIN"
    assert sensor_of(late.replace(effects=(GyroBandwidth(60.0),))).bandwidth == 60.0
    assert [p.name for p in parameters_of(GyroBandwidth, 1)] == ["gyro_bandwidth.frequency", "gyro_bandwidth.damping"]
