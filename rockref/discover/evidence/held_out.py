"""Held-out runs: all numbers that runs share stay as they were fitted; only each release is found anew."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.problem import FitProblem
from rockref.discover.fit.stages import S1, S3, F
from rockref.discover.hypotheses.parameter import Parameter
from rockref.discover.listening.listener import Listener
from rockref.discover.provenance import OF_ONE_RELEASE
from rockref.measure.records.release import Experiment


@dataclass
class ReleaseProblem(FitProblem):
    """Runs of which only the releases are found: `base` has everything else."""

    def parameters(self, effects: Sequence[str] = ()) -> tuple[Parameter, ...]:
        """Return the numbers of each run alone."""
        return tuple(p for p in super().parameters(effects) if p.run is not None)


def held_out_listener(fitter: Fitter, experiment: Experiment) -> Listener | None:
    """Return a listener to the held-out runs of an experiment, recorded with the gyroscope of the fit runs; None where
    there are none."""
    listener, runs = fitter.problem.listener, experiment.holdout_runs()
    return Listener(experiment, runs, listener.end, listener.workers, whole=listener) if runs else None


def held_out_fit(fitter: Fitter, h: FittedModel, listener: Listener) -> tuple[Fitter, FittedModel]:
    """Return a fit of the releases of held-out runs with the shared numbers of h."""
    problem = fitter.problem
    base = fitter.model(h)
    own = {k: v for k, v in base.origin.items() if k not in OF_ONE_RELEASE}
    released = ReleaseProblem(
        problem.experiment, listener, base.replace(origin=own), tone=problem.tone, finer=problem.finer,
        progress=problem.progress,
    )  # fmt: skip
    inner = Fitter(released)
    k = FittedModel(h.effects, np.zeros(len(released.parameters(h.effects))))
    for stage in (S1, S3, F):
        inner.refine(k, stage, 3)
    return inner, k
