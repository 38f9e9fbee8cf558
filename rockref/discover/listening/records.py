"""An experiment as fits see it, refused at once where any of it cannot be used."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rockref.effects import catalogue
from rockref.effects.base import Effect
from rockref.measure.experiment import load_experiment
from rockref.measure.records.release import FIT, HOLDOUT, Experiment, Run
from rockref.measure.signals.impacts import main_impacts
from rockref.model.errors import InputError

#: Samples a second below which nothing is heard of an impact (decided: its clatter has a period of 20 ms and more).
SLOWEST = 200.0
#: Samples by which a record may begin late (decided: what lacks more lacks a part of the release).
LATEST = 1.5


def opened(path: str | Path) -> tuple[Experiment, Experiment]:
    """Return an experiment with its fit runs alone, which is all that a fit may see, and with the held-out ones, too.

    Held-out records that cannot be used are refused here, and not after minutes of fitting.

    Raises
    ------
    InputError
        E-KIND, E-NO-FIT, E-GYRO, E-START, E-SHORT, and those of the reader.
    """
    whole = usable(load_experiment(path, uses=(FIT, HOLDOUT)))
    return load_experiment(path, uses=(FIT,)), whole


def usable(experiment: Experiment) -> Experiment:
    """Return the experiment, if it has releases that a gyroscope followed from the beginning. Raises InputError."""
    where = f"{experiment.path}"
    if experiment.kind != "release" or experiment.gyro is None:
        raise InputError("E-KIND", where, f"is a {experiment.kind}, or has no gyroscope", "Give releases.")
    if not experiment.fit_runs():
        raise InputError("E-NO-FIT", where, "has no fit run", 'Mark runs with use = "fit".')
    if experiment.gyro.sample_rate < SLOWEST:
        what = f"sample_rate_hz = {experiment.gyro.sample_rate:g}: impacts are over between two samples"
        raise InputError("E-GYRO", f"{where}: [gyro]", what, f"Record {SLOWEST:g} samples a second or more.")
    for run in experiment.runs:
        check_record(experiment, run)
    return experiment


def check_record(experiment: Experiment, run: Run) -> None:
    """Refuse a record without its beginning (E-START) or without a main impact (E-SHORT)."""
    if run.t is None or run.crv is None or experiment.gyro is None:
        return
    where = str(experiment.path / run.file)
    if not len(main_impacts(run.t, run.crv).times):
        raise InputError("E-SHORT", where, "shows no main impact", "Leave the run out, or give a longer record.")
    if run.t[0] * experiment.gyro.sample_rate > LATEST:
        cure = "Give the record from the release on, or leave the run out."
        raise InputError("E-START", where, f"begins {run.t[0]:.3g} s after the release", cure)


def own_effects(names: Sequence[str]) -> tuple[str, ...]:
    """Return the ids of a user's own effects, each path/to/file.py:Class, that can be fitted.

    Raises
    ------
    InputError
        E-EFFECT for one of the catalogue, or given twice; E-FILE for one that cannot be used; E-TWIN for one that acts
        on the sensor and does not say how that is undone.
    """
    found = tuple(catalogue.named(name) for name in names)
    for k, kind in enumerate(found):
        if kind.file is None:
            cure = "Leave it out, or name a class of yours, path/to/file.py:Class."
            raise InputError("E-EFFECT", "--effect", f"{kind.id} is in the catalogue, which is tried anyway", cure)
        if kind.id in [other.id for other in found[:k]]:
            raise InputError("E-EFFECT", "--effect", f"{kind.id}: it is given twice", "Give each once.")
        if kind.sensor is not Effect.sensor and not kind.changes_target():
            what = "acts on the sensor, and does not say how that is undone"
            cure = "Give the class a method undo(t, crv), the inverse of sensor."
            raise InputError("E-TWIN", f"effect {kind.id}", what, cure)
    return tuple(kind.id for kind in found)
