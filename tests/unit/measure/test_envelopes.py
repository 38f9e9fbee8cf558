"""Envelopes: the shapes that the source describes, on made signals and on the shipped ones."""

import numpy as np
import pytest

from rockref.measure.envelopes import POINTS, envelope_shape, envelopes
from rockref.measure.experiment import load_experiment
from rockref.measure.impacts import main_impacts
from rockref.model.errors import InputError


def saw(t, frequency):
    """A triangle wave between -1 and 1."""
    return 4.0 * np.abs((t * frequency) % 1.0 - 0.5) - 1.0


def made(shape, frequency=15.0, rate=1000.0):
    t = np.arange(0.0, 1.0, 1.0 / rate)
    tooth = saw(t, frequency)
    return t, np.stack((np.sin(3.0 * t), tooth * shape(t), 0.5 * tooth * shape(t)), axis=-1)


@pytest.mark.parametrize("rate", [1000.0, 2000.0])
def test_teeth_are_joined_by_their_tops(rate):
    t, crv = made(lambda t: 1.0 - 0.5 * t, rate=rate)
    found = envelopes(t, crv, 0.0, 1.0)
    assert found.upper.shape == found.lower.shape == (2, POINTS)
    assert found.teeth.tolist() == [14, 14]
    assert np.allclose(found.periods, 1.0 / 15.0, rtol=0.02)
    inside = (found.t > 0.1) & (found.t < 0.9)
    # The mean over three samples cuts a tip of 60/s by 4 %.
    for row, scale in ((0, 1.0), (1, 0.5)):
        assert np.allclose(found.upper[row, inside], scale * (1.0 - 0.5 * found.t[inside]), rtol=0.06)
        assert np.allclose(found.lower[row, inside], -scale * (1.0 - 0.5 * found.t[inside]), rtol=0.06)


def test_shapes_are_told_apart():
    def shape(function):
        t, crv = made(function)
        found = envelopes(t, crv, 0.0, 1.0)
        return envelope_shape(found.upper[0], found.lower[0])

    flat, round_, ramp = shape(lambda t: 1.0 + 0 * t), shape(lambda t: np.sin(np.pi * t)), shape(lambda t: t)
    # Half a tooth at either end of the arc lowers the outer thirds by 8 %.
    assert flat.variation < 0.05 and abs(flat.bow) < 0.1
    assert round_.bow > 0.4 and round_.start < 0.2 and round_.end < 0.2
    assert ramp.variation > 0.4 and abs(ramp.bow) < 0.1 and ramp.end > 0.7 > 0.2 > ramp.start
    assert flat.largest == pytest.approx(1.0, abs=0.06)
    assert round_.mean == pytest.approx(2.0 / np.pi, rel=0.1)


def test_clatter_that_dies_leaves_an_envelope_at_the_noise():
    t, crv = made(lambda t: np.where(t < 0.5, 1.0, 0.0))
    crv = crv + 0.01 * np.random.default_rng(0).standard_normal(crv.shape)
    found = envelopes(t, crv, 0.0, 1.0, noise=0.01)
    late = (found.t > 0.6) & (found.t < 0.95)
    assert np.abs(found.upper[:, late]).max() < 0.05 > np.abs(found.lower[:, late]).max()
    assert found.teeth[0] in (7, 8)


def test_lines_contain_the_signal_but_for_its_noise():
    rng = np.random.default_rng(4)
    t, crv = made(lambda t: 1.0 + 0.3 * np.sin(7.0 * t))
    crv = crv + 0.01 * rng.standard_normal(crv.shape)
    found = envelopes(t, crv, 0.0, 1.0, noise=0.01)
    for row in range(2):
        at = np.interp(t, found.t, found.upper[row]), np.interp(t, found.t, found.lower[row])
        assert np.mean(crv[:, row + 1] > at[0] + 0.1) < 0.01
        assert np.mean(crv[:, row + 1] < at[1] - 0.1) < 0.01


def test_silence_has_an_envelope_of_zero():
    t = np.arange(1000) / 1000.0
    found = envelopes(t, np.zeros((1000, 3)), 0.0, 1.0)
    assert not found.upper.any() and not found.lower.any()
    assert found.teeth.tolist() == [0, 0] and np.isnan(found.periods).all()
    assert envelope_shape(found.upper[0], found.lower[0]).mean == 0.0


@pytest.mark.parametrize(("start", "end"), [(0.0, 0.006), (2.0, 3.0), (0.5, 0.4)])
def test_stretch_without_samples_is_refused(start, end):
    t, crv = made(np.ones_like)
    with pytest.raises(InputError) as caught:
        envelopes(t, crv, start, end)
    assert caught.value.code == "E-STRETCH"


def test_control_looks_as_the_source_describes(shipped):
    """Transverse: quasi-constant, between 10 and 20 teeth. Longitudinal: bulges, and is small at both ends."""
    experiment = load_experiment(shipped / "mystery-08", uses=("fit",))
    for run in experiment.fit_runs()[:2]:
        first, second = main_impacts(run.t, run.crv).times[:2]
        found = envelopes(run.t, run.crv, first, second, noise=experiment.gyro.noise)
        transverse = envelope_shape(found.upper[0], found.lower[0])
        longitudinal = envelope_shape(found.upper[1], found.lower[1])
        assert 10 <= found.teeth[0] <= 20
        assert transverse.variation < 0.15 and abs(transverse.bow) < 0.15
        assert longitudinal.bow > 0.4
        assert longitudinal.start < 0.3 and longitudinal.end < 0.3
        assert np.degrees(transverse.largest) == pytest.approx(3.0, abs=0.5)
        assert np.degrees(longitudinal.largest) == pytest.approx(6.7, abs=0.7)
