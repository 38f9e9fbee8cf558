"""The verdict, from stored evidence and calibrated numbers: a pure function.

1. Each hypothesis has a probability: Laplace's evidence at one temperature, times the prior odds of its effects.
2. An effect too small to matter gives its probability to the hypothesis without it.
3. If even the best hypothesis leaves innovations above the floor, the runs are not explained: by one run alone, or all.
4. The smallest set of hypotheses that is certain is the verdict: none, one, two effects, or a class.
5. Held-out runs have to show what the fit runs say.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from rockref.discover.evidence.evidence import Evidence, HypothesisEvidence, log_evidence
from rockref.discover.verdict.calibration import Calibration, calibration

VERDICTS = ("none", "named", "indicated", "class", "pair", "something_else", "not_trustworthy")


@dataclass(frozen=True)
class Alternative:
    """A set of effects with its probability and the fit that stands for it."""

    effects: tuple[str, ...]
    probability: float
    evidence: HypothesisEvidence = field(repr=False)


@dataclass(frozen=True)
class Verdict:
    """A verdict: its word, its effects, its probability; all alternatives, and the fit that it stands on.

    reason : why, as a key of the sentences;  run : the run that contradicts the others, if one does
    """

    word: str
    effects: tuple[str, ...]
    probability: float
    alternatives: tuple[Alternative, ...]
    reason: str = ""
    run: str = ""

    @property
    def best(self) -> HypothesisEvidence:
        """Return the fit that the verdict stands on."""
        return self.alternatives[0].evidence


def decide(evidence: Evidence, numbers: Calibration | None = None) -> Verdict:
    """Return the verdict of an experiment's evidence."""
    c = numbers or calibration()
    found = alternatives(evidence, c)
    best = found[0]
    if (run := contradicting_run(best.evidence, c)) is not None:
        return Verdict("not_trustworthy", (), best.probability, found, "run", run)
    if not is_explained(best.evidence, c):
        return Verdict("something_else", (), best.probability, found, "misfit")
    if best.probability < c.certain:
        return undecided(evidence, found, c)
    if not best.effects:
        return Verdict("none", (), best.probability, found)
    if not is_proven(evidence, best, c):
        return Verdict("indicated", best.effects, best.probability, found, "held_out")
    return Verdict("named" if len(best.effects) == 1 else "pair", best.effects, best.probability, found)


def alternatives(evidence: Evidence, c: Calibration) -> tuple[Alternative, ...]:
    """Return the sets of effects with their probabilities, most probable first."""
    scores: dict[tuple[str, ...], float] = {}
    fits: dict[tuple[str, ...], HypothesisEvidence] = {}
    for h in sorted(evidence.hypotheses, key=lambda h: h.objective):
        effects = substantial(h, evidence.carried, c)
        score = log_evidence(h, c.temperature) + len(effects) * np.log(c.prior_odds)
        if effects not in scores or score > scores[effects]:
            scores[effects], fits[effects] = score, h
    keys = sorted(scores, key=lambda k: -scores[k])
    weights = np.exp(np.array([scores[k] for k in keys]) - scores[keys[0]])
    weights /= weights.sum()
    return tuple(Alternative(k, float(w), fits[k]) for k, w in zip(keys, weights, strict=True))


def substantial(h: HypothesisEvidence, carried: tuple[str, ...], c: Calibration) -> tuple[str, ...]:
    """Return the effects of a hypothesis that are large enough to matter, in the order of their names."""
    return tuple(sorted(e for e in h.effects if e not in carried and h.size(e) >= c.least_amplitude))


def contradicting_run(h: HypothesisEvidence, c: Calibration) -> str | None:
    """Return the run that stays unexplained where all others are explained, or None."""
    means = {run: float(np.mean(axes)) for run, axes in h.loss_by_run_and_axis.items()}
    if len(means) < 3:
        return None
    worst = max(means, key=means.__getitem__)
    others = [value for run, value in means.items() if run != worst]
    return worst if means[worst] > c.misfit_of_run and max(others) < c.agreeing_run else None


def is_explained(h: HypothesisEvidence, c: Calibration) -> bool:
    """Return whether the innovations are as small as those of a right model, as a whole and on each run's axes."""
    return h.loss <= c.misfit and max(max(axes) for axes in h.loss_by_run_and_axis.values()) <= c.misfit_of_run


def undecided(evidence: Evidence, found: tuple[Alternative, ...], c: Calibration) -> Verdict:
    """Return the verdict where no single set of effects is certain: an indication, or a class."""
    members: list[Alternative] = []
    for a in found:
        members.append(a)
        if sum(m.probability for m in members) >= c.certain:
            break
    names = [m.effects for m in members if m.effects]
    total = sum(m.probability for m in members)
    if len(members) != len(names):  # nothing is one of them
        if found[0].effects == ():
            return Verdict("none", (), found[0].probability, found, "not_excluded")
        return Verdict("indicated", found[0].effects, found[0].probability, found, "or_nothing")
    common = set(names[0]).intersection(*names[1:])
    if common and len(common) == len(names[0]):  # all hold the first; more beside it is not certain
        return proven_or_indicated(evidence, found, names[0], total, c)
    flat = tuple(dict.fromkeys(e for effects in names for e in effects))
    return Verdict("class", flat, total, found)


def proven_or_indicated(evidence, found, effects, probability: float, c: Calibration) -> Verdict:
    """Return the verdict for effects that all probable sets have in common."""
    proven = is_proven(evidence, found[0], c)
    word = "indicated" if not proven else "named" if len(effects) == 1 else "pair"
    return Verdict(word, effects, probability, found, "" if proven else "held_out")


def is_proven(evidence: Evidence, best: Alternative, c: Calibration) -> bool:
    """Return whether the held-out runs show what the fit runs do: the fall of the loss, sample by sample.

    Without a held-out run, or a fit of the baseline to compare with, nothing is proven.
    """
    null = evidence.of(evidence.carried)
    if null is None or not null.held_out or not best.evidence.held_out:
        return False
    fitted = null.loss - best.evidence.loss
    runs = best.evidence.held_out
    weights = np.array([evidence.held_out_samples.get(run, 1) for run in runs], float)
    falls = np.array([null.held_out[run] - best.evidence.held_out[run] for run in runs])
    return bool(falls @ weights / weights.sum() > c.proof * max(fitted, 0.0))
