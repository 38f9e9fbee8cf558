"""Pairs of an effect and a law: who goes on, and over which horizon they are told apart."""

import numpy as np

from rockref.discover.fit.fitter import FittedModel
from rockref.discover.selection.together import TELLING, best_pairs, telling


def fit(effects: str, loss: float) -> FittedModel:
    return FittedModel(tuple(effects), np.zeros(1), loss=loss)


def test_of_each_effect_the_best_starts_go_on():
    field = [fit("a", 1.3), fit("a", 1.0), fit("b", 1.4), fit("a", 1.1), fit("ab", 2.0)]
    assert [h.loss for h in best_pairs(field, 9, 2)] == [1.0, 1.1, 1.4, 2.0]
    assert [h.loss for h in best_pairs(field, 2, 1)] == [1.0, 1.4]
    assert [h.loss for h in best_pairs(field, 9, 1, margin=1.5)] == [1.0, 1.4]


def test_effects_are_told_apart_where_the_law_alone_leaves_something():
    little, much = TELLING - 0.1, TELLING + 0.1
    assert telling([much, little, much], TELLING) == 0
    assert telling([little, much, 2 * much], TELLING) == 1
    assert telling([little] * 3, TELLING) == 2, "where the law alone explains all, whole runs tell effects apart"
