"""Predictions of motions that took no part in the fit."""

import numpy as np
import pytest

from rockref.model.errors import InputError
from rockref.shake.statistics.binary_regression import fit_binary
from rockref.shake.statistics.held_out import held_out_choice, held_out_regression
from rockref.shake.statistics.scores import log_losses

RNG = np.random.default_rng(16)
X = RNG.normal(size=60)
MOTION = np.repeat(list("abcdef"), 10)
FELL = (RNG.random(60) < 1 / (1 + np.exp(-2 * X))).astype(float)


def test_outcomes_of_a_motion_do_not_reach_its_own_prediction():
    changed = np.where(MOTION == "c", 1 - FELL, FELL)
    one, other = (held_out_regression(X[:, None], y, MOTION) for y in (FELL, changed))
    assert (one[MOTION == "c"] == other[MOTION == "c"]).all()
    assert (one[MOTION != "c"] != other[MOTION != "c"]).all()
    design = np.column_stack([np.ones(60), X])
    kept = MOTION != "c"
    assert (fit_binary(design[kept], FELL[kept]).probability(design[~kept]) == one[~kept]).all()


def test_the_candidate_of_a_motion_is_the_best_of_all_others():
    slopes = np.array([0.0, 1.0, 2.0, 8.0])
    p = 1 / (1 + np.exp(-slopes * X[:, None]))
    found, chosen = held_out_choice(p, FELL, MOTION)
    for k, name in enumerate("abcdef"):
        out = MOTION == name
        losses = [log_losses(column[~out], FELL[~out]).sum() for column in p.T]
        assert chosen[k] == np.argmin(losses)
        assert (found[out] == p[out, chosen[k]]).all()
    with pytest.raises(InputError, match="E-SHAPE"):
        held_out_choice(p[:5], FELL, MOTION)
