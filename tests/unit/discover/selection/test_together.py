"""Pairs of an effect and a law: who goes on, and over which horizon they are told apart."""

import numpy as np

from rockref.discover.fit.fitter import FittedModel
from rockref.discover.fit.starts import GlobalFit
from rockref.discover.selection.together import STARTS, TELLING, best_pairs, telling


def fit(effects: str, loss: float) -> FittedModel:
    return FittedModel(tuple(effects), np.zeros(1), loss=loss)


def test_of_each_effect_the_best_starts_go_on():
    field = [fit("a", 1.3), fit("a", 1.0), fit("b", 1.4), fit("a", 1.1), fit("ab", 2.0)]
    assert [h.loss for h in best_pairs(field, 9, 2)] == [1.0, 1.1, 1.4, 2.0]
    assert [h.loss for h in best_pairs(field, 2, 1)] == [1.0, 1.4]
    assert [h.loss for h in best_pairs(field, 9, 1, margin=1.5)] == [1.0, 1.4]


def test_effects_are_told_apart_where_the_law_alone_leaves_something():
    little, much = TELLING - 0.1, TELLING + 0.1
    fields = [[fit("", loss)] * 5 for loss in (little, much, 2 * much)]
    starts, horizon = telling(GlobalFit(fit("", 3.0), fields))
    assert horizon == 1 and len(starts) == STARTS and [h.loss for h in starts] == [much] * (STARTS - 1) + [3.0]


def test_where_the_law_alone_explains_all_whole_runs_tell_effects_apart():
    fields = [[fit("", TELLING - 0.1)]] * 3
    assert telling(GlobalFit(fit("", 1.0), fields))[1] == 2
