"""Main impacts: found at the right instants, finer than a sample, in model and data alike.

Then main impacts of saw-teeth that are given sample by sample, at 1 kHz.
"""

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from rockref.measure.gyroscope import record, saturate
from rockref.measure.records.release import Gyro
from rockref.measure.signals.impacts import FLAT, _impact, checked_signal, main_impacts, swings
from rockref.measure.signals.running import running_mean
from tests.refusal import refused

# The low-pass of 300 Hz delays slow motion by 0.75 ms, and the half-way point of a step a little more.
DELAY = 0.75e-3
# A drop that takes no time is found late by up to this; see DROP_WINDOW.
LATE = 0.75e-3


@pytest.mark.parametrize("sign", [1, -1])
def test_clean_rocking_gives_the_closed_form(rocking, sign):
    motion = rocking(sign=sign)
    t = np.arange(0.0, 4.0, 0.0005)
    impacts = main_impacts(t, motion.crv(t))
    count = int((motion.times < 3.98).sum())
    assert len(impacts) == count
    # After a drop at once the rate goes on to fall at 3 rad/s^2, and half way down within 4 ms is late by that much.
    assert np.abs(impacts.times - motion.times[:count]).max() < LATE
    assert impacts.signs.tolist() == [sign * (-1) ** k for k in range(count)]
    # The mean of five samples up to the cusp (3 rad/s^2 steep) is 3e-3 rad/s below its tip, and may hold one after it.
    assert np.allclose(impacts.peaks, motion.before[:count], rtol=0.0, atol=6e-3)
    # The same fall of 3 rad/s^2 over 1.5 ms adds a quarter to a drop of 0.02 rad/s.
    assert np.allclose(impacts.drops, (motion.before - motion.after)[:count], rtol=0.4)


def test_instants_are_finer_than_a_sample(rocking, sensed):
    motion = rocking()
    errors = []
    for shift in np.arange(0.0, 1e-3, 1e-4):
        t, crv = sensed(motion, duration=2.5, seed=None, shift=float(shift))
        errors.append(main_impacts(t, crv).times - motion.times[:3] - shift - DELAY)
    # A drop of 2 ms between samples of 1 ms: interpolation follows it to a quarter of a sample; the bias is common.
    assert np.ptp(errors, axis=0).max() < 0.25e-3
    assert np.abs(errors).max() < LATE


def test_noise_moves_the_instants_by_less_than_a_quarter_of_a_sample(rocking, sensed):
    motion = rocking()
    reference = main_impacts(*sensed(motion, seed=None)).times
    found = np.array([main_impacts(*sensed(motion, seed=seed)).times for seed in range(20)])
    assert found.shape == (20, len(reference))
    # 0.05 deg/s over three samples on a drop of 1.1 deg/s in 3 ms is 0.08 ms; the cusp itself may move by a sample.
    assert (found - reference).std(axis=0).max() < 0.2e-3


@pytest.mark.parametrize("number", range(1, 12))
def test_shipped_runs_swing_to_and_fro(shipped, number):
    experiment = load_experiment(shipped / f"mystery-{number:02d}", uses=("fit",))
    for run in experiment.fit_runs():
        impacts = main_impacts(run.t, run.crv)
        first = 1 if run.block_turned == 0.0 else -1
        assert 7 <= len(impacts) <= 11
        assert impacts.signs.tolist() == [first * (-1) ** k for k in range(len(impacts))]
        # Energy is lost, so arcs become shorter and peaks lower; 2 % are left to vibration and a loose mass.
        assert np.all(np.diff(impacts.times, 2) < 0.02 + 0.02 * np.diff(impacts.times)[1:] + 0.06)
        assert np.all(impacts.peaks[2:] < 1.02 * impacts.peaks[:-2])
        assert np.all(impacts.drops > np.radians(0.4))


def test_repeated_runs_agree_on_the_second_impact(shipped):
    """The source: all runs agree until the second main impact. The control's two repeats, to 3 ms of wire jitter."""
    experiment = load_experiment(shipped / "mystery-08", uses=("fit",))
    gaps = [np.diff(main_impacts(r.t, r.crv).times[:2])[0] for r in experiment.fit_runs()[:2]]
    assert abs(gaps[0] - gaps[1]) < 6e-3


@pytest.mark.parametrize("limit", [34.0, 30.0, 20.0])
def test_clipped_records_keep_their_impacts(rocking, sensed, limit):
    motion = rocking()
    t, crv = sensed(motion)
    impacts = main_impacts(t, saturate(crv, np.radians(limit)))
    count = int((motion.times < 2.9).sum())
    assert len(impacts) == count
    # The middle of a flat top is the impact as far as the block rises as fast as it falls.
    assert np.abs(impacts.times - motion.times[:count]).max() < 0.02
    assert impacts.drops[0] == 0.0


def test_clatter_and_misalignment_make_no_impacts(rocking, sensed):
    motion = rocking()
    t, crv = sensed(motion)
    clatter = np.radians(5.0) * (2.0 * np.abs((t * 15.0) % 1.0 - 0.5) - 0.5)
    impacts = main_impacts(t, crv + np.stack((0.1 * clatter, clatter, clatter), axis=-1) + 0.01)
    assert np.abs(impacts.times - motion.times[: len(impacts)] - DELAY).max() < 2e-3 + LATE
    assert len(impacts) == int((motion.times < 2.98).sum())


def test_model_rate_and_sensor_rate_agree(rocking):
    """The same code on a model's 2 kHz and on what a gyroscope makes of it differs by the delay alone."""
    motion = rocking()
    t = np.arange(0.0, 3.0, 0.0005)
    crv = motion.crv(t)
    clean = main_impacts(t, crv).times
    recorded = main_impacts(*record(t, crv, Gyro(1000.0, 0.0, 300.0, 0.0))).times
    assert np.abs(recorded - clean - DELAY).max() < LATE


CUSP = 400


def swing(drop, top=0.5, count=1000, slope=0.001, fall=None):
    """A rate that grows by `slope` a sample to `top` at sample CUSP, loses what `drop` says in the next samples, and
    falls by `fall` a sample from there on."""
    k = np.arange(count)
    fall = slope if fall is None else fall
    lost = np.interp(k - CUSP, np.arange(len(drop) + 1), [0.0, *np.cumsum(drop)])
    after = np.maximum(k - CUSP - len(drop), 0)
    return np.where(k <= CUSP, top - slope * (CUSP - k), top - lost - fall * after)


def impacts(wx, start=0.0, **how):
    t = start + np.arange(len(wx)) / 1000.0
    return main_impacts(t, np.stack([wx, 0 * wx, 0 * wx], axis=-1), **how)


def by_definition(wx, start=0.0):
    """Middle of the drop that follows the largest rate, within 4 ms, of the mean over three samples."""
    fine = running_mean(wx, 1)
    peak = int(np.argmax(fine))
    bottom = peak + int(np.argmin(fine[peak : peak + 5]))
    down = fine[peak : bottom + 1]
    time = start + np.interp(-0.5 * (fine[peak] + fine[bottom]), -down, np.arange(peak, bottom + 1)) / 1000.0
    return time, fine[peak], fine[peak] - fine[bottom], peak


@pytest.mark.parametrize(
    "drop", [[0.05], [0.02, 0.03], [0.01, 0.05, 0.01], [0.0, 0.04], [0.02, 0.02, 0.02, 0.02, 0.02]]
)
@pytest.mark.parametrize("start", [0.0, 5.0])
def test_the_instant_is_the_middle_of_the_drop(drop, start):
    wx = swing(drop)
    found = impacts(wx, start)
    time, peak, size, sample = by_definition(wx, start)
    assert found.times[0] == pytest.approx(time, abs=1e-9)
    assert (found.peaks[0], found.drops[0]) == (pytest.approx(peak, rel=1e-9), pytest.approx(size, rel=1e-9))
    assert (found.samples[0], found.signs[0]) == (sample, 1)
    mirrored = impacts(-wx, start)
    assert mirrored.signs[0] == -1 and np.array_equal(mirrored.peaks, found.peaks)


def test_the_middle_of_a_drop_between_two_levels_is_known():
    """Level, a drop of 0.06 over two samples, level: half way down after one sample, whatever the mean."""
    wx = swing([0.03, 0.03], slope=1e-9, fall=0.0)
    wx[:300] = wx[700:] = 0.0
    found = impacts(wx)
    # The level rises by 1e-9 a sample, so that the cusp is its end.
    assert found.times[0] == pytest.approx(0.401, abs=1e-9)
    assert (found.peaks[0], found.drops[0]) == (pytest.approx(0.5), pytest.approx(0.06))


@pytest.mark.parametrize(("loss", "flat"), [(0.0099, True), (0.0101, False)])
def test_less_than_a_hundredth_is_a_flat_top(loss, flat):
    """Up to 1 rad/s, as good as level for 40 samples, a loss over two, level again for eight, and down."""
    wx = np.interp(np.arange(400), [0, 100, 140, 142, 150, 230, 399], [0, 1 - 1e-9, 1, 1 - loss, 1 - loss, 0.1, 0.05])
    found = impacts(wx)
    if not flat:
        # Half way down after one of the two samples.
        assert found.drops[0] == pytest.approx(loss, rel=1e-6) and found.times[0] == pytest.approx(0.141, abs=1e-6)
        return
    high = np.flatnonzero(running_mean(wx, 1) >= 0.99)
    assert (high[0], high[-1]) == (100, 149)
    assert found.times[0] == pytest.approx(0.5e-3 * (high[0] + high[-1]), abs=1e-12)
    assert found.samples[0] == (high[0] + high[-1]) // 2
    assert (found.peaks[0], found.drops[0]) == (pytest.approx(1.0), 0.0)


def test_a_flat_top_is_that_of_its_own_swing():
    """Two swings that are cut at 0.5 rad/s: the middle of each."""
    wx = 0.5 * np.clip(3.0 * np.sin(np.pi * np.arange(1001) / 400.0), -1.0, 1.0)
    found = impacts(wx)
    assert found.signs.tolist() == [1, -1, 1][: len(found)] and not found.drops[:2].any()
    assert found.times[:2] == pytest.approx([0.2, 0.6], abs=1e-9) and found.samples[:2].tolist() == [200, 600]


@pytest.mark.parametrize(("end", "found"), [(313, 1), (312, 0)])
def test_a_flat_top_within_12_ms_of_the_end_is_where_the_record_was_cut(end, found):
    """The mean over 11 samples is largest on the level, long before its end at sample 300."""
    wx = np.interp(np.arange(end), [0, 100, 200, 300, 400], [0.0, 1.0, 1.0 - 1e-6, 1.0 - 2e-6, 0.0])
    # It falls by a hundredth a sample from there, and is less than 0.99 of its top at once.
    assert np.flatnonzero(running_mean(wx, 1) >= 0.99)[-1] == 300
    assert len(impacts(wx)) == found


@pytest.mark.parametrize(("place", "height"), [(-13, 0.03), (12, 0.21)])
def test_the_largest_rate_is_looked_for_12_ms_about_the_smooth_one(place, height):
    """A wild sample so far from the cusp of the mean over 11 samples is in the mean of its neighbour, too."""
    for further, seen in ((0, True), (int(np.sign(place)), False)):
        wx = swing([0.05], slope=0.0005)
        smooth = int(np.argmax(running_mean(wx, 5)))
        wx[smooth + place + further] += height
        assert int(np.argmax(running_mean(wx, 5))) == smooth
        assert (abs(impacts(wx).samples[0] - smooth - place - further) <= 1) == seen


@pytest.mark.parametrize(("more", "found"), [(13, 1), (12, 0)])
def test_a_cusp_within_12_ms_of_the_end_is_where_the_record_was_cut(more, found):
    smooth = int(np.argmax(running_mean(swing([0.05]), 5)))
    assert len(impacts(swing([0.05], count=smooth + more))) == found


@pytest.mark.parametrize(("first", "found"), [(12, 1), (11, 0)])
def test_a_cusp_within_12_ms_of_the_begin_is_how_the_block_was_thrown(first, found):
    wx = swing([0.05])
    smooth = int(np.argmax(running_mean(wx, 5)))
    cut = wx[smooth - first :]
    # The shorter mean at the begin is lower, since the rate grows.
    assert int(np.argmax(running_mean(cut, 5))) == first
    assert len(impacts(cut)) == found


@pytest.mark.parametrize(("thrown", "found"), [([], 1), ([0.3], 0)])
def test_at_100_hz_two_samples_are_kept_from_the_ends_and_three_are_looked_at_for_the_drop(thrown, found):
    """The mean over three samples has its cusp at the third sample; where the first one is missing, at its first."""
    wx = np.array([0.3, 0.6, 0.9, 0.5, 0.4, 0.3, 0.2, 0.1, 0.0, 0.0])[len(thrown) :]
    t = np.arange(len(wx)) / 100.0
    got = main_impacts(t, np.stack([wx, 0 * wx, 0 * wx], axis=-1))
    assert len(got) == found
    if found:
        # From (0.6 + 0.9 + 0.5)/3 to (0.4 + 0.3 + 0.2)/3.
        assert got.samples[0] == 2 and got.drops[0] == pytest.approx(2.0 / 3.0 - 0.3, rel=1e-12)


def test_swings_below_a_twentieth_of_the_largest_rate_are_not_looked_at():
    """Saw-teeth of 1, -0.055 and 0.045 rad/s; the mean over 11 samples takes a little of each."""
    k = np.arange(1000)
    tooth = np.interp(k % 333, [0, 200, 202, 332], [0.0, 1.0, 0.9, 0.0])
    wx = tooth * np.repeat([1.0, -0.055, 0.045, 0.0], [333, 333, 333, 1])
    found = impacts(wx)
    assert found.signs.tolist() == [1, -1]
    assert impacts(wx, least_rate=0.5).signs.tolist() == [1]
    assert impacts(wx, least_rate=0.01).signs.tolist() == [1, -1, 1]
    assert len(impacts(wx, least_rate=1.5)) == 0


def test_none_has_columns_of_numbers():
    found = impacts(np.zeros(100))
    kinds = [column.dtype.kind for column in (found.times, found.signs, found.peaks, found.drops, found.samples)]
    assert kinds == ["f", "i", "f", "f", "i"]
    assert [a.dtype.kind for a in (impacts(swing([0.05])).signs, impacts(swing([0.05])).samples)] == ["i", "i"]


def test_a_swing_ends_after_the_middle_one_of_its_changes_of_sign():
    x = np.array([2.0, 0.5, -0.5, 0.5, -0.5, -2.0])
    assert swings(x, 1.0) == [(0, 3, 1), (3, 6, -1)]
    assert swings(-x, 1.0) == [(0, 3, -1), (3, 6, 1)]
    assert swings(np.array([2.0, -2.0]), 1.0) == [(0, 1, 1), (1, 2, -1)] and swings(x, 3.0) == []
    # Five changes, one after three samples without, and one back that comes after the next swing has started.
    assert swings(np.array([2.0, 0.5, -0.5, 0.5, -0.5, 0.5, -2.0]), 1.0) == [(0, 4, 1), (4, 7, -1)]
    assert swings(np.array([2.0, 0.5, 0.4, 0.3, -0.5, -2.0]), 1.0) == [(0, 4, 1), (4, 6, -1)]
    assert swings(np.array([2.0, 0.5, -2.0, 0.5, -2.0]), 1.0) == [(0, 2, 1), (2, 5, -1)]
    # What only reaches the threshold is not beyond it.
    assert swings(np.array([2.0, -1.0, 2.0]), 1.0) == [(0, 3, 1)]


def test_what_is_no_run_is_refused_and_what_is_one_is_made_numbers():
    t, crv = checked_signal(list(range(8)), [[0, 1, 2]] * 8)
    assert t.dtype == crv.dtype == np.float64 and crv.shape == (8, 3)
    shapes = "Give (N,) and (N, 3) with at least 8 samples."
    finite = "a value is not finite. Cut the run before it."
    for wrong, said in (
        ((np.arange(7.0), np.zeros((7, 3))), f"shapes (7,) and (7, 3). {shapes}"),
        ((np.arange(8.0), np.zeros((9, 3))), f"shapes (8,) and (9, 3). {shapes}"),
        ((np.zeros((8, 3)), np.zeros((8, 3))), f"shapes (8, 3) and (8, 3). {shapes}"),
        ((np.arange(8.0), np.full((8, 3), np.nan)), finite),
        ((np.full(8, np.inf), np.zeros((8, 3))), finite),
    ):
        for ask in (checked_signal, main_impacts):
            error = refused(ask, *wrong)
            assert str(error) == f"arguments t, crv: {said} [E-SIGNAL]"


def test_a_flat_top_beyond_its_swing_ends_at_its_peak_and_begins_a_hundredth_below():
    t, peak = np.arange(200) * 1e-3, 103
    fine = np.where(np.arange(200) < peak, 0.5, 0.995)
    fine[peak - 1 : peak + 1] = 1.0 - FLAT, 1.0
    # The swing ends at row 100, where the smooth rate is largest.
    time, sign, height, drop, row = _impact(t, fine, np.minimum(t, t[100]), 50, 101, -1)
    assert time == 0.5 * (t[peak - 1] + t[peak])
    assert (sign, height, drop, row) == (-1, 1.0, 0.0, peak - 1)
