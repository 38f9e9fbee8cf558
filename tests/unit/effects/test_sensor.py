"""What the gyroscope does, each against another way to the same signal."""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rockref.effects.base import Effect
from rockref.effects.catalogue import analogue, digital, measured
from rockref.effects.sensor.clock_error import ClockError
from rockref.effects.sensor.gyro_bandwidth import GyroBandwidth, natural_frequency
from rockref.effects.sensor.gyro_drift import GyroDrift
from rockref.effects.sensor.gyro_misalignment import GyroMisalignment
from rockref.effects.sensor.gyro_saturation import FLAT, TOP, GyroSaturation
from rockref.effects.sensor.gyro_scale import GyroScale

T = np.arange(4000) / 2000


def tone(f, phase=0.0, axes=(1.0, 0.5, -0.3)):
    return np.sin(2 * math.pi * f * T + phase)[:, None] * np.array(axes)


def test_misalignment_is_the_rotation_by_its_vector():
    vector = (0.3, -0.2, 0.5)
    crv = tone(3.0) + [0.1, 0.2, 0.3]
    out = GyroMisalignment(*vector).sensor(T, crv)
    assert out == pytest.approx(Rotation.from_rotvec(vector).apply(crv), abs=1e-15)


def test_axes_that_are_not_square_see_each_other():
    """Two sensitive axes at 90 degrees less 2 xy to each other see a rate half way between them alike, and more."""
    xy = 0.01
    out = GyroMisalignment(xy=xy).sensor(T, tone(1.0, axes=(1.0, 1.0, 0.0)))
    apart = math.pi / 2 - 2 * xy
    # Of unit vectors (1, xy) and (xy, 1) the cosine is 2 xy, and each has cos(apart/2) of the rate: to first order.
    assert out[:, 0] == pytest.approx(out[:, 1], abs=1e-15)
    assert np.max(out[:, 0]) == pytest.approx(math.sqrt(2) * math.cos(apart / 2), abs=xy**2)


@pytest.mark.parametrize("f", [5.0, 20.0, 60.0])
def test_bandwidth_follows_its_transfer_function(f):
    """H = w0^2/(w0^2 - w^2 + i sqrt2 w0 w), after the transient; and half the power at the bandwidth itself."""
    cutoff = 20.0
    out = GyroBandwidth(cutoff).sensor(T, tone(f))
    ratio = f / cutoff
    H = 1 / (1 - ratio**2 + 1j * math.sqrt(2) * ratio)
    expected = abs(H) * tone(f, np.angle(H))
    late = T > 1.0  # exp(-2 pi 20/sqrt2) is nothing
    # The signal is straight between samples: (2 pi f h)^2/12 of it.
    assert out[late] == pytest.approx(expected[late], abs=(2 * math.pi * f / 2000) ** 2 / 12)
    if ratio == 1:
        assert np.std(out[late, 0]) / np.std(tone(f)[late, 0]) == pytest.approx(1 / math.sqrt(2), rel=1e-3)


@pytest.mark.parametrize("damping", [0.5, 1.0, 5.0])
def test_damping_shapes_the_filter_and_keeps_the_bandwidth(damping):
    """A tone at the bandwidth comes out with half its power, and late by the angle of the transfer function there."""
    out = GyroBandwidth(20.0, damping).sensor(T, tone(20.0))
    ratio = 2 * math.pi * 20.0 / natural_frequency(20.0, damping)
    late = T > 1.5  # the slowest pole, of damping 5, has exp(-2 pi 20) there
    expected = math.sqrt(0.5) * tone(20.0, -math.atan2(2 * damping * ratio, 1 - ratio**2))
    assert out[late] == pytest.approx(expected[late], abs=(2 * math.pi * 20.0 / 2000) ** 2 / 12)


def test_far_above_one_damping_is_a_filter_of_first_order():
    """1/(1 + i f/f_c); what is left of the second pole falls with the square of the damping."""
    ratio = 0.5
    first = 1 / (1 + 1j * ratio)
    apart = []
    for damping in (5.0, 50.0):
        s = 1j * ratio * 2 * math.pi * 20.0 / natural_frequency(20.0, damping)
        apart.append(abs(1 / (s * s + 2 * damping * s + 1) - first))
    assert apart[0] < 0.006 and apart[1] == pytest.approx(apart[0] / 100, rel=0.05)


@pytest.mark.parametrize("f", [5.0, 60.0])
def test_delay_is_a_phase_that_grows_with_the_frequency(f):
    """H = exp(-i w tau) times the low-pass; alone it leaves sizes as they are."""
    tau, cutoff = 3.3e-3, 20.0
    late = T > 1.0
    alone = GyroBandwidth(delay=tau).sensor(T, tone(f))
    # Cubic between samples: (2 pi f/2000)^4/384 of the tone, at the ends some ten times it.
    assert alone[late] == pytest.approx(tone(f, -2 * math.pi * f * tau)[late], abs=1e-5)
    both = GyroBandwidth(cutoff, delay=tau).sensor(T, tone(f))
    H = np.exp(-2j * math.pi * f * tau) / (1 - (f / cutoff) ** 2 + 1j * math.sqrt(2) * f / cutoff)
    expected = abs(H) * tone(f, np.angle(H))
    # The low-pass takes the signal as straight between samples: (2 pi f h)^2/12 of it.
    assert both[late] == pytest.approx(expected[late], abs=(2 * math.pi * f / 2000) ** 2 / 12 + 1e-5)


def test_a_delay_comes_before_the_bias_and_its_drift():
    """The bias of a sensor that is late does not begin late."""
    out = measured([GyroDrift(rate_x=1.0), GyroBandwidth(delay=0.01)], T, np.zeros((4000, 3)))
    assert np.array_equal(out[:, 0], T)


@pytest.mark.parametrize("rate", [0.99, 1.01])
def test_clock_shows_the_signal_of_another_time(rate):
    """W_m(t) = W(rate t): a tone of 7 Hz looks like one of 7 rate Hz."""
    out = ClockError(rate).sensor(T, tone(7.0))
    inside = T * rate <= T[-1]
    # Cubic between samples: (2 pi 7/2000)^4/384 of the tone, at the ends some ten times it.
    assert out[inside] == pytest.approx(tone(7.0 * rate)[inside], abs=1e-7)
    assert np.array_equal(out[~inside], np.broadcast_to(tone(7.0)[-1], out[~inside].shape))


CHAIN = [
    GyroMisalignment(0.1, 0.2, 0.3), GyroScale(1.1, 0.9, 1.2), GyroBandwidth(50.0),
    GyroDrift(0.1, rate_y=1.0), ClockError(1.01), GyroSaturation(0.8),
]  # fmt: skip


def test_the_chain_is_that_of_a_real_gyroscope():
    """Whatever the order in which they are named: misalignment, scale, bandwidth, drift, the clock's instant, stops."""
    crv = tone(3.0)
    by_hand = crv
    for effect in CHAIN:
        by_hand = effect.sensor(T, by_hand)
    assert np.array_equal(measured(CHAIN[::-1], T, crv), by_hand)
    misalignment, scale = CHAIN[:2]
    assert not np.allclose(misalignment.sensor(T, scale.sensor(T, crv)), scale.sensor(T, misalignment.sensor(T, crv)))


def test_a_data_sheets_low_pass_acts_on_what_is_mounted_and_scaled():
    seen = []
    found = analogue(CHAIN, T, tone(3.0), lambda rates: seen.append(rates) or 0.5 * rates)
    assert np.array_equal(seen[0], CHAIN[1].sensor(T, CHAIN[0].sensor(T, tone(3.0))))
    halved = 0.5 * seen[0]
    for effect in CHAIN[2:5]:
        halved = effect.sensor(T, halved)
    assert np.array_equal(found, halved)
    assert np.array_equal(digital(CHAIN, T, found), np.clip(found, -0.8, 0.8)) and np.abs(found).max() > 0.8


@pytest.mark.parametrize("rate", [0.98, 1.02])
def test_no_clock_shows_more_than_the_range(rate):
    """The corners of a flat top are not interpolated across: a sample is taken first and cut then."""
    out = measured([ClockError(rate), GyroSaturation(0.4)], T, tone(40.0))
    assert np.abs(out).max() == 0.4
    inside = T * rate <= T[-1]
    # Cubic between samples: (2 pi 40/2000)^4/384 of the tone, at the ends some ten times it.
    assert out[inside] == pytest.approx(np.clip(tone(40.0 * rate)[inside], -0.4, 0.4), abs=1e-5)


def test_a_users_own_sensor_acts_before_the_sample_is_taken():
    """It sees the block's time and rates that are not cut, as the drift does."""

    @dataclass(frozen=True)
    class Hum(Effect):
        id, question = "hum", "sensor"

        def sensor(self, t, crv):
            return crv + 0.5 * np.sin(300.0 * np.asarray(t))[:, None]

    out = measured([GyroSaturation(0.4), Hum(), ClockError(1.01)], T, tone(3.0))
    hummed = tone(3.0) + 0.5 * np.sin(300.0 * T)[:, None]
    assert np.array_equal(out, np.clip(ClockError(1.01).sensor(T, hummed), -0.4, 0.4))


@pytest.mark.parametrize(
    "start, seconds, top, flat",
    [(3.0, 0.9 * FLAT, 0.5, False), (0.0, FLAT, 0.5, True), (0.0, 2 * FLAT, TOP * 0.5, False)],
)
def test_a_top_is_flat_where_one_axis_stays_there_for_longer_than_a_cusp(start, seconds, top, flat):
    """Wherever the clock starts; what two axes show one after the other is no longer for it."""
    ticks = 8
    t = start + np.arange(2.0 * ticks) * seconds / ticks
    rates = np.zeros((len(t), 3))
    rates[:ticks, 0] = rates[ticks:, 1] = top
    rates[0, 2] = 0.5
    assert ({"range": 0.5} in GyroSaturation.seeds_in([(t, rates)])) is flat


def test_fits_start_from_a_flat_top_and_from_soft_stops():
    """Hard stops are where the top is flat; soft ones of any strength lie near one of the starts."""
    t = np.arange(0.0, 2.0, 1e-3)
    # With cusps that fall, as those of a rocking block.
    rates = (np.exp(-t) * np.abs(2 * np.mod(t, 0.5) - 0.5))[:, None] * [2.0, 0.1, 0.0]
    assert GyroSaturation.seeds_in([(t, GyroSaturation(0.6).sensor(t, rates))])[0] == {"range": 0.6}
    assert all(seed["softness"] == 1.0 for seed in GyroSaturation.seeds_in([(t, rates)]))
    for strength in (0.6, 0.8, 0.9):
        seeds = GyroSaturation.seeds_in([(t, GyroSaturation(strength, 1.0).sensor(t, rates))])
        # A step of a fit takes a range by half.
        assert min(abs(np.log(seed["range"] / strength)) for seed in seeds if "softness" in seed) < np.log(1.5)
