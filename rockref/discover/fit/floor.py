"""The mean loss that a model leaves in records of its own: what a right one is to be measured by.

A run that listens knows no more than its record tells. Stiff feet, a slow recorder or a narrow band leave innovations
above white noise in the right model too, and by how much is found by simulation (a parametric bootstrap: B. Efron,
R. J. Tibshirani 1993, An Introduction to the Bootstrap, ISBN 978-0-412-04231-7, section 6.5).
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.objective import WHITE
from rockref.discover.fit.stages import Stage
from rockref.discover.fit.whitening import whiten
from rockref.discover.listening.listener import Listener
from rockref.discover.progress import StageCounter
from rockref.measure.gyroscope import quantise

#: Records that are made of each run, of which the median counts; decided: in one of five a run falls out of step.
RECORDS = 3


def floor(fitter: Fitter, h: FittedModel, stage: Stage) -> tuple[float, np.ndarray]:
    """Return the mean loss of a model in records of its own, in all and by run and axis (R, 3); at least white noise's.

    The model moves freely, the gyroscope adds its noise, and the model listens to that with the numbers that made it.
    """
    found = [in_own_record(fitter, h, stage, seed) for seed in range(RECORDS)]
    losses = np.median([fitter_.losses(k) for fitter_, k in found], axis=0)
    return max(WHITE, float(np.median([k.loss for _, k in found]))), np.maximum(WHITE, losses)


def in_own_record(fitter: Fitter, h: FittedModel, stage: Stage, seed: int) -> tuple[Fitter, FittedModel]:
    """Return a fitter of records that h makes with its present numbers, and h evaluated there at a stage."""
    problem, listener = fitter.problem, fitter.problem.listener
    rng = np.random.default_rng((problem.seed, seed))
    parameters = fitter.parameters(h)
    free = replace(stage, rates=math.inf, attitude=math.inf)
    memory = free.memory(problem.time_scale, fitter.residuals(stage).fineness(parameters, h.z))
    shown = listener.predict([problem.job(parameters, h.z)], memory)[0]
    noisy = shown + listener.sigma[:, None, :] * rng.standard_normal(shown.shape)
    runs = [
        replace(run, t=t, crv=quantise(noisy[i, : len(t)], listener.gyro.resolution))
        for i, (run, t) in enumerate(zip(listener.runs, listener.t, strict=True))
    ]
    own = replace(
        problem, listener=Listener(problem.experiment, runs, listener.end, listener.workers, whole=listener),
        progress=StageCounter({}), refined=lambda h, stage: None, spikes={},
    )  # fmt: skip
    again, start = Fitter(own), FittedModel(h.effects, h.z.copy())
    if stage.name in problem.spikes:
        whiten(again, start, stage)
    return again, again.evaluate(start, stage)
