"""What a model would have recorded: the same release, the same gyroscope, the instants of the measured rows."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.engines import chosen, run
from rockref.measure.gyroscope import expected, limited, sample
from rockref.measure.records.release import Experiment, Gyro, Run
from rockref.model.errors import InputError
from rockref.model.problem import Problem, stack
from rockref.model.response import Response

#: The source's step [s].
STEP = 1e-5
# decided: at 4 kHz the filtered rates differ from those at 20 kHz by at most 0.012 deg/s (0.0017 in the mean), which is
# the resolution of the gyroscope; at 2 kHz by 0.05.
FINE_RATE = 4000.0
# decided: a record that is compared after a shift in time, or with a slow clock, needs this much more of the model.
LEAST_MARGIN, MARGIN_SHARE = 0.1, 0.03


@dataclass(frozen=True, eq=False)
class Prediction:
    """One run of a model as the experiment's gyroscope would show it, without noise and quantisation.

    Attributes
    ----------
    run : id of the measured run
    response : the simulated motion, 4 kHz
    crv : (N, 3) what is there to be sampled: body rates after the gyroscope's low-pass and the model's sensor effects,
        at ``response.t``, rad/s; not yet cut at the largest rate that it shows.
    gyro : its data sheet
    """

    run: str
    response: Response = field(repr=False)
    crv: np.ndarray = field(repr=False)
    gyro: Gyro = field(repr=False)

    @property
    def t(self) -> np.ndarray:
        """Return time from the release, (N,) s."""
        return self.response.t

    def at(self, times: np.ndarray) -> np.ndarray:
        """Return the rates at `times` (M,) s, (M, 3) rad/s: at rest before the release, NaN beyond the simulation."""
        times = np.asarray(times, dtype=np.float64)
        sampled = sample(self.t, self.crv, np.clip(times, self.t[0], self.t[-1]))
        rates = limited(times, sampled, self.gyro, self.response.problem.effects)
        return np.where((times <= self.t[-1] + 1e-9)[:, np.newaxis], rates, np.nan)


def gyro_of(experiment: Experiment) -> Gyro:
    """Return the gyroscope of a release experiment. Raises InputError E-KIND where the runs are no releases."""
    if experiment.kind != "release" or experiment.gyro is None:
        what = f"kind is {experiment.kind!r}"
        raise InputError("E-KIND", f"{experiment.path}", what, "Runs of a gyroscope on a released block are needed.")
    return experiment.gyro


def problem_of(model: Model, run: Run, release: Mapping[str, Any] | None = None, step: float = STEP) -> Problem:
    """Return what has to be simulated for a run: its stated tilt and side, its length and a margin.

    `release` replaces values of the release (``theta_0``, ``out_of_plane``, rad). Raises InputError: E-RUN for a run
    that was not loaded, and those of ``Model.problem``.
    """
    if run.t is None or run.release_tilt is None:
        raise InputError("E-RUN", f"run {run.id}", "its file was not opened", "Load the runs of this use.")
    end = float(run.t[-1])
    start = {"theta_0": run.release_tilt, "turned": abs(run.block_turned) > 0.5 * math.pi, **(release or {})}
    return model.problem(end + max(LEAST_MARGIN, MARGIN_SHARE * end), step, FINE_RATE, **start)


def predict(
    model: Model,
    runs: Sequence[Run],
    gyro: Gyro,
    *,
    engine: str = "auto",
    releases: Mapping[str, Mapping[str, Any]] | None = None,
    step: float = STEP,
    progress: Callable[[float], None] | None = None,
) -> list[Prediction]:
    """Return what `model` would have recorded in each of `runs`.

    Sensor effects of the model and the data sheet act in the order of a real gyroscope (`gyroscope.expected`, and
    `gyroscope.limited` when it is sampled). `releases` gives other release values by run id. Raises InputError,
    NumericalError of the simulation.
    """
    problems = [problem_of(model, run, (releases or {}).get(run.id), step) for run in runs]
    responses = solve(problems, engine, progress)
    effects = model.active_effects()
    return [
        Prediction(one.id, response, expected(response.t, response.W, gyro, effects), gyro)
        for one, response in zip(runs, responses, strict=True)
    ]


def solve(problems: list[Problem], engine: str, progress: Callable[[float], None] | None) -> list[Response]:
    """Return the responses of `problems`: one after the other where that is quick, else side by side in one batch.

    A step of the NumPy engine costs nearly the same for one block and for ten.
    """
    if len(problems) > 1 and chosen(problems[0], engine) == "numpy":
        longest = max(p.duration for p in problems)
        batch = run(stack([replace(p, duration=longest) for p in problems]), "numpy", progress)
        return [batch[i] for i in range(len(problems))]
    responses = []
    for k, problem in enumerate(problems):
        responses.append(run(problem, engine, _part(progress, k, len(problems))))
        if progress is not None:
            progress((k + 1) / len(problems))
    return responses


def _part(progress: Callable[[float], None] | None, k: int, count: int) -> Callable[[float], None] | None:
    """Return what the k-th of `count` runs reports its own fraction to."""
    return None if progress is None else lambda share: progress((k + share) / count)
