"""An experiment as fits see it, refused at once where any of it cannot be used."""

from __future__ import annotations

from pathlib import Path

from rockref.discover.windows.on_time import on_time
from rockref.measure.experiment import FIT, HOLDOUT, Experiment, load_experiment
from rockref.model.errors import InputError


def opened(path: str | Path) -> tuple[Experiment, Experiment]:
    """An experiment with its fit runs alone, which is all that a fit may see, and with the held-out ones, too.

    Held-out records that cannot be used are refused here, and not after minutes of fitting. Raises InputError.
    """
    whole = on_time(usable(load_experiment(path, uses=(FIT, HOLDOUT))))
    return on_time(load_experiment(path, uses=(FIT,))), whole


def usable(experiment: Experiment) -> Experiment:
    """The experiment, if it has releases, a gyroscope and fit runs. Raises InputError (E-KIND, E-NO-FIT)."""
    where = f"{experiment.path}"
    if experiment.kind != "release" or experiment.gyro is None:
        raise InputError("E-KIND", where, f"is a {experiment.kind}, or has no gyroscope", "Give releases.")
    if not experiment.fit_runs():
        raise InputError("E-NO-FIT", where, "has no fit run", 'Mark runs with use = "fit".')
    return experiment
