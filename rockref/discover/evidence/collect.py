"""From fits to evidence: eigenvalues, losses by run and axis, amplitudes with intervals, held-out runs."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rockref.discover.evidence.evidence import HypothesisEvidence, Number
from rockref.discover.evidence.held_out import held_out_losses
from rockref.discover.evidence.widths import covariance
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.objective import loss
from rockref.discover.fit.stages import F
from rockref.discover.hypotheses.effects import own_value
from rockref.discover.hypotheses.parameter import Parameter
from rockref.discover.listening.listener import Listener

#: Half width of a 90 % interval in standard deviations of a normal law.
NINETY = 1.6449
#: Length of a block [s] and mean loss from which it is far above white; decided: white blocks of 150 values have 0.945
#: with a deviation of 0.09.
BLOCK, FAR_ABOVE = 0.05, 1.5


def hypothesis_evidence(fitter: Fitter, h: FittedModel, held: Listener | None) -> HypothesisEvidence:
    """Return what a fit at the longest memory says; `held`: the held-out runs, None where they are not asked."""
    fitter.evaluate(h, F)
    covariance_, H = covariance(fitter, h, F)
    runs = fitter.problem.runs
    by_axis = fitter.losses(h)
    parameters = fitter.parameters(h)
    law = [abs(float(z)) for p, z in zip(parameters, h.z, strict=True) if not p.effect and p.run is None]
    return HypothesisEvidence(
        effects=h.effects,
        objective=h.objective,
        eigenvalues=np.linalg.eigvalsh(H).tolist(),
        loss=h.loss,
        loss_by_run_and_axis={run.id: row.tolist() for run, row in zip(runs, by_axis, strict=True)},
        blocks={run.id: float(share) for run, share in zip(runs, far_above(fitter, h), strict=True)},
        farthest=max(law, default=0.0),
        numbers=numbers_of(parameters, h.z, covariance_),
        held_out=held_out_losses(fitter, h, held) if held is not None else {},
    )


def numbers_of(parameters: Sequence[Parameter], z: np.ndarray, covariance_: np.ndarray) -> dict[str, Number]:
    """Return the numbers of the effects with their 90 % intervals."""
    found = {}
    for k, p in enumerate(parameters):
        if not p.effect:
            continue
        half = NINETY * float(np.sqrt(covariance_[k, k]))
        ends = sorted(own_value(p, float(np.clip(z[k] + s * half, p.least, p.most))) for s in (-1, 1))
        size = float(z[k]) / p.typical if p.typical else 0.0
        found[p.name] = Number(own_value(p, float(z[k])), ends[0], ends[1], p.unit, float(z[k]), size)
    return found


def far_above(fitter: Fitter, h: FittedModel) -> np.ndarray:
    """Return the share of blocks of each run whose mean loss is far above white, (R,)."""
    assert h.r is not None
    length = max(1, round(BLOCK * fitter.problem.listener.gyro.sample_rate))
    R, n = h.r.shape[:2]
    whole = n // length * length
    means = loss(h.r[:, :whole]).reshape(R, -1, length * 3).mean(axis=2)
    return (means > FAR_ABOVE).mean(axis=1)
