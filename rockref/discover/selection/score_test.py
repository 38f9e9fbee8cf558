"""What every effect that a model lacks would gain, from one Jacobian: the score test, in its Gauss-Newton form.

C. R. Rao (1948), Large sample tests of statistical hypotheses, Proc. Camb. Phil. Soc. 44:50-57,
doi:10.1017/S0305004100023987.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.stages import Stage
from rockref.discover.hypotheses.effects import seeds_of
from rockref.discover.hypotheses.parameter import Parameter

#: Damping of the predicted step; decided: it only keeps numbers apart that do the same.
DAMPED = 1e-3
#: How many effects are evaluated for each one that is asked for (decided: a predicted gain is within a factor of two).
EVALUATED = 3


@dataclass(frozen=True)
class Proposal:
    """An effect, and the gain [nat] that one step of everything predicts for it."""

    effect: str
    gain: float


@dataclass(frozen=True)
class ScoreTest:
    """One linearisation of a model and of all effects that it lacks.

    H (G, G), g (G,) : Gauss-Newton matrix and gradient;  places : of each effect the rows of its numbers.
    """

    H: np.ndarray
    g: np.ndarray
    own: int
    places: dict[str, np.ndarray]

    def with_effect(self, effect: str) -> tuple[np.ndarray, np.ndarray]:
        """Return matrix and gradient of the model with one effect."""
        rows = np.r_[np.arange(self.own), self.places[effect]]
        return self.H[np.ix_(rows, rows)], self.g[rows]

    def gains(self) -> list[Proposal]:
        """Return what one step with each effect gains over a step without, best first."""
        alone = predicted_gain(self.H[: self.own, : self.own], self.g[: self.own])
        found = [Proposal(e, predicted_gain(*self.with_effect(e)) - alone) for e in self.places]
        return sorted(found, key=lambda p: -p.gain)


def predicted_gain(H: np.ndarray, g: np.ndarray) -> float:
    """Return by how much the objective would fall, were it the quadratic of H and g."""
    d = predicted_step(H, g)
    return float(-(g @ d + 0.5 * d @ H @ d))


def predicted_step(H: np.ndarray, g: np.ndarray) -> np.ndarray:
    """Return the step (G,) to the bottom of the quadratic of H and g, hardly damped."""
    return -np.linalg.solve(H + DAMPED * np.diag(np.diag(H)), g)


def score_test(fitter: Fitter, h: FittedModel, stage: Stage, among: Sequence[str] | None = None) -> ScoreTest:
    """Linearise h, evaluated at a stage, and every candidate that it lacks, or those of them that are `among` some.

    A number that only shapes an absent effect shows nothing.
    """
    base = len(fitter.problem.parameters())
    absent: list[Parameter] = []
    places = {}
    for e in fitter.problem.candidates if among is None else among:
        if e in h.effects:
            continue
        numbers = fitter.problem.parameters((e,))[base:]
        places[e] = len(h.z) + len(absent) + np.arange(len(numbers))
        absent += numbers
    H, g = fitter.linearise(h, stage, absent)
    return ScoreTest(H, g, len(h.z), places)


def proposals(
    fitter: Fitter, h: FittedModel, stage: Stage, most: int, test: ScoreTest | None = None
) -> list[FittedModel]:
    """Return the `most` best additions of one effect to h, a step from h each, and those that start from far.

    The longer memories take those of them alone that are among the best.
    """
    test = score_test(fitter, h, stage) if test is None else test
    far = finite_starts(fitter, h, stage, tuple(test.places))
    found = list(far)
    for p in test.gains()[: EVALUATED * most]:
        k = fitter.with_effect(h, p.effect)
        k.r, k.objective, k.loss = h.r, h.objective, h.loss
        k.H, gradient = test.with_effect(p.effect)
        fitter.step(k, stage, k.H, gradient)
        found.append(k)
    best = sorted(best_of_each(found), key=lambda k: k.objective)[:most]
    return best + [k for k in far if stage.shortest and not any(k is b for b in best)]


def finite_starts(fitter: Fitter, h: FittedModel, stage: Stage, effects: Sequence[str]) -> list[FittedModel]:
    """Return h with each of these effects that has finite starts: the best of them, and one step from it at S1.

    The objective of longer memories is too rough for a step from far.
    """
    base, problem = len(fitter.problem.parameters()), fitter.problem
    seeds = []
    for e in effects:
        numbers = problem.parameters((e,))[base:]
        seeds += [fitter.with_effect(h, e, z) for z in seeds_of(numbers, e, problem.records, problem.units)]
    if not seeds:
        return []
    fitter.evaluate_all(seeds, stage)
    found = best_of_each(seeds)
    for k in found if stage.shortest else ():
        k.H, gradient = fitter.linearise(k, stage)
        fitter.step(k, stage, k.H, gradient)
    return found


def best_of_each(field: Sequence[FittedModel]) -> list[FittedModel]:
    """Return the best of each set of effects."""
    best: dict[frozenset[str], FittedModel] = {}
    for h in sorted(field, key=lambda h: h.objective):
        best.setdefault(frozenset(h.effects), h)
    return list(best.values())
