"""Main impacts: found at the right instants, finer than a sample, in model and data alike."""

import numpy as np
import pytest

from rockref.measure.experiment import Gyro, load_experiment
from rockref.measure.gyroscope import record, saturate
from rockref.measure.impacts import main_impacts, swings
from rockref.model.errors import InputError

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


def test_record_that_ends_before_the_impact_has_none(rocking):
    motion = rocking()
    t = np.arange(0.0, motion.times[0], 0.001)
    assert len(main_impacts(t, motion.crv(t))) == 0
    longer = np.arange(0.0, motion.times[0] + 0.03, 0.001)
    assert len(main_impacts(longer, motion.crv(longer))) == 1


def test_block_at_rest_has_none():
    t = np.arange(1000) / 1000.0
    impacts = main_impacts(t, np.zeros((1000, 3)))
    assert len(impacts) == 0 and impacts.times.shape == impacts.signs.shape == (0,)


def test_small_swings_can_be_left_out(rocking):
    motion = rocking()
    t = np.arange(0.0, 4.0, 0.001)
    # Compared with the mean over 9 ms about the cusp, which is 2 % below it.
    limit = motion.before[3]
    assert len(main_impacts(t, motion.crv(t), least_rate=float(limit))) == 3


def test_swings_turn_only_beyond_the_threshold():
    x = np.array([0.0, 2.0, 0.1, -0.1, 0.1, -2.0, -0.1, 0.1, -0.1, -2.0, 2.0])
    found = swings(x, 1.0)
    assert [s for *_, s in found] == [1, -1, 1]
    assert [f for f, *_ in found][1:] == [last for _, last, _ in found][:-1]
    assert found[0][0] == 0 and found[-1][1] == len(x)
    assert swings(x, 3.0) == []


@pytest.mark.parametrize(
    ("t", "crv"),
    [
        (np.arange(9.0), np.zeros((9, 2))),
        (np.arange(9.0), np.zeros((8, 3))),
        (np.arange(7.0), np.zeros((7, 3))),
        (np.zeros((3, 3)), np.zeros((3, 3))),
        (np.arange(9.0), np.full((9, 3), np.nan)),
        (np.full(9, np.inf), np.zeros((9, 3))),
    ],
)
def test_arrays_that_are_no_run_are_refused(t, crv):
    with pytest.raises(InputError) as caught:
        main_impacts(t, crv)
    assert caught.value.code == "E-SIGNAL"


def test_model_rate_and_sensor_rate_agree(rocking):
    """The same code on a model's 2 kHz and on what a gyroscope makes of it differs by the delay alone."""
    motion = rocking()
    t = np.arange(0.0, 3.0, 0.0005)
    crv = motion.crv(t)
    clean = main_impacts(t, crv).times
    recorded = main_impacts(*record(t, crv, Gyro(1000.0, 0.0, 300.0, 0.0))).times
    assert np.abs(recorded - clean - DELAY).max() < LATE
