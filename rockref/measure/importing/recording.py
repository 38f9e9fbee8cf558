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

# A counter of 32 bits that starts anew.
_WRAP = 2.0**32
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
    chip = log.values[:, channels.rates]
    counts = _time_counts(log, channels)
    good = np.isfinite(chip).all(axis=1) & (np.isfinite(counts) if counts is not None else True)
    notices = [*log.notices, *_lost(log, int((~good).sum()))]
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
        t, found = _seconds(counts[good], channels, log.source)
        rate = rate or found
        keep = np.concatenate(([True], np.diff(t) > 0.0))
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


def _lost(log: Log, lost: int) -> list[Notice]:
    if not lost:
        return []
    what = f"{lost} of {len(log.values)} rows hold no number where a time or a rate should be"
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

        stamps = pd.to_datetime(pd.Series(log.words[channels.time]), errors="coerce", format="mixed")
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
