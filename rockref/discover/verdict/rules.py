"""The verdict, from stored evidence and calibrated numbers: a pure function.

1. Each hypothesis has a probability: Laplace's evidence at one temperature, less what each effect gains by chance, and
   each one beside the first by standing for another form of that, times the prior odds of its effects.
2. An effect too small to matter gives its probability to the hypothesis without it, if anything explains the runs so.
3. If even the best hypothesis leaves innovations above the floor, the runs are not explained: by one run alone, or all.
   An effect that leaves next to nothing of the misfit is indicated all the same, without those beside it that others
   could replace. So it is where one more explains a part of that: an effect that is there explains all that is left,
   another form of the first does not.
4. The verdict is the most probable set where it is certain; else the effects that are certain to be in it, summed over
   all sets; else the smallest class of sets that is certain.
5. Held-out runs have to show what the fit runs say.
6. What is stated is less than what the evidence says by the share of verdicts in which the search itself fails.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import numpy as np

from rockref.discover.evidence.evidence import Evidence, HypothesisEvidence, log_evidence
from rockref.discover.fit.objective import WHITE
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
    fit : what it stands on, where that is not the most probable set
    """

    word: str
    effects: tuple[str, ...]
    probability: float
    alternatives: tuple[Alternative, ...]
    reason: str = ""
    run: str = ""
    fit: HypothesisEvidence | None = field(default=None, repr=False)

    @property
    def best(self) -> HypothesisEvidence:
        """Return the fit that the verdict stands on."""
        return self.alternatives[0].evidence if self.fit is None else self.fit


def decide(evidence: Evidence, numbers: Calibration | None = None) -> Verdict:
    """Return the verdict of an experiment's evidence, with the probabilities that are stated."""
    c = numbers or calibration()
    v = by_evidence(evidence, c)
    stated = tuple(replace(a, probability=c.trust * a.probability) for a in v.alternatives)
    return replace(v, probability=c.trust * v.probability, alternatives=stated)


def by_evidence(evidence: Evidence, c: Calibration) -> Verdict:
    """Return the verdict, with probabilities as if one of the fitted sets were the truth."""
    found = alternatives(evidence, c)
    best = found[0]
    if (run := contradicting_run(best.evidence, c)) is not None:
        return Verdict("not_trustworthy", (), best.probability, found, "run", run)
    if not is_explained(best.evidence, c):
        if (near := nearly_explaining(evidence, found, c)) is not None:
            effects = by_weight(evidence, irreplaceable(evidence, near, c))
            return Verdict("indicated", effects, held_by(found, effects), found, "remnant", fit=near.evidence)
        reason = "sensor" if evidence.sensor_faults else "misfit"
        return Verdict("something_else", (), best.probability, found, reason)
    if best.probability < c.certain:
        return undecided(evidence, found, c)
    if not best.effects:
        return Verdict("none", (), best.probability, found)
    if (less := without_a_form(evidence, best, c)) is not None:
        effects = by_weight(evidence, substantial(less, evidence.carried, c))
        return Verdict("indicated", effects, held_by(found, effects), found, "remnant", fit=less)
    return proven_or_indicated(evidence, found, best.effects, best.probability, c)


def alternatives(evidence: Evidence, c: Calibration) -> tuple[Alternative, ...]:
    """Return the sets of effects with their probabilities, most probable first."""
    scores: dict[tuple[str, ...], float] = {}
    fits: dict[tuple[str, ...], HypothesisEvidence] = {}
    for h in sorted(evidence.hypotheses, key=lambda h: h.objective):
        effects = counted(evidence, h, c)
        each = np.log(c.prior_odds) - evidence.chance / c.temperature
        beside = max(len(effects) - 1, 0) * c.companion / c.temperature
        score = log_evidence(h, c.temperature) + len(effects) * each - beside
        if effects not in scores or score > scores[effects]:
            scores[effects], fits[effects] = score, h
    keys = sorted(scores, key=lambda k: -scores[k])
    weights = np.exp(np.array([scores[k] for k in keys]) - scores[keys[0]])
    weights /= weights.sum()
    return tuple(Alternative(k, float(w), fits[k]) for k, w in zip(keys, weights, strict=True))


def substantial(h: HypothesisEvidence, carried: tuple[str, ...], c: Calibration) -> tuple[str, ...]:
    """Return the effects of a hypothesis that are large enough to matter, in the order of their names."""
    return tuple(sorted(e for e in h.effects if e not in carried and h.size(e) >= c.least_amplitude))


def counted(evidence: Evidence, h: HypothesisEvidence, c: Calibration) -> tuple[str, ...]:
    """Return the effects for which a hypothesis stands: those that are large enough to matter, and such without which
    nothing explains the runs, where it does."""
    large = substantial(h, evidence.carried, c)
    if not is_explained(h, c):
        return large
    explaining = [k.effects for k in evidence.hypotheses if is_explained(k, c)]
    own = set(h.effects) - set(evidence.carried)
    return tuple(sorted(e for e in own if e in large or all(e in effects for effects in explaining)))


def contradicting_run(h: HypothesisEvidence, c: Calibration) -> str | None:
    """Return the run that stays unexplained where all others are explained, or None."""
    means = {run: float(np.mean(axes)) for run, axes in h.losses_above().items()}
    if len(means) < 3:
        return None
    worst = max(means, key=means.__getitem__)
    others = [value for run, value in means.items() if run != worst]
    return worst if means[worst] > c.misfit_of_run and max(others) <= c.misfit else None


def is_explained(h: HypothesisEvidence, c: Calibration) -> bool:
    """Return whether the innovations are as small as those of a right model, as a whole and on each run's axes."""
    return h.loss_above <= c.misfit and max(max(axes) for axes in h.losses_above().values()) <= c.misfit_of_run


def nearly_explaining(evidence: Evidence, found: tuple[Alternative, ...], c: Calibration) -> Alternative | None:
    """Return the smallest set of effects that leaves next to nothing of the baseline's misfit, or None.

    Another law behind the same name leaves innovations above the floor, and still explains most of what was missing.
    """
    null = evidence.of(evidence.carried)
    if null is None:
        return None
    near = [a for a in found if a.effects and leaves_little(a.evidence, null, c)]
    return min(near, key=lambda a: (len(a.effects), a.evidence.objective), default=None)


def irreplaceable(evidence: Evidence, near: Alternative, c: Calibration) -> tuple[str, ...]:
    """Return the effects of a set without which every other leaves clearly more of the baseline's misfit; all, where
    none is.

    Beside an effect of another law, some stand for what that law does differently, one nearly as well as another.
    """
    null = evidence.of(evidence.carried)
    assert null is not None  # as in `nearly_explaining`, which found the set
    much = near.evidence.loss_above + c.remnant * (null.loss_above - WHITE)
    replaced = {e for h in evidence.hypotheses if h.loss_above <= much for e in near.effects if e not in h.effects}
    return tuple(e for e in near.effects if e not in replaced) or near.effects


def without_a_form(evidence: Evidence, best: Alternative, c: Calibration) -> HypothesisEvidence | None:
    """Return the fit of fewer effects that leaves next to nothing, if each further one explains a part of that only.

    None where the effects of the best leave next to nothing of what is left without any one of them.
    """
    null, found, effects = evidence.of(evidence.carried), best.evidence, set(best.effects)
    sets = [(set(substantial(h, evidence.carried, c)), h) for h in evidence.hypotheses]
    while null is not None:
        smaller = [(s, h) for s, h in sets if s and s < effects and len(s) == len(effects) - 1]
        less = min(smaller, key=lambda known: known[1].objective, default=None)
        if less is None or not leaves_little(less[1], null, c) or leaves_little(found, less[1], c):
            break
        effects, found = less
    return None if found is best.evidence else found


def leaves_little(h: HypothesisEvidence, before: HypothesisEvidence, c: Calibration) -> bool:
    """Return whether a hypothesis leaves next to nothing of the misfit of another one."""
    return h.loss_above - WHITE <= c.remnant * (before.loss_above - WHITE)


def undecided(evidence: Evidence, found: tuple[Alternative, ...], c: Calibration) -> Verdict:
    """Return the verdict where no single set of effects is certain: an indication, or a class."""
    members: list[Alternative] = []
    for a in found:
        members.append(a)
        if sum(m.probability for m in members) >= c.certain:
            break
    if any(not m.effects for m in members):
        if found[0].effects == ():
            return Verdict("none", (), found[0].probability, found, "not_excluded")
        return Verdict("indicated", by_weight(evidence, found[0].effects), found[0].probability, found, "or_nothing")
    inclusion = inclusion_probabilities(found)
    certain = [e for e, probability in inclusion.items() if probability >= c.certain]
    if certain:
        return proven_or_indicated(evidence, found, certain, min(inclusion[e] for e in certain), c, "or_more")
    flat = tuple(dict.fromkeys(e for m in members for e in by_weight(evidence, m.effects)))
    return Verdict("class", flat, sum(m.probability for m in members), found)


def inclusion_probabilities(found: tuple[Alternative, ...]) -> dict[str, float]:
    """Return the probability of each effect, whatever else is there: the sum over the sets that hold it.

    M. M. Barbieri, J. O. Berger (2004), Optimal predictive model selection, Ann. Statist. 32:870-897,
    doi:10.1214/009053604000000238.
    """
    every = dict.fromkeys(e for a in found for e in a.effects)
    return {e: held_by(found, (e,)) for e in every}


def held_by(found: tuple[Alternative, ...], effects: Iterable[str]) -> float:
    """Return the probability of all sets that hold these effects."""
    return sum(a.probability for a in found if set(effects) <= set(a.effects))


def by_weight(evidence: Evidence, effects: Iterable[str]) -> tuple[str, ...]:
    """Return effects, first the one without which the runs are explained worst."""

    def without(effect: str) -> float:
        return min((h.objective for h in evidence.hypotheses if effect not in h.effects), default=np.inf)

    return tuple(sorted(effects, key=lambda e: (-without(e), e)))


def proven_or_indicated(
    evidence: Evidence, found: tuple[Alternative, ...], effects: Iterable[str], probability: float, c: Calibration,
    reason: str = "",
) -> Verdict:  # fmt: skip
    """Return the verdict of effects that are certain by the fit runs: what held-out runs show is named."""
    effects = by_weight(evidence, effects)
    stands = next((a for a in found if set(a.effects) == set(effects)), found[0])
    proven = is_proven(evidence, stands, c)
    word = "indicated" if not proven else "named" if len(effects) == 1 else "pair"
    return Verdict(word, effects, probability, found, reason if proven else "held_out", fit=stands.evidence)


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
