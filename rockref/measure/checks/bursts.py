"""Bursts: samples that leap away from the motion for some milliseconds and leap back.

They come before everything that integrates a rate: one sample of 5000 deg/s at 500 Hz is 10 degrees, and the block
seems to fall over.
"""

from __future__ import annotations

import math

import numpy as np

from rockref.measure.reading.columns import DEGREE
from rockref.measure.records.notice import Notice
from rockref.measure.signals.signal import Signal, stretches
from rockref.model.errors import InputError

# decided: a fault of the bus spoils nine samples at most; what lasts longer is a dropout, a wrap, or another motion.
LONGEST = 9
# In simulated records of 60 blocks of 2 cm to 2 m the largest leap out and back within nine samples is 0.08 of the
# first swing's rate from 500 Hz on, and 0.23 at 100 Hz, where nine samples are a large part of a small block's swing.
# decided: more than twice the one, and a third more than the other where sqrt(R/g) has fewer than twenty samples.
LEAP, LEAP_SLOW, FEW_SAMPLES = 0.18, 0.3, 20.0
# decided: noise of six standard deviations, and two steps of the resolution, are no leap.
SIGMAS, STEPS = 6.0, 2.0
# decided: at an end of the record a burst does not leap back; half of the first swing's rate is more than an impact's.
LEAP_AT_END = 0.5
# decided: after a burst the motion goes on where it was, to half of the leap.
BACK = 0.5
# decided: three samples may be drawn straight, as where they are missing, and three such places say enough.
DRAWN, FEW = 3, 3
# decided: no motion of the block has five times the largest rate that it can have.
WILD = 5.0


def burst_samples(x: np.ndarray, least: float) -> np.ndarray:
    """Return which samples, (N,) bool, of a rate x (N,) rad/s leap by `least` rad/s and back within nine samples."""
    leaps = np.diff(x)
    size = np.abs(leaps)
    out = np.zeros(len(x), dtype=bool)
    for length in range(1, min(LONGEST, len(leaps) - 1) + 1):
        lower = np.minimum(size[:-length], size[length:])
        change = np.abs(x[length + 1 :] - x[: -length - 1])
        for first in np.flatnonzero((lower > least) & (change < BACK * lower)):
            inside = x[first + 1 : first + 1 + length]
            level = 0.5 * (x[first] + x[first + 1 + length])
            # All of it stands off: a leap of the motion between two bursts is none.
            if np.abs(inside - level).min() > 0.5 * least:
                out[first + 1 : first + 1 + length] = True
    return out


def burst_at_ends(x: np.ndarray, least: float) -> np.ndarray:
    """Return which samples, (N,) bool, of a rate x (N,) rad/s before or after the motion are off by `least` rad/s."""
    out = np.zeros(len(x), dtype=bool)
    for seen, marks in ((x, out), (x[::-1], out[::-1])):
        leaps = np.abs(np.diff(seen[: 2 * LONGEST + 1]))
        for last in np.flatnonzero(leaps[:LONGEST] > least):
            # The motion goes on quietly after it, and none of these samples belongs to it.
            if (
                leaps[last + 1 :].max(initial=0.0) < 0.5 * least
                and np.abs(seen[: last + 1] - seen[last + 1]).min() > least
            ):
                marks[: last + 1] = True
    return out


def sample_noise(crv: np.ndarray) -> np.ndarray:
    """Return the noise of a sample of each channel, (3,) rad/s, from second differences of crv (N, 3): their median."""
    second = crv[2:] - 2.0 * crv[1:-1] + crv[:-2]
    # Of normal numbers the median distance is 0.6745 standard deviations; a second difference has six variances.
    return np.median(np.abs(second), axis=0) / (0.6745 * math.sqrt(6.0))


def check_bursts(signal: Signal) -> tuple[np.ndarray, np.ndarray, list[Notice]]:
    """Return the rates (N, 3) rad/s with short bursts drawn straight, the rows that were, (N,) bool, and remarks.

    Up to three places of up to three samples are drawn (W-SPIKE). Raises InputError E-SPIKE for more, for longer ones,
    and where a value is out of all reason.
    """
    slow = math.sqrt(0.5 * math.hypot(signal.width, signal.height) / 9.81) < FEW_SAMPLES * signal.step
    size = max(signal.rate, float(np.percentile(np.abs(signal.crv).max(axis=1), 95.0)))
    least = (LEAP_SLOW if slow else LEAP) * size
    least += STEPS * signal.gyro.resolution
    noise = np.maximum(signal.gyro.noise, sample_noise(signal.crv))
    at_end = max(LEAP_AT_END * size, least)
    wild: np.ndarray = np.stack(
        [
            burst_samples(x, least + SIGMAS * rest) | burst_at_ends(x, at_end + SIGMAS * rest)
            for x, rest in zip(signal.crv.T, noise, strict=True)
        ],
        axis=-1,
    )
    rows = np.asarray(wild.any(axis=1))
    if not rows.any():
        return signal.crv, rows, []
    places = [(axis, first, last) for axis in range(3) for first, last in stretches(wild[:, axis])]
    longest = max(last - first for _, first, last in places)
    largest = float(np.abs(signal.crv[wild]).max())
    if longest > DRAWN or len(places) > FEW or largest > WILD * size:
        raise _refusal(signal, places)
    drawn = signal.crv.copy()
    row = np.arange(len(drawn))
    for axis in np.flatnonzero(wild.any(axis=0)):
        out = wild[:, axis]
        drawn[out, axis] = np.interp(row[out], row[~out], drawn[~out, axis])
    cure = "No impact does that: look for a fault of the logger. They were drawn straight."
    notices = [Notice("W-SPIKE", signal.column(axis), _words(signal, axis, [(a, b)]), cure) for axis, a, b in places]
    return drawn, rows, notices


def _refusal(signal: Signal, places: list[tuple[int, int, int]]) -> InputError:
    """Return the refusal of bursts at `places`: axis, first row, last row (exclusive), of one axis the first."""
    axis = min(places, key=lambda place: place[1])[0]
    own = [(first, last) for other, first, last in places if other == axis]
    few = all(last - first <= DRAWN for first, last in own)
    cure = "No block does that: leave these rows out, the reader draws a short gap straight."
    if not few:
        cure = "No block does that: look for a fault of the logger, and cut the record before it."
    return InputError("E-SPIKE", signal.column(axis), _words(signal, axis, own), cure)


def _words(signal: Signal, axis: int, places: list[tuple[int, int]]) -> str:
    first, last = places[0]
    inside = signal.crv[first:last, axis]
    value = inside[np.argmax(np.abs(inside))] / DEGREE
    count = sum(b - a for a, b in places)
    many = "one sample leaps" if count == 1 else f"{count} samples leap"
    where = f"with {value:.4g} deg/s at {signal.t[first]:.4g} s (row {first + 1})"
    if count == 1:
        return f"{many} away and back, {where}"
    if len(places) == 1:
        return f"{count} samples in a row leap away and back, {where}"
    return f"{many} away and back at {len(places)} places, the first {where}"
