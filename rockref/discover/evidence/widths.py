"""How sure a number is: the sandwich of a fit, from gradients over blocks of time, or the tempered posterior.

Innovations of neighbouring instants are not independent where a model is a little wrong, and the inverse of the
Gauss-Newton matrix alone is too narrow. P. J. Huber (1967), Proc. 5th Berkeley Symp. 1:221-233.
"""

from __future__ import annotations

import numpy as np

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.objective import weight
from rockref.discover.fit.stages import Stage
from rockref.discover.hypotheses.parameter import centring

#: Length of a block [s] for the source's block; decided: several memories, so that blocks are independent.
BLOCK = 0.1


def deviations(fitter: Fitter, h: FittedModel, stage: Stage, temperature: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the standard deviation (G,) of each z, and the Gauss-Newton matrix (G, G), at a fit.

    h : polished at the stage; if it is not, it is.

    The larger of two: the sandwich, and the posterior's at the temperature of the evidence. Of factors that only act by
    their ratios, that of their ratio to the geometric mean.
    """
    if h.spread is None:
        fitter.polish(h, stage, 1)
    else:
        fitter.evaluate(h, stage)
    spread = h.spread
    assert spread is not None
    scores = (spread.J * (weight(spread.r) * spread.r)).sum(axis=-1)  # (G, R, n)
    G, R, n = scores.shape
    length = max(1, round(BLOCK * fitter.problem.time_scale * fitter.problem.listener.gyro.sample_rate))
    whole = n // length * length
    blocks = scores[:, :, :whole].reshape(G, R * (whole // length), length).sum(axis=-1)
    inverse = np.linalg.inv(spread.information() + spread.prior())
    sandwich = inverse @ (blocks @ blocks.T + spread.prior()) @ inverse
    sandwich = spread.moves @ sandwich @ spread.moves.T
    told = centring(fitter.parameters(h))
    both = (np.diag(told @ covariance @ told.T) for covariance in (sandwich, spread.covariance(temperature)))
    return np.sqrt(np.maximum(*both)), spread.matrix()
