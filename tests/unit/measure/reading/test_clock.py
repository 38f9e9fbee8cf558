"""Time stamps as loggers write them: nothing is missing where rows over duration agree; sampling times are found."""

from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest

from rockref.measure.reading import timebase
from rockref.measure.reading.table import Table
from rockref.measure.reading.timebase import check_forward, regular_samples
from rockref.model.errors import InputError
from tests.refusal import refused

SECONDS = 3.0


def motion(t):
    """A smooth rate of some 30 deg/s that changes as fast as a rocking block's, rad/s."""
    return 0.5 * np.sin(2.0 * np.pi * t / 0.6) + 0.05 * np.sin(2.0 * np.pi * t / 0.11)


def recorded(stamps, taken, noise=1e-4):
    """A table whose rows were sampled at `taken` s and carry `stamps` s."""
    wx = motion(np.asarray(taken)) + noise * np.random.default_rng(0).standard_normal(len(taken))
    columns = {"t": np.asarray(stamps, dtype=np.float64), "wx": wx}
    return Table(Path("run.csv"), MappingProxyType(columns), MappingProxyType({"t": "t_s", "wx": "wx_deg_s"}), "", ())


def even(rate):
    return np.arange(int(SECONDS * rate)) / rate


def late(t, rows, length):
    """Rows that wait for `length` s are stamped one after the other before the next one."""
    t = t.copy()
    for row in rows:
        group = np.arange(row, row + round(length * 1000))
        t[group] = t[group[-1] + 1] - 2e-5 * np.arange(len(group), 0, -1)
    return t


def bunched(t, count, *, equal=False):
    """Rows that are read `count` at a time, stamped as they are read."""
    place = np.arange(len(t))
    return t[place // count * count] + (0.0 if equal else 2e-5) * (place % count)


TRUE = even(1000)
PLACE = np.random.default_rng(1).uniform(-0.5, 0.5, len(TRUE))
PAIRS = even(64.516)
STAMPS = {
    **{f"whole milliseconds at {rate} Hz": (np.floor(even(rate) * 1e3 + 1e-9) / 1e3, even(rate), rate)
       for rate in (400, 416, 667, 700, 750, 800, 833, 900, 952, 998, 1100, 2000, 8000)},
    "nearest milliseconds at 870 Hz": (np.round(even(870) * 1e3) / 1e3, even(870), 870),
    **{f"stalls of {ms} ms": (late(TRUE, range(100, 2700, 250), ms * 1e-3), TRUE, 1000) for ms in (2, 3, 5, 8, 60)},
    **{f"bunches of {count}": (bunched(TRUE, count), TRUE, 1000) for count in (2, 3, 4, 16, 100)},
    "pairs of equal stamps": (bunched(TRUE, 2, equal=True), TRUE, 1000),
    "intervals of 4 and 27 ms": (PAIRS - 11.5e-3 * (np.arange(len(PAIRS)) % 2), PAIRS, 64.516),
    "latency": (np.maximum.accumulate(TRUE + np.random.default_rng(2).exponential(5e-4, 3000)), TRUE, 1000),
    "latency that overtakes": (TRUE + np.random.default_rng(2).exponential(1e-3, 3000), TRUE, 1000),
    "jitter of the stamps": (TRUE + 0.9e-3 * PLACE, TRUE, 1000),
    "jitter of the samples": (TRUE + 0.9e-3 * PLACE, TRUE + 0.9e-3 * PLACE, 1000),
    "little jitter of the samples": (TRUE + 0.1e-3 * PLACE, TRUE + 0.1e-3 * PLACE, 1000),
}  # fmt: skip


@pytest.mark.parametrize("case", STAMPS)
def test_every_row_stays_and_its_sampling_time_is_found(case):
    stamps, taken, rate = STAMPS[case]
    t, _, filled, notices = regular_samples(recorded(stamps, taken), rate)
    assert filled == ()
    assert {n.code for n in notices} <= {"W-JITTER"}
    # A fifth of a sample: the time of the release is known to a rounding of the stamps only.
    assert np.abs(t - taken).max() < 0.2 / rate


def test_a_rate_that_is_off_is_told_rightly_behind_milliseconds():
    """998 samples a second where 1000 are stated: no sample is missing."""
    t, _, filled, notices = regular_samples(recorded(np.floor(even(998) * 1e3 + 1e-9) / 1e3, even(998)), 1000)
    assert filled == () and [n.code for n in notices] == ["W-RATE", "W-JITTER"]
    assert "samples come at 998.0" in notices[0].what
    with pytest.raises(InputError, match="samples come at 952.0.* not at 1000 Hz") as caught:
        regular_samples(recorded(np.floor(even(952) * 1e3 + 1e-9) / 1e3, even(952)), 1000)
    assert caught.value.code == "E-RATE"


GONE = np.delete(np.arange(len(TRUE)), [300, 301, 302, 1000])


@pytest.mark.parametrize(
    "stamps",
    [TRUE, TRUE + 0.3e-3 * PLACE, late(TRUE, range(110, 2700, 250), 3e-3), np.round(TRUE, 3)],
    ids=["clean", "jitter", "stalls", "milliseconds"],
)
def test_holes_are_found_among_other_faults(stamps):
    _, _, filled, notices = regular_samples(recorded(stamps[GONE], TRUE[GONE]), 1000)
    assert filled == (300, 301, 302, 1000)
    assert "W-GAP-FILLED" in {n.code for n in notices}


def test_a_lost_bunch_is_a_hole():
    """Between two readings a whole one is lost: it is the only interval between readings that is longer."""
    stamps = bunched(TRUE, 4)
    keep = np.delete(np.arange(len(TRUE)), range(800, 804))
    with pytest.raises(InputError, match="4 samples are missing between 0.79606 and 0.804 s") as caught:
        regular_samples(recorded(stamps[keep], TRUE[keep]), 1000)
    assert caught.value.code == "E-GAP"


BACK = {
    "a counter of 16 bits": (np.mod(TRUE, 0.65536), "The counter wraps: add 0.65536 s"),
    "a counter that wraps once": (np.mod(TRUE, 2.097152), "The counter wraps: add 2.09715 s"),
    "a clock that is set back": (np.where(TRUE > 1.5, TRUE - 0.3, TRUE), "The clock was set back there"),
    "two rows that changed places": (TRUE[np.r_[0:500, 501, 500, 502:3000]], "Sort the rows"),
    "a row twice": (TRUE[np.sort(np.r_[0:3000, 700])], "The row stands there twice: remove one"),
    "a stamp twice": (np.where(np.arange(3000) == 700, TRUE[699], TRUE), "export the time in finer units"),
    "a clock that stands": (np.zeros(3000), "The clock stands still"),
}  # fmt: skip

#: Few stamps [s], and what to do about the first that does not go forward.
SORT = "Sort the rows, or remove what was recorded twice."
CUT = "The clock was set back there, or two records were joined: cut the record before it."
TWICE = "Two rows have one time: remove what was recorded twice, or export the time in finer units."
FEW = {
    "one stamp twice": ([0.0, 0.1, 0.1, 0.2], 1, TWICE),
    "two neighbours": ([0.0, 0.1, 0.3, 0.2, 0.4], 2, SORT),
    "the last two": ([0.0, 0.1, 0.3, 0.2], 2, SORT),
    # Sorted the rows are even, though the one after the next is not yet past.
    "three in reverse": ([0.0, 0.1, 0.4, 0.3, 0.2, 0.5, 0.6], 2, SORT),
    "set back for good": ([0.0, 0.1, 0.2, 0.3, 0.15, 0.25, 0.35], 3, CUT),
    "set back by much": ([0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.22, 0.32, 0.42], 5, CUT),
    "set back at the end": ([0.0, 1.0, 2.0, 3.0, 1.0], 3, CUT),
    "a counter that wraps": ([0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0, 0.0], 3,
                             "The counter wraps: add 4 s to all times after each such row."),
    # The counter does not begin at zero, and wraps by not quite the same every time.
    "from five on": ([5.0, 6.0, 7.0, 8.0, 5.2, 6.2, 7.2, 8.2, 5.1], 3,
                     "The counter wraps: add 3.95 s to all times after each such row."),
    "back, not to the start": ([0.0, 1.0, 2.0, 3.0, 1.2, 2.2, 3.2], 3, CUT),
    # An equal stamp elsewhere is no way back.
    "a counter that wraps, and stands once": ([0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 1.0, 2.0, 3.0], 3,
                                              "The counter wraps: add 4 s to all times after each such row."),
    "wraps that differ by two samples": ([0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 0.0], 3,
                                         "The counter wraps: add 5 s to all times after each such row."),
    "by two samples and a half": ([0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 0.0, 0.5, 1.0, 1.5, -0.25], 6, CUT),
    "back by half of the record": ([0.0, 1.0, 0.0, 1.0, 2.0, 3.0, 4.0], 1, CUT),
    "neighbours before a hole": ([0.0, 0.1, 0.3, 0.2, 0.9], 2, SORT),
    "back to a clock that stands": ([0.0, 1.0, 0.0, 0.0, 0.0], 1, CUT),
    "back by different ways": ([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 0.0, 1.0, 2.0, 0.1], 6, CUT),
}  # fmt: skip


@pytest.mark.parametrize("case", FEW)
def test_times_without_a_stated_rate_only_have_to_run_forward(case):
    stamps, row, cure = FEW[case]
    error = refused(check_forward, recorded(stamps, stamps))
    assert (error.code, error.cure) == ("E-TIME", cure)
    assert error.what == f"time goes from {stamps[row]:g} to {stamps[row + 1]:g} s"
    assert error.where == f"run.csv, line {row + 1 + recorded(stamps, stamps).first_line}, column t_s"
    assert check_forward(recorded(stamps[: row + 1], stamps[: row + 1])) is None


@pytest.mark.parametrize("count", [2, 24])
def test_a_block_of_rows_that_was_written_twice_is_told_by_its_lines(count):
    """Whether a rate is stated or not; rows of the same times with other values are no copy."""
    rows = np.r_[0:700, 700 - count : 3000]
    table = recorded(TRUE[rows], TRUE[rows], noise=0.0)
    for check in (check_forward, lambda table: regular_samples(table, 1000)):
        error = refused(check, table)
        assert error.code == "E-TIME" and f"are the {count} before them again" in error.cure
        begin, end = int(error.cure.split()[1]), int(error.cure.split()[3])
        assert (begin, end) == (700 + table.first_line, 700 + count - 1 + table.first_line)
    other = refused(check_forward, recorded(TRUE[rows], np.arange(len(rows))))
    assert "again" not in other.cure
    for last, again in ((700 + count, True), (700 + count - 1, False)):  # the record ends with the copy, or within it
        part = TRUE[rows[:last]]
        assert ("again" in refused(check_forward, recorded(part, part, noise=0.0)).cure) is again


@pytest.mark.parametrize("case", BACK)
def test_each_way_back_has_its_own_advice(case):
    stamps, advice = BACK[case]
    taken = stamps if case == "a row twice" else TRUE[: len(stamps)]
    error = refused(regular_samples, recorded(stamps, taken, noise=0.0), 1000)
    assert error.code == "E-TIME" and advice in error.cure


#: Stamps [s] at one sample a second, of which some are equal, and whether they are taken: rows of a coarse clock come
#: at equal times at least three times, or stand among other steps that are half a sample off.
EQUAL = {
    "one pair, two odd steps": ([0.0, 1.0, 1.0, 3.0, 5.0, 6.0], TWICE),
    "two pairs": ([0.0, 1.0, 1.0, 2.0, 3.0, 3.0, 4.0], TWICE),
    "three pairs": ([0.0, 1.0, 1.0, 2.0, 3.0, 3.0, 4.0, 5.0, 5.0], None),
    "one pair, three steps of two": ([0.0, 1.0, 1.0, 3.0, 5.0, 7.0], None),
    "one pair, three steps of a half more": ([0.0, 1.0, 1.0, 2.5, 4.0, 5.5], None),
}


@pytest.mark.parametrize("case", EQUAL)
def test_equal_stamps_are_a_fault_unless_the_clock_is_coarse(case):
    stamps, cure = EQUAL[case]
    table, equal = recorded(stamps, stamps), np.flatnonzero(np.diff(stamps) == 0)
    if cure is None:
        assert timebase._check_equal(table, equal, 1.0) is None
    else:
        assert refused(timebase._check_equal, table, equal, 1.0).cure == cure


def test_equal_rows_stand_there_twice_only_where_the_time_has_no_room_for_them():
    stamps = np.array([0.0, 1.0, 2.0, 2.0, 3.5])  # half a row more than the time has room for
    assert refused(timebase._check_equal, recorded(stamps, stamps, noise=0.0), np.array([2]), 1.0).cure == TWICE


@pytest.mark.parametrize("ticks, rate, late", [
    ([0.0, 1.0, 3.5, 3.2, 4.0], 1000.0, True),  # sorted they are 1.2 intervals off: only their writing was late
    ([0.0, 1.0, 3.5, 2.5, 4.5], 1024.0, True),  # half an interval is not even
    ([0.0, 1.0, 3.0, 2.0, 4.0], 1000.0, False),  # even once they are sorted: rows out of order
    ([50.0, 1.0, 2.0], 1000.0, False),  # 50 ms late is another clock
])  # fmt: skip
def test_a_late_stamp_is_told_from_a_row_out_of_order(ticks, rate, late):
    assert timebase._overtake(np.array(ticks) / rate, rate) is late


def test_no_two_samples_are_at_one_time():
    pairs = bunched(TRUE, 2, equal=True)
    t, _, _, _ = regular_samples(recorded(pairs, pairs), 1000)
    assert np.diff(t).min() > 0
