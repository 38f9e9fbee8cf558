"""What an effect gains in records that the model without it makes."""

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.floor import RECORDS, in_own_record
from rockref.discover.fit.problem import fit_problem
from rockref.discover.fit.stages import S1, S3, F
from rockref.discover.selection import chance
from rockref.discover.selection.chance import gain_in_own_record, gained_by_chance, weaker
from rockref.effects import catalogue
from tests.unit.discover.synthetic import experiment

MODEL = Model.table_3_1()
LEVER = 1e-4


@pytest.fixture(scope="module")
def fitted() -> tuple[Fitter, FittedModel, FittedModel]:
    """Runs with a little rolling resistance: the baseline and the effect, both fitted."""
    rolling = MODEL.replace(effects=(catalogue.find("rolling_resistance")(lever=LEVER),))
    made = experiment(rolling, [{}, {"tilt": 0.1}], duration=1.2, noisy=True)
    fitter = Fitter(fit_problem(made, made.runs, MODEL, end=1.1, workers=1, candidates=("rolling_resistance",)))
    null = FittedModel((), fitter.problem.nominal())
    more = fitter.with_effect(null, "rolling_resistance")
    for h in (null, more):
        fitter.refine(fitter.tempered(h, S1, 3), S3, 3)
        fitter.polish(h, F, 4)
    return fitter, null, more


def test_an_effect_gains_next_to_nothing_in_records_that_are_made_without_it(fitted):
    fitter, null, more = fitted
    gain = null.objective - more.objective
    by_chance = gain_in_own_record(fitter, null, "rolling_resistance", 0)
    # One number gains half a nat in white noise, and some nats where impacts amplify it; the real one gains a hundred.
    assert by_chance < 10.0 < 0.2 * gain


def test_in_records_that_are_made_with_it_it_gains_as_in_the_runs(fitted):
    fitter, _, more = fitted
    # A record of the model with the effect, in which the effect is left out and found again.
    own, there = in_own_record(fitter, more, F, 0)
    alone = own.polish(own.refine(own.without(there, "rolling_resistance"), S3, 3), F, 4)
    assert alone.objective - there.objective > 50.0


def test_chance_gains_the_most_of_several_records(fitted):
    fitter, null, more = fitted
    single = [gain_in_own_record(fitter, null, "rolling_resistance", seed) for seed in range(RECORDS)]
    assert len(set(single)) == RECORDS
    assert gained_by_chance(fitter, [null, more], more) == max(0.0, *single) < 10.0


@pytest.mark.parametrize(
    ("gains", "asked", "largest"),
    [([3, 1, 4], 3, 4.0), ([3, 40, 5, 2, 50, 6, 1], 7, 50.0), ([-2, 800], 2, 800.0), ([-2, -3, -1], 3, 0.0)],
    ids=["calm", "by much", "more than the effect", "nothing"],
)
def test_more_records_are_asked_where_chance_gains_much(fitted, monkeypatch, gains, asked, largest):
    fitter, null, _ = fitted
    seeds = []
    monkeypatch.setattr(chance, "gain_in_own_record", lambda *given: float(gains[seeds.append(given[-1]) or given[-1]]))
    less = FittedModel((), null.z, objective=17000.0)
    more = FittedModel(("rolling_resistance",), null.z, objective=16700.0)
    assert gained_by_chance(fitter, [less, more], more) == largest and seeds == list(range(asked))


def test_what_gains_far_more_than_chance_could_is_not_asked_for(fitted):
    fitter, null, more = fitted
    far = FittedModel((), null.z, objective=2 * more.objective)
    assert gained_by_chance(fitter, [far, more], more) == 0.0
    assert gained_by_chance(fitter, [more], more) == 0.0
    assert gained_by_chance(fitter, [null, more], null) == 0.0


def test_the_weakest_effect_is_the_one_that_is_missed_least():
    def at(objective: float, *effects: str) -> FittedModel:
        return FittedModel(effects, np.zeros(1), objective=objective)

    pair, a, b, c = at(900.0, "a", "b"), at(950.0, "a"), at(1200.0, "b"), at(800.0, "c")
    assert weaker([pair, a, b, c], pair, ()) is a
    # What the user's model carries is never left out.
    assert weaker([pair, a, b, c], pair, ("b",)) is b
