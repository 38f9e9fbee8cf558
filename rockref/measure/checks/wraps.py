"""Numbers that wrap: a rate that runs over the end of its integer or of its range and goes on at the other end."""

from __future__ import annotations

import numpy as np

from rockref.measure.checks.bursts import LONGEST
from rockref.measure.reading.columns import DEGREE
from rockref.measure.signals.signal import Signal
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
        span = float(np.median(np.abs(leaps[rows] - _going_on(leaps, rows))))
        alike = np.abs(np.abs(leaps[rows]) / span - 1.0) < ALIKE
        if not alike.all() or not _between_ends(x, rows, span) or not _goes_on(x, rows, leaps, span):
            continue
        row = int(rows[0])
        what = f"leaps from {x[row] / DEGREE:.4g} to {x[row + 1] / DEGREE:.4g} deg/s at {signal.t[row + 1]:.4g} s"
        if len(rows) > 1:
            what += f", and {len(rows)} times in all"
        size = f"about {span / DEGREE:.4g} deg/s"
        cure = f"The numbers wrap around: where they do, add the whole range of the sensor, {size}."
        raise InputError("E-WRAP", signal.column(axis), what, cure)


def _going_on(steps: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Return what the motion itself adds to the leaps after `rows`: the mean of the steps beside each that do not leap.

    steps : from each sample to the next (N - 1,)
    """
    quiet = np.ones(len(steps) + 2)  # of the steps, and of what is before and behind them
    quiet[[0, -1]] = quiet[rows + 1] = 0.0
    beside = np.concatenate(([0.0], steps, [0.0])) * quiet
    return (beside[rows] + beside[rows + 2]) / np.maximum(quiet[rows] + quiet[rows + 2], 1.0)


def _between_ends(x: np.ndarray, rows: np.ndarray, span: float) -> bool:
    """Return whether all leaps of x (N,) after `rows` go from near one end of a range `span` to near the other.

    The middle of the range is zero, or, where a value stays beyond for longer than a burst, the middle of the values:
    numbers without a sign begin at their own zero.
    """
    stays = np.diff(np.concatenate(([-1], rows, [len(x) - 1])))
    longest = min(stays[0::2].max(), stays[1::2].max())
    if longest <= LONGEST and len(rows) == 1:
        return False  # a burst at an end of the record
    before, after = x[rows], x[rows + 1]
    if bool(((np.abs(np.abs(before) - 0.5 * span) < AT_END * span) & (before * after < 0.0)).all()):
        return True
    low, high = np.minimum(before, after) - x.min(), x.max() - np.maximum(before, after)
    # A single leap is that of a block that falls and lies.
    return bool(longest > LONGEST and len(rows) > 1 and np.maximum(low, high).max() < AT_END * span)


def _goes_on(x: np.ndarray, rows: np.ndarray, leaps: np.ndarray, span: float) -> bool:
    """Return whether the rate x (N,) goes on as before once its leaps by `span` after `rows` are taken back."""
    turns = np.zeros(len(x))
    turns[rows + 1] = -np.sign(leaps[rows])
    whole = x + span * np.cumsum(turns)
    return bool(np.abs(np.diff(whole)).max() < 0.5 * np.abs(leaps[rows]).min())
