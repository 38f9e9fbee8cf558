"""A search that leaves its state after every stage, and goes on from the state that an interrupted one has left."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.stages import S2, S3, Stage
from rockref.discover.fit_store import FitStore, read_fit, written
from rockref.discover.selection.finalists import remember
from rockref.discover.selection.search import Search

#: Stages after which the state is kept. What follows the last stage needs the score test that is made in it.
ORDER = (S2.name, S3.name)


class KeptSearch(Search):
    """The search of `rockref.discover.selection.search`, its state kept under a key of a store."""

    def __init__(self, fitter: Fitter, store: FitStore, key: str):
        super().__init__(fitter)
        self.store, self.key = store, key
        self.state: dict[str, Any] | None = store.kept["searches"].get(key)
        if self.state is not None:
            self.problem.tone = self.state["tone"]
            self.problem.finer.update(self.state["finer"])
            self.baseline = self.model(self.state["baseline"])
            remember(self.seen, [self.model(known) for known in self.state["seen"]])
            self.problem.say(f"going on after stage {self.state['stage']}")

    def begin(self) -> list[FittedModel]:
        """Return the hypotheses at S2, or those that were kept."""
        return self.passed(S2.name, super().begin)

    def lengthen(self, beam: list[FittedModel], stage: Stage) -> list[FittedModel]:
        """Fit a beam at a longer memory, or return the one that was kept."""
        longer = super().lengthen
        if stage.name not in ORDER:
            return longer(beam, stage)
        return self.passed(stage.name, lambda: longer(beam, stage))

    def passed(self, stage: str, work: Callable[[], list[FittedModel]]) -> list[FittedModel]:
        """Return the beam after a stage: kept, or from its work; nothing where a later stage was kept."""
        if self.state is not None and ORDER.index(self.state["stage"]) >= ORDER.index(stage):
            return [self.model(known) for known in self.state["beam"]] if self.state["stage"] == stage else []
        beam = work()
        fits = [written(self.problem, h) for h in beam]
        self.store.kept["searches"][self.key] = {
            "stage": stage,
            "tone": self.problem.tone,
            "finer": self.problem.finer,
            "beam": fits,
            "baseline": written(self.problem, self.baseline),
            "seen": [written(self.problem, h) for h in self.seen.values()],
        }
        self.store.save()
        return beam

    def model(self, known: dict[str, Any]) -> FittedModel:
        """Return a kept fit."""
        h = read_fit(self.problem, known)
        assert h is not None  # the key of the state covers all on which the numbers depend
        return h
