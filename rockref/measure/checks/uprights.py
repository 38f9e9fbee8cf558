"""Rows that are lost, or out of order, while the stamps go on: the rates no longer add up, or leap within an arc.

At every main impact the block stands upright: from one to the next its rate about X adds up to no angle. Between them
it is borne by one edge, and gravity alone changes that rate.
"""

from __future__ import annotations

import math

import numpy as np

from rockref.measure.reading.columns import DEGREE
from rockref.measure.records.notice import Notice
from rockref.measure.signals.running import half_width, running_mean
from rockref.measure.signals.signal import REFERENCE_SCALE, Signal
from rockref.model.errors import InputError

# In simulated records of 60 blocks of 2 cm to 2 m an arc's angle is off by at most 0.009 of first swing's rate times
# its duration. decided: three times that is no arc, beside the others of the record; an impact is known to two samples.
ODD_ARC, IMPACT_SAMPLES = 0.027, 2.0
# decided: an arc that reaches three tenths of the first swing's rate is long enough to be judged, and late rocking not.
LARGE_ARC = 0.3
# decided: away from upright, where three tenths of the release's tilt are left, all feet of one side stand.
AWAY = 0.3
# In the same records the rate about X leaps there by at most 0.05 of the first swing's from one sample to the next,
# the slope of the motion and the noise taken off. decided: a little more.
LEAP, NOISE_SIGMAS = 0.06, 6.0
# decided: where sqrt(R/g) has fewer than forty samples, impacts are not known well enough.
LEAST_SAMPLES = 40.0
# Fits follow the source's block so long [s]. decided: a later arc is told and not refused, since late rocking is
# irregular.
FOLLOWED = 3.0
# decided: the slope of an arc is that of 10 ms around a sample.
AROUND = 0.010


def check_uprights(signal: Signal) -> list[Notice]:
    """Refuse an arc whose rates add up to an angle (E-ROWS-LOST); remark on a late one, and on a leap within an arc
    (W-LEAP).

    An arc is judged beside the others of its record: a zero that is off, or a range that cuts, is off in all of them.
    """
    impacts = signal.impacts
    if len(impacts) < 3 or signal.scale * REFERENCE_SCALE < LEAST_SAMPLES * signal.step:
        return []
    leaps, arc, what = leaps_in_arcs(signal), odd_arc(signal), ""
    if arc is not None:
        begin, end = impacts.times[arc[0] : arc[0] + 2]
        what = f"the block stands upright at {begin:.4g} and at {end:.4g} s, and between them the rates add up to"
        what += f" {arc[1] / DEGREE:.3g} degrees"
        if begin < FOLLOWED * signal.scale:
            inside = leaps[(signal.t[leaps] > begin) & (signal.t[leaps] < end)]
            what += f"; the rate {_leap(signal, inside)}" if len(inside) else ""
            raise InputError("E-ROWS-LOST", signal.column(0), what, _CURE)
    elif len(leaps):
        what = _leap(signal, leaps)
    return [Notice("W-LEAP", signal.column(0), what, _CURE_OF_LEAP)] if what else []


_CURE = "Rows were lost or put out of order while the time went on: use another run, or cut the record before it."
_CURE_OF_LEAP = (
    "Rows are missing or out of order there, or something struck the block: look at the run, or leave it out."
)


def odd_arc(signal: Signal) -> tuple[int, float] | None:
    """Return the arc, by the impact that begins it, whose rates add up to an angle rad where the others' do not.

    None where all are alike.
    """
    impacts = signal.impacts
    turned = np.interp(impacts.times, signal.t, signal.turned)
    spans = np.diff(impacts.times)
    judged = (impacts.peaks[:-1] > LARGE_ARC * signal.rate) & (impacts.peaks[1:] > LARGE_ARC * signal.rate)
    if judged.sum() < 2:
        return None
    zero = zero_of((np.diff(turned) / spans)[judged])
    off = kept_shifts(turned - zero * impacts.times)
    # Where noise and resolution are all that is known of a rate, it may be off by them all along an arc.
    slack = IMPACT_SAMPLES * signal.step * signal.rate + signal.grain * spans
    odd = judged & (off > ODD_ARC * signal.rate * spans + slack)
    if not odd.any() or odd.sum() > max(1, len(spans) // 3):
        return None
    arc = int(np.argmax(np.where(odd, off, 0.0)))
    return arc, float(turned[arc + 1] - turned[arc])


def kept_shifts(uprights: np.ndarray) -> np.ndarray:
    """Return by what the turn at the impacts (M,) rad shifts over each arc and stays, (M - 1,) rad.

    What is lost with rows is missing from then on. An impact that a ringing sensor puts too late, or a block that leans
    while it stands, gives to one arc what it takes from the next: of the last two impacts before an arc and the first
    two after it, those that differ least tell.
    """
    M = len(uprights)
    pairs = [(i, j) for i in (0, 1) for j in (1, 2)]
    return np.array([
        min(abs(uprights[k + j] - uprights[k - i]) for i, j in pairs if k >= i and k + j < M) for k in range(M - 1)
    ])  # fmt: skip


def zero_of(rates: np.ndarray) -> float:
    """Return the rate [rad/s] by which a zero is off, from those that arcs (K,) add up to: it is the same in all.

    It is not more than their median, of which one odd arc changes nothing, nor more than the middle between their
    quartiles, of which nothing remains where a cut top, or a block that leans while it stands, takes from every other
    arc what it gives to the next. Of two arcs one is not more usual than the other.
    """
    if len(rates) < 3:
        return 0.0
    return min(float(np.median(rates)), float(np.quantile(rates, (0.25, 0.75)).mean()), key=abs)


def leaps_in_arcs(signal: Signal) -> np.ndarray:
    """Return the rows (K,) after which the rate about X leaps while the block is away from upright."""
    t, wx, turned, impacts = signal.t, signal.crv[:, 0], signal.turned, signal.impacts
    upright = np.interp(t, impacts.times, np.interp(impacts.times, t, turned))
    away = (np.abs(turned - upright) > AWAY * signal.tilt) & (t > impacts.times[0]) & (t < impacts.times[-1])
    steps = np.diff(wx)
    half = half_width(t, AROUND)
    # The slope around a step, without the step itself.
    mean, width = running_mean(steps, half), 2 * half + 1
    off = np.abs(steps - (mean * width - steps) / max(1, width - 1))
    noise = NOISE_SIGMAS * math.sqrt(2.0) * signal.gyro.noise + 2.0 * signal.gyro.resolution
    return np.flatnonzero((off > LEAP * signal.rate + noise) & away[1:] & away[:-1])


def _leap(signal: Signal, leaps: np.ndarray) -> str:
    row = int(leaps[0])
    size = (signal.crv[row + 1, 0] - signal.crv[row, 0]) / DEGREE
    what = f"leaps by {size:.3g} deg/s from row {row + 1} to the next, at {signal.t[row + 1]:.4g} s, far from upright"
    return what + (f", and at {len(leaps) - 1} other rows" if len(leaps) > 1 else "")
