"""What is asked of the engines for a run, and what they are told, without a simulation."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.effects.sensor.gyro_saturation import GyroSaturation
from rockref.effects.sensor.gyro_scale import GyroScale
from rockref.measure import prediction
from rockref.measure.prediction import FINE_RATE, STEP, Prediction, gyro_of, problem_of, solve
from rockref.measure.records.release import Experiment, Gyro, Run
from tests.refusal import refusal, refused

GYRO = Gyro(1000.0, 1e-3, 300.0, 0.0)
MODEL = Model.table_3_1()


def a_run(end=0.5, **values):
    return Run(**{"id": "01", "file": "a.csv", "use": "fit", "release_tilt": 0.117, "block_turned": 0.0,
                  "t": np.array([0.0, end / 3, end])} | values)  # fmt: skip


@pytest.mark.parametrize(("end", "margin"), [(0.5, 0.1), (3.0, 0.1), (4.0, 0.12)])
def test_the_simulation_lasts_a_tenth_of_a_second_or_three_hundredths_longer(end, margin):
    problem = problem_of(MODEL, a_run(end))
    # Whole steps.
    assert problem.duration == pytest.approx(end + margin, abs=1.1 * STEP)
    assert (problem.step, problem.output_rate) == (STEP, FINE_RATE)
    assert problem_of(MODEL, a_run(end), step=2e-5).step == 2e-5


def directions(run, **release):
    """The tilt of the released block about X."""
    return problem_of(MODEL, run, release or None).start.Lambda[2, 1]


def test_the_side_and_the_tilt_are_those_of_the_run():
    here = directions(a_run())
    assert abs(here) == pytest.approx(np.sin(0.117), rel=1e-3)
    for turned in (np.pi, -np.pi, 1.6):
        assert directions(a_run(block_turned=turned)) == pytest.approx(-here, rel=1e-6)
    for turned in (0.0, 1.5, -1.5):
        assert directions(a_run(block_turned=turned)) == here
    assert abs(directions(a_run(), theta_0=0.1)) == pytest.approx(np.sin(0.1), rel=1e-3)


@pytest.mark.parametrize("values", [{"t": None}, {"release_tilt": None}])
def test_what_is_said_of_a_run_that_was_not_opened(values):
    said = ("E-RUN", "run 01", "its file was not opened", "Load the runs of this use.")
    assert refusal(problem_of, MODEL, a_run(**values)) == said


@pytest.mark.parametrize(("kind", "gyro"), [("toss", None), ("toss", GYRO), ("release", None)])
def test_what_is_said_of_an_experiment_without_gyroscope(kind, gyro):
    error = refused(gyro_of, Experiment(Path("folder"), "x", kind, "eight_points", 54.0, 0.1, 0.688, None, gyro, ()))
    cure = "Runs of a gyroscope on a released block are needed."
    assert str(error) == f"folder: kind is '{kind}'. {cure} [E-KIND]"


def test_the_gyroscope_is_that_of_the_experiment():
    release = Experiment(Path("folder"), "x", "release", "eight_points", 54.0, 0.1, 0.688, 0.001, GYRO, ())
    assert gyro_of(release) is GYRO


@pytest.fixture
def engine(monkeypatch):
    """An engine that notes what it is given, reports half and all of each run, and answers with its duration."""
    calls = []

    def run(problem, name, progress):
        calls.append((problem, name))
        if progress is not None:
            progress(0.5)
            progress(1.0)
        batch = problem.batch
        return [(problem.duration, i) for i in range(batch[0])] if batch else problem.duration

    monkeypatch.setattr(prediction, "run", run)
    return calls


PROBLEMS = [problem_of(MODEL, a_run(end)) for end in (0.2, 0.4, 0.3)]


def test_runs_one_after_the_other_report_how_much_of_all_is_done(engine):
    shares = []
    assert solve(PROBLEMS, "numba", shares.append) == [p.duration for p in PROBLEMS]
    assert [name for _, name in engine] == 3 * ["numba"]
    assert shares == pytest.approx([1 / 6, 1 / 3, 1 / 3, 1 / 2, 2 / 3, 2 / 3, 5 / 6, 1, 1])
    assert solve(PROBLEMS, "numba", None) == [p.duration for p in PROBLEMS]


def test_the_plain_engine_takes_them_side_by_side_as_long_as_the_longest(engine):
    shares = []
    longest = PROBLEMS[1].duration
    assert solve(PROBLEMS, "numpy", shares.append) == [(longest, 0), (longest, 1), (longest, 2)]
    ((batch, name),) = engine
    assert name == "numpy" and batch.start.x.shape == (3, 3) and shares == [0.5, 1.0]
    assert solve(PROBLEMS[:2], "numpy", None) == [(longest, 0), (longest, 1)]


def test_the_plain_engine_takes_a_single_run_as_it_is(engine):
    shares = []
    assert solve(PROBLEMS[:1], "numpy", shares.append) == [PROBLEMS[0].duration]
    assert engine[0][0] is PROBLEMS[0] and shares == [0.5, 1.0, 1.0]


def test_predictions_carry_run_release_step_and_gyroscope(monkeypatch):
    asked = {}

    class Motion:
        t, W = np.arange(400) / 4000.0, np.ones((400, 3))

    def solved(problems, engine, progress):
        asked.update(problems=problems, engine=engine, progress=progress)
        return [Motion() for _ in problems]

    monkeypatch.setattr(prediction, "solve", solved)
    runs, gyro = [a_run(), a_run(id="02")], replace(GYRO, range=0.5)
    report = [].append
    found = prediction.predict(
        MODEL, runs, gyro, engine="numpy", releases={"02": {"theta_0": 0.1}}, step=2e-5, progress=report
    )
    assert [p.run for p in found] == ["01", "02"] and all(p.gyro is gyro for p in found)
    assert all(isinstance(p.response, Motion) for p in found)
    tilts = [abs(p.start.Lambda[2, 1]) for p in asked["problems"]]
    assert tilts == pytest.approx(np.sin([0.117, 0.1]), rel=1e-3)
    assert [p.step for p in asked["problems"]] == [2e-5, 2e-5]
    assert (asked["engine"], asked["progress"]) == ("numpy", report)
    # The gyroscope's low-pass keeps what stands still.
    assert found[1].crv == pytest.approx(np.ones((400, 3)), rel=1e-9)
    doubled = prediction.predict(MODEL.replace(effects=(GyroScale(2.0, 2.0, 2.0),)), runs, gyro)
    assert doubled[0].crv == pytest.approx(2.0 * np.ones((400, 3)), rel=1e-9)
    assert (asked["engine"], asked["progress"], asked["problems"][0].step) == ("auto", None, STEP)


def test_every_run_has_its_own_response(monkeypatch):
    monkeypatch.setattr(prediction, "solve", lambda *_: [])
    with pytest.raises(ValueError):
        prediction.predict(MODEL, [a_run()], GYRO)


def shown(gyro=GYRO, effects=()):
    """What is shown of rates of 1 + t, 2 and -3 rad/s from 0 to 0.1 s at 4 kHz."""
    t = np.arange(401) / 4000.0
    crv = np.stack([1.0 + t, 0 * t + 2.0, 0 * t - 3.0], axis=-1)
    return Prediction("01", SimpleNamespace(t=t, problem=SimpleNamespace(effects=effects)), crv, gyro)


def test_rates_are_sampled_between_held_before_and_unknown_beyond():
    found = shown().at([-0.5, 0.0, 0.01003, 0.1, 0.1 + 0.9e-9])
    assert found[:, 0] == pytest.approx([1.0, 1.0, 1.01003, 1.1, 1.1], rel=1e-12)
    assert found[:, 1:] == pytest.approx(np.tile([2.0, -3.0], (5, 1)), rel=1e-12)
    assert np.isnan(shown().at(np.array([0.05, 0.1 + 1.1e-9, 1.0]))).all(axis=1).tolist() == [False, True, True]


def test_the_ranges_of_data_sheet_and_effects_cut_what_is_shown():
    assert np.abs(shown(replace(GYRO, range=0.5)).at(np.array([0.05]))).tolist() == [[0.5, 0.5, 0.5]]

    class Noted(GyroSaturation):
        """A range that shows the instants it is asked about."""

        def sensor(self, t, crv):
            return crv * 0.0 + np.asarray(t)[:, None]

    assert shown(effects=(Noted(0.7),)).at([0.02, 0.03]).tolist() == [[0.02] * 3, [0.03] * 3]
