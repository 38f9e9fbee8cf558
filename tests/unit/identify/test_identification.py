"""The rounds of an identification: searched on the signals again while the least squares end above the noise floor."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.identify import identification
from rockref.identify.identification import identify
from rockref.identify.polish import FLOOR, Effort
from rockref.identify.search import Settings

WORK = SimpleNamespace(threads=1)


@pytest.fixture
def rounds(monkeypatch, table_3_1, twin):
    """Identify with least squares that end at given mean squares; returns the end, and what was asked on the way."""
    from rockref.identify.genes import space_12

    space = space_12(table_3_1)

    def prepare(ends, most):
        left, asked = list(ends), []

        def search(cost, shared, size, settings, campaign, identity, path, resume, report):
            asked.append((cost.__name__, settings.seed, settings.mean, identity.get("round")))
            return SimpleNamespace(u=np.full(size, 0.01 * len(asked)))

        def polish(space, targets, u, step, workers, z=False, effort=None):
            chi2 = left.pop(0)
            asked.append(("polish", z, effort.windows))
            return SimpleNamespace(chi2=chi2, z=np.full(12, chi2), at_floor=chi2 < FLOOR)

        monkeypatch.setattr(identification, "search", search)
        monkeypatch.setattr(identification, "polish", polish)
        monkeypatch.setattr(identification, "evaluate", lambda *a: [(0.0, ["terms"])])
        effort = Effort(windows=(0.0,))
        found = identify(space, [twin], [twin], Settings(4, 2, seed=7), WORK, rounds=most, effort=effort)
        return found, asked

    return prepare


def test_at_the_noise_floor_there_is_no_further_round(rounds):
    found, asked = rounds([1.01], 3)
    assert found.rounds == 0 and found.at_floor and found.terms == ["terms"]
    assert asked == [("feature_costs", 7, None, None), ("polish", False, (0.0,))]


def test_above_it_the_signals_are_searched_from_where_the_best_ended(rounds):
    found, asked = rounds([2.0, 3.0, 1.01], 3)
    assert found.rounds == 2 and found.at_floor
    # The second round, too, begins at the end of the first least squares: those of the first round were worse.
    assert asked[2:] == [
        ("signal_costs", 1007, (2.0,) * 12, 1), ("polish", True, ()),
        ("signal_costs", 2007, (2.0,) * 12, 2), ("polish", True, ()),
    ]  # fmt: skip


def test_after_the_last_round_the_best_is_kept_though_it_is_above_the_floor(rounds):
    found, _ = rounds([2.0, 1.5, 1.8], 2)
    assert found.rounds == 2 and found.polished.chi2 == 1.5 and not found.at_floor
