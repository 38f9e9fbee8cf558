"""What a model would have recorded."""

from dataclasses import replace

import numpy as np
import pytest

from rockref import Model
from rockref.effects.sensor.clock_error import ClockError
from rockref.effects.sensor.gyro_drift import GyroDrift
from rockref.effects.sensor.gyro_saturation import GyroSaturation
from rockref.effects.sensor.gyro_scale import GyroScale
from rockref.measure import Gyro, Run, record
from rockref.measure.prediction import predict, problem_of, solve

GYRO = Gyro(1000.0, 1e-3, 300.0, 0.0)
MODEL = Model.table_3_1()


def a_run(duration=0.2, **values):
    t = np.arange(round(duration * 1000)) / 1000.0
    return Run(
        **{"id": "01", "file": "a.csv", "use": "fit", "release_tilt": 0.117, "block_turned": 0.0, "t": t} | values
    )


@pytest.fixture(scope="module")
def prediction():
    return predict(MODEL, [a_run(0.7)], GYRO)[0]


def test_it_is_what_the_gyroscope_records_of_the_response(prediction):
    t, crv = record(prediction.t, prediction.response.W, GYRO)
    assert prediction.at(t) == pytest.approx(crv, abs=1e-12)


def test_before_the_release_it_rests_and_beyond_the_simulation_it_is_unknown(prediction):
    rates = prediction.at(np.array([-0.01, 0.0, prediction.t[-1] + 0.01]))
    assert not rates[:2].any()
    assert np.isnan(rates[2]).all()


def test_sensor_effects_act_in_the_order_of_a_real_gyroscope():
    """What is predicted is what the gyroscope would record; between its samples no more than the range is shown."""
    effects = (GyroSaturation(0.2), GyroScale(1.02, 0.98, 1.02), GyroDrift(0.01), ClockError(1.01))
    found = predict(MODEL.replace(effects=effects), [a_run(0.6)], GYRO)[0]
    t, crv = record(found.t, found.response.W, GYRO, effects=effects)
    assert found.at(t) == pytest.approx(crv, abs=1e-12) and np.abs(crv).max() == 0.2
    assert np.abs(found.at(np.arange(0.0, 0.6, 3.7e-4))).max() == 0.2


def test_batch_gives_the_bits_of_single_runs():
    # Short: the plain engine needs 0.15 ms a step.
    problems = [replace(problem_of(MODEL, a_run(0.01, release_tilt=tilt)), duration=0.02) for tilt in (0.117, 0.100)]
    batch = solve(problems, "numpy", None)
    for problem, response in zip(problems, batch, strict=True):
        assert np.array_equal(response.W, solve([problem], "numpy", None)[0].W)
