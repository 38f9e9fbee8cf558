"""Envelopes: the shapes that the source describes, on made signals and on the shipped ones.

Then envelopes and their shapes, number by number.
"""

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from rockref.measure.signals.envelopes import POINTS, envelope_shape, envelopes
from rockref.measure.signals.impacts import main_impacts
from rockref.measure.signals.running import running_mean
from rockref.model.errors import InputError
from tests.refusal import refusal


def saw(t, frequency):
    """A triangle wave between -1 and 1."""
    return 4.0 * np.abs((t * frequency) % 1.0 - 0.5) - 1.0


def made(shape, frequency=15.0, rate=1000.0):
    t = np.arange(0.0, 1.0, 1.0 / rate)
    tooth = saw(t, frequency)
    return t, np.stack((np.sin(3.0 * t), tooth * shape(t), 0.5 * tooth * shape(t)), axis=-1)


@pytest.mark.parametrize("rate", [1000.0, 2000.0])
def test_teeth_are_joined_by_their_tops(rate):
    t, crv = made(lambda t: 1.0 - 0.5 * t, rate=rate)
    found = envelopes(t, crv, 0.0, 1.0)
    assert found.upper.shape == found.lower.shape == (2, POINTS)
    assert found.teeth.tolist() == [14, 14]
    assert np.allclose(found.periods, 1.0 / 15.0, rtol=0.02)
    inside = (found.t > 0.1) & (found.t < 0.9)
    # The mean over three samples cuts a tip of 60/s by 4 %.
    for row, scale in ((0, 1.0), (1, 0.5)):
        assert np.allclose(found.upper[row, inside], scale * (1.0 - 0.5 * found.t[inside]), rtol=0.06)
        assert np.allclose(found.lower[row, inside], -scale * (1.0 - 0.5 * found.t[inside]), rtol=0.06)


def test_shapes_are_told_apart():
    def shape(function):
        t, crv = made(function)
        found = envelopes(t, crv, 0.0, 1.0)
        return envelope_shape(found.upper[0], found.lower[0])

    flat, round_, ramp = shape(lambda t: 1.0 + 0 * t), shape(lambda t: np.sin(np.pi * t)), shape(lambda t: t)
    # Half a tooth at either end of the arc lowers the outer thirds by 8 %.
    assert flat.variation < 0.05 and abs(flat.bow) < 0.1
    assert round_.bow > 0.4 and round_.start < 0.2 and round_.end < 0.2
    assert ramp.variation > 0.4 and abs(ramp.bow) < 0.1 and ramp.end > 0.7 > 0.2 > ramp.start
    assert flat.largest == pytest.approx(1.0, abs=0.06)
    assert round_.mean == pytest.approx(2.0 / np.pi, rel=0.1)


def test_clatter_that_dies_leaves_an_envelope_at_the_noise():
    t, crv = made(lambda t: np.where(t < 0.5, 1.0, 0.0))
    crv = crv + 0.01 * np.random.default_rng(0).standard_normal(crv.shape)
    found = envelopes(t, crv, 0.0, 1.0, noise=0.01)
    late = (found.t > 0.6) & (found.t < 0.95)
    assert np.abs(found.upper[:, late]).max() < 0.05 > np.abs(found.lower[:, late]).max()
    assert found.teeth[0] in (7, 8)


def test_lines_contain_the_signal_but_for_its_noise():
    rng = np.random.default_rng(4)
    t, crv = made(lambda t: 1.0 + 0.3 * np.sin(7.0 * t))
    crv = crv + 0.01 * rng.standard_normal(crv.shape)
    found = envelopes(t, crv, 0.0, 1.0, noise=0.01)
    for row in range(2):
        at = np.interp(t, found.t, found.upper[row]), np.interp(t, found.t, found.lower[row])
        assert np.mean(crv[:, row + 1] > at[0] + 0.1) < 0.01
        assert np.mean(crv[:, row + 1] < at[1] - 0.1) < 0.01


def test_silence_has_an_envelope_of_zero():
    t = np.arange(1000) / 1000.0
    found = envelopes(t, np.zeros((1000, 3)), 0.0, 1.0)
    assert not found.upper.any() and not found.lower.any()
    assert found.teeth.tolist() == [0, 0] and np.isnan(found.periods).all()
    assert envelope_shape(found.upper[0], found.lower[0]).mean == 0.0


@pytest.mark.parametrize(("start", "end"), [(0.0, 0.006), (2.0, 3.0), (0.5, 0.4)])
def test_stretch_without_samples_is_refused(start, end):
    t, crv = made(np.ones_like)
    with pytest.raises(InputError, match="E-STRETCH]"):
        envelopes(t, crv, start, end)


def test_control_looks_as_the_source_describes(shipped):
    """Transverse: quasi-constant, between 10 and 20 teeth. Longitudinal: bulges, and is small at both ends."""
    experiment = load_experiment(shipped / "mystery-08", uses=("fit",))
    for run in experiment.fit_runs()[:2]:
        first, second = main_impacts(run.t, run.crv).times[:2]
        found = envelopes(run.t, run.crv, first, second, noise=experiment.gyro.noise)
        transverse = envelope_shape(found.upper[0], found.lower[0])
        longitudinal = envelope_shape(found.upper[1], found.lower[1])
        assert 10 <= found.teeth[0] <= 20
        assert transverse.variation < 0.15 and abs(transverse.bow) < 0.15
        assert longitudinal.bow > 0.4
        assert longitudinal.start < 0.3 and longitudinal.end < 0.3
        assert np.degrees(transverse.largest) == pytest.approx(3.0, abs=0.5)
        assert np.degrees(longitudinal.largest) == pytest.approx(6.7, abs=0.7)


def on_y(t, y):
    """Rates with y (N,) on the transverse axis, and twice its mirror image on the longitudinal one."""
    return np.stack((np.zeros_like(t), y, -2.0 * y), axis=-1)


def test_shape_of_ten_points():
    half = np.array([1.0, 2.0, 3.0, 5.0, 8.0, 8.0, 5.0, 4.0, 2.0, 3.0])
    # Where the lines lie does not matter, but for how far they are apart.
    found = envelope_shape(7.0 + half, 7.0 - half)
    assert (found.mean, found.largest) == (pytest.approx(4.1), 8.0)
    assert (found.start, found.end) == (1.0 / 8.0, 3.0 / 8.0)
    # Means of the thirds: 2, 6.5, 3; half the sum of the outer ones is 2.5.
    assert found.bow == pytest.approx((6.5 - 2.5) / 4.1)
    inner = half[1:-1]
    assert found.variation == pytest.approx(np.sqrt(np.mean(inner**2) - np.mean(inner) ** 2) / np.mean(inner))


def test_shape_of_thirty_points():
    half = np.repeat([1.0, 4.0, 6.0, 3.0, 2.0], [3, 7, 10, 7, 3])
    found = envelope_shape(half, -half)
    assert (found.mean, found.largest) == (pytest.approx((3 + 28 + 60 + 21 + 6) / 30), 6.0)
    assert (found.start, found.end) == (pytest.approx(1 / 6), pytest.approx(2 / 6))
    assert found.bow == pytest.approx((6.0 - 0.5 * (3.1 + 2.7)) / (118 / 30))
    mean = (28 + 60 + 21) / 24
    square = (7 * 16 + 10 * 36 + 7 * 9) / 24
    assert found.variation == pytest.approx(np.sqrt(square - mean**2) / mean)


@pytest.mark.parametrize("ends", [0.0, 0.5])
def test_an_envelope_that_is_nowhere_or_only_at_its_ends_does_not_vary(ends):
    half = np.zeros(20)
    half[[0, 1, -2, -1]] = ends
    found = envelope_shape(half, -half)
    assert found.variation == 0.0
    share = 1.0 if ends else 0.0
    assert (found.mean, found.largest, found.start, found.end) == (0.2 * ends, ends, share, share)
    if not ends:
        assert found.bow == 0.0


def rippled(amplitude, noise=0.0, **how):
    """A straight line of height one over a second, with ripples of 25 Hz on it, at 2 kHz."""
    t = np.arange(2000) / 2000.0
    return envelopes(t, on_y(t, t + amplitude * np.sin(2.0 * np.pi * 25.0 * t)), 0.0, 1.0, noise=noise, **how)


def test_a_tooth_stands_out_by_a_twentieth_of_the_range():
    """While the ripple falls the line rises by 0.02: teeth are twice the amplitude less 0.02 and a little."""

    def fall(amplitude):
        # From the top, where the slope -1 of the ripple meets the line's, to the bottom.
        phase = np.arccos(-1.0 / (2.0 * np.pi * 25.0 * amplitude))
        return 2.0 * amplitude * np.sin(phase) - 2.0 * (np.pi - phase) / (2.0 * np.pi * 25.0)

    # The range is 0.98 or so, its twentieth 0.05; the mean over five samples takes 0.6 % of a ripple.
    few, many = 0.030, 0.040
    assert fall(few) < 0.047 < 0.053 < fall(many)
    assert rippled(few).teeth.tolist() == [0, 0]
    # The last top, at 0.97 s, has no deeper bottom after it than the end.
    assert np.all(rippled(many).teeth >= 24)
    assert np.allclose(rippled(many).periods, 0.04, rtol=1e-12)


def test_a_tooth_stands_out_of_the_noise_fourfold():
    t = np.arange(2000) / 2000.0
    crv = on_y(t, 0.5 * np.sin(2.0 * np.pi * 25.0 * t))
    # The teeth of Y are 1 rad/s from top to bottom, less 1 % that the mean of five samples takes; those of Z are 2.
    for noise, teeth in ((0.245, [24, 24]), (0.250, [0, 24]), (0.500, [0, 0])):
        found = envelopes(t, crv, 0.01, 0.99, noise=noise)
        assert found.teeth.tolist() == teeth
        assert np.isnan(found.periods).tolist() == [count == 0 for count in teeth]
    assert found.teeth.dtype.kind == "i"


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(("end", "teeth", "periods"), [(0.05, 1, np.nan), (0.09, 2, 0.04)])
def test_two_teeth_make_a_period(end, teeth, periods):
    t = np.arange(2000) / 2000.0
    found = envelopes(t, on_y(t, 0.1 * np.sin(2.0 * np.pi * 25.0 * t)), 0.0, end)
    assert found.teeth[0] == teeth
    assert found.periods[0] == pytest.approx(periods, rel=1e-12, nan_ok=True)


def test_the_period_is_the_median_of_the_intervals():
    """Tops at 100, 150, 200, 300: intervals 50, 50, 100 samples of half a millisecond."""
    t = np.arange(400) / 2000.0
    y = sum(np.cos(np.clip((np.arange(400) - top) / 20.0, -1.0, 1.0) * np.pi) for top in (100, 150, 200, 300))
    found = envelopes(t, on_y(t, y), 0.0, 0.2)
    assert found.teeth[0] == 4 and found.periods[0] == pytest.approx(0.025, rel=1e-12)


def test_instants_are_spread_from_the_first_sample_to_the_last():
    t = 2.0 + np.arange(1000) / 1000.0
    crv = on_y(t, np.sin(40.0 * t))
    found = envelopes(t, crv, 2.2, 2.5, points=7)
    assert np.allclose(found.t, np.linspace(2.2, 2.499, 7), rtol=0.0, atol=1e-12)
    assert found.upper.shape == found.lower.shape == (2, 7)
    assert len(envelopes(t, crv, 2.2, 2.5).t) == POINTS
    # At its ends it is the signal's own, as the mean of two samples there.
    for k, pair in ((0, crv[200:202]), (-1, crv[498:500])):
        for line in (found.upper, found.lower):
            assert np.allclose(line[:, k], pair[:, 1:].mean(axis=0), rtol=1e-12)


def test_where_there_is_no_tooth_it_follows_the_largest_values():
    """t^2 has no top. Stretches of 50 ms, from half of one after the start to as much before the end: the largest value
    of each is its last; the smallest, which the lower line takes, its first."""
    t = np.arange(1000) / 1000.0
    y = t**2
    found = envelopes(t, on_y(t, y), 0.0, 1.0, points=1000)
    smooth = running_mean(y, 1)
    heads = np.arange(25, 974, 50)[:-1]
    tops, bottoms = ([0, *knots, 999] for knots in (heads + 49, heads))
    assert np.allclose(found.upper[0], np.interp(t, t[tops], smooth[tops]), rtol=0.0, atol=1e-12)
    assert np.allclose(found.lower[0], np.interp(t, t[bottoms], smooth[bottoms]), rtol=0.0, atol=1e-12)
    # The other axis is twice the mirror image.
    assert np.allclose(found.upper[1], -2.0 * found.lower[0], rtol=0.0, atol=1e-12)
    assert np.allclose(found.lower[1], -2.0 * found.upper[0], rtol=0.0, atol=1e-12)


def test_between_two_tops_that_are_far_apart_it_follows_as_well():
    """Tops at 0.2 s and at 0.6 s, with a fourth power falling and rising between them."""
    t = np.arange(800) / 1000.0
    y = np.min([np.abs(t - bottom) for bottom in (0.0, 0.4, 0.8)], axis=0) ** 4
    found = envelopes(t, on_y(t, y), 0.0, 0.8, points=800)
    smooth = running_mean(y, 1)
    middle = np.arange(225, 575, 50)
    pieces = [a + int(np.argmax(smooth[a:b])) for a, b in zip(middle[:-1], middle[1:], strict=True)]
    inside = (t >= 0.2) & (t <= 0.6)
    knots = [200, *pieces, 600]
    assert found.teeth[0] == 2
    assert np.allclose(found.upper[0][inside], np.interp(t, t[knots], smooth[knots])[inside], rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("step", [0.1 / 64.0, 0.1001 / 64.0])
def test_a_tenth_of_a_second_without_a_tooth_is_not_long(step):
    """Up to 0.1 s the upper line is the chord; beyond, it also takes the largest value of a stretch of half of that."""
    t = np.arange(65) * step
    y = t**2
    found = envelopes(t, on_y(t, y), 0.0, 1.0, points=65)
    smooth = running_mean(y, 1)
    # Half of the slowest period are 32 samples, or 31: one stretch, from 16, or 15, to 47, or 45.
    knots = [0, 64] if step == 0.1 / 64.0 else [0, 45, 64]
    assert np.allclose(found.upper[0], np.interp(t, t[knots], smooth[knots]), rtol=0.0, atol=1e-15)


def test_less_than_a_tenth_of_a_second_is_not_long_whatever_the_time_of_day():
    """Half of the slowest period are 31.9 samples, and 63 have room for one stretch of 31 and its half twice."""
    t = 5.0 + np.arange(64) * 0.05 / 31.9
    y = (t - 5.0) ** 2
    smooth = running_mean(y, 1)
    found = envelopes(t, on_y(t, y), 5.0, 6.0, points=64)
    assert np.allclose(found.upper[0], np.interp(t, t[[0, -1]], smooth[[0, -1]]), rtol=0.0, atol=1e-12)


def test_eight_samples_are_enough_and_seven_are_not():
    t = np.arange(1000) / 1000.0
    assert envelopes(t, np.zeros((1000, 3)), 0.492, 0.5).t[0] == 0.492
    said = ("E-STRETCH", "arguments start, end", "7 samples between 0.493 and 0.5 s", "Give a stretch of the run.")
    assert refusal(envelopes, t, np.zeros((1000, 3)), 0.493, 0.5) == said
