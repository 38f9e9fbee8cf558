"""The covariance of innovations of a right model, and innovations made white by it.

A run that listens follows the noise of its record, and impacts amplify what it has followed. So behind an impact the
innovations of the right model are no white noise: errors of a few motions ring through dozens of samples. By how much
is found by simulation: fresh noise is added to the record, and what it changes of the innovations is distributed as
they are (an ensemble in place of a Kalman filter's covariance: G. Evensen 1994, J. Geophys. Res. 99:10143-10162,
doi:10.1029/94JC00572). In each piece of a run the covariance is one and a few spikes, which stand out of what an
ensemble of this size shows of white noise (D. L. Donoho, M. Gavish, I. M. Johnstone 2018, Optimal shrinkage of
eigenvalues in the spiked covariance model, Ann. Statist. 46:1742-1778, doi:10.1214/17-AOS1601).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.spikes import Spikes, spikes
from rockref.discover.fit.stages import Stage
from rockref.discover.listening.listener import AGREES, Job, Listener

#: Records with fresh noise (decided: an error of a motion that amplifies noise tenfold in power, and rings for ten
#: samples, then stands four times above what white noise shows).
RECORDS = 64
#: Length of the pieces of a run [s], for the source's block (decided: three times the longest memory of the rates).
PIECE = 0.06
#: Changes count no further than this many noise widths (decided: a run that falls out of step says nothing more).
FARTHEST = 30.0
#: Median of the absolute value of a standard normal innovation.
MEDIAN = 0.6745


def whiten(fitter: Fitter, h: FittedModel, stage: Stage) -> None:
    """Let a stage count innovations by the covariance that they have about a model; once, so that fits compare."""
    if stage.name not in fitter.problem.spikes:
        fitter.problem.spikes[stage.name] = whitening(fitter, h, stage)


def whitening(fitter: Fitter, h: FittedModel, stage: Stage) -> list[Spikes]:
    """Return what is not white in the innovations that a model would leave at a stage, were it right."""
    problem, listener = fitter.problem, fitter.problem.listener
    change = changes(fitter, h, stage)
    K, R, N, _ = change.shape
    length = max(1, round(PIECE * problem.time_scale * listener.gyro.sample_rate))
    found = []
    for i in range(R):
        for first in range(0, N, length):
            piece = change[:, i, first : first + length]
            found.append(Spikes(i, first, first + piece.shape[1], *spikes(piece.reshape(K, -1))))
    return [s for s in found if len(s.variances)]


def changes(fitter: Fitter, h: FittedModel, stage: Stage) -> np.ndarray:
    """Return what fresh noise in the records changes of innovations, (RECORDS, R, N, 3) in noise widths."""
    problem, listener = fitter.problem, fitter.problem.listener
    rng = np.random.default_rng(problem.seed)
    parameters = fitter.parameters(h)
    memory = stage.memory(problem.time_scale, fitter.residuals(stage).by_stiffness(parameters, h.z))
    job = problem.job(parameters, h.z)
    noisy = [
        replace(run, t=t, crv=listener.measured[i, : len(t)] + listener.sigma[i] * rng.standard_normal((len(t), 3)))
        for _ in range(RECORDS)
        for i, (run, t) in enumerate(zip(listener.runs, listener.t, strict=True))
    ]
    ensemble = Listener(problem.experiment, noisy, listener.end, listener.workers, whole=listener)
    own = listener.innovations(listener.predict([job], memory)[0])
    theirs = ensemble.innovations(ensemble.predict([Job(job.models * RECORDS)], memory)[0])
    return np.clip(theirs.reshape(RECORDS, *own.shape) - own, -FARTHEST, FARTHEST)


def quieten(fitter: Fitter, h: FittedModel, stage: Stage) -> bool:
    """Take the noise of the gyroscope for what a model leaves, where that is less; return whether it is.

    A block that is never calm shows no noise alone; its noise is no more than what the best model leaves between the
    impacts.
    """
    listener, parameters = fitter.problem.listener, fitter.parameters(h)
    memory = stage.memory(fitter.problem.time_scale, fitter.residuals(stage).fineness(parameters, h.z))
    r = listener.innovations(listener.predict([fitter.problem.job(parameters, h.z)], memory)[0])
    left = np.median(np.abs(r[listener.valid[:, : r.shape[1]]]), axis=0) / MEDIAN
    share = np.where(left < 1 - AGREES, left, 1.0)
    if (share < 1.0).any():
        listener.quieten(share)
        fitter.problem.say(f"noise of the axes: {' '.join(f'{x:.2f}' for x in share)} of what it was taken for")
    return bool((share < 1.0).any())
