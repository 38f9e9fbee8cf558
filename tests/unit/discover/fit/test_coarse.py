"""From coarse to fine: what is averaged, and a descent that stops short sample by sample."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover.fit.coarse import coarse_to_fine
from rockref.discover.fit.least_squares import Fit, running_mean
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.windows.series import STATES

B, M = 6, 160


class Rattle:
    """Windows of a slow swell with sharp spikes on it, all of them late by what the model says [samples].

    They are release windows, so that nothing but the delay can move.
    """

    B, runs, rate = B, [SimpleNamespace(release_tilt=0.1)], 1000.0
    time, run_of = np.zeros(B), np.zeros(B, int)
    noise = np.random.default_rng(2).normal(size=(B, M, 3))
    first, length, count = np.ones(B, bool), np.full(B, M), np.full(B, 3 * M)
    workers = 1

    def motion(self, late: float) -> np.ndarray:
        t = np.arange(M) - late
        spikes = sum(np.exp(-((t - at) ** 2) / 2) for at in range(20, 150, 10))
        return 12 * np.exp(-((t - 80) ** 2) / (2 * 20.0**2)) + 5 * spikes

    def residual(self, models, tilt, corrections, which=None, upto=None):
        r = self.motion(models[0].late) - self.motion(0.0)
        return (r[:, None] + self.noise)[slice(None) if which is None else which]

    def pieces(self, which=None, beyond=0):
        return [(slice(None), M)]

    def carry(self, models, tilt, corrections):
        return False


@pytest.fixture
def fit():
    late = Parameter("late", lambda model, value: SimpleNamespace(late=value, origin={}), 0.0, 1.0, prior=100.0)
    return Fit(Rattle(), SimpleNamespace(late=0.0, origin={}), (late,))


def begun(fit, late):
    return fit.point(np.array([late]), np.zeros((B, STATES)))[0]


def test_white_noise_keeps_its_size():
    r = np.random.default_rng(0).normal(size=(40, 500, 3))
    inside = running_mean(r, 12)[:, 12:-12]
    # A standard deviation of 57 000 values, of which every twelfth is new, is known to one percent.
    assert np.std(inside) == pytest.approx(1.0, rel=0.03)


@pytest.mark.parametrize("samples", [4, 5, 12])
def test_each_mean_is_over_the_samples_about_it(samples):
    r = np.random.default_rng(1).normal(size=(2, 30, 3))
    found = running_mean(r, samples)
    for i in range(30):
        own = r[:, max(i - samples // 2, 0) : i - samples // 2 + samples]
        # Sums of thirty numbers of size one, differently ordered.
        np.testing.assert_allclose(found[:, i], own.sum(axis=1) / np.sqrt(samples), rtol=0, atol=1e-13)


def test_a_fit_that_averages_nothing_sees_every_sample(fit):
    point = begun(fit, 3.0)
    raw = fit.series.residual(fit.models(point.z)[0], None, point.corrections)
    np.testing.assert_array_equal(fit.residual(point.z, point.corrections), raw)
    wide = replace(fit, averaged=6)
    np.testing.assert_array_equal(wide.residual(point.z, point.corrections), running_mean(raw, 6))


def test_coarse_stages_lead_out_of_a_wrong_order_of_impacts(fit):
    """Spikes ten samples apart: from nine samples late, fine steps lock on to the wrong ones."""
    start = begun(fit, 9.0)
    stuck = fit.run(start, 30, np.random.default_rng(0))
    assert stuck.z[0] > 5
    led = coarse_to_fine(fit, start)
    # Half a spike's width; fine steps find the rest.
    assert abs(led.z[0]) < 0.5
    # The noise tells the delay to 0.014 samples: 18 series of 13 spikes, each with a squared slope of 22.
    assert abs(fit.run(led, 10, np.random.default_rng(0), tolerance=0).z[0]) < 0.05


def test_the_loss_that_comes_back_is_that_of_every_sample(fit):
    led = coarse_to_fine(fit, begun(fit, 9.0))
    assert led.objective == pytest.approx(fit.point(led.z, led.corrections)[0].objective, rel=1e-12)
