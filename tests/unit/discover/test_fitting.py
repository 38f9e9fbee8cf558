"""Of some starts of a fit the nearest to the runs is kept, and stands on another one that ends in the same place."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover import fitting
from tests.unit.discover.bowls import ALONE, Bowl, family


@pytest.fixture
def ends_at(monkeypatch):
    """Starts that end at given places of a bowl about zero, one after the other."""

    def prepare(*places):
        left = list(places)

        def baseline(setup, effects, begin, iterations):
            end = family(effects, Bowl(np.zeros(1)), np.array([left.pop(0)]))
            return end.fit, end.point

        def agree(fit, point, other, found):
            off = float(abs(point.z - other.z)[0])
            return SimpleNamespace(value=off, passed=off < 0.1)

        monkeypatch.setattr(fitting, "baseline", baseline)
        monkeypatch.setattr(fitting, "information", lambda fit, point: None)
        monkeypatch.setattr(fitting, "starts_agree", agree)
        first = family((), Bowl(np.zeros(1)), np.array([left.pop(0)]))
        best, other = fitting.begun_again(ALONE, first, 0, lambda line: None)
        return float(best.point.z[0]), float(other.point.z[0]), len(left)

    return prepare


@pytest.mark.parametrize(
    "places, kept, confirmed_by, not_begun",
    [
        pytest.param((0.10, 0.15, 9.0), 0.10, 0.15, 1, id="two agree"),
        pytest.param((0.15, 0.10, 9.0), 0.10, 0.15, 1, id="two agree, the second is nearer"),
        pytest.param((0.80, 0.10, 0.15), 0.10, 0.15, 0, id="the first had stopped in a side valley"),
        pytest.param((0.10, 0.80, 0.15), 0.10, 0.15, 0, id="the second had"),
        pytest.param((0.30, 0.60, 0.10), 0.10, 0.30, 0, id="none agree"),
    ],
)
def test_the_nearest_start_is_kept_and_the_one_that_agrees_confirms_it(ends_at, places, kept, confirmed_by, not_begun):
    assert ends_at(*places) == (kept, confirmed_by, not_begun)
