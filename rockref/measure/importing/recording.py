"""A log as times and rates: seconds from the first row, numbers of the three rates, what the accelerometer shows."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np

from rockref.measure.importing.channels import Channels
from rockref.measure.importing.layout import MAX_LOST_SHARE, Log
from rockref.measure.importing.units import time_tick
from rockref.measure.records.notice import Notice
from rockref.model.errors import InputError

# A counter of 32 bits that starts anew, and a count of sixteen.
_WRAP, _SIGN = 2.0**32, 2.0**16
# decided: one row in five without any rate is no loss: two sensors write into one table.
_OTHER_SENSOR = 0.2
_UPDATE_RATE = re.compile(r"(?:update|output) ?rate[^\d]*([\d.]+)", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class Recording:
    """A log, read.

    Attributes: ``source``; ``t`` (N,) s from the first row; ``chip`` (N, 3), the rates in the log's unit and axes;
    ``accelerations`` (N, 3) or None, in any unit; ``rate`` Hz; ``log``, ``channels``; ``notices``.
    """

    source: str
    t: np.ndarray = field(repr=False)
    chip: np.ndarray = field(repr=False)
    accelerations: np.ndarray | None = field(repr=False)
    rate: float
    log: Log = field(repr=False)
    channels: Channels
    notices: tuple[Notice, ...] = ()

    @property
    def whole(self) -> bool:
        """Return whether all rates are whole numbers, as the counts of a chip are."""
        return bool(np.all(self.chip == np.rint(self.chip)))


def recording(log: Log, channels: Channels, rate: float | None = None) -> Recording:
    """Return times and rates of a log; `rate` Hz is the stated sample rate, needed where there is no time column.

    Raises InputError: E-ROWS-LOST, E-RATE, E-TIME, E-SHORT.
    """
    chip, notices = _signed(log, log.values[:, channels.rates])
    counts = _time_counts(log, channels)
    good = np.isfinite(chip).all(axis=1) & (np.isfinite(counts) if counts is not None else True)
    others = np.isnan(chip).all(axis=1)
    if _OTHER_SENSOR < others.mean() < 1.0:
        what = f"{int(others.sum())} of {len(chip)} rows hold no rate: those of another sensor"
        notices.append(Notice("W-ROWS-LOST", log.source, what, "They were left out."))
    else:
        others[:] = False
    notices += _lost(log, ~good & ~others)
    chip = chip[good]
    if len(chip) < 8:
        raise InputError("E-SHORT", log.source, f"{len(chip)} rows hold no motion", "Export the run again.")
    if counts is None:
        rate = rate or _rate_in_preamble(log)
        if rate is None:
            cure = "State the sample rate: --rate 1000."
            raise InputError("E-RATE", log.source, "has no time column that can be read", cure)
        t = np.arange(len(chip)) / rate
    else:
        # Rows without a rate have a time as well, and without them the mean interval would be too long.
        timed = np.isfinite(counts) & ~others
        t, found = _seconds(counts[timed], channels, log.source)
        t = t[good[timed]] - t[good[timed]][0]
        keep = np.concatenate(([True], np.diff(t) > 0.0))
        if rate is not None and (~keep).mean() > MAX_LOST_SHARE:
            what = f"time stands still or runs back in {int((~keep).sum())} of {len(t)} rows"
            notices.append(Notice("W-TIME", log.source, what, f"Rows were counted, {rate:g} a second, as stated."))
            t, keep = np.arange(len(t)) / rate, np.ones(len(t), dtype=bool)
        rate = rate or found
        _refuse_clock_set_back(t, 1.0 / rate, log)
        if not keep.all():
            if (~keep).sum() > max(1.0, MAX_LOST_SHARE * len(t)):
                what = f"time stands still or runs back in {int((~keep).sum())} of {len(t)} rows"
                raise InputError("E-TIME", log.source, what, "State the sample rate, or name another time column.")
            notices.append(Notice("W-TIME", log.source, f"time runs back in {int((~keep).sum())} rows", "Left out."))
            t, chip, good[np.flatnonzero(good)[~keep]] = t[keep], chip[keep], False
    accelerations = log.values[good][:, channels.accelerations] if channels.accelerations is not None else None
    if accelerations is not None and not np.isfinite(accelerations).all():
        accelerations = None
    return Recording(log.source, t, chip, accelerations, rate, log, channels, tuple(notices))


def _signed(log: Log, chip: np.ndarray) -> tuple[np.ndarray, list[Notice]]:
    """Return counts (N, 3) of sixteen bits that were written without their sign as they were meant, and the remark."""
    some = chip[np.isfinite(chip).all(axis=1)]
    whole = len(some) > 0 and bool((some == np.rint(some)).all()) and some.min() >= 0.0
    # Small rates of both signs lie at both ends of the range, and none in its middle.
    if not whole or not 0.9 * _SIGN < some.max() < _SIGN or np.mean(np.abs(some - 0.5 * _SIGN) < 0.2 * _SIGN) > 0.2:
        return chip, list(log.notices)
    cure = "Counts of the upper half of sixteen bits were taken as negative."
    notice = Notice(
        "W-SIGN-LOST", log.source, f"the rates are whole numbers up to {some.max():.0f}, none negative", cure
    )
    return np.where(chip >= 0.5 * _SIGN, chip - _SIGN, chip), [*log.notices, notice]


def _refuse_clock_set_back(t: np.ndarray, step: float, log: Log) -> None:
    """Refuse times (N,) s that run back by more than two samples and go on from there (E-TIME)."""
    back = np.flatnonzero(np.diff(t) < -2.0 * step)
    for row in back:
        if row + 1 < len(t) and t[row + 1 :].min(initial=np.inf) < t[row] and (t[row + 1 : row + 4] < t[row]).all():
            what = f"time runs back by {1e3 * (t[row] - t[row + 1]):.4g} ms at row {row + 2} of {len(t)}, and goes on"
            cure = "The clock was set there: cut the file before it, or leave it out: --rate 1000 --columns gx,gy,gz."
            raise InputError("E-TIME", log.source, what, cure)


def _lost(log: Log, gone: np.ndarray) -> list[Notice]:
    lost = int(gone.sum())
    if not lost:
        return []
    what = f"{lost} of {len(log.values)} rows hold no number where a time or a rate should be"
    what += f", the first is row {int(gone.argmax()) + 1}"
    if lost > max(2.0, MAX_LOST_SHARE * len(log.values)):
        raise InputError(
            "E-ROWS-LOST", log.source, what, "Export the run again, or name the columns: --columns t,gx,gy,gz."
        )
    return [Notice("W-ROWS-LOST", log.source, what, "They were left out.")]


def _time_counts(log: Log, channels: Channels) -> np.ndarray | None:
    """Return the time column as numbers (N,): dates as seconds, empty columns as None."""
    if channels.time is None:
        return None
    if channels.time in log.words:
        import pandas as pd

        words = pd.Series(log.words[channels.time])
        # Dates with points between their parts begin with the day.
        days_first = bool(words.str.match(r"\d{1,2}\.\d{1,2}\.\d{4}").mean() > 0.5)
        stamps = pd.to_datetime(words, errors="coerce", format="mixed", dayfirst=days_first)
        if stamps.isna().mean() > MAX_LOST_SHARE:
            return None
        return (stamps - stamps.iloc[0]).dt.total_seconds().to_numpy(np.float64)
    counts = log.values[:, channels.time].copy()
    return counts if np.isfinite(counts).any() else None


def _seconds(counts: np.ndarray, channels: Channels, source: str) -> tuple[np.ndarray, float]:
    """Return times (N,) s from the first row and the sample rate [Hz] of a time column in its own counts."""
    jumps = np.diff(counts)
    if np.any(jumps < -0.5 * _WRAP):
        counts = counts + _WRAP * np.concatenate(([0], np.cumsum(jumps < -0.5 * _WRAP)))
        jumps = np.diff(counts)
    forward = jumps[jumps > 0.0]
    if not len(forward):
        raise InputError("E-TIME", source, "the time column stands still", "Name another: --columns t,gx,gy,gz.")
    # The mean interval: stamps in whole milliseconds, or of several samples at once, spoil the median.
    typical = forward[forward < 20.0 * np.median(forward)]
    step = float(typical.mean())
    tick = time_tick(step, channels.ticks, source)
    return (counts - counts[0]) * tick, 1.0 / (step * tick)


def _rate_in_preamble(log: Log) -> float | None:
    """Return the sample rate [Hz] that a preamble states, as ``// Update Rate: 100.0Hz``."""
    for line in log.preamble:
        match = _UPDATE_RATE.search(line)
        if match and float(match[1]) > 0.0:
            return float(match[1])
    return None
