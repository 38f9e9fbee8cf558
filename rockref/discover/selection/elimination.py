"""The last comparison at the longest memory: what the best model can do without, and what could stand in its place."""

from __future__ import annotations

from collections.abc import Sequence

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.stages import F
from rockref.discover.selection.finalists import added_effects, converged, follow, lowest, remember
from rockref.discover.selection.halving import WORTH, sized_at_release
from rockref.discover.selection.rivals import rivals
from rockref.discover.selection.score_test import best_of_each, proposals
from rockref.discover.selection.swaps import swapped

#: Part of the misfit without an effect that its replacement may leave after one step (decided: what leaves more is not
#: the cause).
LEAVES = 0.75
#: Additions among which replacements of an effect are chosen, and how many of them (decided: twice as many as are
#: refined).
REPLACING, REPLACED = 4, 2
#: Steps of a model without one of its effects (decided: from its law it comes near at once, or never).
LESS = 3


class Elimination:
    """The comparison of one search.

    baseline : the null, as it was found.  known : the best fit at F of each set of effects; what is fitted is added
    """

    def __init__(self, fitter: Fitter, baseline: FittedModel, known: dict[frozenset[str], FittedModel]):
        self.fitter, self.problem = fitter, fitter.problem
        self.baseline, self.known = baseline, known

    def run(self, beam: Sequence[FittedModel]) -> list[FittedModel]:
        """Return all that was fitted at F, best objective first: the best model of a beam with fewer of its effects, or
        with others in their places."""
        remember(self.known, beam)
        best = self.simplest()
        for e in added_effects(self.fitter, best):
            for h in self.replacements(self.known[frozenset(best.effects) - {e}]):
                remember(self.known, [self.fitter.polish(h, F, 2)])
            remember(self.known, self.rivals(best, e))
        for h in self.as_good(best):
            self.take_out(h)
        if frozenset(self.problem.carried) not in self.known:
            remember(self.known, [self.fitter.polish(self.nothing(best), F, 3)])
        self.problem.progress.begin("without", "comparing the finalists", best.name)
        return swapped(self.fitter, converged(self.fitter, list(self.known.values())))

    def best(self) -> FittedModel:
        """Return the best of all models, less what its effects have to gain."""
        return lowest(self.fitter, list(self.known.values()))

    def simplest(self) -> FittedModel:
        """Take each effect of the best model out; if one does not gain what it has to, go on from the model without."""
        while True:
            best = self.best()
            self.problem.progress.begin("without", "leaving out each effect in turn", best.name)
            self.take_out(best)
            if self.best() is best:
                return best

    def take_out(self, h: FittedModel) -> None:
        """Fit a model without each of its effects, where that is not known yet."""
        for e in added_effects(self.fitter, h):
            if frozenset(h.effects) - {e} not in self.known:
                less = self.fitter.without(h, e)
                follow(self.fitter, [less], list(self.known.values()), LESS)
                remember(self.known, [less])

    def as_good(self, best: FittedModel) -> list[FittedModel]:
        """Return the models that explain the runs as well as the best, and do not hold all of its effects.

        Of those that do, what is left without one of these is an exchange (`rockref.discover.selection.swaps`).
        """
        near = [h for h in self.known.values() if h.objective <= best.objective + WORTH]
        return [h for h in near if not set(best.effects) <= set(h.effects)]

    def nothing(self, best: FittedModel) -> FittedModel:
        """Return the baseline at F with its own law, or with that of the best model, whichever is lower."""
        bare = best
        for e in added_effects(self.fitter, best):
            bare = self.fitter.without(bare, e)
        field = [self.baseline.copy(), bare]
        self.fitter.evaluate_all(field, F)
        return min(field, key=lambda h: h.objective)

    def replacements(self, less: FittedModel) -> list[FittedModel]:
        """Return the best additions to a model at F that are not known yet, and whose first step leads somewhere.

        An error of the sensor may be out of reach of one step of a long memory, and is sized from the release.
        """
        start = self.fitter.evaluate(less.copy(), F)
        sized = sized_at_release(self.fitter, start)
        self.fitter.evaluate_all(sized, F)
        field = best_of_each([*proposals(self.fitter, start, F, REPLACING), *sized])
        lowest = min(h.objective for h in self.known.values())
        bar = lowest + LEAVES * max(start.objective - lowest, 0.0)
        return [h for h in field if frozenset(h.effects) not in self.known and h.objective <= bar][:REPLACED]

    def rivals(self, best: FittedModel, effect: str) -> list[FittedModel]:
        """Return the rivals of an effect that are not known yet, at F."""
        found = rivals(self.fitter, best, effect, self.known.keys())
        follow(self.fitter, found, [*self.known.values(), *found])
        return found
