"""What the best model can do without is taken out of it, and goes no farther."""

import numpy as np
import pytest

import rockref.discover.selection.elimination as elimination
from rockref.discover.fit.fitter import FittedModel
from rockref.discover.selection.elimination import Elimination
from tests.unit.discover.selection.test_finalists import Descents

#: Objectives [nat] of sets of effects: the scale explains the runs, the others gain a little beside it.
KNOWN = {"scale": 1000.0, "scale drag": 960.0, "scale drag clock": 945.0, "drag": 2000.0, "clock": 2100.0, "": 3000.0}


def at(objective: float, *effects: str) -> FittedModel:
    return FittedModel(("carried", *effects), np.zeros(1), objective=objective)


@pytest.fixture
def fitted(monkeypatch) -> list[str]:
    """Return the sets that were fitted, in their order; what is not in KNOWN ends far above."""
    asked: list[str] = []

    def follow(fitter, field, beam, most):
        for h in field:
            asked.append(" ".join(h.effects[1:]))
            h.objective = KNOWN.get(asked[-1], 5000.0)

    monkeypatch.setattr(elimination, "follow", follow)
    return asked


def eliminating(*field: FittedModel) -> Elimination:
    fitter = Descents()
    fitter.problem.progress = fitter.problem
    fitter.problem.begin = lambda *words: None
    fitter.without = lambda h, e: FittedModel(tuple(x for x in h.effects if x != e), h.z)
    return Elimination(fitter, at(3000.0), {frozenset(h.effects): h for h in field})


def test_what_gains_too_little_is_taken_out_one_after_the_other(fitted):
    found = eliminating(at(945.0, "scale", "drag", "clock"))
    assert found.simplest().effects == ("carried", "scale")
    assert fitted == ["drag clock", "scale clock", "scale drag", "drag", "scale", ""]


def test_two_effects_that_are_there_both_stay(fitted):
    found = eliminating(at(300.0, "scale", "drag"))
    assert found.simplest().effects == ("carried", "scale", "drag")
    assert fitted == ["drag", "scale"]


def test_parts_of_what_explains_as_well_are_tried(fitted):
    best, pair, far = at(1000.0, "scale"), at(1005.0, "drag", "clock"), at(1100.0, "clock")
    more = at(990.0, "scale", "drag")
    found = eliminating(best, pair, far, more)
    assert found.as_good(best) == [pair]  # what holds the best has its parts exchanged
    found.take_out(pair)
    assert fitted == ["drag"]  # the clock alone is known
