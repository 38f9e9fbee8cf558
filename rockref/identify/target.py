"""What a model is compared with: a run as a gyroscope recorded it, and what is said of it between two main impacts."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from rockref.api import Model
from rockref.identify.features import Features, features
from rockref.measure.gyroscope import record
from rockref.measure.records.release import Experiment, Gyro, Run
from rockref.model.errors import InputError

#: The gyroscope of a twin experiment, where none is stated: that of the practice experiments.
GYRO = Gyro(sample_rate=1000.0, noise=float(np.radians(0.05)), bandwidth=300.0, resolution=0.0)
#: How far beyond the second main impact a run is needed [s]; decided: the impact itself takes 20 ms, and what finds it
#: looks 12 ms further.
BEYOND = 0.05


@dataclass(frozen=True, eq=False)
class Target:
    """A run to be matched.

    name; t (N,) [s], crv (N, 3) [rad/s] as recorded, up to `BEYOND` after the second main impact; gyro that recorded
    it; tilt: stated at release [rad]; turned: whether the block was turned by 180 degrees; features: of the record.
    """

    name: str
    t: np.ndarray
    crv: np.ndarray
    gyro: Gyro
    tilt: float
    turned: bool = False
    features: Features = field(default=None, repr=False)  # type: ignore[assignment]

    @property
    def until(self) -> float:
        """Return the second main impact [s]: up to here the runs repeat."""
        return float(self.features.impacts[1])

    @property
    def duration(self) -> float:
        """Return how long a simulation must be to be compared [s]; a model that is slower by 6 % is still seen
        (decided)."""
        return 1.06 * self.until + 0.02

    @property
    def residual_duration(self) -> float:
        """Return how long a simulation must be for the residual up to `until` [s]: a sample of the gyroscope further,
        and 20 ms (decided: a spline carries a quarter from one output to the one before, nothing over forty)."""
        return self.until + 1 / self.gyro.sample_rate + 0.02


def target(name: str, t: np.ndarray, crv: np.ndarray, gyro: Gyro, tilt: float, turned: bool = False) -> Target:
    """Return a target from a record t (N,) [s], crv (N, 3) [rad/s].

    Raises InputError: E-SIGNAL; E-IMPACTS where the record has fewer than two main impacts.
    """
    found = features(t, crv)
    if len(found.impacts) < 2:
        what = f"the record has {len(found.impacts)} main impacts"
        raise InputError("E-IMPACTS", f"run {name}", what, "Give a run that reaches its second main impact.")
    last = int(np.searchsorted(t, found.impacts[1] + BEYOND))
    return Target(name, t[:last], crv[:last], gyro, tilt, turned, found)


def seen_until(seen: Target, after: float) -> Target:
    """Return the target, looked at no further than `after` [s] beyond its first main impact."""
    first, second = seen.features.impacts[:2]
    end = np.array([first, min(second, first + after)])
    return replace(seen, features=replace(seen.features, impacts=end))


def targets_of(experiment: Experiment, runs: tuple[Run, ...] | None = None) -> tuple[Target, ...]:
    """Return the fit runs of an experiment (or `runs`) as targets.

    Raises InputError: E-KIND, where the experiment has no releases or no gyroscope; E-IMPACTS.
    """
    if experiment.kind != "release" or experiment.gyro is None:
        what = f"is a {experiment.kind} experiment" if experiment.kind != "release" else "has no [gyro]"
        raise InputError("E-KIND", str(experiment.path), what, "Identification needs releases and a gyroscope.")
    chosen = experiment.fit_runs() if runs is None else runs
    found = []
    for run in chosen:
        assert run.t is not None and run.crv is not None and run.release_tilt is not None
        found.append(target(run.id, run.t, run.crv, experiment.gyro, run.release_tilt, bool(run.block_turned)))
    return tuple(found)


def chosen_runs(targets: tuple[Target, ...], names: str | None) -> tuple[Target, ...]:
    """Return the targets with these names, written as "01,06"; without names the first. Raises InputError (E-RUN)."""
    if names is None:
        return targets[:1]
    known = {t.name: t for t in targets}
    wanted = [name.strip() for name in names.split(",")]
    for name in wanted:
        if name not in known:
            raise InputError(
                "E-RUN", "--search-runs", f"there is no fit run {name!r}", f"There are {', '.join(known)}."
            )
        if wanted.count(name) > 1:
            raise InputError("E-RUN", "--search-runs", f"names run {name} twice", "Name each once.")
    return tuple(known[name] for name in wanted)


def twin(model: Model, step: float, seed: int | None) -> Target:
    """Return a reference simulated with another step, recorded with the noise that `seed` draws (None: no noise)."""
    from rockref.engines import run

    response = run(model.problem(1.6, step, 2000.0), engine="auto")
    rng = None if seed is None else np.random.default_rng(seed)
    t, crv = record(response.t, response.W, GYRO, rng, model.active_effects())
    return target(f"twin {seed}", t, crv, GYRO, model.parameters.theta_0)
