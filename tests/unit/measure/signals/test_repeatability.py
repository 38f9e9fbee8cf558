"""Repeated runs: their band, their spread, and how long they agree.

Then repeated runs that differ by what is known, on a noise that repeats every 20 ms and is the same in all of them.
"""

from dataclasses import replace

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from rockref.measure.records.release import Run
from rockref.measure.signals.impacts import main_impacts
from rockref.measure.signals.noise import noise_floor
from rockref.measure.signals.repeatability import _aligned, repeat_groups, repeatability
from tests.refusal import refused

NOISE = 8.7e-4


def test_repeats_that_differ_by_noise_agree_throughout(rocking, sensed):
    motion = rocking()
    found = repeatability([sensed(motion, seed=seed, shift=0.004 * seed) for seed in range(3)])
    quiet = (found.t > -0.4) & (found.t < -0.05)
    assert np.allclose(np.sqrt((found.spread[quiet] ** 2).mean(axis=0)), NOISE, rtol=0.15)
    assert np.isinf(found.horizon[1:]).all() and np.isinf(found.alike_until).all()
    assert np.allclose(found.noise, NOISE, rtol=0.1)
    # The common drop of each run is put at zero to a fraction of a sample.
    assert np.abs(found.impacts.std(axis=0)).max() < 0.5e-3
    assert found.impacts.shape == (3, 4) and not found.impacts[:, 0].any()
    assert np.all((found.lower <= found.mean) & (found.mean <= found.upper))


def test_control_agrees_until_the_second_impact(shipped):
    """As the source says of its runs: quasi-identical until the second main impact, not long after."""
    experiment = load_experiment(shipped / "mystery-08", uses=("fit",))
    found = repeatability([(run.t, run.crv) for run in repeat_groups(experiment.runs)[0]])
    second = found.impacts[:, 1].mean()
    assert np.all(found.alike_until[1:] > 0.9 * second)
    assert np.all(found.alike_until[1:] < 2.0 * second)
    assert np.all(found.horizon > 0.5 * second)


def test_base_vibration_is_not_locked_to_the_release(shipped):
    """In mystery-06 repeated runs differ before anything has happened; in the control they do not."""
    shaken = load_experiment(shipped / "mystery-06", uses=("fit",))
    found = repeatability([(run.t, run.crv) for run in repeat_groups(shaken.runs)[0]])
    assert np.all(found.horizon[:2] < -0.3)


PATTERN = 1e-3 * np.random.default_rng(7).standard_normal((20, 3))


@pytest.fixture(scope="module")
def base(rocking):
    """Two seconds at 1 kHz: two main impacts, and the pattern on all axes."""
    t = np.arange(2000) / 1000.0
    return t, rocking().crv(t) + np.tile(PATTERN, (100, 1))


def moved(signal, offset):
    """The same run with a constant rate more on each axis (3,)."""
    return signal[0], signal[1] + np.asarray(offset)


def test_mean_band_and_spread_of_two_runs(base):
    """One 0.02 rad/s above, one 0.02 below on Y: the standard deviation of the two is 0.02 sqrt(2)."""
    t, crv = base
    up, down = moved(base, [0.0, 0.02, 0.0]), moved(base, [0.0, -0.02, 0.0])
    found = repeatability([up, down])
    zero = main_impacts(t, crv).times[0]
    assert found.t[0] == pytest.approx(-np.floor(zero * 1000.0) / 1000.0, abs=1e-9)
    assert np.diff(found.t) == pytest.approx(np.full(len(found.t) - 1, 1e-3), rel=1e-9)
    assert found.t[-1] == pytest.approx(np.floor((1.999 - zero) * 1000.0) / 1000.0, abs=1e-9)
    assert found.upper[:, 1] - found.mean[:, 1] == pytest.approx(np.full(len(found.t), 0.02), rel=1e-9)
    assert found.mean[:, 1] - found.lower[:, 1] == pytest.approx(np.full(len(found.t), 0.02), rel=1e-9)
    assert found.spread[:, 1] == pytest.approx(np.full(len(found.t), 0.02 * np.sqrt(2.0)), rel=1e-9)
    assert np.abs(found.spread[:, [0, 2]]).max() < 1e-12
    sigma = noise_floor(t, crv).sigma
    # The noise of one run, not of their difference.
    assert found.noise == pytest.approx(sigma, rel=1e-9)
    assert found.smooth_spread[:, 1] == pytest.approx(np.full(len(found.t), np.sqrt(8e-4 - sigma[1] ** 2)), rel=1e-9)
    assert not found.smooth_spread[:, [0, 2]].any()
    # They differ on Y from the beginning, and nowhere else.
    assert found.horizon.tolist() == [np.inf, found.t[0], np.inf]
    assert found.impacts == pytest.approx(np.tile(main_impacts(t, crv).times - zero, (2, 1)), abs=1e-12)


def test_impacts_are_those_that_all_runs_have(base):
    t, crv = base
    times = main_impacts(t, crv).times
    short = t < 0.5 * (times[0] + times[1])
    found = repeatability([base, (t[short], crv[short])])
    assert found.impacts == pytest.approx(np.zeros((2, 1)), abs=1e-12)


def test_the_noise_of_unlike_runs_is_their_quadratic_mean(base, rocking):
    t, _ = base
    loud = t, rocking().crv(t) + 3.0 * np.tile(PATTERN, (100, 1))
    sigma = noise_floor(*base).sigma
    # Quiet and three times as loud: root of the mean of 1 and 9.
    assert repeatability([base, loud]).noise == pytest.approx(np.sqrt(5.0) * sigma, rel=1e-3)


def stepped(signal, time, step):
    """The same run with a rate on Y from a time on, s after the release."""
    t, crv = signal
    crv = crv.copy()
    crv[t >= time, 1] += step
    return t, crv


def test_the_horizon_is_where_the_spread_of_50_ms_passes_three_noise_widths(base):
    """Two runs differ by D from 1.3 s on. Of the 51 samples of the window k have a variance of D^2/2: the first k with
    k D^2/102 - sigma^2 > 9 sigma^2."""
    sigma = noise_floor(*base).sigma[1]
    for factor, k in ((8.0, 16), (12.0, 8)):
        found = repeatability([base, stepped(base, 1.3, factor * sigma)])
        assert (k - 1) * factor**2 / 102 < 10 < k * factor**2 / 102
        zero = main_impacts(*base).times[0]
        # With the cubic between the samples the step reaches half a sample further, and the grid ends on whole ones.
        assert found.horizon[1] + zero == pytest.approx(1.3 - 0.025 + 0.001 * (k - 1), abs=1.5e-3)
        assert found.horizon[0] == np.inf


def test_a_spread_of_just_less_than_three_noise_widths_is_none(base):
    """The variance of two runs that differ by D is D^2/2, less that of the noise: 4.4 noise widths are not enough."""
    sigma = noise_floor(*base).sigma[1]
    for factor, seen in ((4.4, False), (4.55, True)):
        found = repeatability([base, moved(base, [0.0, factor * sigma, 0.0])])
        assert np.isfinite(found.horizon[1]) == seen


def waves(base, size, other):
    """Two runs with waves of 25 Hz on Y, of these sizes, from 0.8 s on."""
    t, crv = base
    both = []
    for amplitude in (size, other):
        wave = np.where(t >= 0.8, amplitude * np.sin(2.0 * np.pi * 25.0 * t), 0.0)
        both.append((t, crv + np.stack((0 * t, wave, 0 * t), axis=-1)))
    return both


@pytest.mark.parametrize(("other", "alike"), [(0.053, True), (0.046, False)])
def test_runs_are_alike_while_their_spread_is_half_of_their_motion(base, other, alike):
    """Amplitudes a and b: spread |a - b|/sqrt(2), motion sqrt((a^2 + b^2)/2), both as RMS.

    Half of it: (a - b)^2 = (a^2 + b^2)/4, or b/a = (4 - sqrt(7))/3 = 0.4514.
    """
    found = repeatability(waves(base, 0.11, other))
    assert np.isinf(found.alike_until[1]) == alike
    assert np.isinf(found.alike_until[[0, 2]]).all()


def test_runs_part_where_the_motion_of_100_ms_has_grown_from_the_noise(base):
    """Opposite waves: all of the window's motion is spread, and counts when it is five noise widths."""
    sigma = noise_floor(*base).sigma[1]
    a = 0.05
    found = repeatability(waves(base, a, -a))
    zero = main_impacts(*base).times[0]
    # Of 101 samples k have a mean square of a^2/2: k a^2/202 = 25 sigma^2 after some samples, each of its own phase.
    k = 25.0 * sigma**2 * 202 / a**2
    assert found.alike_until[1] + zero == pytest.approx(0.8 - 0.05 + 0.001 * k, abs=6e-3)


def test_small_motion_says_nothing_about_likeness(base):
    """Waves of f noise widths, and the noise, have a mean of sqrt(f^2/2 + 1): five are reached with 6.9."""
    sigma = noise_floor(*base).sigma[1]
    for factor, parted in ((6.3, False), (7.6, True)):
        found = repeatability(waves(base, factor * sigma, -factor * sigma))
        assert np.isfinite(found.alike_until[1]) == parted


def test_runs_are_compared_where_both_are_at_the_coarser_rate(base):
    t, crv = base
    late = t[100:], crv[100:]
    coarse = t[:1900:2], crv[:1900:2]
    found = repeatability([late, coarse])
    zeros = [main_impacts(*signal).times[0] for signal in (late, coarse)]
    assert np.diff(found.t) == pytest.approx(np.full(len(found.t) - 1, 2e-3), rel=1e-9)
    # The late one begins the comparison, the short one ends it, both on whole steps of the coarser from zero.
    assert 0.0 <= found.t[0] - (0.1 - zeros[0]) < 2e-3
    assert 0.0 <= (t[:1900:2][-1] - zeros[1]) - found.t[-1] < 2e-3
    assert np.abs(found.t).min() < 1e-12


def test_samples_that_lie_on_the_common_axis_belong_to_it():
    """The first and the last one, too, where their distance from the impact is a whole number of steps to rounding."""
    t = 0.3 + np.arange(100) / 1000.0
    crv = np.stack([t, t**2, t**3], axis=-1)
    for zero in (0.35, 0.337, 0.3091):
        grid, stack = _aligned([(t, crv), (t, crv)], [zero, zero])
        first = np.round((t[0] - zero) * 1000.0, 6)
        expected = np.arange(np.ceil(first), np.ceil(first) + (100 if first == np.rint(first) else 99)) / 1000.0
        assert grid == pytest.approx(expected, abs=1e-12)
        assert stack[1, :, 1] == pytest.approx((grid + zero) ** 2, abs=1e-9)


def run(id, **values):
    t = np.arange(10) / 1000.0
    plain = Run(id, f"{id}.csv", "fit", 0.117, 0.0, t, np.zeros((10, 3)))
    return replace(plain, **values)


def test_repeats_have_one_tilt_and_one_posture_and_are_loaded():
    runs = [
        run("a"), run("b", release_tilt=0.1), run("c"), run("d", block_turned=np.pi), run("e", t=None, crv=None),
        run("f", crv=None), run("g", release_tilt=0.1), run("h", release_tilt=0.09),
    ]  # fmt: skip
    assert [[one.id for one in group] for group in repeat_groups(runs)] == [["a", "c"], ["b", "g"]]


def test_what_is_said_where_nothing_can_be_compared(base):
    still = base[0], np.zeros_like(base[1])
    for signals, said in (
        ([base], "argument signals: 1 runs. Give two or more repeated runs. [E-REPEATS]"),
        ([base, still, still], "argument signals[1]: the run has no main impact. Leave it out. [E-REPEATS]"),
    ):
        error = refused(repeatability, signals)
        assert str(error) == said
