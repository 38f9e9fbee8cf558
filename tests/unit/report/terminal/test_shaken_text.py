"""Answers about outcomes on a shake table."""

import numpy as np
import pytest

from rockref.report.terminal.shaken_text import answers
from rockref.shake.statistics.distances import exchange_test


@pytest.mark.parametrize("motions, few", [(4, True), (5, True), (6, False)])
def test_motions_that_are_too_few_to_show_anything_are_told(motions, few):
    tilt = {"quantity": "tilt", "name": "model", "p_value": 0.5}
    (said,) = answers({"predictions": [], "maxima": [tilt], "motions": motions})
    assert (f"{motions} motions allow none below" in said) is few


def test_the_least_probability_is_that_of_two_sides_that_share_nothing():
    motion = np.repeat(np.arange(4), 10)
    found = exchange_test(np.zeros(40), np.ones(40), motion, motion, draws=9999)
    (said,) = answers(
        {"predictions": [], "motions": 4, "maxima": [{"quantity": "tilt", "name": "m", "p_value": found.p_value}]}
    )
    # Of 9999 exchanges an eighth, to three standard deviations.
    assert found.p_value == pytest.approx(1 / 8, abs=0.01) and "allow none below 0.125" in said
