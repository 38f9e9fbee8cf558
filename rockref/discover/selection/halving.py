"""Successive halving: many starts, few steps each; who is within a margin of the best goes on to a longer memory.

K. Jamieson, A. Talwalkar (2016), Non-stochastic best arm identification and hyperparameter optimization, AISTATS 51.
"""

from __future__ import annotations

from collections.abc import Sequence

from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.objective import inflation_for
from rockref.discover.fit.stages import S1, S2, Stage
from rockref.discover.fit.starts import first_swing
from rockref.discover.hypotheses.effects import seeds_of
from rockref.discover.selection.score_test import best_of_each, proposals, score_test

#: Additions that are tried at the first stage, refined at it, and taken to the second, at most.
ENTRANTS, FIRST, SECOND = 9, 5, 3
#: How many go into each round at the first stage, and the factor on the best objective up to which they do.
ROUNDS = ((10, 4.0), (7, 2.5))
#: Share of the objective by which one may lie above the best and go on: a margin, never a rank.
MARGIN = 1.15
#: Steps that size a sensor's error from the release.
SIZED = 3
#: Nats that an effect has to gain (decided: what the temperature of the evidence and odds of one in twenty ask for).
WORTH = 10.0
#: Mean loss that inflated noise leaves where an addition is proposed far from the valley.
WARM = 1.5


def within(field: Sequence[FittedModel], most: int, margin: float = MARGIN) -> list[FittedModel]:
    """Return the best of a field, those within a margin of the first, at most so many."""
    ranked = sorted(best_of_each(field), key=lambda h: h.objective)
    return [h for h in ranked if h.objective <= margin * ranked[0].objective][:most]


def halving(fitter: Fitter, starts: Sequence[FittedModel]) -> list[FittedModel]:
    """Return the best additions of one effect to models, each from its start at the shortest memory, fitted at S2."""
    field: list[FittedModel] = []
    for start in starts:
        field += entrants(fitter, FittedModel(start.effects, start.z if start.start is None else start.start))
    fitter.evaluate_all(field, S1)
    for most, margin in ROUNDS:
        field = within(field, most, margin)
        for h in field:
            fitter.tempered(h, S1, 1)
    say(fitter, "S1", field := within(field, FIRST, 2 * MARGIN))
    for h in field:
        h.start = h.z.copy()
        fitter.refine(h, S2, 3)
    field = within(field, SECOND)
    say(fitter, "S2", field)
    return field


def entrants(fitter: Fitter, base: FittedModel) -> list[FittedModel]:
    """Return a model with each of the best effects that it lacks, and each error of the sensor, sized at release."""
    return proposed(fitter, base, S1, ENTRANTS) + sized_at_release(fitter, base)


def proposed(
    fitter: Fitter, base: FittedModel, stage: Stage, most: int, among: Sequence[str] | None = None
) -> list[FittedModel]:
    """Return a model with each of the best effects that it lacks, by a step with the noise inflated to what is left.

    among : the effects that are tried; all if None
    """
    fitter.evaluate(base, stage)
    assert base.r is not None
    warm = stage.inflated(inflation_for(base.r, fitter.residuals(stage).count, WARM))
    fitter.widen()
    test = score_test(fitter, fitter.evaluate(base, warm), warm, among)
    return proposals(fitter, base, warm, most, test)


def sized_at_release(fitter: Fitter, base: FittedModel) -> list[FittedModel]:
    """Return the base with each error of the sensor that it lacks, sized before the first impact at a long memory.

    What has finite starts is not among them: small, it shows nothing.
    """
    found = []
    stage = first_swing(fitter)
    for e in fitter.problem.candidates:
        numbers = fitter.problem.parameters((e,))[len(fitter.problem.parameters()) :]
        has_finite_starts = seeds_of(numbers, e, fitter.problem.records, fitter.problem.units)
        if e in base.effects or has_finite_starts or not any(p.moves_target for p in numbers):
            continue
        h = fitter.tempered(fitter.with_effect(base, e), stage, SIZED)
        own = len(base.z)
        found.append(FittedModel(h.effects, h.z.copy()))
        found[-1].z[:own] = base.z
    return found


def say(fitter: Fitter, stage: str, field: Sequence[FittedModel]) -> None:
    """Report how a field stands."""
    fitter.problem.progress.note(min(field, key=lambda h: h.objective).name)
    fitter.problem.say(f"{stage}: " + ", ".join(f"{h.name} {h.objective:.0f} ({h.loss:.2f})" for h in field))
