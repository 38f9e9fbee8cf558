"""The noise floor: known noise is found again, under motion and impacts.

Then the noise floor of signals that repeat every 20 ms, so that half-overlapping windows of 40 ms are all alike.
"""

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from rockref.measure.signals.noise import noise_floor, smallest_step
from tests.refusal import refusal


@pytest.mark.parametrize("noise", [1e-4, 8.7e-4, 5e-3])
def test_known_noise_is_found_again(rocking, sensed, noise):
    t, crv = sensed(rocking(), noise=noise)
    found = noise_floor(t, crv)
    stated = np.hypot(noise, np.radians(0.01) / np.sqrt(12.0))
    # Thirty windows of 40 samples give 3 %; the calm half of them is taken, which is 3 % lower.
    assert np.allclose(found.sigma, stated, rtol=0.1)
    assert found.calm.min() > 0.5
    # The cubic takes four of forty degrees of freedom, which leaves -0.1 between neighbours.
    assert np.abs(found.whiteness).max() < 0.2


@pytest.mark.parametrize("share", [0.3, 0.6, 0.9])
@pytest.mark.parametrize("side", [-1, 1, 0])
def test_tops_that_were_cut_hold_no_noise(rocking, sensed, share, side):
    """On both sides, or on one; the other axes are what they were, and where all is flat, nothing is calm but that."""
    t, crv = sensed(rocking(), noise=8.7e-4)
    limit = share * np.abs(crv[:, 0]).max()
    low, high = (-np.inf if side > 0 else -limit), (np.inf if side < 0 else limit)
    cut = np.column_stack([np.clip(crv[:, 0], low, high), crv[:, 1:]])
    found, whole = noise_floor(t, cut), noise_floor(t, crv)
    assert np.array_equal(found.sigma[1:], whole.sigma[1:])
    # Fewer windows are left: a quarter of thirty gives 6 %.
    assert found.sigma[0] == pytest.approx(whole.sigma[0], rel=0.15)
    held = np.column_stack([np.full(len(t), limit), crv[:, 1:]])
    assert noise_floor(t, held).sigma[0] < 1e-12


def test_slow_disturbance_is_told_from_white_noise(rocking, sensed):
    t, crv = sensed(rocking(), noise=2e-4)
    hum = 2e-3 * np.sin(2.0 * np.pi * 100.0 * t)
    found = noise_floor(t, crv + np.stack((0 * t, hum, 0 * t), axis=-1))
    assert found.whiteness[1] > 0.5 > 0.2 > abs(found.whiteness[2])
    assert found.sigma[1] == pytest.approx(2e-3 / np.sqrt(2.0), rel=0.1)


def test_clean_model_has_next_to_no_noise(rocking):
    t = np.arange(0.0, 3.0, 0.0005)
    assert noise_floor(t, rocking().crv(t)).sigma.max() < 1e-7


@pytest.mark.parametrize("number", range(1, 12))
def test_data_sheet_of_the_shipped_experiments_holds(shipped, number):
    experiment = load_experiment(shipped / f"mystery-{number:02d}", uses=("fit",))
    for run in experiment.fit_runs():
        found = noise_floor(run.t, run.crv)
        # Clatter leaves few calm stretches, and base vibration some motion in them.
        assert np.all(np.abs(found.sigma / experiment.gyro.noise - 1.0) < 0.2)
        assert np.allclose(found.resolution, experiment.gyro.resolution, rtol=1e-6)


# One period of 20 samples at 1 kHz of three axes.
PATTERN = np.random.default_rng(7).standard_normal((20, 3))


def left_of_a_cubic(window):
    """What a cubic through one window (40, 3) leaves."""
    place = np.arange(len(window))
    return np.stack([x - np.polyval(np.polyfit(place, x, 3), place) for x in window.T], axis=-1)


def test_sigma_and_whiteness_of_windows_that_are_all_alike():
    t = 3.0 + np.arange(400) / 1000.0
    found = noise_floor(t, np.tile(PATTERN, (20, 1)))
    rest = left_of_a_cubic(np.tile(PATTERN, (2, 1)))
    # Forty samples less the four numbers of a cubic; polyfit and QR differ by rounding.
    assert np.allclose(found.sigma, np.sqrt((rest**2).sum(axis=0) / 36.0), rtol=1e-9)
    assert np.allclose(found.whiteness, (rest[1:] * rest[:-1]).mean(axis=0) / (rest**2).mean(axis=0), rtol=1e-9)
    # 19 windows of 40 samples, every 20 of 400, count for 20 ms each.
    assert np.allclose(found.calm, 19 * 0.020, rtol=1e-9)
    assert np.array_equal(found.resolution, np.zeros(3))
    # Without the last sample the last window is not whole.
    assert np.allclose(noise_floor(t[:-1], np.tile(PATTERN, (20, 1))[:-1]).calm, 18 * 0.020, rtol=1e-9)


def test_windows_of_41_samples_follow_every_20():
    """40 ms at 1025 Hz: half of a window is 20 whole samples, of which 19 windows count."""
    found = noise_floor(np.arange(401) / 1025.0, np.tile(PATTERN, (21, 1))[:401])
    assert np.allclose(found.calm, 19 * 20 / 1025.0, rtol=1e-9)


def test_a_cubic_is_no_noise():
    t = np.arange(400) / 1000.0
    cubic = np.stack([(t - 0.1) ** 3, 2.0 + t - t**2, -5.0 * t**3], axis=-1)
    assert noise_floor(t, cubic).sigma.max() < 1e-12
    # Of the fourth power 8/35 P4 is left (Legendre), of mean 1/3, in units of half a window; 40 samples for 36
    # degrees of freedom add a tenth.
    left = 8.0 / 35.0 / 3.0 * 0.02**4
    assert np.allclose(noise_floor(t, np.stack([t**4] * 3, axis=-1)).sigma, left, rtol=0.1)


def test_only_calm_windows_count_each_axis_its_own():
    """The middle is twice as loud on Y and 1.4 times on Z: beyond and within half as much again as the calmest."""
    crv = np.tile(PATTERN, (20, 1))
    loud = slice(160, 240)
    crv[loud] *= [1.0, 2.0, 1.4]
    found = noise_floor(np.arange(400) / 1000.0, crv)
    plain = noise_floor(np.arange(400) / 1000.0, np.tile(PATTERN, (20, 1)))
    # Windows begin at 0, 20, ...: 3 lie in the loud part, and the 2 across its edges are louder than 1.5 times, too.
    assert np.allclose(found.calm[[0, 2]], 19 * 0.020, rtol=1e-9)
    assert found.calm[1] == pytest.approx(14 * 0.020, rel=1e-9)
    # More than half of the windows are calm in all cases: the median is theirs.
    assert np.allclose(found.sigma, plain.sigma, rtol=1e-9)
    assert found.whiteness[1] == pytest.approx(plain.whiteness[1], rel=1e-9)


@pytest.mark.parametrize(
    ("first", "last", "left"),
    # Windows of 40 begin at 0, 20, ...: four samples are no top, five are; where four windows are left, they tell.
    [(109, 113, 19), (109, 114, 17), (119, 124, 16), (100, 140, 16), (380, 400, 18), (0, 300, 4)],
)
def test_windows_that_reach_into_a_cut_top_do_not_count(first, last, left):
    """As many samples as told stand at the largest number of X; what they leave untouched is as loud as it was."""
    crv = np.tile(PATTERN, (20, 1))
    plain = noise_floor(np.arange(400) / 1000.0, crv)
    crv[first:last, 0] = PATTERN[:, 0].min()
    found = noise_floor(np.arange(400) / 1000.0, crv)
    assert np.allclose(found.calm, [left * 0.020, 19 * 0.020, 19 * 0.020], rtol=1e-9)
    assert np.allclose(found.sigma, plain.sigma, rtol=1e-9)


def test_silence_has_no_noise_and_no_colour():
    found = noise_floor(np.arange(400) / 1000.0, np.zeros((400, 3)))
    for values in (found.sigma, found.whiteness, found.resolution):
        assert not values.any()


def test_slow_records_have_windows_of_eight_samples():
    """At 50 Hz 40 ms are two samples, with which a cubic is not left anything: twice as many as it has numbers."""
    t = np.arange(32) / 50.0
    crv = np.random.default_rng(1).standard_normal((32, 3))
    windows = np.stack([left_of_a_cubic(crv[k : k + 8]) for k in range(0, 25, 4)])
    rms = np.sqrt((windows**2).sum(axis=1) / 4.0)
    calm = rms <= 1.5 * np.percentile(rms, 10.0, axis=0)
    found = noise_floor(t, crv)
    assert np.allclose(found.sigma, [np.median(rms[calm[:, k], k]) for k in range(3)], rtol=1e-9)
    assert np.allclose(found.calm, calm.sum(axis=0) * 4 / 50.0, rtol=1e-9)
    said = ("E-SIGNAL", "arguments t, crv", "31 samples, less than four windows of 8", "Give a longer run.")
    assert refusal(noise_floor, t[:31], crv[:31]) == said


STEPS = np.rint(10.0 * np.random.default_rng(2).standard_normal(300))


@pytest.mark.parametrize("step", [0.05, 1e-13, 1e6])
def test_the_step_is_found_in_any_unit(step):
    found = smallest_step(np.stack([np.ones(300), step * STEPS, step * STEPS + step / 3.0], axis=-1))
    # The levels are multiples to rounding, and so are their differences.
    assert np.allclose(found, [0.0, step, step], rtol=1e-9, atol=0.0)


def test_rounding_of_a_level_is_no_step():
    """The same level, written in two ways, a part in 10^11 apart."""
    twice = 0.05 * STEPS
    twice[::2] *= 1.0 + 1e-11
    assert smallest_step(np.stack([twice] * 3, axis=-1)) == pytest.approx(0.05, rel=1e-9)


def test_values_that_are_no_multiples_have_no_step():
    """Seven values in turn, one of which is off the grid by a fiftieth of a step; and a ramp, with no level twice."""
    values = np.tile([0.0, 1.0, 2.0, 4.0, 5.02, 7.0, 8.0], 40)
    assert not smallest_step(np.stack([values, 0.3 * np.arange(280.0), values**1.1], axis=-1)).any()
    values = np.tile([0.0, 1.0, 2.0, 4.0, 5.0002, 7.0, 8.0], 40)
    assert smallest_step(np.stack([values] * 3, axis=-1)) == pytest.approx(0.9998, abs=3e-4)


def test_a_short_run_of_a_small_block_has_shorter_windows():
    t = np.arange(100) * 1e-3
    crv = np.random.default_rng(0).standard_normal((100, 3))
    assert refusal(noise_floor, t, crv)[2] == "100 samples, less than four windows of 40"
    assert noise_floor(t, crv, window=0.02).sigma.shape == (3,)
