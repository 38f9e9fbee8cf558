"""Motion out of the plane: how much leaks from the main axis, how much there is, when it begins."""

import numpy as np
import pytest

from rockref.measure.activity import activity, arc_shares, leakage, onset, out_of_plane
from rockref.measure.experiment import load_experiment
from rockref.measure.impacts import main_impacts
from rockref.measure.noise import noise_floor


def test_leakage_of_a_misaligned_gyroscope_is_measured(rocking, sensed):
    t, crv = sensed(rocking())
    offsets = np.array([0.003, -0.002])
    crv = crv + np.stack((0 * t, 0.04 * crv[:, 0] + offsets[0], -0.02 * crv[:, 0] + offsets[1]), axis=-1)
    found = leakage(t, crv, main_impacts(t, crv))
    # Three standard errors, which the noise of 0.05 deg/s on a swing of 37 deg/s makes 0.3e-3.
    assert np.all(np.abs(found.slopes - [0.04, -0.02]) < 3.0 * found.errors)
    assert 1e-4 < found.errors.max() < 4e-4
    assert np.allclose(found.offsets, offsets, rtol=0.0, atol=3e-4)
    rest = out_of_plane(crv, found)
    assert np.sqrt((rest**2).mean()) == pytest.approx(8.7e-4, rel=0.1)


def test_without_an_impact_nothing_is_taken_out():
    t = np.arange(1000) / 1000.0
    crv = np.ones((1000, 3))
    found = leakage(t, crv, main_impacts(t, np.zeros((1000, 3))))
    assert not found.slopes.any() and not found.offsets.any()


def test_misalignment_shows_in_the_shipped_experiment(shipped):
    """mystery-04 has a gyroscope turned by -0.034 rad about Z and 0.029 rad about Y; the others have none."""
    for number, expected in ((4, [-0.0337, -0.0286]), (8, [0.0, 0.0])):
        experiment = load_experiment(shipped / f"mystery-{number:02d}", uses=("fit",))
        for run in experiment.fit_runs():
            slopes = leakage(run.t, run.crv, main_impacts(run.t, run.crv)).slopes
            # Second order in the angles: 0.045 times 0.034 and 0.029.
            assert np.allclose(slopes, expected, rtol=0.0, atol=2e-3)


def test_activity_is_the_quadratic_mean_of_both_axes(rocking):
    t = np.arange(3000) / 1000.0
    crv = rocking().crv(t)
    crv[:, 1] = np.where(t > 1.5, 0.3 * np.sin(2.0 * np.pi * 40.0 * t), 0.0)
    crv[:, 2] = np.where(t > 1.5, 0.4 * np.sin(2.0 * np.pi * 40.0 * t), 0.0)
    impacts = main_impacts(t, crv)
    found = activity(t, crv, leakage(t, crv, impacts))
    assert found[t < 1.4].max() == 0.0
    assert np.allclose(found[(t > 1.6) & (t < 2.9)], 0.5 / np.sqrt(2.0), rtol=0.03)


def test_shares_are_counted_by_arc(rocking):
    t = np.arange(3000) / 1000.0
    crv = rocking().crv(t)
    impacts = main_impacts(t, crv)
    crv[:, 1] = 0.1 * crv[:, 0] * (t > impacts.times[0]) * (t < impacts.times[1])
    shares = arc_shares(t, crv, leakage(t, crv, impacts), impacts)
    assert len(shares) == len(impacts) + 1
    assert shares[1] == pytest.approx(0.1, rel=0.01)
    assert np.delete(shares, 1).max() < 5e-3


@pytest.mark.parametrize("before", [0.005, 0.02, 0.04])
def test_onset_before_the_impact(rocking, sensed, before):
    motion = rocking()
    t, crv = sensed(motion)
    begin = motion.times[0] - before
    crv = crv + np.stack((0 * t, np.where((t > begin) & (t < begin + 0.06), 2.0 * (t - begin), 0.0), 0 * t), axis=-1)
    impacts, noise = main_impacts(t, crv), noise_floor(t, crv)
    leak = leakage(t, crv, impacts)
    # A ramp of 2 rad/s^2 leaves four noise widths after 1.7 ms.
    assert onset(t, crv, impacts, leak, noise) == pytest.approx(begin + 1.7e-3, abs=1.5e-3)
    assert onset(t, crv, impacts, leak, noise, level=0.02) == pytest.approx(begin + 0.01, abs=1.5e-3)


def test_planar_motion_has_no_onset(rocking, sensed):
    t, crv = sensed(rocking())
    impacts = main_impacts(t, crv)
    assert np.isnan(onset(t, crv, impacts, leakage(t, crv, impacts), noise_floor(t, crv)))
    none = main_impacts(t[:300], crv[:300])
    assert np.isnan(onset(t, crv, none, leakage(t, crv, none), noise_floor(t, crv)))


def test_motion_starts_before_the_impact_in_the_control(shipped):
    """The source saw it 0.02 s before; above the noise it shows 0.016 s before."""
    experiment = load_experiment(shipped / "mystery-08", uses=("fit",))
    for run in experiment.fit_runs()[:3]:
        impacts = main_impacts(run.t, run.crv)
        begin = onset(run.t, run.crv, impacts, leakage(run.t, run.crv, impacts), noise_floor(run.t, run.crv))
        assert -0.025 < begin - impacts.times[0] < -0.012
