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

#: By the stage: mean loss of what twice as many steps change from which steps are halved, and the largest factor on
#: their number (decided: short memories only lead to a valley, and a twentieth of the noise hides none; what the long
#: ones find is told, and a hundredth is a bias beside intervals, but on simulated blocks a second halving takes off
#: nothing).
COARSE = {"S1": (0.05, 4.0), "S2": (0.05, 4.0), "S3": (0.01, 2.0), "F": (0.01, 2.0)}


def fine_enough(fitter: Fitter, field: Sequence[FittedModel], stages: Sequence[Stage]) -> bool:
    """Halve the steps of these stages as long as halving them changes the innovations of one of a field.

    Returns whether they were fine enough; what was evaluated with coarser ones is to be evaluated again.
    """
    fine, finer = True, fitter.problem.finer
    for stage in stages:
        coarse, finest = COARSE[stage.name]
        while finer.get(stage.name, 1.0) < finest and changed(fitter, field, stage) > coarse:
            finer[stage.name] = 2.0 * finer.get(stage.name, 1.0)
            fine = False
            fitter.problem.say(f"{stage.name}: steps halved")
    return fine


def changed(fitter: Fitter, field: Sequence[FittedModel], stage: Stage) -> float:
    """Return the mean loss of what twice as many steps change of innovations at a stage, the largest of a field."""
    once, twice = [h.copy() for h in field], [h.copy() for h in field]
    fitter.evaluate_all(once, stage)
    fitter.evaluate_all(twice, replace(stage, steps=2 * stage.steps))
    count = fitter.residuals(stage).count
    pairs = [(a.r, b.r) for a, b in zip(once, twice, strict=True) if a.r is not None and b.r is not None]
    return max((float(loss(a - b).sum()) / count for a, b in pairs), default=0.0)
