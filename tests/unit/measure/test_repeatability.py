"""Repeated runs: their band, their spread, and how long they agree."""

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from rockref.measure.repeatability import repeat_groups, repeatability
from rockref.model.errors import InputError

NOISE = 8.7e-4


def with_clatter(signal, motion, until=9.0, phase=0.0, frequency=20.0):
    t, crv = signal
    s = t - motion.times[0]
    wave = np.sin(2.0 * np.pi * frequency * s + np.where(s > until, phase, 0.0)) * (s > 0.0)
    return t, crv + np.stack((0 * t, 0.05 * wave, 0.05 * wave), axis=-1)


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


def test_horizon_is_where_runs_part(rocking, sensed):
    motion = rocking()
    runs = [
        with_clatter(sensed(motion, seed=1), motion, until=0.7, phase=0.0),
        with_clatter(sensed(motion, seed=2), motion, until=0.7, phase=np.pi),
    ]
    found = repeatability(runs)
    # Opposite phases: the standard deviation of two runs is sqrt(2) times the amplitude, far above both limits; the
    # windows of 50 and 100 ms see it up to half their length early.
    assert found.horizon[1] == pytest.approx(0.7, abs=0.03)
    assert found.alike_until[1] == pytest.approx(0.7, abs=0.06)
    assert np.isinf(found.alike_until[0])


def test_small_differences_pass_the_noise_and_stay_alike(rocking, sensed):
    motion = rocking()
    a, b = (with_clatter(sensed(motion, seed=seed), motion) for seed in (1, 2))
    b = b[0], b[1] * [1.0, 1.25, 1.25]
    found = repeatability([a, b])
    assert found.horizon[1] < 0.1
    assert np.isinf(found.alike_until[1])


def test_runs_of_other_rates_and_lengths_are_compared_where_both_are(rocking):
    motion = rocking()
    fine, coarse = np.arange(0.0, 2.0, 0.0005), np.arange(0.0, 3.0, 0.001)
    found = repeatability([(fine, motion.crv(fine)), (coarse, motion.crv(coarse))])
    assert np.allclose(np.diff(found.t), 0.001, rtol=1e-9)
    assert found.t[-1] <= 2.0 - motion.times[0] + 1e-3
    # A grid through the first main impact itself.
    assert np.abs(found.t).min() < 1e-12


def test_groups_of_repeats(shipped):
    experiment = load_experiment(shipped / "mystery-01")
    assert [[run.id for run in group] for group in repeat_groups(experiment.runs)] == [["01", "02", "03"]]
    assert [[run.id for run in group] for group in repeat_groups(experiment.fit_runs())] == [["01", "02"]]
    closed = load_experiment(shipped / "mystery-01", uses=("fit",))
    assert [[run.id for run in group] for group in repeat_groups(closed.runs)] == [["01", "02"]]


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


def test_what_cannot_be_compared_is_refused(rocking):
    motion = rocking()
    t = np.arange(0.0, 2.0, 0.001)
    good = (t, motion.crv(t))
    for signals, words in (([good], "1 runs"), ([good, (t, np.zeros((len(t), 3)))], "no main impact")):
        with pytest.raises(InputError, match=words) as caught:
            repeatability(signals)
        assert caught.value.code == "E-REPEATS"
