"""What an effect is mistaken for, by its own statement, fitted from the shortest memory."""

from __future__ import annotations

from collections.abc import Collection

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.stages import S1, S2, S3
from rockref.discover.selection.halving import MARGIN, proposed, say, within
from rockref.effects import catalogue

#: Rivals that go on to S2 and to longer memories, and steps of each at S3, after one at S1 and one at S2 (decided: from
#: the law beside the effect they come near at once, or never).
WENT_ON, LAST, STEPS = 3, 2, 3


def confounders(effect: str, candidates: Collection[str]) -> list[str]:
    """Return the candidates that an effect may be mistaken for: its confounder, those whose confounder it is, and
    theirs.

    Three errors that scale or stretch a record are confounders in a row: each names one neighbour.
    """
    near = neighbours(effect, candidates)
    far = {x for e in near for x in neighbours(e, candidates)}
    return sorted((near | far) - {effect})


def neighbours(effect: str, candidates: Collection[str]) -> set[str]:
    """Return the candidates that name an effect as their confounder, or that it names."""
    own = catalogue.find(effect).confounder
    return {x for x in candidates if x == own or catalogue.find(x).confounder == effect}


def rivals(fitter: Fitter, best: FittedModel, effect: str, known: Collection[frozenset[str]]) -> list[FittedModel]:
    """Return a model with each rival in an effect's place, fitted at S3: those that stay within a margin of it.

    A model explains a record with the wrong effect where its law has bent beside it. There one step of a long memory
    leads no rival into its valley; at the shortest memory it does.
    """
    there = [e for e in confounders(effect, fitter.problem.candidates) if e not in best.effects]
    less, own = fitter.without(best, effect), best.copy()
    there = [e for e in there if frozenset((*less.effects, e)) not in known]
    if not there:
        return []
    field = proposed(fitter, less, S1, WENT_ON, there)
    for stage, most, steps in ((S1, WENT_ON, 1), (S2, LAST, 1), (S3, LAST, STEPS)):
        fitter.widen()
        for h in field:
            (fitter.tempered if stage is S1 else fitter.refine)(h, stage, steps)
        limit = MARGIN * fitter.evaluate(own, stage).objective
        say(fitter, f"rivals of {effect} at {stage.name}", [own, *field])
        field = [h for h in within(field, most) if h.objective <= limit]
        if not field:
            break
    return field
