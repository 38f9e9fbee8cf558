"""The noise floor: known noise is found again, under motion and impacts."""

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from rockref.measure.noise import noise_floor, smallest_step
from rockref.model.errors import InputError


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


def test_noise_of_each_axis_is_its_own(rocking, sensed):
    t, crv = sensed(rocking(), noise=1e-3)
    crv = crv + np.random.default_rng(3).standard_normal(crv.shape) * [0.0, 3e-3, 0.0]
    sigma = noise_floor(t, crv).sigma
    assert sigma[1] == pytest.approx(np.sqrt(10.0) * 1e-3, rel=0.1)
    assert np.allclose(sigma[[0, 2]], 1e-3, rtol=0.1)


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


def test_smallest_step():
    rng = np.random.default_rng(0)
    x = rng.standard_normal((500, 3))
    x[:, 0] = np.rint(x[:, 0] / 0.05) * 0.05
    x[:, 2] = 1.0
    assert smallest_step(x)[0] == pytest.approx(0.05, rel=1e-9)
    assert smallest_step(x)[1:].tolist() == [0.0, 0.0]


def test_run_that_is_too_short_is_refused():
    t = np.arange(100) / 1000.0
    with pytest.raises(InputError) as caught:
        noise_floor(t, np.zeros((100, 3)))
    assert caught.value.code == "E-SIGNAL"
