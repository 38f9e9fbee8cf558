"""Steps of the law, as fine as the records ask for.

How fine they have to be depends on the block, on the hypothesis and on the noise: a light, hard block rings faster, and
a quiet gyroscope hears more. So it is measured: what twice as many steps change, beside the noise.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.objective import loss
from rockref.discover.fit.stages import Stage

#: By the stage: mean loss of what twice as many steps change from which steps are halved; decided: short memories only
#: lead to a valley, and a twentieth of the noise hides none.
COARSE = {"S1": 0.05, "S2": 0.05, "S3": 0.01}
#: The same at the longest memory, in all [nat]. There models are compared by nats: on simulated blocks halving takes
#: off nine tenths of it, so that one is left.
COARSE_IN_ALL = 10.0
#: The largest factor on the number of steps (decided: a fit then takes twice to three times as long).
FINEST = 4.0


def fine_enough(fitter: Fitter, field: Sequence[FittedModel], stages: Sequence[Stage]) -> bool:
    """Halve the steps of these stages as long as halving them changes the innovations of one of a field.

    Returns whether they were fine enough; what was evaluated with coarser ones is to be evaluated again.
    """
    fine, finer = True, fitter.problem.finer
    for stage in stages:
        while finer.get(stage.name, 1.0) < FINEST and changed(fitter, field, stage) > coarse(fitter, stage):
            finer[stage.name] = 2.0 * finer.get(stage.name, 1.0)
            fine = False
            fitter.problem.say(f"{stage.name}: steps halved")
    return fine


def coarse(fitter: Fitter, stage: Stage) -> float:
    """Return the loss [nat] of what twice as many steps change from which those of a stage are halved."""
    share = COARSE.get(stage.name)
    return COARSE_IN_ALL if share is None else 0.5 * share * fitter.residuals(stage).count


def changed(fitter: Fitter, field: Sequence[FittedModel], stage: Stage) -> float:
    """Return the loss [nat] of what twice as many steps change of innovations at a stage, the largest of a field."""
    once, twice = [h.copy() for h in field], [h.copy() for h in field]
    fitter.evaluate_all(once, stage)
    fitter.evaluate_all(twice, replace(stage, steps=2 * stage.steps))
    pairs = [(a.r, b.r) for a, b in zip(once, twice, strict=True) if a.r is not None and b.r is not None]
    return max((0.5 * float(loss(a - b).sum()) for a, b in pairs), default=0.0)
