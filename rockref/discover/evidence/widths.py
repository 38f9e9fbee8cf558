"""How sure a number is: the sandwich of a fit, from gradients over blocks of time, or the tempered posterior.

Innovations of neighbouring instants are not independent where a model is a little wrong, and the inverse of the
Gauss-Newton matrix alone is too narrow. P. J. Huber (1967), Proc. 5th Berkeley Symp. 1:221-233.
"""

from __future__ import annotations

import numpy as np

from rockref.discover.fit.differences import jacobian
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.objective import weight
from rockref.discover.fit.stages import Stage

#: Length of a block [s] for the source's block; decided: several memories, so that blocks are independent.
BLOCK = 0.1


def deviations(fitter: Fitter, h: FittedModel, stage: Stage, temperature: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the standard deviation (G,) of each z, and the Gauss-Newton matrix (G, G), at a fit evaluated at a stage.

    The larger of two: the sandwich, and the posterior's at the temperature of the evidence. Along a ridge of strongly
    coupled numbers the objective is rough, fits end anywhere within some nats, and only the second is wide enough.
    """
    assert h.r is not None
    parameters = fitter.parameters(h)
    J = jacobian(fitter.residuals(stage), parameters, h.z, h.r)
    scores = (J * (weight(h.r) * h.r)).sum(axis=-1)  # (G, R, n)
    G, R, n = scores.shape
    length = max(1, round(BLOCK * fitter.problem.time_scale * fitter.problem.listener.gyro.sample_rate))
    whole = n // length * length
    blocks = scores[:, :, :whole].reshape(G, R * (whole // length), length).sum(axis=-1)
    flat = J.reshape(G, -1)
    data = (flat * weight(h.r).ravel()) @ flat.T
    prior = np.eye(G)
    inverse = np.linalg.inv(data + prior)
    sandwich = inverse @ (blocks @ blocks.T + prior) @ inverse
    tempered = np.linalg.inv(data / temperature + prior)
    return np.sqrt(np.maximum(np.diag(sandwich), np.diag(tempered))), data + prior
