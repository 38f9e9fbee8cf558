"""Detection limits: what a linearisation says of effects that are absent."""

from types import SimpleNamespace

import numpy as np

from rockref.discover.hypotheses.parameter import Parameter
from rockref.discover.selection.score_test import ScoreTest
from rockref.discover.verdict.calibration import calibration
from rockref.discover.verdict.detection import detection


def limits_for(*information: float) -> dict:
    """Detection limits of effects a, b, ... of one number each, with this much information about it, prior included."""

    def parameters(effects=()):
        return tuple(Parameter(f"{e}.size", lambda model, value: model, 0.0, typical=1.0) for e in effects)

    places = {name: np.array([k]) for k, name in enumerate("abc"[: len(information)])}
    test = ScoreTest(np.diag(information), np.zeros(len(information)), 0, places)
    return detection(SimpleNamespace(parameters=parameters), test, calibration())[0]


def test_the_more_runs_tell_of_a_number_the_smaller_is_its_limit():
    found = limits_for(3e2, 1e4)
    assert found["a.size"]["in_typical_sizes"] > found["b.size"]["in_typical_sizes"] >= calibration().least_amplitude


def test_what_no_small_step_shows_has_no_limit():
    assert set(limits_for(1.0, 1e4)) == {"b.size"}
