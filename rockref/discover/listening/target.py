"""What a run listens to: the rates and the turns of the block that a record tells of, the sensor undone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from rockref.discover.listening.attitude import attitudes
from rockref.discover.provenance import ZERO_OFFSETS
from rockref.effects.base import Effect
from rockref.measure.records.release import Gyro, Run

#: Least rate of the ticks [Hz]; decided: between ticks of 0.5 ms rates are straight to a thousandth over a contact of
#: 1.5 ms (as `rockref.measure.gyroscope` has it).
TICK_RATE = 2000.0
#: Samples through which rates between samples are read.
NODES = 6
#: How far a record is looked at beyond the last tick [s]; decided: a low-pass of 10 Hz has forgotten it by then.
BEYOND = 0.1
#: How far a run listens beyond its end [s] (decided: the electronics of a gyroscope of 100 Hz have passed on by then
#: what happens at the end).
FARTHER = 0.03
#: Share of it by which a recorder's clock may be slow, and the run go on (decided: a clock that is out by as much as
#: that loses an hour a day).
SLOW_CLOCK = 0.05
#: Intervals of two clocks are alike where their ratio changes by no more over a record (decided: rounding of instants).
ALIKE = 1e-9
#: Share of an interval by which instants may be uneven and are taken as they are (decided: 0.03 ms at 1 kHz).
UNEVEN = 0.03


class Behind(NamedTuple):
    """What is behind the electronics: instants t (N,) [s] of the record's rows, and rates (K, 3) [rad/s] at the
    ticks."""

    t: np.ndarray
    rates: np.ndarray


@dataclass(frozen=True)
class Grid:
    """The instants at which a run listens: `count` ticks, `interval` s apart, from the release on."""

    interval: float
    count: int

    @property
    def t(self) -> np.ndarray:
        """Return the instants (count,) [s]."""
        return self.interval * np.arange(self.count)


def grid(sample_rate: float, end: float) -> Grid:
    """Return the ticks up to `end` s and a little beyond: whole parts of a sample, at TICK_RATE or above."""
    parts = math.ceil(TICK_RATE / sample_rate - 1e-9)
    interval = 1.0 / (sample_rate * parts)
    return Grid(interval, ticks_upto(end, interval))


def ticks_upto(end: float, interval: float) -> int:
    """Return how many ticks [s] a run needs of which a record tells up to `end` s of the recorder's time."""
    return int(((1 + SLOW_CLOCK) * end + FARTHER) / interval) + 2


@dataclass(frozen=True)
class Target:
    """Rates (K, 3) [rad/s] and turns since the release (K, 3, 3) at the ticks, and what of them is heard, (K, 4).

    heard : factors 0 or 1 of the three rates and of the turn.
    """

    rates: np.ndarray
    turns: np.ndarray
    heard: np.ndarray

    def less(self, offset: tuple[float, ...], ticks: Grid) -> Target:
        """Return the target with an offset of the rates (3,) [rad/s] taken off."""
        if not any(offset):
            return self
        rates = self.rates - np.array(offset)
        return Target(rates, attitudes(np.eye(3), rates, ticks.interval), self.heard)


def zero_offset(model) -> tuple[float, ...]:
    """Return what is left of the gyroscope's zero (3,) [rad/s] in the run of a model, by the notes in its origin."""
    return tuple(float(model.origin.get(name, 0.0)) for name in ZERO_OFFSETS)


def target_of(run: Run, gyro: Gyro, effects: Sequence[Effect], ticks: Grid, undone: dict[tuple, Behind]) -> Target:
    """Return what a record tells of the block if its sensor had these effects.

    The sensor is undone in reverse order: recorder, electronics, the data sheet's low-pass, mounting. Beyond the end of
    a record, and where it was cut flat, nothing is heard.
    undone : what is behind the electronics, by their effects, of this run and these ticks; what is new is added. A
    mounting turns and scales each instant by itself, so it is undone at the ticks alone
    """
    assert run.t is not None and run.crv is not None
    from rockref.effects import catalogue

    rows = run.t <= ticks.interval * ticks.count + BEYOND
    t, crv = even(run.t[rows], run.crv[rows])
    heard = catalogue.heard(effects, t, crv)
    if gyro.range is not None:
        heard &= np.abs(crv) < gyro.range * (1 - 1e-6)
    at, behind = ticks.t, tuple(e for e in effects if e.stage != "mounting")
    if behind not in undone:
        dated, (t, crv) = t, catalogue.undone(behind, t, crv, gyro.bandwidth)
        undone[behind] = Behind(t, between(t, crv, at, dated))
    t = undone[behind].t
    _, rates = catalogue.undone([e for e in effects if e.stage == "mounting"], at, undone[behind].rates)
    seen = np.ones((len(at), 3), bool)
    for j in np.flatnonzero(~heard.all(axis=0)):
        seen[:, j] = np.interp(at, t, heard[:, j].astype(float)) > 0.999
    seen &= (at <= t[-1])[:, None]
    whole = np.logical_and.accumulate(seen.all(axis=1))
    return Target(
        rates, attitudes(np.eye(3), rates, ticks.interval), np.concatenate([seen, whole[:, None]], axis=1).astype(float)
    )


def between(t: np.ndarray, crv: np.ndarray, at: np.ndarray, dated: np.ndarray | None = None) -> np.ndarray:
    """Return rates (K, 3) at instants `at`: Lagrange's polynomial through the six samples (N, 3) about each.

    t : (N,) [s], even, or true instants of rows that a clock whose rate moves has dated evenly, `dated` (N,) [s].
    Beyond its ends the first or the last sample.  Straight lines between samples of 2 ms cut the corners of an impact
    by ten noise widths, and a model that listens to them follows.
    """
    if dated is None or alike(t, dated):
        first, shares = nodes_about(float(t[0]), float(t[-1]), len(t), at)
    else:
        # The place is straight between samples to a millionth of one: a clock moves by 1e-5 of itself from one to the
        # next, and a chord leaves an arc by an eighth of that.
        first, shares = nodes_at(np.interp(at, t, np.arange(len(t))), len(t))
    rates = np.zeros((len(at), 3))
    for k in range(shares.shape[1]):
        rates += shares[:, k, None] * crv[first + k]
    return rates


def alike(t: np.ndarray, dated: np.ndarray) -> bool:
    """Return whether the instants t (N,) of rows are their dates (N,) on another scale."""
    return bool(np.ptp(np.diff(t) / np.diff(dated)) <= ALIKE)


def nodes_about(start: float, end: float, count: int, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the first of the samples about each instant (K,), and the shares of those (K, nodes)."""
    return _nodes_about(start, end, count, at.tobytes())


@lru_cache(maxsize=32)
def _nodes_about(start: float, end: float, count: int, instants: bytes) -> tuple[np.ndarray, np.ndarray]:
    at = np.frombuffer(instants)
    return nodes_at(np.clip((at - start) * ((count - 1) / (end - start)), 0, count - 1), count)


def nodes_at(place: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the first of the `count` samples about each place (K,), counted in samples, and the shares of those."""
    nodes = min(NODES, count)
    first = np.clip(np.floor(place).astype(int) - nodes // 2 + 1, 0, count - nodes)
    away = (place - first)[:, None] - np.arange(nodes)
    shares = np.empty((len(place), nodes))
    for k in range(nodes):
        others = [j for j in range(nodes) if j != k]
        shares[:, k] = np.prod(away[:, others], axis=1) / math.prod(k - j for j in others)
    return first, shares


def even(t: np.ndarray, crv: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return a record at even instants: as it is where its own are even, cubic between its samples where they are not.

    Only what the run listens to is moved; innovations are taken at the instants of the record.
    """
    step = float(t[-1] - t[0]) / (len(t) - 1)
    if np.max(np.abs(np.diff(t) - step)) <= UNEVEN * step:
        return t, crv
    from scipy.interpolate import CubicSpline

    at = t[0] + step * np.arange(len(t))
    return at, np.clip(CubicSpline(t, crv)(at), crv.min(axis=0), crv.max(axis=0))
