"""What all fits of one experiment share: the runs, the baseline, and the numbers of each set of effects."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.fit.spikes import Spikes
from rockref.discover.fit.stages import Stage, time_scale
from rockref.discover.hypotheses.candidates import within_base
from rockref.discover.hypotheses.effects import effect_parameters
from rockref.discover.hypotheses.law import law_parameters, release_parameters, with_law
from rockref.discover.hypotheses.parameter import Parameter, centring
from rockref.discover.listening.listener import Job, Listener, record_of
from rockref.discover.progress import StageCounter
from rockref.effects.natural import NaturalUnits, natural_units
from rockref.measure.experiment import TILT_UNCERTAINTY
from rockref.measure.records.release import Experiment, Run
from rockref.model.parameters import BLOCK, Parameters

#: Seconds of each run that are used, for the source's block.
END = 3.0


@dataclass
class FitProblem:
    """The runs of an experiment and the baseline that is fitted to them.

    base : the baseline without effects.  carried : effects of the user's model, part of every hypothesis
    candidates : ids of the effects that may be missing.  tone : frequency [Hz] of a line in the misfit, if there is one
    companion : nats that an effect beside another one has to gain beyond what any has to
    finer : factor on the steps of a stage, by its name (`rockref.discover.fit.steps`)
    spikes : what is not white in the innovations of a right model, by the stage (`rockref.discover.fit.whitening`)
    progress : counts the stages.  refined : called with every hypothesis that was refined, and its stage
    """

    experiment: Experiment
    listener: Listener
    base: Model
    candidates: tuple[str, ...] = ()
    carried: tuple[str, ...] = ()
    seed: int = 0
    tone: float | None = None
    companion: float = 0.0
    finer: dict[str, float] = field(default_factory=dict)
    spikes: dict[str, list[Spikes]] = field(default_factory=dict)
    progress: StageCounter = field(default_factory=lambda: StageCounter({}), repr=False)
    refined: Callable[[Any, Stage], None] = lambda h, stage: None
    _known: dict = field(default_factory=dict, repr=False)

    def say(self, line: str) -> None:
        """Report a line of the optimiser."""
        self.progress.say(line)

    @property
    def runs(self) -> tuple[Run, ...]:
        """Return the runs."""
        return self.listener.runs

    @property
    def records(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """Return times (N,) [s] and rates (N, 3) [rad/s] of each run."""
        return [record_of(run) for run in self.runs]

    @property
    def time_scale(self) -> float:
        """Return by how much slower than the source's block the block rocks."""
        return time_scale(self.base)

    @property
    def units(self) -> NaturalUnits:
        """Return the natural units of the block, with which the typical sizes of effects grow."""
        return natural_units(self.base)

    def parameters(self, effects: Sequence[str] = ()) -> tuple[Parameter, ...]:
        """Return the numbers of the law, of each release, and of these effects, in this order."""
        key = (tuple(effects), self.tone)
        if key not in self._known:
            R = len(self.runs)
            uncertainty = self.experiment.tilt_uncertainty or TILT_UNCERTAINTY
            found = [*law_parameters(self.base, self.experiment.prior)]
            found += release_parameters(R, uncertainty, self.listener.gyro.zero_uncertainty)
            for id in effects:
                found += [within_base(p, self.base) for p in effect_parameters(id, R, self.tone, self.units)]
            self._known[key] = tuple(found)
        return self._known[key]

    def job(self, parameters: Sequence[Parameter], z: np.ndarray, only: Sequence[int] | None = None) -> Job:
        """Return the models of the runs at z; of the runs `only`, where that is given."""
        if any(p.by_ratio for p in parameters):
            z = centring(parameters) @ z
        values = [p.value(float(at)) for p, at in zip(parameters, z, strict=True)]
        law, own = {}, []
        releases: list[dict[str, float]] = [{} for _ in self.runs]
        own_of: list[list[tuple[Parameter, float]]] = [[] for _ in self.runs]
        for p, value in zip(parameters, values, strict=True):
            if p.run is None:
                if p.effect:
                    own.append((p, value))
                else:
                    law[p.name] = value
            elif p.effect:
                own_of[p.run].append((p, value))
            else:
                releases[p.run][p.kind] = value
        shared = with_values(with_law(self.base, law) if law else self.base, own)
        models: list[Model | None] = []
        for i in range(len(self.runs)):
            if only is not None and i not in only:
                models.append(None)
                continue
            released = replace(shared, origin={**shared.origin, **releases[i]})
            models.append(with_values(released, own_of[i]))
        return Job(tuple(models))

    def nominal(self, effects: Sequence[str] = ()) -> np.ndarray:
        """Return z of the baseline's own numbers, those of Table 3.1 scaled with the block; effects are absent."""
        parameters = self.parameters(effects)
        z = np.zeros(len(parameters))
        for k, p in enumerate(parameters):
            if p.run is None and not p.effect:
                z[k] = p.z_of(nominal_value(self.base, p.name))
        return z


def with_values(model: Model, values: Sequence[tuple[Parameter, float]]) -> Model:
    """Return a model with numbers of its effects."""
    for p, value in values:
        model = p.set(model, value)
    return model


def nominal_value(model: Model, name: str) -> float:
    """Return a parameter of a model as a fit counts it: tangential over normal stiffness in place of K_T.

    Where the parameters are those of Table 3.1, lengths scale with the width and stiffness with the mass.
    """
    p = model.parameters
    of_source = p.replace(theta_0=Parameters().theta_0) == Parameters()
    if name == "K_T":
        return p.K_T / p.K_N
    if name == "K_N":
        return p.K_N * (model.mass / BLOCK["mass"].value if of_source else 1.0)
    scale = model.width / BLOCK["width"].value if of_source else 1.0
    if name.startswith("delta_long_"):
        return p.delta_long[int(name[-1]) - 1] * scale
    return getattr(p, name) * (scale if name == "delta_diag" else 1.0)


def fit_problem(
    experiment: Experiment, runs: Sequence[Run], base: Model, end: float = END, workers: int | None = None, **options
) -> FitProblem:
    """Return the problem of fitting a baseline to runs, up to `end` s for the source's block."""
    carried = tuple(e.id for e in base.active_effects())
    listener = Listener(experiment, runs, end * time_scale(base), workers)
    return FitProblem(experiment, listener, replace(base, effects=()), carried=carried, **options)
