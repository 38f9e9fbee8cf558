"""What a signal says of itself does not depend on where it hangs in time, which way it is turned, or its scale."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from rockref.measure.gyroscope import low_pass, quantise, saturate
from rockref.measure.signals.activity import leakage, out_of_plane
from rockref.measure.signals.envelopes import envelopes
from rockref.measure.signals.impacts import main_impacts
from rockref.measure.signals.ledger import AFTER, FIT_WINDOW, energy_ledger, rocking_block
from rockref.measure.signals.noise import noise_floor
from rockref.measure.signals.phases import phases
from rockref.measure.signals.spectra import amplitude_spectrum

WIDTH, HEIGHT = 0.1, 0.688
ALPHA, RADIUS = math.atan2(WIDTH, HEIGHT), 0.5 * math.hypot(WIDTH, HEIGHT)
P = math.sqrt(0.75 * 9.81 / RADIUS)
BLOCK = rocking_block(54.0, WIDTH, HEIGHT)


@st.composite
def runs(draw) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A block let go at some tilt, with some loss, clatter and noise: times, rates, true impact times."""
    angle = draw(st.floats(0.05, 0.125))
    restitution = draw(st.floats(0.9, 0.97))
    clatter = draw(st.floats(0.0, 0.08))
    frequency = draw(st.floats(10.0, 40.0))
    seed = draw(st.integers(0, 2**32 - 1))
    t = np.arange(0.0, 2.0, 0.001)
    wx, time, times, sign = (ALPHA - angle) * P * np.sinh(P * t), 0.0, [], 1
    for k in range(8):
        quarter = math.acosh(ALPHA / (ALPHA - angle)) / P
        time += quarter if k == 0 else 2.0 * quarter
        rate = restitution * P * math.sqrt(ALPHA**2 - (ALPHA - angle) ** 2)
        angle = ALPHA - math.sqrt(ALPHA**2 - (rate / P) ** 2)
        s = t - time
        wx = np.where(s >= 0.0, sign * (rate * np.cosh(P * s) - ALPHA * P * np.sinh(P * s)), wx)
        times.append(time)
        sign = -sign
    wave = clatter * np.sin(2.0 * np.pi * frequency * t) * (t > times[0])
    crv = np.stack((wx + 0.1 * wave, wave, 1.5 * wave), axis=-1)
    crv += 8.7e-4 * np.random.default_rng(seed).standard_normal(crv.shape)
    return t, crv, np.array(times)


@given(runs())
def test_impacts_are_found_whatever_the_run(run):
    t, crv, times = run
    impacts = main_impacts(t, crv)
    expected = times[times < t[-1] - 0.02]
    assert len(impacts) in (len(expected), int((times < t[-1]).sum()))
    # Clatter of a tenth of 0.08 rad/s on the main axis moves the cusp of 3 rad/s^2 by a few milliseconds.
    assert np.abs(impacts.times - times[: len(impacts)]).max() < 6e-3
    assert impacts.signs.tolist() == [(-1) ** k for k in range(len(impacts))]


@given(runs())
def test_mirrored_run_has_the_mirrored_impacts(run):
    t, crv, _ = run
    one, other = main_impacts(t, crv), main_impacts(t, -crv)
    assert np.array_equal(one.times, other.times)
    assert np.array_equal(one.signs, -other.signs)
    assert np.array_equal(one.drops, other.drops)
    a, b = energy_ledger(t, crv, BLOCK), energy_ledger(t, -crv, BLOCK)
    assert np.array_equal(a.energy_before, b.energy_before)
    assert np.array_equal(a.apex_angles, -b.apex_angles)


@given(runs(), st.sampled_from([0.5, 2.0, 1024.0]))
def test_scale_of_the_rates_scales_what_it_must(run, scale):
    """Powers of two, so that the bits are the same."""
    t, crv, _ = run
    one, other = main_impacts(t, crv), main_impacts(t, scale * crv)
    assert np.array_equal(one.times, other.times)
    assert np.array_equal(scale * one.peaks, other.peaks)
    a, b = energy_ledger(t, crv, BLOCK), energy_ledger(t, scale * crv, BLOCK)
    assert np.array_equal(a.restitution, b.restitution, equal_nan=True)
    assert np.allclose(scale**2 * a.energy_after, b.energy_after, rtol=1e-12, equal_nan=True)
    assert np.allclose(scale * noise_floor(t, crv).sigma, noise_floor(t, scale * crv).sigma, rtol=1e-9)


@given(runs(), st.integers(-8, 8))
def test_shift_of_time_shifts_what_it_must(run, seconds):
    t, crv, _ = run
    one, other = main_impacts(t, crv), main_impacts(t + seconds, crv)
    assert np.allclose(one.times + seconds, other.times, rtol=0.0, atol=1e-9)
    a, b = phases(t, crv), phases(t + seconds, crv)
    assert [name for name, *_ in a.intervals] == [name for name, *_ in b.intervals]
    assert np.allclose(a.shares, b.shares, rtol=1e-9)


@given(runs())
def test_ledger_balances(run):
    """Energy after one impact = loss of the arc + energy before the next; before = loss of the impact + after."""
    t, crv, _ = run
    ledger = energy_ledger(t, crv, BLOCK)
    scale = ledger.energy_before[0]
    known = np.isfinite(ledger.energy_after)
    assert np.allclose(
        ledger.energy_before - ledger.impact_loss, ledger.energy_after, atol=1e-12 * scale, equal_nan=True
    )
    assert np.allclose(ledger.energy_after[:-1] - ledger.free_loss, ledger.energy_before[1:], atol=1e-12 * scale)
    # Of impacts with a whole fit window behind them. Drawn are 0.90 to 0.97. Clatter of 0.008 rad/s on the main axis,
    # carried on from fits of 100 ms, and an instant that is 1 ms off take up to 0.0105 rad/s off either rate, of which
    # none is below 0.23 (2500 draws): 0.90 - 1.9 x 0.0105 / 0.23 = 0.81. A last arc that is cut is read from less.
    whole = known & (ledger.times + AFTER + FIT_WINDOW <= t[-1])
    assert np.all(ledger.restitution[whole] > 0.8) and np.all(ledger.restitution[whole] < 1.05)
    assert np.all(ledger.restitution[known] > 0.0)
    assert np.all(ledger.path > 0.0) and np.all(ledger.square > 0.0) and np.all(ledger.out_of_plane >= 0.0)


@given(runs(), st.floats(-0.1, 0.1), st.floats(-0.1, 0.1))
def test_leakage_is_taken_out_again(run, y, z):
    t, crv, _ = run
    impacts = main_impacts(t, crv)
    leaked = crv + np.stack((0 * t, y * crv[:, 0], z * crv[:, 0]), axis=-1)
    plain = leakage(t, crv, impacts)
    found = leakage(t, leaked, impacts)
    assert np.allclose(found.slopes - plain.slopes, [y, z], rtol=0.0, atol=1e-9)
    assert np.allclose(out_of_plane(leaked, found), out_of_plane(crv, plain), rtol=0.0, atol=1e-9)


@given(runs())
def test_envelopes_change_sides_with_the_signal(run):
    t, crv, _ = run
    one, other = envelopes(t, crv, 0.6, 1.4), envelopes(t, -crv, 0.6, 1.4)
    assert np.array_equal(one.upper, -other.lower)
    assert np.all(one.upper >= one.lower - 1e-9)


signals = st.integers(0, 2**32 - 1).map(lambda seed: np.random.default_rng(seed).standard_normal((300, 3)))


@given(signals, signals, st.floats(-10.0, 10.0), st.floats(0.0, 0.2))
def test_spectra_are_linear_in_amplitude_and_obey_the_triangle(a, b, factor, start):
    t = np.arange(300) / 1000.0
    frequencies = np.arange(5.0, 100.0, 5.0)
    one, other = (amplitude_spectrum(t, x, start, 0.3, frequencies).amplitudes for x in (a, b))
    both = amplitude_spectrum(t, a + factor * b, start, 0.3, frequencies).amplitudes
    assert np.all(both <= one + abs(factor) * other + 1e-9)
    assert np.all(both >= np.abs(one - abs(factor) * other) - 1e-9)


@given(signals, signals, st.floats(-10.0, 10.0), st.floats(20.0, 900.0))
def test_low_pass_is_linear_and_keeps_what_stands_still(a, b, factor, bandwidth):
    step = 1e-4
    together = low_pass(a + factor * b, step, bandwidth)
    apart = low_pass(a, step, bandwidth) + factor * low_pass(b, step, bandwidth)
    assert np.allclose(together, apart, rtol=0.0, atol=1e-10 * (1.0 + abs(factor)))
    assert np.allclose(low_pass(np.full((50, 3), factor), step, bandwidth), factor, rtol=1e-9, atol=1e-12)


@given(signals, st.floats(1e-6, 0.5), st.floats(0.1, 3.0))
def test_steps_and_limits_change_nothing_the_second_time(x, resolution, limit):
    once = quantise(x, resolution)
    assert np.array_equal(quantise(once, resolution), once)
    assert np.array_equal(quantise(-x, resolution), -once)
    assert np.all(np.abs(once - x) <= 0.5 * resolution * (1.0 + 1e-9))
    cut = saturate(x, limit)
    assert np.array_equal(saturate(cut, limit), cut)
    assert np.all(np.diff(cut, axis=0) * np.diff(x, axis=0) >= 0.0)
