"""Numbers that wrap: a rate that runs over the end of its integer or of its range and goes on at the other end."""

from __future__ import annotations

import numpy as np

from rockref.measure.columns import DEGREE
from rockref.measure.signal import Signal
from rockref.model.errors import InputError

# decided: no sample of a block is further from the one before than half of the rate of its first swing.
LEAP = 0.5
# decided: leaps of one number are alike to a quarter of it, for the motion goes on between the samples, and begin and
# end within a quarter of it from its ends.
ALIKE, AT_END = 0.25, 0.25


def check_wraps(signal: Signal) -> None:
    """Refuse a rate that leaps from one end of its range to the other and back (E-WRAP)."""
    for axis in range(3):
        x = signal.crv[:, axis]
        leaps = np.diff(x)
        rows = np.flatnonzero(np.abs(leaps) > LEAP * signal.rate)
        if not len(rows):
            continue
        span = float(np.median(np.abs(leaps[rows])))
        alike = np.abs(np.abs(leaps[rows]) / span - 1.0) < ALIKE
        # From near one end to near the other, on either side of the middle of both.
        ends = (np.abs(np.abs(x[rows]) - 0.5 * span) < AT_END * span) & (x[rows] * x[rows + 1] < 0.0)
        if not (alike & ends).all() or not _goes_on(x, rows, leaps, span):
            continue
        row = int(rows[0])
        what = f"leaps from {x[row] / DEGREE:.4g} to {x[row + 1] / DEGREE:.4g} deg/s at {signal.t[row + 1]:.4g} s"
        if len(rows) > 1:
            what += f", and {len(rows)} times in all"
        cure = f"The numbers wrap around: add {span / DEGREE:.4g} deg/s where they do, or record with a larger range."
        raise InputError("E-WRAP", signal.column(axis), what, cure)


def _goes_on(x: np.ndarray, rows: np.ndarray, leaps: np.ndarray, span: float) -> bool:
    """Whether the rate x (N,) goes on as before once its leaps by `span` after `rows` are taken back."""
    turns = np.zeros(len(x))
    turns[rows + 1] = -np.sign(leaps[rows])
    whole = x + span * np.cumsum(turns)
    return bool(np.abs(np.diff(whole)).max() < 0.5 * np.abs(leaps[rows]).min())
