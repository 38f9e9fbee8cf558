"""What a gyroscope has made of the rates is taken back: effect by effect, and the channel as a whole."""

import math

import numpy as np
import pytest

from rockref import InputError
from rockref.effects.base import Effect
from rockref.effects.catalogue import EFFECTS, QUESTIONS, analogue, heard, measured, undone
from rockref.effects.sensor.clock_error import ClockError
from rockref.effects.sensor.gyro_bandwidth import DAMPING, GyroBandwidth, fast_pad, undo_low_pass
from rockref.effects.sensor.gyro_drift import GyroDrift
from rockref.effects.sensor.gyro_misalignment import GyroMisalignment
from rockref.effects.sensor.gyro_saturation import TOLD, TOP, GyroSaturation
from rockref.effects.sensor.gyro_scale import GyroScale
from rockref.measure.gyroscope import low_pass

STEP = 5e-4
T = STEP * np.arange(4000)
SEEDS = range(3)


def rates(t, f=7.0):
    """Rates (N, 3) [rad/s] that ring at f Hz, and are at rest before 0 and after 2 s."""
    envelope = np.where((t > 0) & (t < 2), np.sin(math.pi * t / 2) ** 2, 0)
    return (envelope * np.sin(2 * math.pi * f * t))[:, None] * np.array([1.0, 0.5, -0.3])


def drawn(id, seed):
    """A sensor effect with numbers drawn from all that is plausible."""
    rng, kind = np.random.default_rng(seed), EFFECTS[id]
    return kind(**{name: rng.uniform(q.low, q.high) for name, q in kind.quantities.items()})


def back(effect, f=7.0):
    """Rates that come back from what a sensor shows, and those that were there at the instants that come with them."""
    t, crv = effect.undo(T, effect.sensor(T, rates(T, f)))
    return crv, rates(t, f)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("id", ["gyro_misalignment", "gyro_scale", "gyro_drift"])
def test_what_is_mixed_scaled_or_shifted_comes_back(id, seed):
    # The same sums backwards: rounding of numbers of one.
    np.testing.assert_allclose(*back(drawn(id, seed)), atol=1e-15)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_rows_of_a_wrong_clock_come_back_at_their_true_instants(seed):
    # Cubic between samples: (2 pi 7/2000)^4/384 of the tone, at the ends some ten times it.
    np.testing.assert_allclose(*back(drawn("clock_error", seed)), atol=1e-7)


@pytest.mark.parametrize("seed", SEEDS)
def test_what_a_slow_and_late_sensor_shows_comes_back_in_its_band(seed):
    effect = drawn("gyro_bandwidth", seed)
    f = min(effect.frequency / 2, 30.0)
    # Where half the power passes the regularised inverse keeps 1e-3 back. The filter takes the signal as straight
    # between samples, (2 pi f h)^2/12 of it; the delay as cubic, (2 pi f h)^4/384 and ten times that at the ends.
    tolerance = 1e-3 + (2 * math.pi * f * STEP) ** 2 / 12 + (2 * math.pi * f * STEP) ** 4 / 38
    np.testing.assert_allclose(*back(effect, f), atol=tolerance)


def test_noise_above_the_band_is_not_made_loud():
    """At most 1/(2 sqrt(1e-3)) = 16 times, where an inverse without regularisation has (500/20)^2 = 625."""
    noise = np.random.default_rng(0).normal(size=(4000, 3))
    _, crv = GyroBandwidth(20.0).undo(T, noise)
    assert crv.std() < 16 * noise.std()


def test_a_record_of_a_thousand_rows_a_second_shows_steep_flanks_again():
    w = np.stack([np.sin(2 * np.pi * f * T) for f in (3.0, 20.0, 60.0)], axis=1)
    seen = low_pass(w, STEP, 300.0)[::2]
    error = np.abs(undo_low_pass(seen, 1000.0, ((300.0, DAMPING),)) - w[::2])[200:-200].max()
    # The filter delays by 0.75 ms, and that is gone: what is left of 60 Hz is the first-order hold, (2 pi 60 h)^2/12.
    assert error < 2 * (2 * np.pi * 60 * STEP) ** 2 / 12 and error < 0.03 * np.abs(seen - w[::2])[200:-200].max()


@pytest.mark.parametrize("n", [801, 1500, 4001])
def test_a_record_that_begins_and_ends_in_motion_comes_back_up_to_its_ends(n):
    w = 0.3 + 0.2 * STEP * np.arange(n)[:, None] * [1.0, 2.0, -1.0]
    found = undo_low_pass(low_pass(w, STEP, 300.0), 1 / STEP, ((300.0, DAMPING),))
    # The filter starts settled: 0.75 ms of the slopes of 0.4 rad/s2 are late there, and fade within some rows.
    np.testing.assert_allclose(found, w, rtol=0, atol=1e-5)
    # Inside only the regularisation is left, 1e-3 of what a slope has at high frequency.
    np.testing.assert_allclose(found[200:-200], w[200:-200], rtol=0, atol=1e-9)


def test_few_rows_have_an_inverse_of_their_own_length():
    for n in (1, 2, 3, 5):
        steady = np.full((n, 3), 0.7)
        np.testing.assert_allclose(undo_low_pass(steady, 2000.0, ((300.0, DAMPING),)), steady, rtol=1e-12)
    both = ((300.0, DAMPING), (50.0, 1.0))
    w = rates(T[:2000])
    twice = undo_low_pass(undo_low_pass(w, 2000.0, both[:1]), 2000.0, both[1:])
    # Two low-passes in one inverse: as one after the other, but for the regularisation.
    assert np.abs(undo_low_pass(w, 2000.0, both) - twice).max() < 5e-3 * np.abs(twice).max()


def is_smooth(n):
    """Whether n has no prime factor above five."""
    for prime in (2, 3, 5):
        while n % prime == 0:
            n //= prime
    return n == 1


@pytest.mark.parametrize("n, pad", [(4000, 1000), (3999, 1000), (7, 1), (1013, 499), (2, 2), (97, 30), (3, 2), (9, 5)])
def test_ends_are_the_shortest_with_which_the_transform_is_fast(n, pad):
    found = fast_pad(n, pad)
    assert found >= pad and is_smooth(n + 2 * found)
    assert not any(is_smooth(n + 2 * shorter) for shorter in range(pad, found))


def test_rows_alone_have_no_slope_to_undo():
    one, two = np.array([[0.3, 0.0, 0.0]]), np.array([[0.3, 0.0, 0.0], [0.5, 0.0, 0.0]])
    t, crv = GyroBandwidth(20.0, delay=0.1).undo(T[:1], one)
    assert t.tolist() == [0.0] and crv is one
    assert undone([], T[:1], one, 300.0)[1] is one
    # Two rows have one: a slow sensor has smoothed it.
    assert np.ptp(GyroBandwidth(20.0).undo(T[:2], two)[1][:, 0]) > 0.2
    assert np.ptp(undone([], T[:2], two, 20.0)[1][:, 0]) > 0.2


def test_instants_are_doubles_and_rates_keep_their_precision():
    t, crv = T.astype(np.float32), rates(T).astype(np.float32)
    for effect in (ClockError(1.01), GyroBandwidth(50.0, delay=2e-3)):
        assert effect.undo(t, crv)[0].dtype == np.float64
    for effect in (GyroMisalignment(0.1, 0.2, 0.3, xy=0.01), GyroScale(1.1, 0.9, 1.2), GyroDrift(0.1, rate_y=0.1)):
        assert effect.undo(T, crv)[1].dtype == np.float32, effect.id


def test_uneven_rows_have_no_inverse():
    uneven = np.concatenate([T[:50], T[60:110]])
    with pytest.raises(InputError, match="even spacing"):
        GyroBandwidth(20.0).undo(uneven, np.zeros((100, 3)))
    # A delay alone does not ask.
    assert np.array_equal(GyroBandwidth(delay=0.01).undo(uneven, np.zeros((100, 3)))[0], uneven - 0.01)


@pytest.mark.parametrize("softness", [0.03, 0.3, 1.0])
def test_what_soft_stops_have_bent_is_put_back_where_it_is_heard(softness):
    effect = GyroSaturation(0.3, softness)
    shown = effect.sensor(T, rates(T))
    told = effect.heard(T, shown)
    # Lines over h = 0.004 ranges leave |f''/f'| h^2/8 of one, at most 2 h^2/8: 4e-6, of 0.3 rad/s.
    np.testing.assert_allclose(effect.undo(T, shown)[1][told], rates(T)[told], atol=4e-6 * 0.3)
    assert 0.5 < told.mean() < 1
    # The curve has a slope of at least a fifty-seventh there; its lines, a thousandth less.
    noisy = effect.undo(T, shown + 1e-6)[1]
    assert np.abs(noisy - effect.undo(T, shown)[1])[told].max() < 57.1e-6


def test_what_hard_stops_have_cut_is_not_heard_and_stays():
    effect = GyroSaturation(0.6)
    shown = np.round(effect.sensor(T, rates(T)) / 0.007) * 0.007
    t, crv = effect.undo(T, shown)
    assert t is T and crv is shown
    told = effect.heard(T, shown)
    assert not told[np.abs(rates(T)) >= 0.6].any() and told[np.abs(rates(T)) < TOP * 0.6 - 0.0035].all()


def test_noise_beyond_soft_stops_is_the_largest_rate_that_they_tell():
    _, crv = GyroSaturation(0.6, 1.0).undo(T[:1], np.array([[0.61, -0.7, 0.0]]))
    assert crv == pytest.approx(np.array([[TOLD * 0.6, -TOLD * 0.6, 0.0]]))


CHAIN = [
    GyroMisalignment(0.1, 0.2, 0.3, xy=0.01), GyroScale(1.1, 0.9, 1.2), GyroBandwidth(50.0, delay=2e-3),
    GyroDrift(0.1, rate_y=0.1), ClockError(1.01), GyroSaturation(0.8),
]  # fmt: skip


def test_the_channel_runs_backwards():
    """Stops, clock, drift, bandwidth, data sheet, scale, misalignment; where nothing was cut the rates are back."""
    longer = STEP * np.arange(4100)  # than what the slow clock dates as two seconds: no row is held
    whole = analogue(CHAIN, longer, rates(longer), lambda crv: low_pass(crv, STEP, 300.0))[:4000]
    t, crv = undone(iter(CHAIN[:-1]), T, whole, 300.0)
    assert t == pytest.approx(1.01 * T - 2e-3, abs=1e-15)
    # Two low-passes of signals that are straight between samples, (2 pi 7 h)^2/12 each, and scales near one.
    tolerance = 3 * (2 * math.pi * 7 * STEP) ** 2 / 12
    assert crv == pytest.approx(rates(t), abs=tolerance)
    # Each of the stations counts: without any one of them the rates do not come back.
    for i, effect in enumerate(CHAIN[:-1]):
        t, crv = undone(CHAIN[:i] + CHAIN[i + 1 : -1], T, whole, 300.0)
        assert np.abs(crv - rates(t)).max() > 10 * tolerance, effect.id
    true = rates(1.01 * T - 2e-3)
    assert np.abs(undone(CHAIN[:-1], T, whole)[1] - true).max() > 10 * tolerance
    # Soft stops come last of all.
    stops = GyroSaturation(2.0, 1.0)
    assert undone([*CHAIN[:-1], stops], T, stops.sensor(T, whole), 300.0)[1] == pytest.approx(true, abs=tolerance)


def test_the_channel_says_what_of_a_record_is_heard():
    record = measured(CHAIN, T, rates(T))
    told = heard(iter(CHAIN), T, record)
    assert np.array_equal(told, np.abs(record) < TOP * 0.8) and not told.all()
    assert heard(CHAIN[:-1], T, record).all() and heard([], T, record).shape == record.shape
    assert np.array_equal(heard(CHAIN[-1:], T, record), told)


def test_a_users_own_effect_hears_what_it_has_shown_itself():
    """The stops and the clock are undone before it is asked, and what it does not hear is not heard."""
    asked = []

    class Numb(Effect):
        id = "numb"

        def heard(self, t, crv):
            asked.append((t, crv))
            return np.abs(crv) > 0.05

    record = GyroSaturation(0.6, 1.0).sensor(T, rates(T))
    told = heard([GyroSaturation(0.6, 1.0), Numb(), ClockError(1.01)], T, record)
    ((t, crv),) = asked
    assert np.array_equal(t, 1.01 * T) and np.array_equal(crv, GyroSaturation(0.6, 1.0).undo(T, record)[1])
    assert np.array_equal(told, (np.abs(crv) > 0.05) & (np.abs(record) < TOP * 0.6))


def test_batches_ride_along():
    crv = np.stack([rates(T), rates(T, 5.0)])
    for effect in CHAIN:
        both, told = effect.undo(T, crv)[1], effect.heard(T, crv)
        for i in range(2):
            assert np.array_equal(both[i], effect.undo(T, crv[i])[1]), effect.id
            assert np.array_equal(told[i], effect.heard(T, crv[i])), effect.id


def test_effects_of_the_sensor_and_no_others_change_the_target():
    shown = rates(T)
    of_the_sensor = {kind.id for kind in QUESTIONS["sensor"][1:]}
    assert {id for id, kind in EFFECTS.items() if kind.changes_target()} == of_the_sensor
    for kind in EFFECTS.values():
        t, crv = kind().undo(T, shown)
        assert t is T and crv is shown and kind().heard(T, shown).all()
