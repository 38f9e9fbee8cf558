"""What of a pair is needed, on bowls in place of fits."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover import window_rules as rules
from rockref.discover.fit.families import gain_over
from rockref.discover.looking import fewer
from rockref.discover.looking.fewer import both_needed, one_for_both, without
from rockref.discover.looking.look import Look
from tests.unit.discover.bowls import WINDOWS, Bowl, family

BOTH = ("rolling_resistance", "quadratic_drag")


@pytest.mark.parametrize("floor, left", [(1.0, ("quadratic_drag",)), (1.2, ("rolling_resistance", "quadratic_drag"))])
def test_a_pair_loses_the_effect_that_came_to_nothing_unless_the_fit_suffers(monkeypatch, floor, left):
    pair = family(("rolling_resistance", "quadratic_drag"), Bowl(np.array([0.1, 0.0, 1.0])), [0.1, 0.05, 1.0])
    single = Bowl(np.array([0.1, 1.0]), floor=floor)
    asked = []

    def baseline(setup, effects, z):
        asked.append((effects, tuple(z)))
        return single, single.point(z, np.zeros((WINDOWS, 5)))[0]

    monkeypatch.setattr(fewer, "baseline", baseline)
    assert without(None, pair, "rolling_resistance").effects == left
    assert asked == [(("quadratic_drag",), (0.1, 1.0))]


@pytest.mark.parametrize("share, left", [(0.9, ("quadratic_drag",)), (1.1, BOTH)])
def test_the_first_of_a_pair_has_to_gain_beside_the_second_what_a_second_has_to(monkeypatch, share, left):
    """Evenly softer feet were found first, where a contact stiffened; beside it they gained nothing."""
    pair = family(BOTH, Bowl(np.array([0.1, 0.4, 1.0])), [0.1, 0.4, 1.0])
    per_unit = 2 / float(np.sum(pair.fit.series.count))
    single = Bowl(np.array([0.1, 1.0]), floor=1.0 + share * rules.SECOND * per_unit)
    monkeypatch.setattr(fewer, "first_alone", lambda setup, found, seed: alone_with(BOTH[:1], 2.0))
    monkeypatch.setattr(
        fewer, "baseline", lambda setup, effects, z: (single, single.point(z, np.zeros((WINDOWS, 5)))[0])
    )
    monkeypatch.setattr(fewer, "finished", lambda setup, found, seed: found)
    said = []
    found = both_needed(None, pair, 0, said.append)
    assert found.effects == left and (found is pair) == (left == BOTH)
    alone = fewer.less(None, pair, "rolling_resistance")
    assert gain_over(alone, pair) == pytest.approx(share * rules.SECOND) and "rolling_resistance beside" in said[1]


@pytest.mark.parametrize("share, left", [(0.9, BOTH[:1]), (1.1, BOTH)])
def test_the_second_of_a_pair_has_to_gain_over_the_first_begun_where_the_pair_ended(monkeypatch, share, left):
    """Sides, feet and a centre of mass led out of one side valley alike; none of them was there."""
    pair = family(BOTH, Bowl(np.array([0.1, 0.4, 1.0])), [0.1, 0.4, 1.0])
    per_unit = 2 / float(np.sum(pair.fit.series.count))
    single = Bowl(np.array([0.1, 0.4]), floor=1.0 + share * rules.SECOND * per_unit)
    setup = SimpleNamespace(log=None, fit=lambda series, effects: single)
    alone = fewer.first_alone(setup, pair, 0)
    assert alone.effects == BOTH[:1] and tuple(alone.point.z) == (0.1, 0.4)
    assert gain_over(alone, pair) == pytest.approx(share * rules.SECOND)
    monkeypatch.setattr(fewer, "less", lambda setup, found, effect: alone_with(BOTH[1:], 2.0))
    monkeypatch.setattr(fewer, "finished", lambda setup, found, seed: found)
    said = []
    found = both_needed(setup, pair, 0, said.append)
    assert found.effects == left and (found is pair) == (left == BOTH) and "quadratic_drag beside" in said[0]


def alone_with(effects, floor):
    return family(effects, Bowl(np.array([0.1, 1.0]), floor=floor), [0.1, 1.0])


@pytest.mark.parametrize(
    "behind, size, stands",
    [(-90.0, 0.7, True), (20.0, 0.7, True), (40.0, 0.7, False), (400.0, 0.7, False), (-90.0, 0.1, False)],
)
def test_one_effect_stands_in_the_place_of_two_where_it_explains_as_much(monkeypatch, behind, size, stands):
    """An inertia and a tilt of the plate were told where the centre of mass alone was off."""
    pair = family(BOTH, Bowl(np.array([0.1, 0.4, 1.0])), [0.1, 0.4, 1.0])
    kept = family((), Bowl(np.array([0.1]), floor=1.5), [0.1])
    first = family(BOTH[:1], Bowl(np.array([0.1, 0.4]), floor=1.2), [0.1, 0.4])
    per_unit = 2 / float(np.sum(pair.fit.series.count))
    alone = family(("mass_eccentricity",), Bowl(np.array([0.1, 0.7]), floor=1.0 + behind * per_unit), [0.1, 0.7])
    look = Look(kept, [first], {BOTH[0]: gain_over(kept, first)})
    asked = []

    def first_steps(setup, kinds, plain):
        assert (plain.effects, tuple(plain.point.z)) == ((), (0.1,))
        asked.extend(kind.id for kind in kinds)
        return [alone]

    monkeypatch.setattr(fewer, "first_steps", first_steps)
    monkeypatch.setattr(fewer, "size_of", lambda found: size)
    monkeypatch.setattr(fewer, "refit_all", lambda setup, families, iterations, seed: families)
    monkeypatch.setattr(fewer, "finished", lambda setup, found, seed: found)
    setup = SimpleNamespace(
        fit=lambda series, effects: Bowl(np.array([0.1])), base=SimpleNamespace(points=8, active_effects=list), own=()
    )
    found = one_for_both(setup, look, pair, 0, [].append)
    assert not set(asked) & set(BOTH) and "mass_eccentricity" in asked
    assert (found is not None) == stands
    if stands:
        assert [f.effects for f in found.order] == [alone.effects, BOTH[:1]] and found.kept is kept
        assert found.gains["mass_eccentricity"] == pytest.approx(gain_over(kept, alone))
        assert look.order == [first]
