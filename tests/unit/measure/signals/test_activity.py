"""Motion out of the plane: how much leaks from the main axis, how much there is, when it begins.

Then motion out of the plane, number by number: leakage by least squares, shares of arcs, and the instant of its onset.
"""

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from rockref.measure.signals.activity import Leakage, activity, arc_shares, leakage, onset, out_of_plane
from rockref.measure.signals.impacts import main_impacts
from rockref.measure.signals.noise import NoiseFloor, noise_floor
from tests.unit.measure.struck import struck


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


def test_misalignment_shows_in_the_shipped_experiment(shipped):
    """mystery-04 has a gyroscope turned by -0.034 rad about Z and 0.029 rad about Y; the others have none."""
    for number, expected in ((4, [-0.0337, -0.0286]), (8, [0.0, 0.0])):
        experiment = load_experiment(shipped / f"mystery-{number:02d}", uses=("fit",))
        for run in experiment.fit_runs():
            slopes = leakage(run.t, run.crv, main_impacts(run.t, run.crv)).slopes
            # Second order in the angles: 0.045 times 0.034 and 0.029.
            assert np.allclose(slopes, expected, rtol=0.0, atol=2e-3)


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


NONE = Leakage(np.zeros(2), np.zeros(2), np.zeros(2))
T = np.arange(1000) / 1000.0


def noise(sigma_y):
    return NoiseFloor(np.array([9.0, sigma_y, 9.0]), np.zeros(3), np.zeros(3), np.zeros(3))


def test_leakage_is_a_line_by_least_squares_up_to_60_ms_before_the_impact():
    rng = np.random.default_rng(0)
    wx, rest = 3.0 + 20.0 * T, 0.01 * rng.standard_normal((1000, 2))
    crv = np.column_stack([wx, wx[:, None] * [0.04, -0.02] + [0.3, -0.2] + rest])
    # From the sample 60 ms before the impact on, other things happen.
    crv[440:] = rng.standard_normal((560, 3))
    found = leakage(T, crv, struck(0.5, 0.7))
    slopes, covariance = zip(*(np.polyfit(wx[:440], y, 1, cov="unscaled") for y in crv[:440, 1:].T), strict=True)
    assert found.slopes == pytest.approx([s[0] for s in slopes], rel=1e-9)
    assert found.offsets == pytest.approx([s[1] for s in slopes], rel=1e-9)
    left = crv[:440, 1:] - out_of_plane_of_a_line(wx[:440], slopes)
    # Two of the samples are taken by the line.
    variance = (left**2).sum(axis=0) / 438
    assert found.errors == pytest.approx(np.sqrt(variance * covariance[0][0, 0]), rel=1e-9)


def out_of_plane_of_a_line(wx, slopes):
    return np.column_stack([np.polyval(s, wx) for s in slopes])


@pytest.mark.parametrize(("count", "leaks"), [(15, False), (16, True)])
def test_a_swing_of_fewer_than_sixteen_samples_says_nothing(count, leaks):
    crv = np.column_stack([T, 2.0 * T + 1.0, -T])
    found = leakage(T, crv, struck(0.0595 + count / 1000.0))
    assert found.slopes == pytest.approx([2.0, -1.0] if leaks else [0.0, 0.0], abs=1e-9)
    assert found.offsets == pytest.approx([1.0, 0.0] if leaks else [0.0, 0.0], abs=1e-9)
    assert found.errors.shape == (2,) and found.errors == pytest.approx([0.0, 0.0], abs=1e-9)


@pytest.mark.parametrize("impacts", [struck(), struck(0.5)])
def test_a_rate_that_does_not_change_leaks_nothing(impacts):
    found = leakage(T, np.ones((1000, 3)), impacts)
    for values in (found.slopes, found.offsets, found.errors):
        assert values.shape == (2,) and not values.any()


def test_a_rate_that_does_not_change_may_stand_on_another_axis():
    found = leakage(T, np.column_stack([T, np.full(1000, 3.0), -T]), struck(0.5))
    assert found.slopes == pytest.approx([0.0, -1.0], abs=1e-9)
    # Without a change on the main axis nothing leaks from it.
    assert not leakage(T, np.column_stack([np.ones(1000), T, T]), struck(0.5)).slopes.any()


def test_what_leaks_is_taken_out():
    crv = np.array([[2.0, 5.0, 7.0], [-1.0, 0.0, 1.0]])
    leak = Leakage(np.array([0.5, -0.25]), np.array([1.0, 2.0]), np.zeros(2))
    assert out_of_plane(crv, leak).tolist() == [[3.0, 5.5], [-0.5, -1.25]]


def test_activity_of_a_single_sample_is_spread_over_the_window():
    crv = np.zeros((1000, 3))
    crv[500] = [9.0, 3.0, 4.0]
    for half, found in ((50, activity(T, crv, NONE)), (10, activity(T, crv, NONE, window=0.02))):
        expected = np.where(np.abs(np.arange(1000) - 500) <= half, 5.0 / np.sqrt(2 * half + 1), 0.0)
        assert found == pytest.approx(expected, abs=1e-12)


def test_activity_leaves_out_what_leaks():
    crv = np.column_stack([T, 0.1 * T + 0.3, -0.2 * T])
    leak = Leakage(np.array([0.1, -0.2]), np.array([0.3, 0.4]), np.zeros(2))
    assert activity(T, crv, leak) == pytest.approx(np.full(1000, 0.4), rel=1e-9)


def test_shares_of_arcs_between_impacts():
    """Main rates of 1, 2, 0 and 4 in four arcs; and an arc without samples, between two impacts of one interval."""
    main = np.repeat([1.0, 2.0, 0.0, 4.0], 250)
    crv = np.column_stack([main, np.full(1000, 0.3), np.full(1000, -0.4)])
    found = arc_shares(T, crv, NONE, struck(0.25, 0.5, 0.75, 0.9001, 0.9002))
    assert found == pytest.approx([0.5, 0.25, np.nan, 0.125, np.nan, 0.125], rel=1e-12, nan_ok=True)
    leak = Leakage(np.zeros(2), np.array([0.3, -0.4]), np.zeros(2))
    assert arc_shares(T, crv, leak, struck(0.25)) == pytest.approx([0.0, 0.0], abs=1e-12)


def test_every_sample_counts_for_the_share_of_its_arc():
    crv = np.array([[3.0, 4.0, 0.0], [4.0, 0.0, 3.0], [1.0, 2.0, 2.0], [1.0, 0.0, 0.0]])
    found = arc_shares(np.arange(4.0), crv, NONE, struck(1.5, 2.5))
    assert found == pytest.approx([1.0, np.sqrt(8.0), 0.0], rel=1e-12)


def test_small_rates_have_shares_as_well():
    crv = np.column_stack([np.full(1000, 0.01), np.full(1000, 0.003), np.full(1000, 0.004)])
    assert arc_shares(T, crv, NONE, struck(0.5)) == pytest.approx([0.5, 0.5], rel=1e-12)


def ramp(slope=2.0, calm=0.0, start=0.48, later=0.0):
    """About Y: `calm` up to 60 ms before the impact at 0.5 s, a ramp from `start` on, and `later` after 0.52 s."""
    wy = np.where(T < 0.43, calm, 0.0) + np.where(T > start, slope * (T - start), 0.0)
    wy[T > 0.52] = later
    return np.column_stack([np.zeros(1000), wy, np.full(1000, 50.0)])


def begin(crv, level=None, sigma=0.0, impacts=None, t=T):
    return onset(t, crv, struck(0.5) if impacts is None else impacts, NONE, noise(sigma), level=level)


def test_onset_is_the_first_sample_above_the_level():
    """2 rad/s2 from 0.48 s: 0.0205 rad/s are passed at 0.49025 s. The mean over five samples follows a line."""
    assert begin(ramp(), level=0.0205) == pytest.approx(0.491, abs=1e-12)
    assert begin(-ramp(), level=0.0205) == pytest.approx(0.491, abs=1e-12)


@pytest.mark.parametrize(("calm", "sigma", "slope", "time"), [
    # Four noise widths: 0.0405 after 20.25 ms.
    (0.0, 0.0405 / 4.0, 2.0, 0.501),
    # Five times the disturbance before, a constant one: 0.0205 after 10.25 ms.
    (0.0041, 0.0, 2.0, 0.491),
    # Three hundredths of the largest value until 10 ms after the impact, 0.6 rad/s: 0.018 after 0.9 ms.
    (0.0, 0.0, 20.0, 0.481),
])  # fmt: skip
def test_the_level_is_the_largest_of_three(calm, sigma, slope, time):
    crv = ramp(slope, calm)
    # Calm up to where the impact is near, to the sample.
    crv[:440, 1] = calm
    assert begin(crv, sigma=sigma) == pytest.approx(time, abs=1e-12)


def test_the_onset_is_looked_for_from_60_ms_before_to_10_ms_after():
    """What is larger outside is another thing."""
    crv = ramp(later=40.0)
    assert begin(crv, level=0.0205) == pytest.approx(0.491, abs=1e-12)
    # The level is passed 11 ms after the impact, or not later than 10 ms after it.
    assert np.isnan(begin(crv, level=0.0601))
    assert begin(crv, level=0.0599) == pytest.approx(0.51, abs=1e-12)
    # Above the level throughout: it begins with the first sample that is looked at.
    crv[:, 1] = 1.0
    assert begin(crv, level=0.5) == pytest.approx(0.44, abs=1e-12)


def test_motion_that_died_down_before_the_largest_value_is_not_the_onset():
    crv = ramp()
    crv[450:460, 1] = 0.03
    assert begin(crv, level=0.0205) == pytest.approx(0.491, abs=1e-12)
    # And what comes down again after the largest value is no end of it.
    crv[505:, 1] = 0.0
    assert begin(crv, level=0.0205) == pytest.approx(0.491, abs=1e-12)


def test_a_level_below_the_largest_value_alone_is_passed_before_it():
    """A ramp that is cut at 0.505 s: means of five of 0.042, 0.044, and 0.036 at once after it."""
    crv = ramp()
    crv[505:, 1] = 0.0
    assert begin(crv, level=0.041) == pytest.approx(0.501, abs=1e-12)


def test_above_nothing_it_begins_with_the_first_sample_that_is_not_zero():
    """The ramp has its first value after 0.48 s, which the mean over five samples shows two samples earlier."""
    assert begin(ramp(), level=0.0) == pytest.approx(0.479, abs=1e-12)


def test_a_level_that_is_just_reached_is_not_passed():
    crv = ramp()
    crv[:, 1] = np.where(T > 0.48, 0.5, 0.0)
    assert np.isnan(begin(crv, level=0.5)) and np.isfinite(begin(crv, level=0.499))


def test_without_an_impact_or_a_calm_time_or_samples_near_it_there_is_no_onset():
    assert np.isnan(begin(ramp(), impacts=struck()))
    assert np.isnan(begin(ramp()[440:], t=T[440:]))
    assert np.isnan(begin(ramp()[:440], t=T[:440]))
    assert begin(ramp()[439:], level=0.0205, t=T[439:]) == pytest.approx(0.491, abs=1e-12)
