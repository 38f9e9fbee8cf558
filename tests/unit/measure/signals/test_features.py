"""Features of a saw-tooth whose features are known.

Then features of signals that are straight between given points.
"""

import numpy as np
import pytest

from rockref.measure.signals import features
from rockref.measure.signals.running import running_mean
from rockref.model.errors import InputError

T = np.arange(2000) / 2000.0


def saw_tooth(t, period=0.08, heights=1.0):
    """Straight flanks between +height and -height."""
    phase = (t / period) % 1.0
    return heights * (4 * np.abs(phase - 0.5) - 1)


def test_straight_flanks():
    found = features.flanks(saw_tooth(T))
    assert len(found.bounds) == 23
    assert np.min(found.straightness) > 1 - 1e-12


def test_flanks_of_a_sine_are_neither():
    found = features.flanks(np.sin(2 * np.pi * T / 0.08))
    assert np.all(found.straightness < 0.995)
    assert np.all(found.bend < 0.6)


def drawn(places, heights):
    """A signal (N,) that is straight between the heights at these samples."""
    return np.interp(np.arange(places[-1] + 1), places, heights)


def refused(call):
    with pytest.raises(InputError) as caught:
        call()
    return str(caught.value)


@pytest.mark.parametrize("unit", [1.0, 1e-6])
def test_extremes_stand_out_by_a_twentieth_of_the_range(unit):
    """Two ripples on the way from 0 to 1 and back: of 0.06 and of 0.04 of the range."""
    places = [0, 20, 30, 50, 60, 80, 100]
    x = unit * drawn(places, [0.0, 0.5, 0.44, 0.8, 0.76, 1.0, 0.0])
    assert features.extremes(x).tolist() == [20, 30, 80]
    assert features.extremes(x, least=0.03).tolist() == [20, 30, 50, 60, 80]
    assert features.extremes(-x).tolist() == [20, 30, 80]


def test_a_level_signal_has_no_extremes():
    assert len(features.extremes(np.zeros(50))) == 0


@pytest.mark.parametrize(("length", "bounds"), [(12, [[20, 32], [32, 52]]), (11, [[31, 51]])])
def test_a_flank_of_twelve_samples_has_a_shape(length, bounds):
    x = drawn([0, 20, 20 + length, 40 + length, 60 + length], [0.0, 1.0, -1.0, 1.0, 0.0])
    assert features.flanks(x.tolist()).bounds.tolist() == bounds


def test_shape_of_a_flank_with_its_tips_left_out():
    """A cubic from top to bottom, 41 samples of which four at either end are left out; the best of all joints."""
    s = np.linspace(-1.0, 1.0, 41)
    flank = s**3 / 3.0 - 1.5 * s + 0.2 * s**2
    x = np.concatenate([np.linspace(0.0, flank[0], 30)[:-1], flank, np.linspace(flank[-1], 0.0, 30)[1:]])
    found = features.flanks(x)
    assert found.bounds.tolist() == [[29, 69]]
    y, place = flank[4:-4], np.arange(33.0)

    def left(terms):
        A = np.stack(terms, axis=-1)
        return np.sum((y - A @ np.linalg.solve(A.T @ A, A.T @ y)) ** 2)

    line = left([np.ones(33), place])
    # Joints at every other sample, two away from the ends.
    two = min(left([np.ones(33), place, np.maximum(place - joint, 0.0)]) for joint in range(2, 31, 2))
    assert found.straightness[0] == pytest.approx(1.0 - line / (33 * np.var(y)), rel=1e-9)
    assert found.bend[0] == pytest.approx(1.0 - two / line, rel=1e-6)


@pytest.mark.parametrize(("end", "joint"), [(90, 2), (90, 46), (91, 20), (91, 46)])
def test_a_joint_at_every_other_sample_of_a_flank_is_found(end, joint):
    """Of 61 samples 49 are left, from the sixth on, of 62 there are 50: joints are up to two from the ends."""
    x = drawn([0, 30, 36 + joint, end, 120], [0.0, 1.0, 0.5 - 0.01 * joint, -1.0, 0.0])
    found = features.flanks(x)
    assert found.bounds.tolist() == [[30, end]] and found.bend[0] == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("bow", [-0.4, 0.0, 0.3])
def test_curvature_of_teeth_on_a_parabola(bow):
    """Eight teeth of unequal distance; the first and the last two are anywhere, the others on 1 - bow s^2."""
    tips = np.array([10, 25, 40, 52, 70, 85, 95, 110])
    inner = tips[2:-2]
    s = 2.0 * (inner - inner[0]) / (inner[-1] - inner[0]) - 1.0
    heights = np.concatenate([[0.7, 2.0], 1.0 - bow * s**2, [1.5, 0.9]])
    x = drawn([0, *tips, 125], [0.0, *(heights * (-1.0) ** np.arange(8)), 0.0])
    assert features.curvature(x.tolist()) == pytest.approx(bow / heights[2:-2].mean(), abs=1e-12)


def test_what_is_said_of_too_few_teeth():
    tips = np.arange(10, 80, 10)
    x = drawn([0, *tips, 90], [0.0, *(-1.0) ** np.arange(7), 0.0])
    said = "argument x: has fewer than eight extremes. Give a whole arc. [E-STRETCH]"
    assert refused(lambda: features.curvature(x)) == said
    said = "argument x: has no saw-tooth. Give a stretch with out-of-plane motion. [E-STRETCH]"
    assert refused(lambda: features.flanks(np.arange(100.0))) == said


def test_ripple_is_what_the_running_mean_leaves():
    t = 5.0 + np.arange(1000) / 1000.0
    x = np.random.default_rng(0).standard_normal(1000)
    # 75 ms at 1 kHz: 38 samples on each side, rounded.
    assert features.ripple(t, x.tolist()) == pytest.approx(x - running_mean(x, 38), abs=1e-12)
    assert features.ripple(t, x, window=0.02) == pytest.approx(x - running_mean(x, 10), abs=1e-12)


@pytest.mark.parametrize("lines", [160, 161, 163, 300])
def test_rhythm_is_read_to_an_eighth_of_a_line(lines):
    """A second of 1 kHz: lines are 0.125 Hz apart. A level and the time of day do not matter."""
    t = 5.0 + np.arange(1000) / 1000.0
    x = 50.0 + np.sin(2.0 * np.pi * 0.125 * lines * t)
    assert features.rhythm(t, x.tolist()) == pytest.approx(8.0 / lines, rel=1e-9)


def test_rhythm_of_few_periods_is_not_drawn_aside_by_the_ends():
    """Two and a half periods: with a window that ends at zero the highest line is at them, to 2 %."""
    t = np.arange(1000) / 1000.0
    x = np.cos(2.0 * np.pi * 2.5 * t)
    assert features.rhythm(t, x) == pytest.approx(0.4, rel=0.04)
