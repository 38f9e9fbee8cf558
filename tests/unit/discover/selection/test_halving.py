"""Who goes on: by a margin, never by a rank."""

import numpy as np

from rockref.discover.fit.fitter import FittedModel
from rockref.discover.selection.halving import within


def fit(effects, objective) -> FittedModel:
    return FittedModel(tuple(effects), np.zeros(1), objective=objective)


def test_all_within_the_margin_go_on_and_no_one_else():
    field = [fit("a", 1000.0), fit("b", 1140.0), fit("c", 1160.0)]
    assert [h.effects for h in within(field, 5, 1.15)] == [("a",), ("b",)]
    assert len(within(field, 1, 1.15)) == 1


def test_of_each_set_of_effects_the_best_goes_on_in_whatever_order_it_is_written():
    assert [h.objective for h in within([fit("ab", 1001.0), fit("ba", 1000.0)], 5)] == [1000.0]
