"""The time column: it runs forward, at the stated rate, without holes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from rockref.measure.reading.clock import (
    EVEN,
    LEAST_BEATS,
    bunch_length,
    even_clock,
    follows_stamps,
    missing_samples,
    numbers_of,
    quantum,
)
from rockref.measure.reading.columns import RATES
from rockref.measure.reading.table import Table
from rockref.measure.records.notice import Notice
from rockref.model.errors import InputError

# decided: a hole of three samples is shorter than a main impact (5 ms at 1 kHz); a longer one may hide an impact.
MAX_FILLED = 3
# decided: a logger that loses more than one sample in a hundred is not to be trusted with the others.
MAX_FILLED_SHARE = 0.01
# decided: one part in a hundred is another rate; two in ten thousand is more than a bad crystal (100 ppm) does.
RATE_ERROR, RATE_WARNING = 1e-2, 2e-4
# decided: a logger writes a row within 50 ms; what is later is another clock.
LATEST_STAMP = 0.05
# decided: stamps that are late catch up within fifty rows; a sample and a half is no rounding of a clock.
SET_ROWS, SET_SAMPLES = 50, 1.5
# decided: the record starts at the release; a tenth of a second later the first swing can still be recognised.
LATEST_START = 0.1


def regular_samples(
    table: Table, sample_rate: float
) -> tuple[np.ndarray, Mapping[str, np.ndarray], tuple[int, ...], list[Notice]]:
    """Return sampling times (N,) s, the other columns (N,) by quantity, the rows that were filled in, and notices.

    `sample_rate` is the stated rate in Hz. Holes of up to three samples are filled by linear interpolation. The times
    are the stamps where the rates follow them; where stamps are rounded, late or bunched, those of the even clock.
    Remarks: W-JITTER, W-RATE, W-GAP-FILLED, W-START. Raises InputError: E-TIME, E-RATE, E-GAP, E-START, E-SHORT.
    """
    t, name = table.columns["t"], table.names["t"]
    where, notices = f"{table.path}, column {name}", list[Notice]()
    if len(t) < 2:
        raise InputError("E-SHORT", str(table.path), "one row holds no motion", "Export the run again.")
    check_order(table, sample_rate)
    missing = missing_samples(t, sample_rate)
    numbers = numbers_of(missing)
    start, interval = even_clock(t, numbers)
    _check_rate(1.0 / interval, len(t), sample_rate, where, notices)
    _check_gaps(t, missing, table, name)
    times = _sampling_times(table, numbers, start, interval, sample_rate, notices)
    _check_start(times, 1.0 / sample_rate, where, notices)
    others = {quantity: values for quantity, values in table.columns.items() if quantity != "t"}
    if not missing.any():
        return times, others, (), notices
    return *_fill(times, others, numbers, where, notices), notices


def _sampling_times(
    table: Table, numbers: np.ndarray, start: float, interval: float, stated: float, notices: list[Notice]
) -> np.ndarray:
    """Return when the samples were taken, (N,) s: at their stamps, or at the even clock's ticks; remark on jitter."""
    t, where = table.columns["t"], f"{table.path}, column {table.names['t']}"
    even = start + interval * numbers
    off = (t - even) / interval
    if np.abs(off).max() <= EVEN:
        return t
    rising = bool((np.diff(t) > 0.0).all())
    follows = follows_stamps(off, [table.columns[axis] for axis in RATES if axis in table.columns]) and rising
    bunch = bunch_length(t, 1.0 / interval)
    if follows is None:
        follows = rising and bunch == 1 and not np.abs(off).max() <= 1.1 * quantum(t) / interval
    jitter = float(np.abs(np.diff(off)).max())
    # decided: stamps rounded to half a sample are off by as much; beyond, it is the clock that wanders.
    if jitter > 0.6:
        what = f"intervals between samples differ from 1/{stated:g} s by up to {100 * jitter:.0f} %"
        if bunch > 1:
            what = f"time stamps come in bunches of {bunch}, and rows over duration are {1.0 / interval:.6g} Hz"
        if follows:
            notices.append(Notice("W-JITTER", where, what, "The time stamps were kept as they are."))
        else:
            put = f"No sample is missing for that: rows were put at even intervals, {1.0 / interval:.6g} a second."
            notices.append(Notice("W-JITTER", where, what, put))
    return t if follows else even


def check_forward(table: Table) -> None:
    """Refuse a time column that runs back or stands still (E-TIME)."""
    t = table.columns["t"]
    back = np.flatnonzero(np.diff(t) <= 0)
    if len(back):
        raise _backwards(table, int(back[0]), _again(table, int(back[0])) or _advice(t, int(back[0])))


def check_order(table: Table, rate: float) -> None:
    """Refuse a time column that runs back, or in which rows stand twice (E-TIME).

    Equal stamps of other rows are those of a coarse clock, or of rows that are read together: the rate decides.
    """
    t = table.columns["t"]
    back = np.flatnonzero(np.diff(t) < 0)
    if len(back) and (_set_back(t, back, rate) or not _overtake(t, rate)):
        raise _backwards(table, int(back[0]), _again(table, int(back[0])) or _advice(t, int(back[0])))
    equal = np.flatnonzero(np.diff(t) == 0)
    _check_equal(table, equal, rate)


def _set_back(t: np.ndarray, back: np.ndarray, rate: float) -> bool:
    """Return whether stamps t (N,) s that run back after a row of `back` go on from there: late ones catch up again."""
    off = t - np.arange(len(t)) / rate
    for row in back:
        before, after = off[max(0, row + 1 - SET_ROWS) : row + 1], off[row + 1 : row + 1 + SET_ROWS]
        if len(after) >= SET_ROWS and float(np.median(before) - np.median(after)) * rate > SET_SAMPLES:
            return True
    return False


def _overtake(t: np.ndarray, rate: float) -> bool:
    """Return whether stamps t (N,) s are late by more than an interval, so that one passes the next, and rows are in
    order.

    Where rows are out of order their stamps are even once they are sorted.
    """
    off = t - np.arange(len(t)) / rate
    even = np.abs(np.diff(np.sort(t)) * rate - 1.0).max() < 0.5
    return not even and float(np.ptp(off)) < LATEST_STAMP


def _check_equal(table: Table, equal: np.ndarray, rate: float) -> None:
    """Refuse rows of equal stamps, after `equal`, that neither a coarse clock nor readings of many rows explain."""
    t = table.columns["t"]
    if not t[-1] > t[0]:
        raise _backwards(table, 0, "The clock stands still: export the time stamps in finer units.")
    if not len(equal):
        return
    twice = equal[np.all([values[equal] == values[equal + 1] for values in table.columns.values()], axis=0)]
    # Rows of a coarse clock may be equal where nothing moves; rows over duration say whether there are too many.
    if len(twice) and (len(t) - 1) > (t[-1] - t[0]) * rate + 0.5:
        raise _backwards(table, int(twice[0]), "The row stands there twice: remove one.")
    odd = np.abs(np.diff(t) * rate - 1.0) >= 0.5
    if len(equal) < LEAST_BEATS and odd.sum() <= LEAST_BEATS * len(equal):
        raise _backwards(table, int(equal[0]), _advice(t, int(equal[0])))


def _backwards(table: Table, row: int, cure: str) -> InputError:
    t, name = table.columns["t"], table.names["t"]
    what = f"time goes from {t[row]:g} to {t[row + 1]:g} s"
    return InputError("E-TIME", f"{table.path}, line {row + 1 + table.first_line}, column {name}", what, cure)


def _again(table: Table, row: int) -> str:
    """Say which lines to remove where the rows after `row` are those before it again; nothing where they are not."""
    t, first = table.columns["t"], row + 1
    count = int(np.argmax(t[row::-1] == t[first])) + 1
    columns = table.columns.values()
    if first + count > len(t) or any((x[first - count : first] != x[first : first + count]).any() for x in columns):
        return ""
    begin = first + table.first_line
    return f"Lines {begin} to {begin + count - 1} are the {count} before them again: remove them."


def _advice(t: np.ndarray, row: int) -> str:
    """Say what to do about stamps t (N,) s that go back, or stand, after `row`."""
    steps = np.diff(t)
    if steps[row] == 0.0:
        return "Two rows have one time: remove what was recorded twice, or export the time in finer units."
    usual = float(np.median(steps))
    back = np.flatnonzero(steps < 0)
    # A counter falls back by its whole range, each time by the same, and goes on as before.
    wrap = usual - float(np.median(steps[back]))
    if (
        usual > 0.0
        and np.ptp(steps[back]) <= 2.0 * usual
        and wrap > 0.5 * float(np.ptp(t))
        and t[row + 1] - t.min() < usual
    ):
        return f"The counter wraps: add {wrap:.6g} s to all times after each such row."
    alone = row + 2 < len(t) and t[row + 2] > t[row]
    if alone or usual > 0.0 and np.abs(np.diff(np.sort(t)) / usual - 1.0).max() < 0.5:
        return "Sort the rows, or remove what was recorded twice."
    return "The clock was set back there, or two records were joined: cut the record before it."


def _check_rate(found: float, rows: int, stated: float, where: str, notices: list[Notice]) -> None:
    """Compare the rate of the rows, Hz, holes counted, with the stated one."""
    what = f"samples come at {found:.6g} Hz, not at {stated:g} Hz"
    off = abs(found / stated - 1.0)
    # With few samples the rounding of the first and last stamp is larger than the tolerance.
    slack = 1.0 / rows
    if off > RATE_ERROR + slack:
        cure = "Correct sample_rate_hz, or the unit of the time column."
        raise InputError("E-RATE", where, what, cure)
    if off > RATE_WARNING + slack:
        notices.append(Notice("W-RATE", where, what, "The time stamps were believed, not the stated rate."))


def _check_gaps(t: np.ndarray, missing: np.ndarray, table: Table, name: str) -> None:
    cure = "Use a run without holes, or cut the record before it."
    wide = np.flatnonzero(missing > MAX_FILLED)
    if len(wide):
        row = int(wide[0]) + 1
        what = f"{missing[row - 1]} samples are missing between {t[row - 1]:g} and {t[row]:g} s"
        raise InputError("E-GAP", f"{table.path}, line {row + table.first_line}, column {name}", what, cure)
    total = int(missing.sum())
    if total > MAX_FILLED_SHARE * len(t):
        what = f"{total} of {len(t) + total} samples are missing"
        raise InputError("E-GAP", f"{table.path}, column {name}", what, cure)


def _check_start(t: np.ndarray, step: float, where: str, notices: list[Notice]) -> None:
    cure = "Time is counted from the release: shift the column, and cut what was recorded before it."
    if t[0] < -0.5 * step or t[0] > LATEST_START:
        raise InputError("E-START", where, f"time starts at {t[0]:g} s", cure)
    if t[0] > 1.5 * step:
        notices.append(Notice("W-START", where, f"time starts at {t[0]:g} s", "The first samples are missing."))


def _fill(
    t: np.ndarray, columns: Mapping[str, np.ndarray], old: np.ndarray, where: str, notices: list[Notice]
) -> tuple[np.ndarray, Mapping[str, np.ndarray], tuple[int, ...]]:
    """Draw missing samples straight; `old` (N,) are the sample numbers of the rows that are there."""
    new = np.arange(old[-1] + 1)
    rows = np.setdiff1d(new, old)
    what = f"{len(rows)} samples were missing, the first at {np.interp(rows[0], old, t):g} s"
    notices.append(Notice("W-GAP-FILLED", where, what, "They were filled in by linear interpolation."))
    filled = {quantity: np.interp(new, old, values) for quantity, values in columns.items()}
    return np.interp(new, old, t), filled, tuple(int(row) for row in rows)
