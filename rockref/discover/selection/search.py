"""Forward selection with backward elimination over {nothing, each effect, pairs, triples}, one budget for all.

1. Fit the baseline at short memories. Innovations that stay above white contradict it.
2. If contradicted: try all effects with the law as it is stated, at S1, then at S2 for what S1 smooths away. If none
   explains the runs there: fit the baseline from starts over the whole prior, or the law beside an effect that leads,
   or look for the law and an effect together; then for one more effect, and the law anew. What S1 does not contradict
   only S2 compares.
3. Lengthen the memory. At the longest, fits step side by side until they end; the score test proposes more effects, by
   what a step gains at S3 and by what it promises at F, and those that gain enough join.
4. Where innovations stay above white noise, move the best model along the ridges of the law, and compare again there.
5. At the longest memory take the effects of the best model out, one after the other, and try to replace those that
   stay (`selection.elimination`).

On the way steps are made as fine as the records ask for (`fit.steps`), and innovations white (`fit.whitening`).
"""

from __future__ import annotations

from collections.abc import Sequence

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.floor import floor
from rockref.discover.fit.objective import WHITE
from rockref.discover.fit.ridges import kicked
from rockref.discover.fit.stages import S1, S2, S3, F, Stage
from rockref.discover.fit.starts import AGAIN, GlobalFit, global_fit, released
from rockref.discover.fit.steps import fine_enough
from rockref.discover.fit.whitening import quieten, whiten
from rockref.discover.selection.elimination import Elimination
from rockref.discover.selection.finalists import added_effects, follow, lowest, penalised, remember
from rockref.discover.selection.halving import MARGIN, WORTH, halving, proposed, say, within
from rockref.discover.selection.score_test import ScoreTest, best_of_each, proposals, score_test
from rockref.discover.selection.together import from_anywhere, from_statement, leads
from rockref.discover.selection.tone import tone

#: Mean loss from which innovations contradict a model, and from which nothing explains the runs at S3 and nothing more
#: is tried (white noise: 0.947). Where records of a model's own leave more than white noise, both are so much higher.
CONTRADICTED, UNEXPLAINED = 1.12, 1.5
#: The same from which a better law is looked for at the longest memory (decided: records of a model's own scatter by
#: a hundredth).
IMPERFECT = 0.97
#: Shares of the misfit that the first, and the second effect may leave if one more is looked for (decided: what leaves
#: more is not the cause, and no other on top of it is; of two right effects the second explains most of what is left).
LEAVES = (0.75, 0.5)
#: Prior deviations that the law may move from its nominal numbers and count as a block of the source's make (decided: a
#: tenth of every parameter of Table 3.1 is 0.3).
STAYED = 0.5
#: Factor on the best objective up to which a model goes on after each stage (decided: a longer memory changes the order
#: of models by less).
MARGINS = {"S3": 1.06, "F": 1.02}
#: Models that go on, additions that are refined (by what one step gains, and by what it promises), effects at most.
BEAM, ADDED, MOST = 4, 2, 3
#: Other valleys of the law that are followed where the best leaves a little (decided: as many as hypotheses).
VALLEYS = 4
#: Hypotheses within the margin beside which one more effect is tried.
EQUALS = 2
#: Steps at S3, and at S2 of what S1 smooths away (decided: as many as what comes from S1 takes there).
STEPS, SHARPER = 3, 3
#: Words for the stages of longer memory.
MEMORY = {"S3": "refining the best models", "F": "testing every effect again at the longest memory"}


class Search:
    """One search over the hypotheses of a problem."""

    def __init__(self, fitter: Fitter):
        self.fitter, self.problem = fitter, fitter.problem
        self.seen: dict[frozenset[str], FittedModel] = {}
        self._floors: dict[tuple[tuple[str, ...], str], float] = {}
        self.baseline = self.nominal()
        self.test: ScoreTest | None = None  # of the best hypothesis at the last stage

    def run(self) -> list[FittedModel]:
        """Return the last hypotheses at F, best objective first; the null is always one of them."""
        beam = self.lengthen(self.begin(), S3)
        if self.leaves_more(self.best(beam), UNEXPLAINED, S3):
            return self.unexplained(beam)
        beam = self.lengthen(beam, F)
        best = self.best(beam)
        if self.leaves_more(best, IMPERFECT, F) and not self.leaves_more(best, CONTRADICTED, F):
            beam = self.second_look(beam)
        return self.eliminate(beam)

    def second_look(self, beam: list[FittedModel]) -> list[FittedModel]:
        """Return a beam at F with what stands in a better valley of the law, if there is one beside the best model.

        A model that leaves more than white noise may have the right effect and feet that are nearly right: it is moved
        along the ridges of the law at the shortest memory. Or several effects stand for another one, and found the law
        only after all had been compared. In both cases all effects are compared again beside the new law.
        """
        best = self.best(beam)
        self.problem.progress.begin("F", "looking for a better law", best.name)
        moved = self.fitter.tempered(FittedModel(best.effects, best.z.copy()), S1, 2)
        moved = self.fitter.settle(kicked(self.fitter, moved, S1, 2), S2, 4)
        (end,) = self.followed([moved.copy()])
        self.problem.say(f"{end.name}, the law moved: mean loss {end.loss:.2f}")
        better = end.objective <= best.objective - WORTH
        added = added_effects(self.fitter, best)
        if not better and len(added) < 2:
            return beam
        base = moved if better else best
        for e in added:
            base = self.fitter.without(base, e)
        self.baseline = self.settled(base)
        singles = halving(self.fitter, [self.baseline])
        return within([*beam, end, *self.followed([self.baseline, *singles])], BEAM, MARGINS["F"])

    def followed(self, field: list[FittedModel]) -> list[FittedModel]:
        """Return those of a field at S2 that stay near the best, at F."""
        self.fitter.widen()
        for h in field:
            self.fitter.refine(h, S3, STEPS)
        field = within(field, BEAM, MARGINS["S3"])
        follow(self.fitter, field, field)
        remember(self.seen, field)
        return field

    def unexplained(self, beam: list[FittedModel]) -> list[FittedModel]:
        """Return the best hypothesis and the baseline at F, where none explains the runs."""
        self.problem.progress.begin("without", "following the nearest model", self.best(beam).name)
        kept = [self.best(beam), self.baseline.copy()]
        return sorted(best_of_each([self.fitter.polish(h, F, 3) for h in kept]), key=lambda h: h.objective)

    def null(self) -> FittedModel:
        """Return the baseline from its nominal numbers at S2, and at S3 where S2 is contradicted."""
        carried = self.problem.carried
        null = FittedModel(carried, self.problem.nominal(carried))
        fine_enough(self.fitter, [released(self.fitter, null)], (S1, S2))
        self.fitter.tempered(null, S1, 4)
        null.start = null.z.copy()
        return self.settled(null)

    def settled(self, h: FittedModel) -> FittedModel:
        """Refine at S2, and go on there as long as innovations that are not white become much smaller."""
        fine_enough(self.fitter, [h], (S1, S2))
        self.fitter.refine(h, S2, 3)
        if self.leaves_more(h, CONTRADICTED, S2):
            self.fitter.settle(h, S2, 3)
        return h

    def begin(self) -> list[FittedModel]:
        """Return the hypotheses that explain the runs at S2, or come nearest to it."""
        progress = self.problem.progress
        progress.begin("baseline", "fitting the baseline")
        null = self.null()
        self.problem.say(f"baseline: mean loss {null.loss:.2f}")
        self.problem.tone = tone(self.fitter, null)
        beam = [null]
        if not self.is_explained(null):
            self.add_first(beam)
        self.baseline = self.best([h for h in beam if h.effects == self.problem.carried])
        left = self.baseline.loss
        while not self.is_explained(best := self.best(beam)) and self.may_add(best, left):
            left = best.loss
            progress.begin("effects", f"comparing {self.compared(best)}", best.name)
            added = halving(self.fitter, self.equals(beam, best)) if self.shows(best) else self.sharper(best)
            if min(h.objective for h in added) > best.objective:
                break
            self.add(beam, added)
            if not self.is_explained(now := self.best(beam)) and self.shows(now):
                beam.append(self.anywhere(now))
        return within(beam, BEAM)

    def shows(self, h: FittedModel) -> bool:
        """Return whether the shortest memory contradicts a model: where it does not, it tells no effects apart, and no
        laws beside them."""
        return self.leaves_more(self.fitter.evaluate(h.copy(), S1), CONTRADICTED, S1)

    def add_first(self, beam: list[FittedModel]) -> None:
        """Add hypotheses of one effect to a beam of the baseline: with feet as they are, then with other feet.

        Where an effect explains the runs and the law stays where it was, no other feet are looked for. Else the
        baseline starts over the whole prior; where that does not explain them, so does the law beside an effect that
        leads by far; where none does, an effect and the law are looked for together, if the shortest memory shows that
        something is missing.
        """
        progress, null = self.problem.progress, self.best(beam)
        progress.begin("effects", f"comparing {self.compared(null)}", null.name)
        added, leader = from_statement(self.fitter, null, self.nominal(), UNEXPLAINED)
        self.add(beam, added)
        if not self.is_explained(self.best(beam)):
            self.add(beam, self.sharper(null))
        if self.is_explained(best := self.best(beam)) and self.moved(best) < STAYED:
            return
        progress.begin("starts", "fitting the baseline from other starts", best.name)
        nominal = released(self.fitter, self.nominal())
        found = global_fit(self.fitter, nominal.effects, nominal.z)
        beam.append(alone := self.in_its_valley(found))
        self.problem.say(f"the law from anywhere: mean loss {alone.loss:.2f}")
        if not self.is_explained(self.best(beam)):
            self.add(beam, self.sharper(alone))
        if self.is_explained(best := self.best(beam)) or not self.shows(alone):
            return
        left = min(h.loss for h in beam if h.effects == self.problem.carried)
        if leader is None and leads(best, left):
            leader = best.copy()
        if leader is not None:
            beam.append(self.anywhere(leader))
        if not self.is_explained(best := self.best(beam)) and not leads(best, left):
            self.add(beam, from_anywhere(self.fitter, found))

    def sharper(self, h: FittedModel) -> list[FittedModel]:
        """Return the best additions of one effect to a model at S2, where what S1 smooths away shows."""
        field = proposed(self.fitter, h.copy(), S2, ADDED)
        for k in field:
            self.fitter.refine(k, S2, SHARPER)
        say(self.fitter, "what S1 smooths", field)
        return field

    def add(self, beam: list[FittedModel], added: Sequence[FittedModel]) -> None:
        """Add hypotheses to a beam, and let the best go on at S2."""
        beam += added
        self.fitter.polish(self.best(beam), S2, 5)

    def may_add(self, best: FittedModel, left: float) -> bool:
        """Return whether one more effect is looked for: `left` is the mean loss that the last one was to explain."""
        added = len(added_effects(self.fitter, best))
        return 0 < added < MOST and best.loss - WHITE <= LEAVES[added - 1] * (left - WHITE)

    def moved(self, h: FittedModel) -> float:
        """Return how far the law is from its nominal numbers, in prior deviations of the number that moved most."""
        nominal = self.nominal().z
        law = [k for k, p in enumerate(self.fitter.parameters(h)) if p.run is None and not p.effect]
        return float(max(abs(h.z[k] - nominal[k]) for k in law)) if law else 0.0

    def compared(self, best: FittedModel) -> str:
        """Return what the forward step compares, in words."""
        beside = added_effects(self.fitter, best)
        more = f" beside {' and '.join(beside)}" if beside else ""
        return f"{len(set(self.problem.candidates) - set(best.effects))} effects{more}"

    def equals(self, beam: Sequence[FittedModel], best: FittedModel) -> list[FittedModel]:
        """Return the best hypotheses with as many effects as the best, within the margin."""
        return within([h for h in beam if len(h.effects) == len(best.effects)], EQUALS)

    def is_explained(self, h: FittedModel) -> bool:
        """Return whether innovations at S2 are those of a right model."""
        return not self.leaves_more(h, CONTRADICTED, S2)

    def leaves_more(self, h: FittedModel, limit: float, stage: Stage) -> bool:
        """Return whether the mean loss of h, fitted at a stage, is above a limit that holds for a floor of white noise.

        Stiff feet and slow recorders leave more than white noise in right models too.
        """
        if h.loss <= limit:
            return False
        key = (h.effects, stage.name)
        if key not in self._floors:
            self._floors[key] = floor(self.fitter, h, stage)[0]
        return h.loss > limit * self._floors[key] / WHITE

    def anywhere(self, h: FittedModel) -> FittedModel:
        """Return a hypothesis whose law starts over the whole prior; releases and effects start as they are in h."""
        found = self.in_its_valley(global_fit(self.fitter, h.effects, h.z))
        self.problem.say(f"{h.name}, the law from anywhere: mean loss {found.loss:.2f}")
        return found

    def in_its_valley(self, found: GlobalFit) -> FittedModel:
        """Return the best of a fit from anywhere at S2; where it leaves a little, the best of all its valleys at S3.

        At the shortest memory two valleys of the law may be as low as each other.
        """
        best = self.settled(found.best)
        if not CONTRADICTED < best.loss <= UNEXPLAINED:
            return best
        others = found.valleys(VALLEYS, MARGIN)
        for h in others:
            self.settled(self.fitter.tempered(h, S1, AGAIN))
        field = [best.copy(), *others]
        for h in field:
            self.fitter.refine(h, S3, STEPS)
        say(self.fitter, "valleys", field)
        return self.settled(self.best(field))

    def nominal(self) -> FittedModel:
        """Return the baseline at its nominal numbers, before it bends towards what it lacks."""
        carried = self.problem.carried
        return FittedModel(carried, self.problem.nominal(carried))

    def best(self, beam: Sequence[FittedModel]) -> FittedModel:
        """Return the hypothesis with the least objective."""
        return min(beam, key=lambda h: h.objective)

    def lengthen(self, beam: list[FittedModel], stage: Stage) -> list[FittedModel]:
        """Fit a beam at a longer memory; at the longest let the score test add to the best."""
        self.problem.progress.begin(stage.name, MEMORY[stage.name], self.best(beam).name)
        self.fitter.widen()
        fine_enough(self.fitter, beam, [stage])
        if stage is S3 and quieten(self.fitter, self.best(beam), stage):
            self._floors.clear()
        whiten(self.fitter, self.best(beam), stage)
        if stage is F:
            follow(self.fitter, beam, beam)
            remember(self.seen, beam)
        else:
            for h in beam:
                self.fitter.refine(h, stage, STEPS)
        beam = within(beam, BEAM, MARGINS[stage.name])
        if stage is F:
            beam = self.joined(beam)
        say(self.fitter, stage.name, beam)
        return beam

    def joined(self, beam: list[FittedModel]) -> list[FittedModel]:
        """Return a beam at F with the additions to its best that gain enough, by the score test."""
        best = lowest(self.fitter, beam)
        if len(best.effects) >= MOST:
            return beam
        self.test = score_test(self.fitter, self.fitter.evaluate(best, F), F)
        added = proposals(self.fitter, self.fitter.evaluate(best.copy(), S3), S3, ADDED)
        added += self.promising(best, self.test, added)
        for h in added:
            self.fitter.refine(h, S3, STEPS)
        follow(self.fitter, added, [*beam, *added])
        remember(self.seen, added)
        bar = penalised(self.fitter, best)
        gaining = [h for h in added if penalised(self.fitter, h) < bar]
        return within([*beam, *gaining], BEAM, MARGINS["F"])

    def promising(self, best: FittedModel, test: ScoreTest, known: Sequence[FittedModel]) -> list[FittedModel]:
        """Return the additions that a score test puts first and that are not known: one step may fail where the valley
        bends."""
        there = {h.effects[-1] for h in known}
        found = [p.effect for p in test.gains()[:ADDED] if p.effect not in there]
        return [self.fitter.with_effect(best, e) for e in found]

    def eliminate(self, beam: list[FittedModel]) -> list[FittedModel]:
        """Return the last hypotheses at F, best first (`rockref.discover.selection.elimination`)."""
        return Elimination(self.fitter, self.baseline, self.seen).run(beam)
