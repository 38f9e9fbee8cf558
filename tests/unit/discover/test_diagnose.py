"""The moves of a diagnosis, on bowls in place of fits: where it begins, and the pruning of a pair."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover import diagnose
from rockref.discover.diagnose import beginning, ranked_by, without
from rockref.discover.looking.look import Look
from tests.unit.discover.bowls import WINDOWS, Bowl, family


@pytest.mark.parametrize("floor, left", [(1.0, ("quadratic_drag",)), (1.2, ("rolling_resistance", "quadratic_drag"))])
def test_a_pair_loses_the_effect_that_came_to_nothing_unless_the_fit_suffers(monkeypatch, floor, left):
    pair = family(("rolling_resistance", "quadratic_drag"), Bowl(np.array([0.1, 0.0, 1.0])), [0.1, 0.05, 1.0])
    single = Bowl(np.array([0.1, 1.0]), floor=floor)
    asked = []

    def baseline(setup, effects, z):
        asked.append((effects, tuple(z)))
        return single, single.point(z, np.zeros((WINDOWS, 5)))[0]

    monkeypatch.setattr(diagnose, "baseline", baseline)
    assert without(None, pair, "rolling_resistance").effects == left
    assert asked == [(("quadratic_drag",), (0.1, 1.0))]


@pytest.mark.parametrize(
    "sensor, plain, builds_on",
    [
        (1.0, 4.0, ("gyro_scale",)),  # it explains what follows, too
        (1.6, 2.9, ()),  # it leaves all windows structured, and the baseline's own turn ends less than twice above
        (1.6, 3.5, ("gyro_scale",)),  # the baseline is far worse
        (1.0, 1.001, ()),  # hardly better than the baseline
    ],
)
def test_what_the_release_suggested_is_built_on_if_it_explains_what_follows(monkeypatch, sensor, plain, builds_on):
    asked = []

    def baseline(setup, effects=(), z=None, iterations=None):
        asked.append(effects)
        bowl = Bowl(np.zeros(1 + len(effects)), floor=sensor if effects else plain)
        return bowl, bowl.point(np.zeros(1 + len(effects)), np.zeros((WINDOWS, 5)))[0]

    monkeypatch.setattr(diagnose, "baseline", baseline)
    own = SimpleNamespace(prior=1.0)
    setup = SimpleNamespace(workers=1, parameters=lambda effects: [own] * (1 + len(effects)))
    seen = {"loss": 1.0, "z": np.zeros(1), "starts": {("gyro_scale",): np.zeros(2)}}
    null, start = beginning(setup, [(), ("gyro_scale",)], seen)
    assert (null.effects, start.effects) == ((), builds_on)
    assert asked == [(), ("gyro_scale",)] + [()] * (sensor > 1.5)


def test_the_first_of_a_pair_is_ranked_by_what_both_gain():
    """It may have a small gain of its own in the last look, as a second effect beside the one whose place it took."""
    null = family((), Bowl(np.zeros(1), floor=1.5), np.zeros(1))
    pair = family(("rolling_resistance", "quadratic_drag"), Bowl(np.array([0.1, 0.5, 1.0])), [0.1, 0.5, 1.0])
    gains = ranked_by(null, pair, Look(null, [], {"rolling_resistance": 5.0, "quadratic_drag": 300.0, "adhesion": 7.0}))
    assert gains["rolling_resistance"] > 100 and gains["quadratic_drag"] == 300.0 and gains["adhesion"] == 7.0
    # What the release named was in no look.
    alone = family(("rolling_resistance",), Bowl(np.array([0.1, 0.5])), [0.1, 0.5])
    assert ranked_by(null, alone, Look(alone, [], {}))["rolling_resistance"] > 100
