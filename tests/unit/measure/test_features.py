"""Features of a saw-tooth whose features are known."""

import numpy as np
import pytest

from rockref.measure import features
from rockref.model.errors import InputError

T = np.arange(2000) / 2000.0


def saw_tooth(t, period=0.08, heights=1.0):
    """Straight flanks between +height and -height."""
    phase = (t / period) % 1.0
    return heights * (4 * np.abs(phase - 0.5) - 1)


def test_extremes_alternate():
    x = saw_tooth(T)
    tips = features.extremes(x)
    # tips every 0.04 s, from 0.04 on
    assert T[tips] == pytest.approx(np.arange(1, 25) * 0.04, abs=1e-9)
    assert np.all(np.diff(np.sign(x[tips])) != 0)


def test_straight_flanks():
    found = features.flanks(saw_tooth(T))
    assert len(found.bounds) == 23
    assert np.min(found.straightness) > 1 - 1e-12


def test_flanks_of_two_segments():
    """Steep, then flat: one line explains most, two joined lines all the rest."""
    t = np.linspace(0, 1, 101)
    rise = np.interp(t, [0, 0.3, 1], [-1, 0.4, 1])
    found = features.flanks(np.concatenate([rise[:0:-1], rise, rise[-2::-1], rise[1:]]))
    assert np.all(found.straightness < 0.96)
    # the joint is looked for at every other sample
    assert np.all(found.bend > 0.99)


def test_flanks_of_a_sine_are_neither():
    found = features.flanks(np.sin(2 * np.pi * T / 0.08))
    assert np.all(found.straightness < 0.995)
    assert np.all(found.bend < 0.6)


@pytest.mark.parametrize("bow", [-0.3, -0.05, 0.0, 0.4])
def test_curvature_of_the_envelope(bow):
    place = np.linspace(-1, 1, len(T))
    x = saw_tooth(T, heights=1 - bow * place**2)
    tips = features.extremes(x)[2:-2]
    reach = place[tips[-1]]
    mean = np.mean(1 - bow * place[tips] ** 2)
    # the tips of teeth with sloping heights lie a sample aside
    assert features.curvature(x) == pytest.approx(bow * reach**2 / mean, abs=5e-3)


def test_ripple_takes_out_what_is_slow():
    slow, fast = 30 * T, 0.3 * np.sin(2 * np.pi * T / 0.025)
    inner = slice(200, -200)
    assert features.ripple(T, slow + fast, window=0.075)[inner] == pytest.approx(fast[inner], abs=0.02)


def test_rhythm():
    # lines are 1/(8 T) apart: 0.6 % of this frequency
    assert features.rhythm(T, 5 + np.sin(2 * np.pi * T / 0.05)) == pytest.approx(0.05, rel=6e-3)


def test_what_has_no_teeth_is_refused():
    with pytest.raises(InputError) as refused:
        features.flanks(T)
    assert refused.value.code == "E-STRETCH"
    with pytest.raises(InputError) as refused:
        features.curvature(saw_tooth(T[:300]))
    assert refused.value.code == "E-STRETCH"
