"""Runs at the instants that windows count by: sample k stands k / sample_rate after the release.

A logger that comes at 1003 samples a second where 1000 are stated would otherwise look like a clock that is off.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rockref.measure.clock import EVEN
from rockref.measure.experiment import Experiment, Gyro, Run
from rockref.measure.impacts import main_impacts
from rockref.measure.timebase import RATE_WARNING
from rockref.model.errors import InputError

#: Samples a second below which no state can be read off a window (decided: a parabola takes five, here 20 ms).
SLOWEST = 200.0
#: By how many samples a record may begin late and be taken as it is, and be used at all (decided: half a sample is the
#: rounding of its stamps; what W-START is said of, a sample and a half and more, lacks a part of the release).
AS_IT_IS, LATEST = 0.5, 1.5


def gyro_of(experiment: Experiment) -> Gyro:
    """The data sheet of an experiment's gyroscope. Raises InputError (E-GYRO) where it has none, or a slow one."""
    where = f"{experiment.path}: [gyro]"
    if experiment.gyro is None:
        cure = "Windows are restarted from gyroscope records; state [gyro] in experiment.toml."
        raise InputError("E-GYRO", where, "is missing", cure)
    if experiment.gyro.sample_rate < SLOWEST:
        what = f"sample_rate_hz = {experiment.gyro.sample_rate:g}: windows of 25 ms hold too few samples"
        raise InputError("E-GYRO", where, what, f"Record {SLOWEST:g} samples a second or more; 500 are good.")
    return experiment.gyro


def on_time(experiment: Experiment) -> Experiment:
    """The experiment with the opened runs at k / sample_rate from the release on; those that are so already are kept.

    The times of the runs are those of their samples; a line through them takes the rounding of even ones away.
    Raises InputError: E-GYRO; E-START where the beginning is missing; E-SHORT where no main impact shows.
    """
    rate = gyro_of(experiment).sample_rate
    return replace(experiment, runs=tuple(_on_time(experiment, run, rate) for run in experiment.runs))


def _on_time(experiment: Experiment, run: Run, rate: float) -> Run:
    if run.t is None or run.crv is None:
        return run
    where = str(experiment.path / run.file)
    if not len(main_impacts(run.t, run.crv).times):
        cure = "Leave the run out, or give a longer record."
        raise InputError("E-SHORT", where, "shows no main impact, after which windows begin", cure)
    interval, late = np.polyfit(np.arange(len(run.t)), run.t, 1)
    if late * rate > LATEST:
        cure = "Give the record from the release on, or leave the run out."
        raise InputError("E-START", where, f"begins {late:.3g} s late: windows follow the block from its release", cure)
    even = np.arange(len(run.t)) * interval + late
    uneven = np.abs(run.t - even).max() > EVEN * interval
    if abs(interval * rate - 1) < RATE_WARNING and abs(late) * rate < AS_IT_IS and not uneven:
        return run
    return _moved(run, run.crv, np.asarray(run.t) if uneven else even, rate)


def _moved(run: Run, crv: np.ndarray, taken: np.ndarray, rate: float) -> Run:
    """The run with its rates (N, 3), taken at these instants (N,) [s], at k / rate, by cubics; as far as it goes."""
    from scipy.interpolate import CubicSpline

    t = np.arange(int(taken[-1] * rate) + 1) / rate
    moved = CubicSpline(taken, crv)(np.maximum(t, taken[0]))
    # Cubics shoot over where a record is cut flat at the gyroscope's stops.
    return replace(run, t=t, crv=np.clip(moved, crv.min(axis=0), crv.max(axis=0)), pose=None)
