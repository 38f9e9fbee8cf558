"""What an effect is mistaken for is fitted in its place."""

import pytest

from rockref import Model
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.problem import fit_problem
from rockref.discover.fit.stages import S1, S3
from rockref.discover.selection.rivals import confounders, rivals
from rockref.discover.selection.search import Search
from rockref.effects import catalogue
from tests.unit.discover.synthetic import experiment

ALL = tuple(catalogue.EFFECTS)
MODEL = Model.table_3_1()
RATE = 1.01


@pytest.fixture(scope="module")
def search() -> Search:
    hurried = MODEL.replace(effects=(catalogue.find("clock_error")(rate=RATE),))
    made = experiment(hurried, [{}, {"tilt": 0.1}], duration=1.2, noisy=True)
    candidates = ("clock_error", "inertia_deviation", "gyro_scale", "quadratic_drag")
    return Search(Fitter(fit_problem(made, made.runs, MODEL, end=1.1, workers=1, candidates=candidates)))


def test_confounders_are_each_other_s():
    rows = {e: confounders(e, ALL) for e in ALL}
    assert all((a in rows[b]) == (b in rows[a]) and a not in rows[a] for a in ALL for b in ALL)


def test_what_stretches_a_record_or_its_rates_is_in_one_row():
    assert {"clock_error", "gyro_scale", "inertia_deviation"} <= set(confounders("dimension_deviation", ALL))
    # What is no candidate is no rival, and leads to none.
    assert confounders("dimension_deviation", ("dimension_deviation", "clock_error")) == []


def test_a_rival_finds_its_valley_from_a_law_that_has_bent_beside_another_effect(search):
    fitter = search.fitter
    bent = fitter.with_effect(FittedModel((), search.problem.nominal()), "inertia_deviation")
    bent = fitter.refine(fitter.tempered(bent, S1, 4), S3, 3)
    clock, *_ = rivals(fitter, bent, "inertia_deviation", [])
    assert clock.effects == ("clock_error",)
    # Ten nats: a wrong effect that the law helps is told apart by more in two noisy runs.
    assert clock.objective < bent.objective - 10.0
    (rate,) = (
        p.value(z) for p, z in zip(fitter.parameters(clock), clock.z, strict=True) if p.name == "clock_error.rate"
    )
    assert rate - 1 == pytest.approx(RATE - 1, rel=0.1)
    # A set that is known is not fitted again.
    assert rivals(fitter, bent, "inertia_deviation", [frozenset({e}) for e in search.problem.candidates]) == []
