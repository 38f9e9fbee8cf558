"""What each effect of the sensor makes of a few rows, by hand."""

import math

import numpy as np
import pytest

from rockref.effects.sensor.clock_error import ClockError
from rockref.effects.sensor.gyro_bandwidth import GyroBandwidth, natural_frequency
from rockref.effects.sensor.gyro_drift import GyroDrift
from rockref.effects.sensor.gyro_misalignment import GyroMisalignment
from rockref.effects.sensor.gyro_saturation import GyroSaturation
from rockref.effects.sensor.gyro_scale import GyroScale

#: Rounding of a few products.
ROUNDED = 1e-14
T = np.arange(60) / 2000
CRV = np.random.default_rng(5).normal(size=(60, 3))


def test_a_sensor_that_is_turned_by_a_right_angle_shows_the_other_axis():
    """A quarter turn about z takes the rate about x to y."""
    out = GyroMisalignment(z=math.pi / 2).sensor(T, CRV)
    # The exponential of a quarter turn, by its series.
    assert out == pytest.approx(CRV[:, [1, 0, 2]] * (-1, 1, 1), abs=1e-14)


@pytest.mark.parametrize("name, i, j", [("xy", 0, 1), ("xz", 0, 2), ("yz", 1, 2)])
def test_two_axes_that_are_not_square_show_a_share_of_each_other(name, i, j):
    out = GyroMisalignment(**{name: 0.2}).sensor(T, CRV)
    wanted = CRV.copy()
    wanted[:, i] += 0.2 * CRV[:, j]
    wanted[:, j] += 0.2 * CRV[:, i]
    assert out == pytest.approx(wanted, rel=ROUNDED)


def test_the_sensor_turns_first_and_lacks_square_axes_after():
    out = GyroMisalignment(z=math.pi / 2, xy=0.1, xz=0.2, yz=0.3).sensor(T, CRV)
    shares = np.array([[1, 0.1, 0.2], [0.1, 1, 0.3], [0.2, 0.3, 1]])
    # The exponential of a quarter turn, by its series.
    assert out == pytest.approx((CRV[:, [1, 0, 2]] * (-1, 1, 1)) @ shares.T, abs=1e-14)


def test_scale_bias_and_range_are_those_of_each_axis():
    assert GyroScale(0.5, 2.0, 4.0).sensor(T, CRV) == pytest.approx(CRV * (0.5, 2.0, 4.0), rel=ROUNDED)
    drifting = GyroDrift(0.1, 0.2, 0.3, 4.0, 5.0, 6.0).sensor(T, CRV)
    assert drifting == pytest.approx(CRV + (0.1, 0.2, 0.3) + T[:, None] * (4.0, 5.0, 6.0), rel=1e-12)
    out = GyroSaturation(0.5).sensor(T, CRV)
    assert np.array_equal(out, np.sign(CRV) * np.minimum(np.abs(CRV), 0.5))


def test_soft_stops_bend_the_rates_as_a_hyperbolic_tangent_does():
    e2 = np.exp(4 * CRV)  # of twice the rates over the range
    soft = GyroSaturation(0.5, 1.0).sensor(T, CRV)
    assert soft == pytest.approx(0.5 * (e2 - 1) / (e2 + 1), rel=1e-12)
    hard, between = GyroSaturation(0.5).sensor(T, CRV), GyroSaturation(0.5, 0.25).sensor(T, CRV)
    assert between == pytest.approx(0.75 * hard + 0.25 * soft, rel=ROUNDED)
    assert GyroSaturation(softness=1.0).sensor(T, CRV) is CRV


@pytest.mark.parametrize("kind", [GyroMisalignment, GyroScale, GyroDrift, GyroSaturation, GyroBandwidth, ClockError])
def test_an_absent_sensor_effect_gives_back_the_record(kind):
    assert kind().sensor(T, CRV) is CRV


@pytest.mark.parametrize("damping", [0.3, 0.5, math.sqrt(0.5), 1.0, 5.0, 1e4])
@pytest.mark.parametrize("bandwidth", [0.5, 20.0])
def test_half_the_power_passes_at_the_bandwidth(bandwidth, damping):
    """(1 - r^2)^2 + (2 d r)^2 = 2 with r the bandwidth over the undamped frequency: in its place, and not elsewhere."""
    r = 2 * math.pi * bandwidth / natural_frequency(bandwidth, damping)
    # r^2 is that of the sum to a rounding of each term.
    assert (1 - r * r) ** 2 + (2 * damping * r) ** 2 == pytest.approx(2.0, rel=ROUNDED)


def test_the_damping_is_butterworths_unless_another_is_given():
    """There the undamped frequency is the bandwidth."""
    assert natural_frequency(20.0) == pytest.approx(2 * math.pi * 20.0, rel=ROUNDED)


@pytest.mark.parametrize("bandwidth, damping", [(0.0, 0.7), (-1.0, 0.7), (20.0, 0.0), (20.0, -0.5)])
def test_a_filter_needs_a_bandwidth_and_a_damping(bandwidth, damping):
    with pytest.raises(ValueError) as found:
        natural_frequency(bandwidth, damping)
    error = found.value
    assert (error.code, error.where) == ("E-RANGE", "arguments bandwidth, damping")
    assert (error.what, error.cure) == (f"{bandwidth:g} Hz and {damping:g}", "Give positive numbers.")


@pytest.mark.parametrize("effect", [GyroBandwidth(40.0), GyroBandwidth(40.0, 1.5, 0.002), GyroBandwidth(delay=0.002)])
def test_a_slow_sensor_has_shown_the_first_row_for_ever(effect):
    """Rows that repeat the first before it change nothing of what comes."""
    longer = np.concatenate([np.repeat(CRV[:1], 20, axis=0), CRV])
    out = effect.sensor(np.arange(80) / 2000, longer)[20:]
    # A spline sees the bend at the first row a little before and after it; a filter keeps to rounding.
    rows = slice(0 if effect.delay == 0 else 20, None)
    assert effect.sensor(T, CRV)[rows] == pytest.approx(out[rows], abs=1e-12 if effect.delay == 0 else 1e-8)


@pytest.mark.parametrize("effect", [GyroBandwidth(40.0), GyroBandwidth(delay=0.002)])
def test_a_slow_sensor_does_not_know_the_hour(effect):
    """Times of 7 s and more are kept to 1e-15 s, of a row's 5e-4 s."""
    assert effect.sensor(T + 7.0, CRV) == pytest.approx(effect.sensor(T, CRV), abs=1e-9)


@pytest.mark.parametrize("effect", [GyroBandwidth(40.0), GyroBandwidth(delay=0.002), ClockError(1.01)])
def test_a_record_of_one_row_is_settled_on_it(effect):
    """As a run has that is shorter than the time between its rows; two rows are a record."""
    assert np.array_equal(effect.sensor(T[:1], CRV[:1]), CRV[:1])
    assert not np.array_equal(effect.sensor(T[:2], CRV[:2]), CRV[:2])


def analytic_response(frequency, damping, t):
    """Answer of a second-order low-pass to a ramp of slope one that begins at t = 0: by its impulse response."""
    omega = natural_frequency(frequency, damping)
    poles = np.roots([1, 2 * damping * omega, omega * omega])
    # Partial fractions of omega^2/(s^2 (s - p)(s - q)): a ramp that is late, and one term a pole.
    p, q = poles
    terms = omega**2 * (np.exp(p * t) / (p * p * (p - q)) + np.exp(q * t) / (q * q * (q - p)))
    return t - 2 * damping / omega + terms.real


@pytest.mark.parametrize("damping", [0.5, 2.0])
def test_a_ramp_comes_out_as_the_filters_own_equation_says(damping):
    """The rates are taken as straight between rows, and a ramp is."""
    ramp = np.outer(T, (1.0, -2.0, 0.5))
    out = GyroBandwidth(40.0, damping).sensor(T, ramp)
    # The step's matrix exponential and the recursion, of 60 rows of up to 0.06.
    assert out == pytest.approx(np.outer(analytic_response(40.0, damping, T), (1.0, -2.0, 0.5)), abs=1e-12)


def test_rows_may_be_a_little_uneven_and_not_more():
    """A tenth of a row's time is refused where more is; rounded times are not."""
    shifted = np.where(np.arange(60) == 30, 0.05, 0.0) / 2000
    assert GyroBandwidth(40.0).sensor(T + shifted, CRV) == pytest.approx(GyroBandwidth(40.0).sensor(T, CRV))
    with pytest.raises(ValueError) as found:
        GyroBandwidth(40.0).sensor(T + 5 * shifted, CRV)
    error = found.value
    assert (error.code, error.where, error.what) == ("E-STEP", "effect gyro_bandwidth", "needs rows at even spacing")
    assert error.cure == "Choose an output rate that divides the number of steps a second."


LINE = 0.2 + np.outer(T, (3.0, -1.0, 0.5))


@pytest.mark.parametrize("delay, slower", [(0.0017, 1), (1.0, 100)])
def test_a_delay_holds_the_first_row_until_it_is_over(delay, slower):
    """Of three rows and a half, and of the longest that there is, on rows at 20 Hz."""
    t = slower * T
    late = 0.2 + np.outer(np.maximum(t - delay, 0.0) / slower, (3.0, -1.0, 0.5))
    assert GyroBandwidth(delay=delay).sensor(t, LINE) == pytest.approx(late, abs=1e-12)


@pytest.mark.parametrize("rate", [0.7, 1.3])
def test_a_clock_shows_a_line_steeper_or_flatter_within_the_record(rate):
    """Where its time lies outside the record the row at that end is held."""
    true_time = np.clip(rate * (T + 0.01), 0.01, T[-1] + 0.01)
    out = ClockError(rate).sensor(T + 0.01, LINE)
    assert out == pytest.approx(0.2 + np.outer(true_time - 0.01, (3.0, -1.0, 0.5)), abs=1e-12)


def test_the_error_of_a_clock_grows_by_its_share_a_second():
    """True time is t + (rate - 1)(t + growth t^2/2), in which a line shows as a parabola."""
    out = ClockError(0.9, 0.2).sensor(T, LINE)
    true_time = T - 0.1 * (T + 0.1 * T * T)
    assert out == pytest.approx(0.2 + np.outer(true_time, (3.0, -1.0, 0.5)), abs=1e-12)


@pytest.mark.parametrize("rate, growth, fastest", [(1.02, 0.25, 1.05), (1.02, -0.25, 0.95), (100.0, 1.0, 1.05)])
def test_the_rate_of_a_clock_moves_by_a_twentieth_at_most(rate, growth, fastest):
    """And from there on by nothing: no time stands still or turns back."""
    effect, t = ClockError(rate, growth), np.linspace(0.0, 60.0, 6001)
    still = 0.05 * rate / (abs(rate - 1) * abs(growth))
    speed = np.diff(effect.true_time(t)) / 0.01
    assert speed[0] == pytest.approx(rate * (1 + (rate - 1) / rate * growth * min(0.005, still)), rel=1e-2)
    after = t[1:] > still + 0.02
    assert after.any() and speed[after] == pytest.approx(rate * fastest, rel=1e-9)
    assert np.array_equal(effect.true_time(t[:3]), [effect.true_time(x) for x in t[:3]])


def test_a_clock_whose_error_does_not_grow_has_the_bits_of_its_rate():
    assert np.array_equal(ClockError(1.013).true_time(T), 1.013 * T)
    assert ClockError(1.0, 0.5).is_absent() and np.array_equal(ClockError(1.0, 0.5).true_time(T), T)


@pytest.mark.parametrize("effect", [GyroBandwidth(delay=0.0017), ClockError(0.7)])
def test_times_are_kept_whatever_they_are_written_in(effect):
    """Times of single precision, written as such, are moved in double: a line comes out straight."""
    t = T.astype(np.float32)
    line = np.outer(t.astype(float), (3.0, -1.0, 0.5))
    moved = (
        np.maximum(t.astype(float) - effect.delay, 0) if isinstance(effect, GyroBandwidth) else 0.7 * t.astype(float)
    )
    # Single precision would leave 1e-9 of 0.03 s.
    assert effect.sensor(t, line) == pytest.approx(np.outer(moved, (3.0, -1.0, 0.5)), abs=1e-13)


@pytest.mark.parametrize(
    "effect",
    [
        GyroMisalignment(0.1, 0.2, 0.3, 0.1), GyroScale(1.1, 0.9, 1.2), GyroDrift(0.1, rate_y=1.0),
        GyroBandwidth(40.0), GyroBandwidth(delay=0.0017), ClockError(0.7, 0.5), GyroSaturation(0.8),
    ],
)  # fmt: skip
def test_runs_side_by_side_do_not_see_each_other(effect):
    both = effect.sensor(T, np.stack([CRV, 2 * CRV[::-1]]))
    assert np.array_equal(both[0], effect.sensor(T, CRV))
    assert np.array_equal(both[1], effect.sensor(T, 2 * CRV[::-1]))
