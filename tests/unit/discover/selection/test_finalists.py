"""Fits that are followed side by side: all that can still come near the best are, and no others."""

import numpy as np

from rockref.discover.fit.fitter import FittedModel
from rockref.discover.fit.starts import GlobalFit
from rockref.discover.selection.finalists import CONVERGED, follow, lowest, remember
from rockref.discover.selection.halving import WORTH


class Problem:
    """What a fit asks of its problem."""

    carried, companion = ("carried",), 75.0

    def say(self, line): ...

    def refined(self, h, stage): ...


class Descents:
    """A fitter whose fits fall along given objectives, one a step."""

    def __init__(self, **falls):
        self.falls, self.steps, self.problem = falls, dict.fromkeys(falls, 0), Problem()
        self.field = [FittedModel((name,), np.zeros(1)) for name in falls]  # no more effects than the user's model

    def evaluate_all(self, field, stage):
        for h in field:
            h.objective = self.falls[h.name][0]

    def polished(self, h, stage):
        self.steps[h.name] += 1
        k = min(self.steps[h.name], len(self.falls[h.name]) - 1)
        h.objective = self.falls[h.name][k]
        return k + 1 < len(self.falls[h.name])

    def follow(self, **kept):
        follow(self, self.field, self.field, **kept)
        return [h.objective for h in self.field]


def test_a_fit_that_turns_late_into_its_valley_arrives_beside_one_that_turns_early():
    descents = Descents(early=[5000.0, 4000.0, 2000.0, 1000.0], late=[5000.0, 4900.0, 4500.0, 2500.0, 990.0])
    assert descents.follow() == [1000.0, 990.0]


def test_what_at_its_pace_does_not_come_near_stops():
    slow = [1000.0 + 20 * WORTH - WORTH * k for k in range(20)]
    descents = Descents(arrived=[1000.0], slow=slow)
    descents.follow()
    # It gains its worth a step: after the first of eight steps, seven more would leave it twelve times that above.
    assert descents.steps == {"arrived": 1, "slow": 1}


def test_no_fit_takes_more_steps_than_it_may():
    endless = [1000.0 - k for k in range(50)]
    for most in (3, CONVERGED):
        descents = Descents(endless=endless)
        descents.follow(most=most)
        assert descents.steps == {"endless": most}


def test_valleys_of_a_fit_from_anywhere_are_those_near_its_best_over_whole_records():
    losses = (1.0, 1.1, 1.14, 1.2)
    last = [FittedModel((), np.full(1, k), loss=loss) for k, loss in enumerate(losses)]
    found = GlobalFit([[FittedModel((), np.zeros(1), loss=0.1)], last], [])
    assert [h.loss for h in found.valleys(4, 1.15)] == [1.1, 1.14]
    assert [h.loss for h in found.valleys(1, 1.15)] == [1.1]


def test_an_effect_beside_another_has_to_gain_more_than_one_alone():
    def at(objective: float, *effects: str) -> FittedModel:
        return FittedModel(("carried", *effects), np.zeros(1), objective=objective)

    fitter = Descents()
    null, one, two = at(1000.0), at(989.0, "drag"), at(905.0, "drag", "clock")
    assert lowest(fitter, [null, one]) is one and lowest(fitter, [at(998.0), one]) is not one
    # 84 nats are less than what any effect has to gain (10) and what one beside another has to (75).
    assert lowest(fitter, [one, two]) is one
    assert lowest(fitter, [one, better := at(903.0, "drag", "clock")]) is better


def test_the_lowest_fit_of_each_set_is_kept():
    known: dict = {}
    high, low = (
        FittedModel(effects, np.zeros(1), objective=x) for effects, x in ((("a", "b"), 2.0), (("b", "a"), 1.0))
    )
    remember(known, [high, low, high])
    assert known == {frozenset({"a", "b"}): low}
