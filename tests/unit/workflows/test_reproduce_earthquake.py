"""The page of the earthquake: what it answers, and curves that stand where their levels are."""

import numpy as np
import pytest

from rockref.shake import defects
from rockref.workflows.reproduce_earthquake import levels_figure, sentences


def made_up(more):
    """Return a study of two levels of 400 signals: `more` only the calibrated block falls, ten only the other."""
    one, other = np.zeros((2, 400))
    one[:more], other[390:] = 1.0, 1.0
    level = defects._level(1.5, {"fell": np.array([one, other]), "rocked": np.array([one, one])})
    found = (level, defects._level(2.0, {"fell": np.array([one, other]), "rocked": np.array([one, one])}))
    twice = defects.difference(np.tile(one, 2), np.tile(other, 2))
    return defects.Defects(found, twice, defects.difference(one, one), (2 * more, 20), 1e-5)


@pytest.mark.parametrize(
    "more, answer, where",
    [
        (60, "The calibrated block falls more often", "at 1.5, 2 m/s2"),
        (10, "A difference in falls is not shown", "at no level"),
        (0, "The calibrated block falls less often", "at 1.5, 2 m/s2"),
    ],
)
def test_the_answer_comes_first_and_goes_with_the_interval(more, answer, where):
    said = sentences(made_up(more))
    assert said[0].startswith(answer) and where in said[2]


def test_both_curves_stand_where_their_levels_are():
    figure = levels_figure(made_up(60))
    drawn = [line.get_xdata().tolist() for line in figure.axes[0].lines]
    assert drawn == [[1.5, 2.0], [1.5, 2.0]]
