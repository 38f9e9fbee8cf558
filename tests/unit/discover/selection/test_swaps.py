"""An effect in another's place: known runs, the wrong one of two named, and the right one put there."""

import pytest

from rockref import Model
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.problem import fit_problem
from rockref.discover.fit.stages import S1, S2, S3, F
from rockref.discover.selection.swaps import MOST, swapped, swaps
from rockref.effects import catalogue
from tests.unit.discover.synthetic import experiment

MODEL = Model.table_3_1()
CANDIDATES = ("gyro_scale", "quadratic_drag", "clock_error", "cable_restraint")


@pytest.fixture(scope="module")
def mistaken() -> tuple[Fitter, FittedModel, FittedModel]:
    """Runs with drag; the baseline and a cable that damps, which stands for it, both fitted."""
    slowed = MODEL.replace(effects=(catalogue.find("quadratic_drag")(c=0.4),))
    made = experiment(slowed, [{}, {"tilt": 0.1}], duration=1.2, noisy=True)
    fitter = Fitter(fit_problem(made, made.runs, MODEL, end=1.1, workers=1, candidates=CANDIDATES))
    null = FittedModel((), fitter.problem.nominal())
    wrong = fitter.with_effect(null, "cable_restraint")
    for h in (null, wrong):
        fitter.refine(fitter.refine(fitter.tempered(h, S1, 3), S2, 2), S3, 3)
        fitter.polish(h, F, 3)
    return fitter, null, wrong


def test_the_right_effect_is_put_in_the_place_of_the_wrong_one(mistaken):
    fitter, null, wrong = mistaken
    found = swapped(fitter, [wrong, null])
    best = found[0]
    assert best.effects == ("quadratic_drag",)
    assert best.objective < wrong.objective - 50.0
    drag = fitter.model(best).effects[0].values()["c"]
    assert drag == pytest.approx(0.4, rel=0.05)


def test_what_is_known_is_not_proposed(mistaken):
    fitter, _, wrong = mistaken
    known = {frozenset({e}) for e in CANDIDATES if e != "clock_error"}
    assert [h.effects for h in swaps(fitter, wrong, known)] == [("clock_error",)]
    assert len(swaps(fitter, wrong, set())) <= MOST
    assert wrong.effects == ("cable_restraint",)


def test_a_baseline_has_no_place_to_take(mistaken):
    fitter, null, _ = mistaken
    assert swaps(fitter, null, set()) == [] and swapped(fitter, [null]) == [null]
