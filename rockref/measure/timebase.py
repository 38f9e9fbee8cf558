"""The time column: it runs forward, at the stated rate, without holes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from rockref.measure.notice import Notice
from rockref.measure.table import Table
from rockref.model.errors import InputError

# decided: a hole of three samples is shorter than a main impact (5 ms at 1 kHz); a longer one may hide an impact.
MAX_FILLED = 3
# decided: a logger that loses more than one sample in a hundred is not to be trusted with the others.
MAX_FILLED_SHARE = 0.01
# decided: one part in a hundred is another rate; two in ten thousand is more than a bad crystal (100 ppm) does.
RATE_ERROR, RATE_WARNING = 1e-2, 2e-4
# decided: the record starts at the release; a tenth of a second later the first swing can still be recognised.
LATEST_START = 0.1


def regular_samples(
    table: Table, sample_rate: float
) -> tuple[np.ndarray, Mapping[str, np.ndarray], tuple[int, ...], list[Notice]]:
    """Return time (N,) s, the other columns (N,) by quantity, the rows that were filled in, and notices.

    `sample_rate` is the stated rate in Hz. Holes of up to three samples are filled by linear interpolation.
    Raises InputError: E-TIME (runs back or stands still), E-RATE, E-GAP, E-START.
    """
    t, name = table.columns["t"], table.names["t"]
    where, notices = f"{table.path}, column {name}", list[Notice]()
    check_forward(table)
    if len(t) < 2:
        raise InputError("E-SHORT", str(table.path), "one row holds no motion", "Export the run again.")
    step = 1.0 / sample_rate
    jumps = np.diff(t)
    missing = _missing(jumps / step)
    _check_rate(t, jumps, missing, sample_rate, where, notices)
    _check_gaps(t, missing, table, name)
    _check_start(t, step, where, notices)
    jitter = float(np.abs(jumps - step * (missing + 1)).max()) / step
    # decided: stamps rounded to half a sample are off by as much; beyond, it is the clock that wanders.
    if jitter > 0.6:
        what = f"intervals between samples differ from 1/{sample_rate:g} s by up to {100 * jitter:.0f} %"
        notices.append(Notice("W-JITTER", where, what, "The time stamps were kept as they are."))
    others = {quantity: values for quantity, values in table.columns.items() if quantity != "t"}
    if not missing.any():
        return t, others, (), notices
    return *_fill(t, others, missing, where, notices), notices


def _missing(jumps: np.ndarray) -> np.ndarray:
    """Return how many samples are missing in each interval (N,), given in samples.

    An early or late stamp makes one interval long and its neighbour short: only what both together lack is missing.
    """
    missing = np.rint(jumps) - 1.0
    pairs = np.rint(jumps[1:] + jumps[:-1]) - 2.0
    missing[1:] = np.minimum(missing[1:], pairs)
    missing[:-1] = np.minimum(missing[:-1], pairs)
    return np.maximum(missing, 0.0).astype(np.int64)


def check_forward(table: Table) -> None:
    """Refuse a time column that runs back or stands still (E-TIME)."""
    t, name = table.columns["t"], table.names["t"]
    back = np.flatnonzero(np.diff(t) <= 0)
    if len(back):
        row = int(back[0]) + 1
        what = f"time goes from {t[row - 1]:g} to {t[row]:g} s"
        cure = "Sort the rows, or remove what was recorded twice."
        raise InputError("E-TIME", f"{table.path}, line {row + 2}, column {name}", what, cure)


def _check_rate(
    t: np.ndarray, jumps: np.ndarray, missing: np.ndarray, rate: float, where: str, notices: list[Notice]
) -> None:
    median = 1.0 / float(np.median(jumps))
    cure = "Correct sample_rate_hz, or the unit of the time column."
    # The median does not see holes; stamps rounded to whole milliseconds make it useless for fine differences.
    if abs(median / rate - 1.0) > 0.2:
        raise InputError("E-RATE", where, f"samples come at {median:.6g} Hz, not at {rate:g} Hz", cure)
    # An early stamp makes one interval short and the next one long: only what is missing counts beside the intervals.
    mean = float((len(jumps) + missing.sum()) / (t[-1] - t[0]))
    off = abs(mean / rate - 1.0)
    # With few samples the rounding of the first and last stamp is larger than the tolerance.
    slack = 1.0 / len(t)
    if off > RATE_ERROR + slack:
        raise InputError("E-RATE", where, f"samples come at {mean:.6g} Hz, not at {rate:g} Hz", cure)
    if off > RATE_WARNING + slack:
        what = f"samples come at {mean:.6g} Hz, not at {rate:g} Hz"
        notices.append(Notice("W-RATE", where, what, "The time stamps were believed, not the stated rate."))


def _check_gaps(t: np.ndarray, missing: np.ndarray, table: Table, name: str) -> None:
    cure = "Use a run without holes, or cut the record before it."
    wide = np.flatnonzero(missing > MAX_FILLED)
    if len(wide):
        row = int(wide[0]) + 1
        what = f"{missing[row - 1]} samples are missing between {t[row - 1]:g} and {t[row]:g} s"
        raise InputError("E-GAP", f"{table.path}, line {row + 2}, column {name}", what, cure)
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
    t: np.ndarray, columns: Mapping[str, np.ndarray], missing: np.ndarray, where: str, notices: list[Notice]
) -> tuple[np.ndarray, Mapping[str, np.ndarray], tuple[int, ...]]:
    old = np.arange(len(t)) + np.concatenate(([0], np.cumsum(missing)))
    new = np.arange(old[-1] + 1)
    rows = np.setdiff1d(new, old)
    what = f"{len(rows)} samples were missing, the first at {np.interp(rows[0], old, t):g} s"
    notices.append(Notice("W-GAP-FILLED", where, what, "They were filled in by linear interpolation."))
    filled = {quantity: np.interp(new, old, values) for quantity, values in columns.items()}
    return np.interp(new, old, t), filled, tuple(int(row) for row in rows)
