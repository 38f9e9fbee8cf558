"""What must hold before a fit is believed: stages, starts, step, bounds, innovations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rockref.discover.evidence.evidence import HypothesisEvidence
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.objective import WHITE, loss
from rockref.discover.fit.stages import F
from rockref.discover.hypotheses.parameter import Parameter
from rockref.discover.verdict.calibration import Calibration
from rockref.discover.verdict.rules import contradicting_run, is_explained

#: Distance of two fits up to which they end in the same place: in standard deviations (decided: of a dozen numbers one
#: is farther once in forty fits), and in prior deviations (decided: a tenth of what is expected is known well).
AGREE, KNOWN_WELL = 3.0, 0.1
#: Change of the mean loss at half the step; decided: a third of the scatter of a run's mean loss.
STEP_CHANGE = 0.02
#: Prior deviations from which a number is at the end of its range: a flat prior has 0.13 % of itself beyond (decided).
BOUND = 3.0
#: Gates that another fit ends in the same place, and which one.
OTHER_FITS = {"stages_agree": "The fit at half the memory", "starts_agree": "The fit from another start"}


@dataclass(frozen=True)
class Gate:
    """One check: `name` (stable), whether it `passed`, the `value` found, the `limit`, and a sentence."""

    name: str
    passed: bool
    value: float
    limit: float
    sentence: str

    def to_dict(self) -> dict[str, Any]:
        """Return plain numbers and words."""
        return {
            "name": self.name, "passed": bool(self.passed), "value": round(float(self.value), 4), "limit": self.limit,
            "sentence": self.sentence,
        }  # fmt: skip


def same_place(name: str, parameters: Sequence[Parameter], a: np.ndarray, b: np.ndarray, width: np.ndarray) -> Gate:
    """Return the gate, one of OTHER_FITS, that another fit ends at a where b is, in all numbers that all runs share.

    width : (G,) standard deviations of z
    """
    shared = np.array([p.run is None for p in parameters])
    off = np.where(shared, np.abs(a - b) / np.maximum(AGREE * width, KNOWN_WELL), 0.0)
    worst = int(np.argmax(off))
    apart = abs(float(a[worst] - b[worst]))
    sentence = (
        f"{OTHER_FITS[name]} differs most in {parameters[worst].name}: by {apart:.2f} prior deviations, "
        f"{apart / float(width[worst]):.1f} standard deviations."
    )
    return Gate(name, bool(off[worst] < 1.0), float(off[worst]), 1.0, sentence)


def step_halved(fitter: Fitter, h: FittedModel) -> Gate:
    """Return whether half the step of the law leaves the mean loss as it is, in every run and axis."""
    assert h.r is not None
    fine = replace(F, steps=2 * F.steps)
    r = fitter.residuals(fine).at(fitter.parameters(h), [h.z])[0]
    n = fitter.problem.listener.valid[:, : r.shape[1]].sum(axis=1)[:, None]
    change = float(np.abs((loss(r) - loss(h.r)).sum() / (3 * n.sum())))
    sentence = f"Half the step changes the mean loss by {change:.4f}."
    return Gate("step_halved", change < STEP_CHANGE, change, STEP_CHANGE, sentence)


def off_bounds(parameters: Sequence[Parameter], z: np.ndarray) -> Gate:
    """Return whether every number that all runs share is inside its range."""
    off = np.array([abs(float(value)) if p.run is None else 0.0 for p, value in zip(parameters, z, strict=True)])
    worst = int(np.argmax(off))
    sentence = f"{parameters[worst].name} is farthest from the centre of its prior: {off[worst]:.1f} deviations."
    return Gate("off_bounds", bool(off[worst] < BOUND), float(off[worst]), BOUND, sentence)


def innovations_white(said: HypothesisEvidence, c: Calibration) -> Gate:
    """Return whether the innovations are as small as those of a right model, in all and by run and axis."""
    run = contradicting_run(said, c)
    worst = max(said.loss_by_run_and_axis, key=lambda id: max(said.loss_by_run_and_axis[id]))
    sentence = (
        f"The innovations have a mean loss of {said.loss:.2f} (white noise: {WHITE:.2f}), "
        f"at most {max(said.loss_by_run_and_axis[worst]):.2f} about one axis of run {worst}."
    )
    if run is not None:
        sentence += f" Run {run} contradicts the others."
    return Gate("innovations_white", run is None and is_explained(said, c), said.loss, c.misfit, sentence)
