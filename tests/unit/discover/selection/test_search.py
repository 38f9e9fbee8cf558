"""The search asks the stage at which an effect shows."""

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.problem import fit_problem
from rockref.discover.fit.stages import S1, S2
from rockref.discover.selection.score_test import ScoreTest
from rockref.discover.selection.search import ADDED, Search
from rockref.effects import catalogue
from tests.unit.discover.synthetic import experiment

MODEL = Model.table_3_1()
#: Bandwidth of the gyroscope [Hz]: its slope is late by 3 ms, which is less than what S1 smooths over.
BANDWIDTH = 70.0


@pytest.fixture(scope="module")
def search() -> Search:
    slow = MODEL.replace(effects=(catalogue.find("gyro_bandwidth")(frequency=BANDWIDTH),))
    made = experiment(slow, [{}, {"tilt": 0.1}], duration=1.2, noisy=True)
    candidates = ("gyro_bandwidth", "mass_eccentricity", "stribeck_friction", "dimension_deviation")
    return Search(Fitter(fit_problem(made, made.runs, MODEL, end=1.1, workers=1, candidates=candidates)))


def test_what_the_shortest_memory_smooths_away_is_found_at_the_next(search):
    null = FittedModel((), search.problem.nominal())
    at = {stage.name: search.fitter.evaluate(null.copy(), stage).loss for stage in (S1, S2)}
    # S1 hardly shows it: an effect of the motion gains half as much again from one memory to the next one.
    assert at["S2"] > 2 * at["S1"]
    best, *others = sorted(search.sharper(null), key=lambda h: h.objective)
    assert best.effects == ("gyro_bandwidth",)
    # What stands in for it explains less than half: a factor of two is far beyond the scatter of noise.
    assert all(h.objective > 2 * best.objective for h in others)
    (bandwidth,) = (
        p.value(z)
        for p, z in zip(search.fitter.parameters(best), best.z, strict=True)
        if p.name == "gyro_bandwidth.frequency"
    )
    # Fitted as 1/frequency. Three steps at S2 of a rough objective, and a start at absence: a twentieth.
    assert 1 / bandwidth == pytest.approx(BANDWIDTH, rel=0.05)


def test_what_a_score_test_puts_first_is_tried_though_one_step_gains_nothing(search):
    best = FittedModel((), search.problem.nominal())
    effects = search.problem.candidates
    # One number each, of gradients 3, 4, 1, 2 and the same information: the second promises most, then the first.
    rows = {e: np.array([k]) for k, e in enumerate(effects)}
    test = ScoreTest(np.eye(len(effects)), np.array([3.0, 4.0, 1.0, 2.0]), 0, rows)
    assert ADDED == 2
    assert [h.effects for h in search.promising(best, test, [])] == [(effects[1],), (effects[0],)]
    known = [search.fitter.with_effect(best, effects[1])]
    (left,) = search.promising(best, test, known)
    assert left.effects == (effects[0],)
    # It starts where the model is, the effect absent.
    assert left.z[: len(best.z)] == pytest.approx(best.z) and not left.z[len(best.z) :].any()
