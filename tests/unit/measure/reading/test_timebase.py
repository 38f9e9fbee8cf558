"""The time column runs forward, at the stated rate, without holes."""

from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest

from rockref.measure.reading.table import Table
from rockref.measure.reading.timebase import regular_samples
from tests.refusal import refusal, refused


def table(t):
    t = np.asarray(t, dtype=np.float64)
    columns = {"t": t, "wx": 10.0 * t}
    return Table(Path("run.csv"), MappingProxyType(columns), MappingProxyType({"t": "t_s", "wx": "wx_deg_s"}), "", ())


CLEAN = np.arange(1000) / 1000.0


def test_clean_time_passes_untouched():
    source = table(CLEAN)
    t, columns, filled, notices = regular_samples(source, 1000.0)
    assert t is source.columns["t"]
    assert list(columns) == ["wx"]
    assert filled == () and notices == []


def changed(row, value):
    t = CLEAN.copy()
    t[row] = value
    return t


@pytest.mark.parametrize(
    ("t", "rate", "code", "where", "words"),
    [
        (changed(500, 0.499), 1000.0, "E-TIME", "line 502", "from 0.499 to 0.499"),
        (CLEAN[::-1], 1000.0, "E-TIME", "line 3", "from 0.999"),
        # Stamps that are late catch up again; a clock that was set back goes on from there.
        (CLEAN - 0.02 * (CLEAN > 0.4995), 1000.0, "E-TIME", "line 502", "from 0.499 to 0.48"),
        (CLEAN * 2.0, 1000.0, "E-RATE", "t_s", "500 Hz"),
        (CLEAN / 2.0, 1000.0, "E-RATE", "t_s", "2000 Hz"),
        (CLEAN * 1000.0, 1000.0, "E-RATE", "t_s", "1 Hz"),
    ],
)
def test_faulty_time_is_refused_with_its_line(t, rate, code, where, words):
    error = refused(regular_samples, table(t), rate)
    assert error.code == code
    assert where in error.where
    assert words in error.what


@pytest.mark.parametrize(
    ("t", "code"), [(CLEAN * 1.005, "W-RATE"), (CLEAN + 0.01, "W-START"), (changed(500, 0.4993), "W-JITTER")]
)
def test_what_can_be_worked_with_is_said(t, code):
    got, _, filled, notices = regular_samples(table(t), 1000.0)
    assert [n.code for n in notices] == [code]
    assert np.array_equal(got, t)
    assert filled == ()


def test_stamps_rounded_to_the_millisecond_are_no_gaps():
    t = np.round(np.arange(1200) / 600.0, 3)
    _, _, filled, notices = regular_samples(table(t), 600.0)
    assert filled == () and notices == []


def stamped(late, count=1000):
    """Every eightieth stamp of a good clock of 1 kHz is late by so many seconds."""
    t = np.arange(count) / 1000.0
    t[40::80] += late
    return t


@pytest.mark.parametrize("late", [-0.0007, 0.0007])
def test_stamps_that_are_early_or_late_are_no_other_rate(late):
    """Twelve stamps of a thousand are off by seven tenths of a sample: no sample is missing, and none is too many."""
    t, _, filled, notices = regular_samples(table(stamped(late)), 1000.0)
    assert filled == () and len(t) == 1000
    words = "intervals between samples differ from 1/1000 s by up to 70 %. The time stamps were kept as they are."
    assert [str(n) for n in notices] == [f"run.csv, column t_s: {words} [W-JITTER]"]


@pytest.mark.parametrize(("late", "said"), [(0.00058, []), (0.00062, ["W-JITTER"])])
def test_a_stamp_may_be_off_by_six_tenths_of_a_sample(late, said):
    assert [n.code for n in regular_samples(table(stamped(late)), 1000.0)[3]] == said


@pytest.mark.parametrize(
    ("stretch", "codes"),
    [
        (1.0011, []),
        (1.0013, ["W-RATE"]),
        (0.9989, []),
        (0.9987, ["W-RATE"]),
        (1.0109, ["W-RATE"]),
        (0.9892, ["W-RATE"]),
    ],
)
def test_the_rate_may_be_off_by_a_hundredth_and_what_one_stamp_is_worth(stretch, codes):
    """Two ten thousandths are not said, beside the thousandth that one stamp is; a hundredth is not refused."""
    assert [n.code for n in regular_samples(table(stretch * CLEAN), 1000.0)[3]] == codes


@pytest.mark.parametrize("stretch", [1.0113, 0.9889])
def test_more_than_a_hundredth_is_another_rate(stretch):
    error = refused(regular_samples, table(stretch * CLEAN), 1000.0)
    what = f"samples come at {1000.0 / stretch:.6g} Hz, not at 1000 Hz"
    cure = "Correct sample_rate_hz, or the unit of the time column."
    assert str(error) == f"run.csv, column t_s: {what}. {cure} [E-RATE]"


def test_a_fifth_is_another_rate_whatever_the_holes():
    """Most intervals are 1.25 samples: it is the median that says so, before anything else."""
    error = refused(regular_samples, table(1.26 * CLEAN), 1000.0)
    assert error.what == "samples come at 793.651 Hz, not at 1000 Hz"
    assert error.cure == "Correct sample_rate_hz, or the unit of the time column."


def test_what_is_said_of_another_rate():
    notices = regular_samples(table(1.005 * CLEAN), 1000.0)[3]
    what = "samples come at 995.025 Hz, not at 1000 Hz. The time stamps were believed, not the stated rate."
    assert [str(n) for n in notices] == [f"run.csv, column t_s: {what} [W-RATE]"]


@pytest.mark.parametrize("gone", [[1], [998], [1, 2, 3], [500, 501, 502], [996, 997, 998], [1, 998]])
def test_holes_are_filled_wherever_they_are(gone):
    t, columns, filled, notices = regular_samples(table(np.delete(CLEAN, gone)), 1000.0)
    assert filled == tuple(gone)
    assert np.allclose(t, CLEAN, rtol=0.0, atol=1e-15) and np.allclose(
        columns["wx"], 10.0 * CLEAN, rtol=0.0, atol=1e-14
    )
    what = f"{len(gone)} samples were missing, the first at {CLEAN[gone[0]]:g} s"
    cure = "They were filled in by linear interpolation."
    assert [str(n) for n in notices] == [f"run.csv, column t_s: {what}. {cure} [W-GAP-FILLED]"]


def test_a_hole_beside_a_late_stamp_is_filled_once():
    t = CLEAN.copy()
    t[500] += 0.0004
    assert regular_samples(table(np.delete(t, [501])), 1000.0)[2] == (501,)
    assert regular_samples(table(np.delete(t, [499])), 1000.0)[2] == (499,)


def holed(count):
    """A clock of so many samples, of which ten are missing, one by one."""
    return table(np.delete(np.arange(count) / 1000.0, np.arange(50, 450, 40)))


def test_one_sample_in_a_hundred_may_be_missing():
    """Of those that are there: ten beside a thousand, and not beside one less."""
    assert len(regular_samples(holed(1010), 1000.0)[2]) == 10
    error = refused(regular_samples, holed(1009), 1000.0)
    cure = "Use a run without holes, or cut the record before it."
    assert str(error) == f"run.csv, column t_s: 10 of 1009 samples are missing. {cure} [E-GAP]"


def test_what_is_said_of_a_wide_hole():
    error = refused(regular_samples, table(np.delete(CLEAN, [300, 301, 302, 303, 600, 601, 602, 603])), 1000.0)
    what = "4 samples are missing between 0.299 and 0.304 s"
    cure = "Use a run without holes, or cut the record before it."
    assert str(error) == f"run.csv, line 302, column t_s: {what}. {cure} [E-GAP]"


@pytest.mark.parametrize(("start", "codes"), [(-0.0005, []), (0.0015, []), (0.0016, ["W-START"]), (0.1, ["W-START"])])
def test_time_begins_at_the_release(start, codes):
    assert [n.code for n in regular_samples(table(CLEAN + start), 1000.0)[3]] == codes


@pytest.mark.parametrize("start", [-0.0006, 0.1001])
def test_time_that_begins_elsewhere_is_refused(start):
    error = refused(regular_samples, table(CLEAN + start), 1000.0)
    cure = "Time is counted from the release: shift the column, and cut what was recorded before it."
    assert str(error) == f"run.csv, column t_s: time starts at {start:g} s. {cure} [E-START]"


def test_what_is_said_of_a_late_start():
    notices = regular_samples(table(CLEAN + 0.01), 1000.0)[3]
    said = "run.csv, column t_s: time starts at 0.01 s. The first samples are missing. [W-START]"
    assert [str(n) for n in notices] == [said]


def test_two_rows_are_enough_for_a_clock_and_one_is_not():
    assert len(regular_samples(table([0.0, 0.001]), 1000.0)[0]) == 2
    said = ("E-SHORT", "run.csv", "one row holds no motion", "Export the run again.")
    assert refusal(regular_samples, table([0.0]), 1000.0) == said


def stamps_alone(t):
    """A table of times without a rate that would tell when its rows were taken."""
    return Table(Path("run.csv"), MappingProxyType({"t": t}), MappingProxyType({"t": "t_s"}), "", ())


WANDERING = CLEAN + 0.45e-3 * np.sin(2.1 * np.arange(1000))
TICKS = np.arange(1000) // 4 * 4e-3
EVENLY = "No sample is missing for that: rows were put at even intervals, 1000 a second."


@pytest.mark.parametrize(
    ("t", "kept", "what", "cure"),
    [
        (WANDERING, True, "intervals between samples differ from 1/1000 s by up to 78 %",
         "The time stamps were kept as they are."),
        # Read four at a time: stamps tell of the reading.
        (TICKS + 2e-5 * (np.arange(1000) % 4), False,
         "time stamps come in bunches of 4, and rows over duration are 1000 Hz", EVENLY),
        (np.arange(1000) // 2 * 2e-3 + 2e-5 * (np.arange(1000) % 2), False,
         "time stamps come in bunches of 2, and rows over duration are 1000 Hz", EVENLY),
        # A bunch's rows come in less than half of their time, if not at once.
        (np.arange(1000) // 2 * 2e-3 + 3.5e-4 * (np.arange(1000) % 2), False,
         "time stamps come in bunches of 2, and rows over duration are 1000 Hz", EVENLY),
        # Off by two steps of the clock, of which a rounding explains one.
        (np.round((CLEAN + 0.36e-3 * np.sin(2.1 * np.arange(1000))) * 5e3) / 5e3, True,
         "intervals between samples differ from 1/1000 s by up to 80 %", "The time stamps were kept as they are."),
        # What a clock of whole milliseconds rounds off, and no more.
        (np.floor(np.arange(1000) / 0.87) / 1e3, False,
         "intervals between samples differ from 1/870 s by up to 74 %",
         "No sample is missing for that: rows were put at even intervals, 870.003 a second."),
    ],
)  # fmt: skip
def test_without_rates_the_stamps_themselves_say_whether_rows_were_taken_at_them(t, kept, what, cure):
    rate = float(what.partition("1/")[2].split()[0]) if "1/" in what else 1000.0
    got, _, filled, notices = regular_samples(stamps_alone(t), rate)
    assert filled == () and np.array_equal(got, t) is kept
    assert [str(n) for n in notices] == [f"run.csv, column t_s: {what}. {cure} [W-JITTER]"]
    if not kept:
        assert np.ptp(np.diff(got)) < 1e-12


@pytest.mark.parametrize("first", [0, 1])
def test_rows_alike_in_a_still_stretch_are_no_row_twice(first):
    """Two rows a tick of the clock, all alike; as many as the stated rate has. One more stands there twice."""
    place = first + np.arange(1999)
    t = 0.01 + place // 2 / 1000.0
    still = MappingProxyType({"t": t, "wx": np.zeros(len(t))})
    names = MappingProxyType({"t": "t_s", "wx": "wx_deg_s"})
    assert len(regular_samples(Table(Path("run.csv"), still, names, "", ()), 2000.0)[0]) == 1999
    more = MappingProxyType({"t": np.append(t, t[-1]), "wx": np.zeros(len(t) + 1)})
    error = refused(regular_samples, Table(Path("run.csv"), more, names, "", ()), 2000.0)
    assert error.cure == "The row stands there twice: remove one."


def test_a_row_twice_late_in_a_record_is_told_with_its_line():
    t = 0.05 + np.sort(np.append(CLEAN, CLEAN[700]))
    error = refused(regular_samples, table(t), 1000.0)
    assert (error.cure, error.where) == ("The row stands there twice: remove one.", "run.csv, line 703, column t_s")


def test_a_clock_that_stands_is_told_at_its_second_row():
    error = refused(regular_samples, table(np.full(50, 0.01)), 1000.0)
    assert error.where == "run.csv, line 3, column t_s" and error.what == "time goes from 0.01 to 0.01 s"
    assert error.cure == "The clock stands still: export the time stamps in finer units."


def test_what_is_said_of_time_that_runs_back():
    error = refused(regular_samples, table(changed(500, 0.1)), 1000.0)
    what, cure = "time goes from 0.499 to 0.1 s", "Sort the rows, or remove what was recorded twice."
    assert str(error) == f"run.csv, line 502, column t_s: {what}. {cure} [E-TIME]"
