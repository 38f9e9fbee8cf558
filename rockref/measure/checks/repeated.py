"""Numbers that stand twice in one record: rows that the logger wrote again, or one channel in two columns."""

from __future__ import annotations

import numpy as np

from rockref.measure.reading.columns import DEGREE
from rockref.measure.signals.signal import Signal
from rockref.model.errors import InputError

# decided: noise makes each row another one. Five equal rows in which the three rates change twelve times are a copy:
# with noise of one step, chance makes one in ten thousand records. A coarse step repeats its stairs with few changes.
LEAST_ROWS, LEAST_CHANGES = 5, 12
# decided: two channels of one record share one sample in two by a copy only.
SHARED = 0.5


def check_repeats(signal: Signal) -> None:
    """Refuse rows that stand twice in a record, and one channel in two columns (E-REPEAT)."""
    _check_columns(signal)
    crv = signal.crv
    found = repeated_rows(crv)
    if found is None:
        return
    earlier, first, count = found
    what = f"rows {first + 1} to {first + count} hold the numbers of rows {earlier + 1} to {earlier + count} again"
    what += f", from {signal.t[first]:.4g} s on"
    cure = "The logger wrote a block twice: use another run, or cut the record before it."
    raise InputError("E-REPEAT", signal.path, what, cure)


def repeated_rows(crv: np.ndarray) -> tuple[int, int, int] | None:
    """Return first row, row of its copy, and count of rows of crv (N, 3) that stand twice, the longest; or None."""
    _, kinds = np.unique(crv, axis=0, return_inverse=True)
    kinds = kinds.reshape(-1)
    order = np.argsort(kinds, kind="stable")
    again = kinds[order[1:]] == kinds[order[:-1]]
    # Of each row, how many rows before it the same numbers stood last; 0 where they did not.
    back = np.zeros(len(crv), dtype=np.int64)
    back[order[1:][again]] = (order[1:] - order[:-1])[again]
    changes = np.concatenate(([0], np.cumsum((np.diff(crv, axis=0) != 0.0).sum(axis=1))))
    best: tuple[int, int, int] | None = None
    edges = np.flatnonzero(np.diff(back)) + 1
    for first, last in zip(np.concatenate(([0], edges)), np.concatenate((edges, [len(back)])), strict=True):
        count = int(last - first)
        if back[first] < 2 or count < LEAST_ROWS or changes[last - 1] - changes[first] < LEAST_CHANGES:
            continue
        if best is None or count > best[2]:
            best = int(first - back[first]), int(first), count
    return best


def _check_columns(signal: Signal) -> None:
    """Refuse two columns that hold one channel, with one sign or the other (E-REPEAT)."""
    moving = np.abs(signal.crv) > 0.1 * signal.rate
    for a, b in ((0, 1), (0, 2), (1, 2)):
        x, y = signal.crv[:, a], signal.crv[:, b]
        rows = moving[:, a] | moving[:, b]
        if rows.sum() < LEAST_CHANGES or not max(np.mean(x[rows] == y[rows]), np.mean(x[rows] == -y[rows])) > SHARED:
            continue
        size = float(np.abs(x).max()) / DEGREE
        what = f"{signal.names[a]} and {signal.names[b]} hold the same numbers, up to {size:.3g} deg/s"
        raise InputError("E-REPEAT", signal.column(b), what, "Check which column holds which axis of the chip.")
