"""Faults of the logger: single wild samples, and stretches that stand still, at the limits that are stated."""

from pathlib import Path

import numpy as np
import pytest

from rockref.measure.faults import check_dropout, check_wild, wild_samples, without
from rockref.model.errors import InputError

NAMES = ["wx_deg_s", "wy_deg_s", "wz_deg_s"]
PATH = Path("run.csv")


def calm(count=400, rate=0.1):
    return np.full((count, 3), rate)


@pytest.mark.parametrize("first", [0, 1000, 1997])
def test_three_in_a_row_are_wild_and_four_are_not(first):
    crv = calm(2000)
    crv[first : first + 3, 1] = -9.0
    assert np.flatnonzero(wild_samples(crv, 0.6)).tolist() == [first, first + 1, first + 2]
    crv[max(first - 1, 0) : first + 4, 1] = -9.0
    crv[300, 2] = 9.0
    assert np.flatnonzero(wild_samples(crv, 0.6)).tolist() == [300]


@pytest.mark.parametrize(("expected", "limit"), [(0.6, 3.0), (0.01, 0.5)])
def test_wild_is_five_times_what_is_expected_or_what_one_in_a_hundred_has(expected, limit):
    """Five times 0.6 rad/s, or five times the 0.1 rad/s that all samples but one have."""
    for value, wild in ((limit * 0.999, False), (limit * 1.001, True)):
        crv = calm()
        crv[100, 0] = value
        assert wild_samples(crv, expected)[100] == wild


def test_what_is_exactly_five_times_is_not_wild():
    crv = calm()
    crv[100, 0] = 5.0
    assert not wild_samples(crv, 1.0).any()


def test_rows_are_drawn_straight_between_their_neighbours():
    crv = np.arange(10.0)[:, None] * [1.0, -2.0, 3.0]
    rows = np.zeros(10, bool)
    rows[[3, 4, 8]] = True
    damaged = np.where(rows[:, None], 99.0, crv)
    assert np.allclose(without(damaged, rows), crv, rtol=0.0, atol=1e-14)


@pytest.mark.parametrize("rows", [np.zeros(10, bool), np.ones(10, bool)])
def test_where_none_or_all_is_wild_the_rates_stay_as_they_are(rows):
    crv = calm(10)
    assert without(crv, rows) is crv


def test_wild_samples_are_refused_with_place_and_size():
    t, crv, rows = np.arange(10) * 0.5, np.zeros((10, 3)), np.zeros(10, bool)
    check_wild(t, crv, rows, NAMES, PATH)
    rows[[4, 7]] = True
    crv[4] = np.radians([1.0, -4000.0, 20.0])
    cure = "No block does that: leave these rows out, the reader draws a short gap straight. [E-SPIKE]"
    for words in ("2 wild samples, the first", "one wild sample,"):
        with pytest.raises(InputError) as caught:
            check_wild(t, crv, rows, NAMES, PATH)
        assert str(caught.value) == f"run.csv, column wy_deg_s: {words} with -4000 deg/s at 2 s. {cure}"
        rows[7] = False


def held(first, last, count=60):
    """Rates that change by 0.1 rad/s a sample, at 100 Hz, and stand still from `first` to `last`, both included."""
    place = np.arange(count)
    place = np.where((place >= first) & (place <= last), first, place)
    return np.arange(count) * 0.01, 0.1 * place[:, None] * [1.0, 2.0, -1.0]


def dropouts(t, crv, standing=None, expected=1.0):
    standing = np.ones(len(t), bool) if standing is None else standing
    return check_dropout(t, crv, standing, expected, PATH)


CURE = "The logger dropped out: cut the record before it, or leave these rows out where they are few."


def test_fifty_milliseconds_are_refused():
    """Six samples of one value at 100 Hz: fifty milliseconds."""
    t, crv = held(2, 7, 17)
    t = np.arange(17) * 0.010
    with pytest.raises(InputError) as caught:
        dropouts(t, crv)
    values = ", ".join(f"{0.2 * np.degrees(c):.4g}" for c in (1.0, 2.0, -1.0))
    what = f"all three rates are held at {values} deg/s from 0.02 to 0.07 s"
    assert str(caught.value) == f"run.csv: {what}. {CURE} [E-DROPOUT]"


@pytest.mark.parametrize(("last", "remarks"), [(2, 0), (3, 1), (6, 1)])
def test_ten_milliseconds_are_remarked_on(last, remarks):
    found = dropouts(*held(2, last, 17))
    assert len(found) == remarks
    if remarks:
        values = ", ".join(f"{0.2 * np.degrees(c):.4g}" for c in (1.0, 2.0, -1.0))
        what = f"all three rates are held at {values} deg/s from 0.02 to 0.0{last} s"
        assert str(found[0]) == f"run.csv: {what}. {CURE} [W-DROPOUT]"


def test_every_stretch_is_remarked_on():
    t, crv = held(5, 8)
    crv[30:33] = crv[30]
    assert [n.what.split("from ")[1] for n in dropouts(t, crv)] == ["0.05 to 0.08 s", "0.3 to 0.32 s"]


def test_two_rates_that_stand_still_are_none():
    t, crv = held(5, 20)
    crv[:, 1] = np.arange(len(t))
    assert dropouts(t, crv) == []


def test_what_has_fallen_over_may_stand_still():
    t, crv = held(5, 20)
    assert dropouts(t, crv, standing=t < 0.05) == []
    with pytest.raises(InputError):
        dropouts(t, crv, standing=t < 0.051)


def rest(count=60):
    return np.arange(count) * 0.01, np.zeros((count, 3))


@pytest.mark.parametrize(("jump", "fault"), [(0.098, False), (0.1, False), (0.102, True)])
@pytest.mark.parametrize("place", ["before", "after"])
def test_zeros_are_a_dropout_where_the_rate_jumps_by_a_twentieth(place, jump, fault):
    """Of 2 rad/s here, on all axes alike: into the zeros, which last to the end, or out of them."""
    t, crv = rest()
    # A slow rise to the jump, or a slow decay after it.
    if place == "before":
        crv[:20] = np.linspace(0.001, jump, 20)[:, None]
    else:
        crv[40:] = np.linspace(jump, 0.001, 20)[:, None]
    if fault:
        with pytest.raises(InputError, match="E-DROPOUT"):
            dropouts(t, crv, expected=2.0)
    else:
        assert dropouts(t, crv, expected=2.0) == []


def test_a_level_that_is_held_from_end_to_end_is_a_dropout():
    t, crv = rest()
    for level, fault in ((0.05, False), (0.06, True)):
        crv[:, 2] = -level
        if fault:
            with pytest.raises(InputError, match="from 0 to 0.59 s"):
                dropouts(t, crv)
        else:
            assert dropouts(t, crv) == []


def test_one_sample_before_a_stretch_shows_its_jump():
    t, crv = rest()
    crv[0, 0] = 0.3
    with pytest.raises(InputError, match="from 0.01 to 0.59 s"):
        dropouts(t, crv)


def test_a_rest_that_ends_gently_is_none():
    """The block begins to move by a hundredth of its rate; what it does a sample later is no jump out of the rest."""
    t, crv = rest()
    crv[40:, 0] = 0.01
    crv[41:, 0] = 0.3 + 0.001 * np.arange(19)
    assert dropouts(t, crv) == []
