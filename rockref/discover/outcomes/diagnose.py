"""Which effect is missing, from outcomes on a shake table.

1. Run every test many times, with the model as it is and with each candidate at several sizes, under the same draws;
   at more sizes about the best one where the outcomes ask strongly for a candidate.
2. Find how probable the outcomes of the tests are at each size: a parabola a candidate, all with one value at zero; one
   of its own about its best size for a strong candidate.
3. Weigh each candidate by the integral over its sizes, with motions held out that no size has seen.
4. Decide by the rules of records: named, indicated, a class, nothing, or something else.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.evidence.evidence import Evidence
from rockref.discover.fit.objective import WHITE
from rockref.discover.outcomes.candidates import CANDIDATES, Candidate, Setting
from rockref.discover.outcomes.likelihood import Likelihood, likelihood, simulated
from rockref.discover.outcomes.sizes import profile
from rockref.discover.outcomes.weighing import evidence_of, held_out
from rockref.discover.verdict.calibration import Calibration, calibration
from rockref.discover.verdict.rules import Verdict, decide
from rockref.discover.verdict.sentences import sentence
from rockref.model.errors import InputError
from rockref.shake.ensemble import AFTER
from rockref.shake.experiment import ShakenExperiment

#: Runs of each test at each size; decided: a share of falls is then known to 0.15 where it is one half.
RUNS = 12
#: Standard errors by which outcomes are less probable than the model's own runs, from which they are unexplained.
UNEXPLAINED = 3.0


@dataclass(frozen=True, eq=False)
class OutcomeDiagnosis:
    """What the outcomes say: the evidence, and the verdict on it."""

    evidence: Evidence
    verdict: Verdict

    def sentence(self) -> str:
        """Return the verdict in a sentence or two."""
        if self.verdict.word == "something_else":
            excess = (self.verdict.best.loss - WHITE) / self.evidence.signature["standard_error"]
            return (
                f"Something is missing that no candidate explains: with the nearest one, "
                f"{' and '.join(self.verdict.best.effects) or 'the baseline'}, the outcomes are less probable than "
                f"runs of the model itself by {excess:.1f} standard errors."
            )
        ends = [e for e in self.verdict.effects if e in self.evidence.signature["open_ends"]]
        more = f" The interval of {' and '.join(ends)} ends with the sizes that were tried." if ends else ""
        return sentence(self.verdict, self.evidence) + more

    def to_dict(self) -> dict[str, Any]:
        """Return evidence, verdict and probabilities as plain values."""
        return {
            "schema": "rockref.diagnose.shaken/1", "verdict": self.verdict.word, "effects": list(self.verdict.effects),
            "probability": self.verdict.probability, "sentence": self.sentence(),
            "alternatives": [{"effects": list(a.effects), "probability": a.probability}
                             for a in self.verdict.alternatives],
            "evidence": self.evidence.to_dict(),
        }  # fmt: skip


def diagnose_outcomes(
    experiment: ShakenExperiment,
    model: Model,
    candidates: tuple[Candidate, ...] = CANDIDATES,
    *,
    runs: int = RUNS,
    step: float = 1e-5,
    after: float = AFTER,
    seed: int = 0,
    workers: int | None = None,
    say: Callable[[str], None] = lambda text: None,
) -> OutcomeDiagnosis:
    """Say which candidate the model lacks, by the outcomes of the tests.

    runs : of each test at each size;  step, after [s], seed : of `Ensemble`

    Raises InputError: E-RECORD without records, E-MOTIONS for tests of one motion, and as runs do.
    """
    if experiment.motions is None:
        cure = "Give the records of the motions: the candidates are tried in runs."
        raise InputError("E-RECORD", experiment.name, "has no column record", cure)
    if len(np.unique(experiment.motion)) < 2:
        cure = "Shake with several motions: one says nothing about others. Name them in the column motion."
        raise InputError("E-MOTIONS", experiment.name, "has tests of one motion only", cure)
    base = Setting(model, experiment.motions, experiment.draws)

    def at(setting: Setting) -> Likelihood:
        return likelihood(experiment, simulated(setting, runs, step, after, seed, workers))

    say(f"the baseline: {runs} runs of {len(experiment.motion)} tests")
    null, fitted, profiles = at(base), ~held_out(experiment), []
    for k, c in enumerate(candidates, 1):
        say(f"{k} of {len(candidates)}: {c.id}")
        made = profile(c, null, fitted, lambda size, c=c: at(c.apply(base, size)))  # type: ignore[misc]
        profiles += [made] if len(made.z) else []
    found = evidence_of(experiment, null, profiles)
    return OutcomeDiagnosis(found, decide(found, numbers(found)))


def numbers(evidence: Evidence) -> Calibration:
    """Return the numbers of the rules for outcomes: what is unexplained depends on how many tests there are, and there
    are no companions."""
    said = evidence.signature
    return replace(
        calibration(), temperature=said["temperature"], companion=0.0,
        misfit=WHITE + UNEXPLAINED * said["standard_error"],
        misfit_of_run=WHITE + UNEXPLAINED * said["largest_standard_error"],
    )  # fmt: skip
