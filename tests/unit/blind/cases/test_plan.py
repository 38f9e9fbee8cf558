"""Which cases are made."""

from collections import Counter

import pytest

from rockref.blind.cases.hidden import EFFECTS
from rockref.blind.cases.plan import CONTROL, LEVER, OUTSIDER, PAIR, SINGLE, SIZES, TWIN, counts, listed, plan


@pytest.mark.parametrize("n", [1, 4, 5, 12, 60, 120, 187])
def test_the_number_is_kept(n):
    assert sum(counts(n).values()) == n == len(plan(1, n))


def test_five_cases_have_one_of_each_kind():
    assert set(Counter(case.kind for case in plan(3, 5))) == {CONTROL, SINGLE, PAIR, OUTSIDER, TWIN}


def test_two_hundred_cases_have_every_effect_at_every_size():
    singles = {case.effects[0] for case in plan(5, 190) if case.kind == SINGLE}
    assert singles >= {(id, size) for id in EFFECTS for size in SIZES}


def test_the_seed_decides():
    assert plan(9, 40) == plan(9, 40) and plan(9, 40) != plan(10, 40)
    seeds = Counter(case.seed for case in plan(9, 40) if case.kind != TWIN)
    assert max(seeds.values()) == 1


def test_twins_differ_in_the_cause_alone():
    twins = [case for case in plan(2, 100) if case.kind == TWIN]
    assert len(twins) == 8
    for seed in {case.seed for case in twins}:
        one, other = [case for case in twins if case.seed == seed]
        assert one.runs == other.runs and one.same_as == other.same_as
        assert {one.effects[0][0], other.effects[0][0]} == set(one.same_as)
        assert not any(turned for *_, turned in one.runs)
    tilt, shift = (
        next(c.values[id]["y"] for c in twins if id in c.values) for id in ("plate_tilt", "mass_eccentricity")
    )
    assert abs(shift) / LEVER == pytest.approx(abs(tilt)) or len({c.seed for c in twins}) > 2


def test_cases_of_ones_own():
    cases = listed(1, ["none", "gyro_scale", "gyro_scale:2", "plate_tilt+gyro_drift", "sloshing"])
    assert [case.kind for case in cases] == [CONTROL, SINGLE, SINGLE, PAIR, OUTSIDER]
    assert cases[2].effects == (("gyro_scale", 2.0),)
    with pytest.raises(ValueError, match="gyro_scal"):
        listed(1, ["gyro_scal"])


@pytest.mark.parametrize("word", ["gyro_scale:nan", "gyro_scale:0", "gyro_scale:-1", "gyro_scale:inf", "gyro_scale:x"])
def test_a_size_that_is_none_is_refused(word):
    """Nothing, or what is no number, would be hidden, and be sealed as an effect."""
    with pytest.raises(ValueError, match=f"^{word}$"):
        listed(1, ["none", word])


def test_an_effect_twice_in_a_case_is_refused():
    with pytest.raises(ValueError, match="gyro_scale"):
        listed(1, ["gyro_scale+gyro_scale:2"])
