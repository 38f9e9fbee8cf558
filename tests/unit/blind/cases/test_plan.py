"""Which cases are made."""

from collections import Counter

import pytest

from rockref.blind.cases.blocks import NEAR, OTHER
from rockref.blind.cases.faulty import FAULTS
from rockref.blind.cases.hidden import EFFECTS
from rockref.blind.cases.plan import (
    CONTROL,
    FAULTY,
    LEVER,
    MATCHED,
    PAIR,
    SINGLE,
    SIZES,
    UNLISTED,
    counts,
    listed,
    plan,
    shared,
)  # fmt: skip


@pytest.mark.parametrize("n", [1, 4, 5, 12, 60, 120, 187])
@pytest.mark.parametrize("block", [NEAR, OTHER])
def test_the_number_is_kept(n, block):
    near, other = (n, 0) if block == NEAR else (0, n)
    assert sum(counts(n, block).values()) == n == len(plan(1, near, other))
    assert {case.block for case in plan(1, near, other)} == {block}


def test_five_cases_have_one_of_each_kind_and_ten_have_a_matched_pair():
    kinds = {CONTROL, SINGLE, PAIR, UNLISTED, FAULTY}
    assert set(Counter(case.kind for case in plan(3, 5))) == kinds
    assert set(Counter(case.kind for case in plan(3, 10))) == kinds | {MATCHED}


def test_a_third_are_of_other_blocks_and_pairs_are_near_the_source():
    assert shared(120) == (80, 40) and shared(1) == (1, 0)
    cases = plan(4, *shared(120))
    assert Counter(case.block for case in cases) == {NEAR: 80, OTHER: 40}
    assert {case.block for case in cases if case.kind == MATCHED} == {NEAR}


def test_faulty_records_have_every_fault_and_nothing_hidden():
    faulty = [case for case in plan(6, 100) if case.kind == FAULTY]
    assert {case.fault for case in faulty} == set(FAULTS) and not any(case.effects for case in faulty)


def test_words_in_turn_for_either_kind_of_block():
    cases = listed(1, ["none", "wrapped"], 3, 2)
    assert Counter((case.block, case.kind) for case in cases) == {
        (NEAR, CONTROL): 2, (NEAR, FAULTY): 1, (OTHER, CONTROL): 1, (OTHER, FAULTY): 1,
    }  # fmt: skip
    assert cases == listed(1, ["none", "wrapped"], 3, 2) != listed(2, ["none", "wrapped"], 3, 2)
    each = listed(1, ["each:0.5"])
    assert [case.effects for case in each] == [((id, 0.5),) for id in EFFECTS]
    assert listed(1, [], 3, 2) == []


def test_two_hundred_cases_have_every_effect_at_every_size():
    singles = {case.effects[0] for case in plan(5, 190) if case.kind == SINGLE}
    assert singles >= {(id, size) for id in EFFECTS for size in SIZES}


def test_the_seed_decides():
    assert plan(9, 40) == plan(9, 40) and plan(9, 40) != plan(10, 40)
    seeds = Counter(case.seed for case in plan(9, 40) if case.kind != MATCHED)
    assert max(seeds.values()) == 1


def test_pairs_differ_in_the_cause_alone():
    pairs = [case for case in plan(2, 100) if case.kind == MATCHED]
    assert len(pairs) == 6
    for seed in {case.seed for case in pairs}:
        one, other = [case for case in pairs if case.seed == seed]
        assert one.runs == other.runs and one.same_as == other.same_as
        assert {one.effects[0][0], other.effects[0][0]} == set(one.same_as)
        assert not any(turned for *_, turned in one.runs)
    tilt, shift = (
        next(c.values[id]["y"] for c in pairs if id in c.values) for id in ("plate_tilt", "mass_eccentricity")
    )
    assert abs(shift) / LEVER == pytest.approx(abs(tilt)) or len({c.seed for c in pairs}) > 2


def test_cases_of_ones_own():
    cases = listed(1, ["none", "gyro_scale", "gyro_scale:2", "plate_tilt+gyro_drift", "sloshing"])
    assert [case.kind for case in cases] == [CONTROL, SINGLE, SINGLE, PAIR, UNLISTED]
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
